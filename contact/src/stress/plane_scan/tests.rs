//! The depths of a body, and the peaks of planes at them.

use std::sync::Arc;

use pellicle_influence::RadialTables;
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Grid;

use super::*;
use crate::stress::model::Sliding;

fn depths(top: f64, bottom: f64) -> Vec<f64> {
    let target = Target {
        top,
        bottom,
        quantities: Vec::new(),
    };
    target
        .depths(10.0, 0.1)
        .iter()
        .map(|depth| depth.z)
        .collect()
}

#[test]
fn depths_cover_a_body_from_top_to_bottom_and_are_densest_at_the_surface() {
    for (top, bottom) in [
        (0.0, 1.0),
        (0.0, 0.01),
        (3.0, 4.0),
        (1.0, 9.0),
        (0.0, 500.0),
        (3.0, 500.0),
        (0.0, f64::INFINITY),
        (5.0, f64::INFINITY),
        (100.0, f64::INFINITY),
    ] {
        let found = depths(top, bottom);
        assert!(found.is_sorted_by(|one, other| one < other), "{found:?}");
        // To the underside of a layer, in a base on the scale of the load or of its depth.
        let last = if bottom.is_finite() {
            bottom
        } else {
            top + 2.0 * top.max(10.0)
        };
        assert_eq!((found[0], found[found.len() - 1]), (top, last));
        let gaps: Vec<f64> = found.windows(2).map(|pair| pair[1] - pair[0]).collect();
        for (gap, next) in gaps.iter().zip(&gaps[1..]) {
            assert!(gap / next < 2.6 && next / gap < 2.6, "{found:?}");
        }
        // Stresses vary on the scale of the depth.
        let below_surface = found.iter().skip_while(|z| **z == 0.0);
        let depths: Vec<&f64> = below_surface.collect();
        let is_dense = |pair: &[&f64]| pair[1] / pair[0] < 2.1;
        assert!(depths.windows(2).all(is_dense), "{found:?}");
        assert!(top == 0.0 || found.len() >= 5, "{found:?}");
    }
}

#[test]
fn layers_below_the_surface_take_five_planes_each_if_they_are_thin_on_the_scale_of_their_depth() {
    // Layers of a third, a half and a fifth of the contact's radius on a half-space.
    let interfaces = [0.0, 1.6, 4.4, 5.5, f64::INFINITY];
    let planes = interfaces
        .windows(2)
        .map(|ends| depths(ends[0], ends[1]).len());
    let planes: Vec<usize> = planes.collect();
    assert_eq!(planes[2], 5, "{planes:?}");
    assert!(planes.iter().sum::<usize>() <= 28, "{planes:?}");
}

#[test]
fn an_interface_has_one_depth() {
    assert_eq!(depths(2.0, 2.0), [2.0]);
}

#[test]
fn a_value_within_two_percent_of_the_largest_counts_as_near_it() {
    for (value, largest, wanted) in [
        (0.981, 1.0, true),
        (0.979, 1.0, false),
        (-1.019, -1.0, true),
        (-1.021, -1.0, false),
    ] {
        assert_eq!(is_nearly(value, largest), wanted);
    }
}

/// Pressures on blocks of 2 × 2 elements, on a unit square of 8 × 8.
fn field() -> StressField {
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let pressed = |e: usize| match [e / 16, e % 8 / 2] {
        [1, 1] => 1.0,
        [1, 2] => 2.0,
        [2, 2] => 0.5,
        _ => 0.0,
    };
    let pressure: Vec<f64> = (0..64).map(pressed).collect();
    let tables = Arc::new(RadialTables::build(&body).unwrap());
    let grid = Grid::new(1.0, 8).unwrap();
    StressField::of(tables, grid, &pressure, Sliding::default())
}

fn rough(field: &StressField) -> RoughDepths {
    let (foundation, side) = (field.tables().foundation(), field.grid().element_side());
    RoughDepths::new(foundation, side, field.tractions()).unwrap()
}

#[test]
fn planes_under_blocks_have_the_stresses_of_the_field_at_the_block_centres() {
    let field = field();
    // Under elements to 2e-6. Blocks of an eighth of the depth widen a load by b²/12 along x and along y, from which
    // −σ_zz under a force falls by 5/768 = 0.65 %.
    for (m, z, accuracy) in [(0, 0.2, 1e-5), (1, 2.0, 1e-2), (5, 32.0, 1e-2)] {
        let depth = Depth::below(z);
        let mut blocks = BlockPlanes::new(&field, m, z);
        blocks.move_to(&mut rough(&field), depth).unwrap();
        let places = 0..blocks.shown * blocks.shown;
        let states: Vec<_> = places.map(|place| blocks.stresses.state(place)).collect();
        let place = |k: usize| [k / blocks.shown, k % blocks.shown];
        let point =
            |k: usize| [0, 1].map(|axis| blocks.first[axis] + place(k)[axis] as f64 * blocks.side);
        let points: Vec<_> = (0..states.len()).map(point).collect();
        // On either side of the loaded square, from −0.25 to 0.25, at least 0.3 of its side plus one and a half depths.
        let [low, high] = [points[0], points[states.len() - 1]];
        for axis in 0..2 {
            let edges = [-low[axis], high[axis]].map(|middle| middle + blocks.side / 2.0);
            let reach = 0.25 + 0.3 * 0.5 + 1.5 * z;
            let most = reach + 3.0 * blocks.side;
            assert!(
                edges.iter().all(|edge| (reach..most).contains(edge)),
                "{edges:?}"
            );
        }
        assert!(blocks.shown < 64);
        let wanted = field.at_points(&points, depth).unwrap();
        let largest = wanted.iter().flat_map(|state| state.stress);
        let largest = largest.fold(0.0, |largest: f64, stress| largest.max(stress.abs()));
        for (found, wanted) in states.iter().zip(&wanted) {
            for (found, wanted) in found.stress.iter().zip(wanted.stress) {
                assert!((found - wanted).abs() < accuracy * largest, "{m}");
            }
        }
    }
}

#[test]
fn peaks_of_a_plane_are_the_values_near_the_largest_with_no_larger_neighbour() {
    let (side, zz) = (20, 2);
    let mut stresses = PlaneStresses::zeros(side);
    let last = side - 1;
    let mut values = vec![0.0; side * side];
    for (i, j, stress) in [
        (5, 3, 9.9),
        (2, 3, 10.0),
        (2, 2, 9.95),
        (3, 4, 9.95),
        (0, 7, 9.85),
        (last, last, 9.82),
        (8, 8, 9.7),
    ] {
        values[i * side + j] = stress;
    }
    stresses.take(zz, &values);
    stresses.find_invariants();
    // On the axis of a uniaxial stress all of these are its value.
    for quantity in [
        StressQuantity::Tension,
        StressQuantity::VonMises,
        StressQuantity::MaxPrincipal,
    ] {
        let found = stresses.peaks(quantity, f64::NEG_INFINITY);
        let rounded = found.iter().map(|(value, _)| (1e6 * value).round() / 1e6);
        assert_eq!(rounded.collect::<Vec<_>>(), [10.0, 9.9, 9.85, 9.82]);
        assert_eq!(found[0].1, [2, 3]);
        // Other planes may have larger values.
        assert_eq!(stresses.peaks(quantity, 10.1).len(), 2);
        assert!(stresses.peaks(quantity, 11.0).is_empty());
    }
}

#[test]
fn peaks_of_every_plane_equal_its_stresses_under_elements_and_under_blocks() {
    // Hertz's pressure of radius and peak 1, 32 elements across: from a depth of 1 on under blocks of two elements.
    let size = 40;
    let grid = Grid::new(2.5, size).unwrap();
    let pressure = grid
        .centres()
        .map(|[x, y]| (1.0 - x * x - y * y).max(0.0).sqrt());
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let tables = Arc::new(RadialTables::build(&body).unwrap());
    let pressure: Vec<f64> = pressure.collect();
    let field = StressField::of(tables, grid, &pressure, Sliding::default());
    assert_eq!(field.loaded().size, 32);
    let quantities = [StressQuantity::Compression, StressQuantity::VonMises];
    let target = |top: f64, bottom: f64| Target {
        top,
        bottom,
        quantities: quantities.to_vec(),
    };
    let element = grid.element_side();
    let depths = target(0.0, 3.0).depths(32.0 * element, element);
    // Of a whole body only peaks near the largest are kept.
    let planes = depths.iter().map(|depth| target(depth.z, depth.z));
    let targets: Vec<Target> = planes.collect();
    let found = scan(&field, &mut rough(&field), &targets)
        .unwrap()
        .starting_points;
    assert!(found.is_sorted_by(|one, other| one.value >= other.value));
    for (index, of) in targets.iter().enumerate() {
        let depths = of.depths(32.0 * element, element);
        for quantity in quantities {
            for (at, depth) in depths.iter().enumerate() {
                let mut own = found.iter().filter(|start| {
                    let place = (start.target, start.quantity, start.depth);
                    place == (index, quantity, at)
                });
                let largest = own.next().unwrap();
                let there = field.at(largest.at, *depth).unwrap();
                let ratio = largest.value / quantity.of(&there);
                // Blocks of side b = z/8 widen a load by the variance b²/12 along x and along y, and −σ_zz under a
                // force falls by 5/2 of their sum over z²: 5/768 = 0.65 %.
                assert!(
                    (ratio - 1.0).abs() < 1e-2,
                    "{quantity:?} {}: {ratio}",
                    depth.z
                );
                if quantity == StressQuantity::Compression {
                    // p0/(1 + z²/a²) on the axis, which is next to the middle of a block.
                    let ratio = largest.value * (1.0 + depth.z * depth.z);
                    assert!((ratio - 1.0).abs() < 0.02, "{}: {ratio}", depth.z);
                    let apart = largest.at[0].hypot(largest.at[1]);
                    assert!(apart <= element.max(depth.z / 8.0), "{}: {apart}", depth.z);
                }
            }
        }
    }
}

#[test]
fn an_interface_shares_the_plane_at_the_bottom_of_its_body() {
    let field = field();
    let target = |top: f64, bottom: f64| Target {
        top,
        bottom,
        quantities: vec![StressQuantity::VonMises],
    };
    let mut rough = rough(&field);
    let targets = [target(0.0, 0.5), target(0.5, 0.5)];
    let Scan { planes, .. } = scan(&field, &mut rough, &targets).unwrap();
    assert!(Arc::ptr_eq(planes[0].last().unwrap(), &planes[1][0]));
    assert_eq!(rough.computed(), planes[0].len());
}

#[test]
fn interpolated_between_planes_the_largest_stress_under_hertz_lies_where_it_does() {
    let grid = Grid::new(2.5, 64).unwrap();
    let pressure = grid
        .centres()
        .map(|[x, y]| (1.0 - x * x - y * y).max(0.0).sqrt());
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let tables = Arc::new(RadialTables::build(&body).unwrap());
    let pressure: Vec<f64> = pressure.collect();
    let field = StressField::of(tables, grid, &pressure, Sliding::default());
    let target = Target {
        top: 0.0,
        bottom: f64::INFINITY,
        quantities: vec![StressQuantity::VonMises],
    };
    let scan = scan(&field, &mut rough(&field), &[target]).unwrap();
    let StartingPoint { depth, at, .. } = scan.starting_points[0];
    let (value, [x, y, z]) = refined(&scan.planes[0], StressQuantity::VonMises, (depth, at));
    // Johnson 1985: 0.62 p0 at 0.481 a. The stresses are interpolated to 1e-3, which moves the place by a hundredth.
    assert!((value - 0.6205).abs() < 2e-3, "{value}");
    assert!((z - 0.481).abs() < 0.01 && x.hypot(y) < 0.01, "{x} {y} {z}");
}

#[test]
fn a_smooth_pressure_is_scanned_in_blocks_and_a_rough_one_in_elements() {
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let tables = Arc::new(RadialTables::build(&body).unwrap());
    let grid = Grid::new(2.0, 128).unwrap();
    let doublings = |pressure: &dyn Fn([f64; 2]) -> f64| {
        let pressure: Vec<f64> = grid.centres().map(pressure).collect();
        let field = StressField::of(tables.clone(), grid, &pressure, Sliding::default());
        smooth_doublings(&field)
    };
    let ball = |[x, y]: [f64; 2]| (1.0 - x * x - y * y).max(0.0).sqrt();
    assert_eq!(doublings(&ball), 2);
    assert_eq!(
        doublings(&|[x, y]| ball([4.0 * x, 4.0 * y])),
        0,
        "32 elements across"
    );
    let waves = |[x, y]: [f64; 2]| (ball([x, y]) * (1.0 + (90.0 * x).sin())).max(0.0);
    assert_eq!(doublings(&waves), 0);
}
