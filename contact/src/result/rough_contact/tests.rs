//! Rough contacts with known islands, areas and gaps.

use std::sync::Arc;

use approx::assert_relative_eq;
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{HeightMap, MapCompliance, ReliefMap};

use super::*;
use crate::{
    Boundary, Domain, FlatPunch, IndenterMap, Load, LoadingPath, Paraboloid, SolverOptions, Step,
    solve_path,
};

/// A half-space of `E* = 1` with a relief below an indenter, under one force.
fn path(
    relief: Relief,
    indenter: Indenter,
    domain: Domain,
    elements: usize,
    force: f64,
) -> LoadingPath {
    let body = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    let model = Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter,
        cache: Cache::none(),
    };
    let (options, loads) = (SolverOptions::default(), [Load::Force(force)]);
    solve_path(&model, domain, elements, &loads, &options, &mut ()).unwrap()
}

/// A map of n × n samples of a height.
fn map(n: usize, side: f64, height: impl Fn([f64; 2]) -> f64) -> HeightMap {
    let at = |i: usize| ((i as f64 + 0.5) / n as f64 - 0.5) * side;
    let heights = (0..n * n).map(|k| height([at(k / n), at(k % n)]));
    HeightMap::new(heights.collect(), [n; 2], [side; 2]).unwrap()
}

fn rough(step: &Step) -> &RoughContact {
    step.rough.as_ref().unwrap()
}

/// Two equal paraboloids of radius 1 at x = ±0.4: the plain sum over the elements.
#[test]
fn two_bumps_are_two_islands_with_a_hull_around_them() {
    let bumps = map(64, 2.0, |[x, y]| -0.5 * ((x.abs() - 0.4).powi(2) + y * y));
    let relief = ReliefMap::new(bumps, MapCompliance::Uniform(0.0)).unwrap();
    let plane = FlatPunch::new(9.0).unwrap();
    let domain = Domain::Side(1.6);
    let path = path(Relief::Map(relief), plane.into(), domain, 128, 0.002);
    let (step, grid) = (&path.steps[0], &path.grid);
    let (found, pressure) = (rough(step), &step.solution.pressure);
    let pressed: Vec<usize> = (0..grid.len()).filter(|e| pressure[*e] > 0.0).collect();
    let island = pressed.len() as f64 / 2.0 * grid.element_area();
    let Islands {
        count,
        largest_area,
        mean_area,
        ..
    } = found.islands;
    assert_eq!((count, largest_area, mean_area), (2, island, island));
    assert_relative_eq!(
        found.counted_area,
        pressed.len() as f64 * grid.element_area(),
        max_relative = 1e-12
    );
    let cut = 0.118_114_16 * found.perimeter * grid.element_side();
    assert_relative_eq!(
        found.corrected_area,
        found.counted_area - cut,
        max_relative = 1e-8
    );
    // The hull of two discs of radius a: π a² + 2a · distance. The polygon of elements matches it to within an element.
    let radius = (step.summary.contact_area / 2.0 / std::f64::consts::PI).sqrt();
    let hull = |a: f64, from: f64| std::f64::consts::PI * a * a + 2.0 * a * from;
    let [inner, outer] = [-0.5, 0.5].map(|more| hull(radius + more * grid.element_side(), 0.8));
    assert!((inner..outer).contains(&found.nominal_area), "{found:?}");
    assert_eq!(found.pressures.total(), pressed.len());
    // The hull carries the force at its nominal pressure.
    let nominal = step.summary.nominal_pressure.unwrap();
    assert_relative_eq!(nominal * found.nominal_area, 0.002, max_relative = 1e-12);
    // The mean gap from the whole surface: between the outermost tangents |y| < a, from disc to disc.
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let within = |e: &usize| {
        let [x, y] = [grid.centre(e / grid.size()), grid.centre(e % grid.size())];
        let beyond = (x.abs() - 0.4).max(0.0);
        beyond.hypot(y) <= radius
    };
    let gaps: Vec<f64> = (0..grid.len())
        .filter(within)
        .map(|e| surface.gap[e].max(0.0))
        .collect();
    let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
    // The hull includes a further rim of one element, where gaps are small.
    assert_relative_eq!(found.mean_gap, mean, max_relative = 0.03);
}

#[test]
fn the_nominal_area_of_a_cell_is_the_whole_cell() {
    let q = std::f64::consts::PI;
    // The map extends beyond the cell, as far as its lowest point may be moved.
    let waves = map(192, 6.0, |[x, y]| {
        0.01 * (1.0 - (q * x).cos() * (q * y).cos())
    });
    let indenter = IndenterMap::new(waves).into();
    let path = path(Relief::Bare, indenter, Domain::Periodic(2.0), 64, 0.004);
    assert_eq!(path.boundary, Boundary::Periodic);
    let found = rough(&path.steps[0]);
    assert_relative_eq!(found.nominal_area, 4.0, max_relative = 1e-12);
    assert_eq!(path.steps[0].summary.nominal_pressure, Some(0.004 / 4.0));
    // One crest in the middle, and one around the corners of the cell.
    assert_eq!(found.islands.count, 2);
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let mean = surface.gap.iter().sum::<f64>() / surface.gap.len() as f64;
    // Gaps in contact are zero to the certificate's tolerance.
    assert_relative_eq!(found.mean_gap, mean, max_relative = 1e-7);
    let open = surface.gap.len() - found.pressures.total();
    assert_eq!(found.gaps.total(), open);
    let largest = surface.gap.iter().copied().fold(0.0, f64::max);
    assert_relative_eq!(found.gaps.largest, largest, max_relative = 1e-12);
}

#[test]
fn unmeasured_elements_are_not_counted() {
    let ball = Paraboloid::new(1.0).unwrap();
    let path = path(Relief::Bare, ball.into(), Domain::Side(1.0), 32, 0.01);
    assert_eq!(path.steps[0].rough, None);
}
