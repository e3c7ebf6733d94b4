//! Short paths, whose results agree with their own pressures.

use std::sync::Arc;

use pellicle_influence::{ElasticBodies, RadialTables};
use pellicle_kernel::Material;
use pellicle_texture::{CylinderSpec, Cylinders, Film, Lattice, Relief};

use super::*;
use crate::{Indenter, Paraboloid, Pyramid};

/// A half-space under an indenter.
fn model(relief: Relief, indenter: impl Into<Indenter>) -> Model {
    Model::on_half_space([1.0, 0.0], relief, indenter)
}

fn ball() -> Paraboloid {
    Paraboloid::new(1.0).unwrap()
}

/// Solves some loads on 32 × 32 elements.
fn solve(
    model: &Model,
    domain: Domain,
    loads: &[Load],
    options: SolverOptions,
) -> Result<LoadingPath, ContactError> {
    solve_path(model, domain, 32, loads, &options, &mut ())
}

fn with_hardness(hardness: f64) -> SolverOptions {
    SolverOptions {
        hardness,
        ..SolverOptions::default()
    }
}

#[test]
fn a_summary_follows_from_the_pressures_whichever_sector_was_solved() {
    let pillars = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.1,
        height: 0.002,
        period: 0.25,
        offset: [0.0, 0.0],
        young_modulus: 10.0,
    };
    let pillars = Relief::Cylinders(Cylinders::new(pillars).unwrap());
    let film = Relief::Film(Film::new(0.02, 0.5).unwrap().stiffening());
    let berkovich = Pyramid::berkovich(0.05).unwrap();
    for (model, force, hardness) in [
        (model(Relief::Bare, ball()), 0.02, f64::INFINITY),
        (model(film, ball()), 0.02, 0.12),
        (model(Relief::Bare, berkovich), 0.05, 0.3),
        (model(pillars, ball()), 0.02, f64::INFINITY),
    ] {
        let path = solve(
            &model,
            Domain::Side(1.0),
            &[Load::Force(force)],
            with_hardness(hardness),
        );
        let path = path.unwrap();
        let (step, size) = (&path.steps[0], path.grid.size());
        let (pressure, summary) = (&step.solution.pressure, &step.summary);
        let surface = path.surface(&path.geometry(), 0).unwrap();
        let largest = |field: &[f64]| field.iter().copied().fold(0.0, f64::max);
        let pressing = (0..size * size).filter(|e| pressure[*e] > 0.0);
        let count = pressing.clone().count();
        assert_eq!(summary.contact_elements, count);
        let to_edge = pressing.clone().map(|e| {
            let [i, j] = [e / size, e % size];
            i.min(j).min(size - 1 - i).min(size - 1 - j)
        });
        assert_eq!(summary.elements_to_edge, to_edge.min());
        let area = path.grid.element_area();
        let cut = pressing
            .clone()
            .filter(|e| pressure[*e] >= hardness)
            .count();
        assert_eq!(cut > 0, hardness.is_finite());
        let has_hardness = hardness.is_finite();
        assert_eq!(summary.area_at_limit.is_some(), has_hardness);
        assert_eq!(summary.plastic_depth.is_some(), has_hardness);
        let area_at_limit = summary.area_at_limit.unwrap_or(0.0);
        assert!((area_at_limit - cut as f64 * area).abs() < 1e-12);
        let near = |found: f64, wanted: f64| (found - wanted).abs() <= 1e-7 * wanted.abs();
        let depth = summary.plastic_depth.unwrap_or(0.0);
        assert!(near(depth, largest(&surface.plastic_depth)));
        assert!(near(
            summary.largest_shortening,
            largest(&surface.shortening)
        ));
        assert!(near(summary.mean_pressure * summary.contact_area, force));
        // The edge is located within an element.
        let counted = count as f64 * area;
        assert!((summary.contact_area / counted - 1.0).abs() < 0.15);
        let parts = summary.contact_area_on_relief + summary.contact_area_between;
        assert!(near(parts, summary.contact_area));
        let peak = largest(pressure);
        assert!(summary.max_pressure >= peak && summary.max_pressure < 1.1 * peak);
        assert!(summary.max_pressure <= hardness);
        let place = |e: usize| [e / size, e % size].map(|i| path.grid.centre(i));
        let radii = pressing.map(|e| place(e)[0].hypot(place(e)[1]));
        let radius = radii.fold(0.0, f64::max);
        assert!((summary.contact_radius - radius).abs() < 1.5 * path.grid.element_side());
        // Elements pressed below the limit touch, and nothing overlaps.
        let slack = 1e-7 * step.solution.penetration;
        for (p, gap) in pressure.iter().zip(&surface.gap) {
            let is_free = *p > 0.0 && *p < hardness;
            assert!(*p >= hardness || *gap > -slack);
            assert!(!is_free || gap.abs() < slack);
        }
    }
}

#[test]
fn pressures_of_three_coarser_grids_are_kept_on_request_and_work_is_reported_by_grid() {
    let (model, load) = (model(Relief::Bare, ball()), [Load::Force(0.02)]);
    for coarse_pressures in [true, false] {
        let options = SolverOptions {
            coarse_pressures,
            ..SolverOptions::default()
        };
        let path = solve_path(&model, Domain::Side(1.0), 128, &load, &options, &mut ()).unwrap();
        let step = &path.steps[0];
        let sizes: Vec<usize> = step
            .work
            .levels
            .iter()
            .map(|level| level.elements)
            .collect();
        let (last, coarser) = sizes.split_last().unwrap();
        assert!(*last == 128 && coarser.len() >= 3);
        assert!(sizes.is_sorted_by(|coarse, fine| 2 * coarse == *fine));
        let kept: Vec<usize> = step.coarser.iter().map(|kept| kept.grid.size()).collect();
        let wanted = &coarser[coarser.len() - 3..];
        assert_eq!(kept, if coarse_pressures { wanted } else { &[] });
        for kept in &step.coarser {
            let carried = kept.pressure.iter().sum::<f64>() * kept.grid.element_area();
            assert!((carried / 0.02 - 1.0).abs() < 1e-9);
        }
        let work = step.work.levels.last().unwrap();
        assert_eq!(step.work.iterations, work.iterations);
        assert_eq!(step.work.operator_applications, work.operator_applications);
        assert_eq!(step.residuals.len(), work.iterations + 1);
        let estimated = step.grid_error.levels.iter().map(|level| level.elements);
        assert!(estimated.eq(sizes.iter().copied()));
        assert!(step.work.seconds > 0.0 && path.solve_seconds > 0.0);
    }
}

/// The tables of a model under an elastic indenter.
fn under(model: &Model, own: Material) -> Arc<RadialTables> {
    let bodies = ElasticBodies::new(model.tables.foundation().clone(), own);
    Arc::new(RadialTables::of_bodies(&bodies).unwrap())
}

#[test]
fn each_of_two_equal_bodies_is_displaced_by_half_the_total() {
    let rigid = model(Relief::Bare, ball());
    let own = Material::new(1.0, 0.0).unwrap();
    let equal = Model {
        tables: under(&rigid, own),
        ..rigid
    };
    let (depth, domain) = (0.04, Domain::Side(1.0));
    let loads = [Load::Penetration(depth)];
    let path = solve(&equal, domain, &loads, SolverOptions::default()).unwrap();
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let pressure = &path.steps[0].solution.pressure;
    let places = path.grid.centres().zip(pressure).zip(&surface.displacement);
    for (([x, y], p), u) in places {
        if *p > 0.0 {
            // The two bodies share D − f.
            let both = depth - f64::midpoint(x * x, y * y);
            assert!((u - both / 2.0).abs() < 1e-7 * depth, "{x} {y}");
        }
    }
    assert!(path.surface(&path.geometry(), 1).is_none());
}

#[test]
fn a_chosen_domain_that_cuts_a_contact_off_is_enlarged_and_a_given_one_is_not() {
    let model = model(Relief::Bare, ball());
    // Hertz: a³ = 3 Q R/(4 E*), a = 0.2
    let loads = [Load::Force(4.0 / 3.0 * 0.2_f64.powi(3))];
    let found = |domain: Domain| solve(&model, domain, &loads, SolverOptions::default()).unwrap();
    let given = found(Domain::Side(0.3));
    assert_eq!(given.grid.side(), 0.3);
    assert_eq!(given.steps[0].cut_off, Some(CutOff::Domain));
    let chosen = found(Domain::Chosen(0.3));
    let powers = (chosen.grid.side() / 0.3).ln() / ENLARGEMENT.ln();
    assert!((powers - powers.round()).abs() < 1e-9 && (1.0..3.0).contains(&powers.round()));
    assert_eq!(chosen.steps[0].cut_off, None);
    let large = found(Domain::Chosen(0.8));
    assert_eq!(large.grid.side(), 0.8);
}

#[test]
fn a_chosen_domain_too_small_to_carry_the_force_at_the_hardness_is_enlarged() {
    let model = model(Relief::Bare, ball());
    // An area of 1, on squares of side 0.8 and 1.2.
    let (loads, options) = ([Load::Force(0.01)], with_hardness(0.01));
    let given = solve(&model, Domain::Side(0.8), &loads, options);
    assert!(matches!(given, Err(ContactError::BeyondHardness { .. })));
    let chosen = solve(&model, Domain::Chosen(0.8), &loads, options).unwrap();
    assert!(chosen.grid.side() > 1.19);
    assert!((chosen.steps[0].summary.area_at_limit.unwrap() - 1.0).abs() < 0.05);
}

/// An observer that cancels after reports of this many steps.
struct Patience(usize);

impl Observer for Patience {
    fn progress(&mut self, _: &Progress) -> Signal {
        if self.0 == 0 {
            return Signal::Cancel;
        }
        self.0 -= 1;
        Signal::Continue
    }
}

#[test]
fn loads_are_solved_independently_and_a_cancelled_path_keeps_the_earlier_ones() {
    let model = model(Relief::Bare, ball());
    let loads = [0.02, 0.001, 0.01, 0.005].map(Load::Force);
    let (domain, options) = (Domain::Side(1.0), SolverOptions::default());
    let path = solve(&model, domain, &loads, options).unwrap();
    assert_eq!(path.steps.len(), 4);
    for (step, load) in path.steps.iter().zip(loads) {
        let alone = solve(&model, domain, &[load], options).unwrap();
        assert!(step.solution == alone.steps[0].solution);
    }
    let cancelled = |patience: usize| {
        let mut observer = Patience(patience);
        solve_path(&model, domain, 32, &loads, &options, &mut observer).unwrap()
    };
    let none = cancelled(0);
    assert!(none.interrupted && none.steps.is_empty());
    let some = cancelled(30);
    assert!(some.interrupted && some.steps.len() < 4);
    for (step, whole) in some.steps.iter().zip(&path.steps) {
        assert!(step.solution == whole.solution);
    }
    assert!(!cancelled(100_000).interrupted);
}

#[test]
fn on_small_grids_as_many_loads_are_solved_at_once_as_the_threads_allow() {
    let threads = rayon::current_num_threads();
    assert_eq!(loads_at_once(64, 1000), threads.min(512));
    assert_eq!([1, 0].map(|loads| loads_at_once(64, loads)), [1, 1]);
    assert_eq!(loads_at_once(4096, 1000), 1);
    // Half of two million elements: at most two at once.
    assert_eq!(loads_at_once(1024, 1000), threads.min(2));
}

/// A ball with a needle at the centre of an element of the finest grid, which coarser grids miss.
#[derive(Debug)]
struct Needle;

/// Row and column of the needle's element, of 128.
const NEEDLE: [usize; 2] = [21, 100];

impl crate::Profile for Needle {
    fn height(&self, x: f64, y: f64) -> f64 {
        let [a, b] = NEEDLE.map(|i| (i as f64 + 0.5) / 128.0 - 0.5);
        let needle = 1e-3 + (x - a).hypot(y - b).powi(2) / 1e-4;
        f64::midpoint(x * x, y * y).min(needle)
    }
}

#[test]
fn contact_outside_the_region_is_found_and_included() {
    let model = model(Relief::Bare, Indenter::custom(Needle));
    for load in [Load::Penetration(3e-3), Load::Force(1e-4)] {
        let (domain, options) = (Domain::Side(1.0), SolverOptions::default());
        let path = solve_path(&model, domain, 128, &[load], &options, &mut ()).unwrap();
        let solution = &path.steps[0].solution;
        assert!(solution.certificate.is_satisfied());
        let needle = NEEDLE[0] * 128 + NEEDLE[1];
        assert!(solution.pressure[needle] > 0.0, "{load:?}");
        let beside = [needle - 1, needle + 1, needle - 128, needle + 128];
        assert!(beside.iter().all(|e| solution.pressure[*e] == 0.0));
    }
}

#[test]
fn a_peak_inside_a_contact_lies_between_elements_and_one_at_its_edge_on_an_element() {
    let load = [Load::Force(0.02)];
    let options = SolverOptions::default();
    let smooth = solve(
        &model(Relief::Bare, ball()),
        Domain::Side(1.0),
        &load,
        options,
    )
    .unwrap();
    let summary = smooth.steps[0].summary;
    let largest = smooth.steps[0]
        .solution
        .pressure
        .iter()
        .copied()
        .fold(0.0, f64::max);
    assert_eq!(summary.peak_place, crate::PeakPlace::Inside);
    // The deviation from a paraboloid moves the vertex by a fraction of an element.
    let [x, y] = summary.max_pressure_at;
    assert!(x.hypot(y) < 5e-3 * smooth.grid.element_side());
    // For even N the axis is a corner of elements, where the paraboloid through them is higher.
    assert!(summary.max_pressure > largest * (1.0 + 1e-4));
    assert!(summary.edge_uncertainty > 0.0 && !summary.meets_outline);
    let punch = crate::FlatPunch::new(0.3).unwrap();
    let edged = solve(
        &model(Relief::Bare, punch),
        Domain::Side(1.0),
        &load,
        options,
    )
    .unwrap();
    let summary = edged.steps[0].summary;
    let pressure = &edged.steps[0].solution.pressure;
    let largest = pressure.iter().copied().fold(0.0, f64::max);
    assert_eq!(
        (summary.max_pressure, summary.peak_place),
        (largest, crate::PeakPlace::IndenterEdge)
    );
    let at = edged
        .grid
        .centres()
        .zip(pressure)
        .find(|(_, p)| **p == largest);
    let [x, y] = at.unwrap().0;
    assert!((summary.max_pressure_at[0] - x).hypot(summary.max_pressure_at[1] - y) < 1e-12);
    assert!(summary.meets_outline && x.hypot(y) > 0.25);
}
