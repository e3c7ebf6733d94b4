//! Peaks that are known from a closed form or from values all around them.

use std::sync::Arc;

use pellicle_influence::RadialTables;
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Grid;

use super::*;
use crate::stress::model::Sliding;

#[test]
fn the_vertex_of_a_parabola_is_recovered() {
    let value = |z: f64| 3.0 - 2.0 * (z - 0.7).powi(2);
    let found = vertex([0.1, 0.5, 2.0].map(|z| [z, value(z)])).unwrap();
    assert!((found - 0.7).abs() < 1e-14, "{found}");
    assert!(vertex([0.1, 0.5, 2.0].map(|z| [z, -value(z)])).is_none());
}

#[test]
fn a_bracket_narrows_on_a_peak_in_a_few_trials() {
    let peaks: [fn(f64) -> f64; 3] = [
        |z| z * (1.0 - z).exp(),
        |z| 1.0 - (z - 1.0).abs(),
        |z| if z < 1.0 { z } else { 2.0 - z * z },
    ];
    for value in peaks {
        for start in [0.2, 1.7] {
            let tried = |z: f64| DepthTrial {
                z,
                value: value(z),
                place: [0, 0],
            };
            let mut bracket = Bracket::around(tried(start), [0.1, 4.1]);
            for end in [0.1, 4.1] {
                bracket.take(tried(end));
            }
            let mut trials = 0;
            while !bracket.is_narrow() {
                let z = bracket.next();
                assert!(z > bracket.low && z < bracket.high);
                bracket.take(tried(z));
                trials += 1;
            }
            assert!(trials <= 5, "{trials}");
            let [first, second, third] = bracket.best.map(|tried| tried.value);
            assert!(first >= second && second >= third);
            assert!(bracket.low <= 1.0 && bracket.high >= 1.0);
            assert!(
                bracket.high - bracket.low <= 1.0,
                "a quarter of the first width"
            );
            assert!((bracket.best[0].z - 1.0).abs() <= 0.5);
        }
    }
}

/// Hertz's pressure of radius and peak 1 on 15 × 15 elements of a square of side 3, under sliding.
fn hertz(friction: f64) -> StressField {
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let grid = Grid::new(3.0, 15).unwrap();
    let pressure = (0..grid.len()).map(|e| {
        let [x, y] = [e / 15, e % 15].map(|i| grid.centre(i));
        (1.0 - x * x - y * y).max(0.0).sqrt()
    });
    let sliding = Sliding {
        friction,
        direction: 0.0,
    };
    let tables = Arc::new(RadialTables::build(&body).unwrap());
    StressField::of(tables, grid, &pressure.collect::<Vec<_>>(), sliding)
}

#[test]
fn a_climb_ends_under_the_centre_from_near_and_far() {
    let field = hertz(0.0);
    let middle = field.at([0.0; 2], Depth::below(0.4)).unwrap();
    for start in [[0.0, 0.0], [1.3, -0.9], [-0.45, 5.0], [30.0, -30.0]] {
        let mut search = PeakSearch::new(&field, StressQuantity::Compression, [0.0, f64::INFINITY]);
        let found = search.climb(start, 0.4).unwrap();
        assert!(found.at[0].hypot(found.at[1]) < 1e-12 && found.at[2] == 0.4);
        assert!((found.value + middle.stress[2]).abs() < 1e-9);
    }
}

#[test]
fn no_point_around_a_peak_exceeds_it_and_it_lies_at_its_reported_position() {
    for (friction, range) in [(0.0, [0.0, f64::INFINITY]), (0.3, [0.25, 0.9])] {
        let field = hertz(friction);
        let mut search = PeakSearch::new(&field, StressQuantity::VonMises, range);
        let found = search.peak([0.4, 0.2], [0.25, 0.35, 0.9]).unwrap();
        let [x, y, z] = found.at;
        let there = field.at([x, y], Depth::below(z)).unwrap();
        assert!((there.von_mises() - found.value).abs() < 1e-9);
        let offsets = [-0.1, -0.02, 0.0, 0.02, 0.1];
        let points = offsets.map(|u| offsets.map(|v| [x + u, y + v])).concat();
        for depth in offsets.map(|w| Depth::below((z + w).max(0.25))) {
            for state in field.at_points(&points, depth).unwrap() {
                // The peak is flat; its place is accurate to a hundredth of the radius.
                assert!(state.von_mises() < (1.0 + 1e-5) * found.value, "{found:?}");
            }
        }
    }
}

#[test]
fn within_an_element_of_the_surface_only_centres_count() {
    let field = hertz(0.0);
    let mut search = PeakSearch::new(&field, StressQuantity::Compression, [0.0, f64::INFINITY]);
    let found = search.peak([0.3, 0.1], [0.0, 0.0, 0.1]).unwrap();
    assert_eq!(found.at[2], 0.0);
    // The pressure of the middle element.
    assert!((found.value - 1.0).abs() < 1e-9 && found.at[0].hypot(found.at[1]) < 1e-12);
}

#[test]
fn the_element_nearest_to_a_centre_is_its_own() {
    let field = hertz(0.0);
    let search = PeakSearch::new(&field, StressQuantity::VonMises, [0.0, 1.0]);
    for place in [[0, 0], [3, -2], [-7, 20]] {
        let [x, y, z] = search.point(place, 0.3);
        assert_eq!((search.place([x + 0.09, y - 0.09]), z), (place, 0.3));
    }
    // The row of the first loaded elements lies at x = −0.8.
    assert!((search.point([0, 5], 0.0)[0] + 0.8).abs() < 1e-12);
}

#[test]
fn a_bracket_is_divided_at_the_vertex_of_its_parabola_or_in_the_golden_section() {
    let trial = |z: f64, value: f64| DepthTrial {
        z,
        value,
        place: [0, 0],
    };
    let next = |best: [(f64, f64); 3]| {
        let bracket = Bracket {
            low: 0.0,
            high: 4.0,
            width: 4.0,
            best: best.map(|(z, value)| trial(z, value)),
        };
        bracket.next()
    };
    // A vertex is accepted if it lies over a sixteenth of the width, 0.25, from the best and from either end.
    let parabola = |vertex: f64, at: [f64; 3]| at.map(|z| (z, 9.0 - (z - vertex).powi(2)));
    let vertices = [
        (1.3, [1.0, 2.0, 0.5]),
        (0.3, [1.0, 2.0, 3.0]),
        (3.7, [3.0, 2.0, 1.0]),
    ];
    for (vertex, at) in vertices {
        assert!(
            (next(parabola(vertex, at)) - vertex).abs() < 1e-13,
            "{vertex}"
        );
    }
    // Otherwise the wider side of the best is divided.
    let golden = [
        (1.2, [1.0, 2.0, 0.5], 1.0 + GOLDEN * 3.0),
        (0.2, [1.0, 2.0, 3.0], 1.0 + GOLDEN * 3.0),
        (3.8, [3.0, 2.0, 1.0], 3.0 - GOLDEN * 3.0),
        (3.2, [3.0, 2.0, 1.0], 3.0 - GOLDEN * 3.0),
    ];
    for (vertex, at, wanted) in golden {
        assert!(
            (next(parabola(vertex, at)) - wanted).abs() < 1e-13,
            "{vertex}"
        );
    }
}

#[test]
fn depths_at_either_end_of_a_range_lie_in_its_body() {
    let field = hertz(0.0);
    let search = PeakSearch::new(&field, StressQuantity::VonMises, [0.2, 0.5]);
    let found = [0.2, 0.3, 0.5].map(|z| search.depth(z));
    assert!(found == [Depth::below(0.2), Depth::below(0.3), Depth::above(0.5)]);
}

#[test]
fn an_endless_climb_stops_a_few_depths_outside_the_loaded_square() {
    // Eleven elements of side 0.2 have pressure, from −1.1 on; a decaying stress has no peak before the limit.
    let field = hertz(0.0);
    let mut search = PeakSearch::new(&field, StressQuantity::Tension, [0.0, f64::INFINITY]);
    for depth in [0.2, 0.6] {
        let found = search.climb([90.0, 0.0], depth).unwrap();
        let limit = field.loaded().size as f64 * 0.2 + FARTHEST_DEPTHS * depth;
        assert!(found.at[0].abs() <= 1.1 + limit + 1e-9, "{found:?}");
    }
}

#[test]
fn a_peak_between_depths_is_interpolated_within_the_range_however_narrow() {
    let field = hertz(0.0);
    // Von Mises stress is largest near 0.48; the depths of an interpolation are an eighth of the width apart.
    for (range, start, inside) in [
        ([0.4, 0.45], 0.4, false),
        ([0.3, 2.0], 0.35, true),
        ([0.2, 0.5], 0.45, true),
        ([0.55, 0.56], 0.56, false),
    ] {
        let mut search = PeakSearch::new(&field, StressQuantity::VonMises, range);
        let first = search.climb([0.0; 2], start).unwrap();
        let found = search
            .between_centres(first, search.place([0.0; 2]), 1.0)
            .unwrap();
        let depth = found.at[2];
        assert!(
            depth >= range[0] && depth <= range[1],
            "{range:?}: {found:?}"
        );
        assert!(found.value > first.value, "{range:?}: {found:?}");
        // No neighbouring depth exceeds it by more than a thousandth.
        let around = [-0.02, 0.02].map(|z| depth + z);
        for z in around
            .into_iter()
            .filter(|z| *z > range[0] && *z < range[1])
        {
            let state = field
                .at([found.at[0], found.at[1]], Depth::below(z))
                .unwrap();
            assert!(state.von_mises() < 1.001 * found.value);
        }
        assert_eq!(
            depth > range[0] && depth < range[1],
            inside,
            "{range:?}: {found:?}"
        );
    }
}
