//! Tests of the search for extremes.

use std::sync::Arc;

use pellicle_influence::{Depth, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Grid;

use super::*;
use crate::ErrorEstimate;

#[test]
fn starting_points_of_one_peak_are_followed_once_and_none_far_below_the_largest() {
    let depths = [0.0, 0.1, 0.4, 1.0];
    let kept = |starting_points: &[(f64, [f64; 2], usize)]| {
        let starting_points: Vec<_> = starting_points
            .iter()
            .map(|(value, at, depth)| StartingPoint {
                target: 0,
                quantity: StressQuantity::VonMises,
                value: *value,
                at: *at,
                depth: *depth,
            })
            .collect();
        let kept = distinct(&starting_points, &depths, 0.1);
        kept.iter().map(|kept| kept.value).collect::<Vec<_>>()
    };
    let first = (10.0, [0.0; 2], 1);
    // At the next depth within an element, and within half the depth; farther; at the same depth; two depths away.
    assert_eq!(kept(&[first, (9.9, [0.06, 0.06], 0)]), [10.0]);
    assert_eq!(kept(&[first, (9.9, [0.1, 0.15], 2)]), [10.0]);
    assert_eq!(kept(&[first, (9.9, [0.08, 0.08], 0)]), [10.0, 9.9]);
    assert_eq!(kept(&[first, (9.9, [0.15, 0.15], 2)]), [10.0, 9.9]);
    assert_eq!(kept(&[first, (9.9, [0.01, 0.0], 1)]), [10.0, 9.9]);
    assert_eq!(kept(&[first, (9.9, [0.01, 0.0], 3)]), [10.0, 9.9]);
    assert_eq!(kept(&[first, (9.7, [0.9, 0.0], 1)]), [10.0]);
    let apart = [0, 1, 2, 3, 4].map(|i| (10.0, [f64::from(i), 0.0], 1));
    assert_eq!(kept(&apart).len(), 4);
}

/// Hertz's pressure of radius and peak 1 on a square of side 3.
fn hertz(size: usize) -> StressField {
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let grid = Grid::new(3.0, size).unwrap();
    let pressure = (0..grid.len()).map(|e| {
        let [x, y] = [e / size, e % size].map(|i| grid.centre(i));
        (1.0 - x * x - y * y).max(0.0).sqrt()
    });
    let tables = Arc::new(RadialTables::build(&body).unwrap());
    StressField::of(
        tables,
        grid,
        &pressure.collect::<Vec<_>>(),
        Sliding::default(),
    )
}

#[test]
fn a_peak_is_found_again_on_a_coarser_grid_at_its_depth_or_near_it() {
    let field = hertz(15);
    let value = |[top, bottom]: [f64; 2], z| {
        let peak = StressPeak {
            value: 1.0,
            at: [0.1, 0.0, z],
        };
        let target = Target {
            top,
            bottom,
            quantities: Vec::new(),
        };
        let mut rough = RoughDepths::new(field.tables().foundation(), 0.2, [0.0; 2]).unwrap();
        let depths = target.depths(2.2, 0.2);
        let quantity = StressQuantity::Compression;
        coarse_value(
            &mut PeakSearch::new(&field),
            &mut rough,
            quantity,
            &depths,
            peak,
        )
        .unwrap()
    };
    let there = |z| {
        let state = field.at([0.0; 2], Depth::below(z)).unwrap();
        -state.stress[2]
    };
    // The compression falls with depth. At an end of the range the value is that of the end; inside, it is that at
    // the depth times the rise to the top of the depths around it, which is at most 1.2.
    for end in [0.8, 2.0] {
        assert!((value([0.8, 2.0], end) / there(end) - 1.0).abs() < 1e-5);
    }
    let found = value([0.78, 0.84], 0.81);
    assert!((found / there(0.78) - 1.0).abs() < 1e-4, "{found}");
    assert!((value([0.3, 2.0], 0.8) / there(0.8) - 1.0).abs() < 1e-5);
}

/// A half-space of Poisson's ratio 0.3 under an indenter at a depth, on a square of side 1 and grids of up to 32
/// elements.
fn solved(indenter: impl Into<crate::Indenter>, depth: f64) -> LoadingPath {
    let model = crate::Model::on_half_space([1.0, 0.3], pellicle_texture::Relief::Bare, indenter);
    let options = crate::SolverOptions {
        coarse_pressures: true,
        ..crate::SolverOptions::default()
    };
    let (domain, load) = (crate::Domain::Side(1.0), crate::Load::Penetration(depth));
    crate::solve_path(&model, domain, 32, &[load], &options, &mut ()).unwrap()
}

fn found(finder: &ExtremeFinder, targets: &[Target]) -> Vec<Vec<Extreme<3>>> {
    let mut rough = ExtremeFinder::rough_depths(finder.path, Sliding::default()).unwrap();
    finder.find(&mut rough, targets).unwrap()
}

#[test]
fn under_a_ball_the_largest_stresses_are_those_of_hertz_each_in_its_range() {
    let a: f64 = 0.3;
    let path = solved(crate::Paraboloid::new(1.0).unwrap(), a * a);
    // p0 = 2 E* a/(π R)
    let p0 = 2.0 * a / (std::f64::consts::PI * 0.91);
    let body = Target {
        top: 0.0,
        bottom: f64::INFINITY,
        quantities: vec![StressQuantity::VonMises, StressQuantity::MaxShear],
    };
    // −σ_zz = p0/(1 + z²/a²) on the axis, and no shear there.
    let depth = 0.5 * a;
    let interface = Target {
        top: depth,
        bottom: depth,
        quantities: vec![StressQuantity::Compression],
    };
    let deep = Target {
        top: a,
        bottom: 2.0 * a,
        quantities: vec![StressQuantity::Compression],
    };
    let finder = ExtremeFinder::new(&path, &path.steps[0], Sliding::default());
    let found = found(&finder, &[body, interface, deep]);
    // Johnson 1985: 0.62 p0 and 0.31 p0 at 0.48 a.
    for (extreme, wanted, z) in [
        (found[0][0], 0.62, 0.481 * a),
        (found[0][1], 0.31, 0.481 * a),
        (found[1][0], 0.8, depth),
        (found[2][0], 0.5, a),
    ] {
        // Ten elements per radius.
        assert!(
            (extreme.value / p0 / wanted - 1.0).abs() < 0.02,
            "{extreme:?}"
        );
        assert!((extreme.at[2] / z - 1.0).abs() < 0.05, "{extreme:?}");
        assert_eq!(extreme.at[..2], [0.0; 2]);
        let estimate = extreme.estimate.unwrap();
        assert!(estimate < 0.1 * extreme.value, "{extreme:?}");
    }
    assert_eq!([found[0].len(), found[1].len(), found[2].len()], [2, 1, 1]);
}

#[test]
fn an_extreme_at_an_edge_is_not_resolved_and_one_close_to_the_axis_is_moved_to_it() {
    let path = solved(crate::FlatPunch::new(0.2).unwrap(), 0.01);
    let finder = ExtremeFinder::new(&path, &path.steps[0], Sliding::default());
    let side = path.grid.element_side();
    let values = [(8, 1.5), (16, 1.125), (32, 1.03125)];
    let judged = |at: [f64; 3]| finder.judged(StressPeak { value: 1.03125, at }, &values);
    for (at, is_resolved) in [
        ([0.2, 0.0, 1.9 * side], false),
        ([0.2, 0.0, 2.1 * side], true),
        ([0.0, -0.2, 0.0], false),
        ([0.05, 0.05, 0.0], true),
    ] {
        let found = judged(at);
        assert_eq!(found.resolved, is_resolved, "{at:?}");
        assert_eq!((found.value, found.at[2]), (1.03125, at[2]));
        let accuracy = path.steps[0].solution.certificate.worst() + path.tables.error_estimate();
        let wanted = ErrorEstimate::of_values(&values, true, !is_resolved, accuracy);
        assert_eq!(found.estimate, wanted.map(|wanted| wanted.estimate));
    }
    let snapped = judged([0.9e-3 * side, -1.1e-3 * side, 0.1]);
    assert_eq!(snapped.at, [0.0, -1.1e-3 * side, 0.1]);
    let snapped = judged([1.1e-3 * side, -0.9e-3 * side, 0.1]);
    assert_eq!(snapped.at, [1.1e-3 * side, 0.0, 0.1]);
}
