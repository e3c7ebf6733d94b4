//! Peaks that are known from a closed form or from values all around them.

use std::sync::Arc;

use pellicle_influence::RadialTables;
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Grid;

use super::*;
use crate::stress::model::Sliding;

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

fn rough(field: &StressField) -> RoughDepths {
    RoughDepths::new(field.tables().foundation(), 0.2, field.tractions()).unwrap()
}

#[test]
fn a_climb_ends_under_the_centre_from_near_and_far() {
    let field = hertz(0.0);
    let middle = field.at([0.0; 2], Depth::below(0.4)).unwrap();
    for start in [[0.0, 0.0], [1.3, -0.9], [-0.45, 5.0], [30.0, -30.0]] {
        let mut search = PeakSearch::new(&field);
        let from = (start, Depth::below(0.4));
        let found = search.climb(&mut rough(&field), StressQuantity::Compression, from);
        let found = found.unwrap();
        assert!(found.at[0].hypot(found.at[1]) < 1e-12 && found.at[2] == 0.4);
        assert!((found.value + middle.stress[2]).abs() < 1e-5);
    }
}

#[test]
fn no_point_around_a_peak_exceeds_it() {
    for friction in [0.0, 0.3] {
        let field = hertz(friction);
        let (mut search, mut rough) = (PeakSearch::new(&field), rough(&field));
        let quantity = StressQuantity::VonMises;
        let depths = [0.28, 0.38, 0.5].map(Depth::below);
        let found = search.between(&mut rough, quantity, ([0.4, 0.2], 0.38), (&depths, 1));
        let (StressPeak { at: [x, y, z], .. }, rise) = found.unwrap();
        let largest = search
            .state(&mut rough, [x, y], Depth::below(z))
            .unwrap()
            .von_mises();
        let above = search
            .state(&mut rough, [x, y], Depth::below(0.38))
            .unwrap();
        // By a parabola through depths a third apart.
        assert!(
            (largest / above.von_mises() / rise - 1.0).abs() < 4e-3,
            "{rise}"
        );
        let offsets = [-0.1, -0.02, 0.0, 0.02, 0.1];
        let points = offsets.map(|u| offsets.map(|v| [x + u, y + v])).concat();
        for depth in offsets.map(|w| Depth::below((z + w).clamp(0.28, 0.5))) {
            for state in field.at_points(&points, depth).unwrap() {
                // The peak is flat; its place is accurate to a hundredth of the radius.
                assert!(state.von_mises() < (1.0 + 5e-5) * largest, "{x} {y} {z}");
            }
        }
    }
}

#[test]
fn an_endless_climb_stops_a_few_depths_outside_the_loaded_square() {
    // Eleven elements of side 0.2 have pressure, from −1.1 on; a decaying stress has no peak before the limit.
    let field = hertz(0.0);
    let mut search = PeakSearch::new(&field);
    for depth in [0.2, 0.6] {
        let from = ([90.0, 0.0], Depth::below(depth));
        let found = search.climb(&mut rough(&field), StressQuantity::Tension, from);
        let found = found.unwrap();
        let limit = field.loaded().size as f64 * 0.2 + FARTHEST_DEPTHS * depth;
        assert!(found.at[0].abs() <= 1.1 + limit + 1e-9, "{found:?}");
    }
}

#[test]
fn quantities_share_the_tables_of_a_depth_and_few_tables_are_kept() {
    let field = hertz(0.0);
    let (mut search, mut rough) = (PeakSearch::new(&field), rough(&field));
    for quantity in [StressQuantity::VonMises, StressQuantity::MaxShear] {
        for depth in [0.4, 0.6, 0.8].map(Depth::below) {
            search
                .climb(&mut rough, quantity, ([0.0; 2], depth))
                .unwrap();
        }
    }
    assert_eq!((rough.computed(), search.planes.len()), (3, 3));
    for i in 0..300 {
        let depth = Depth::below(0.4 + 1e-3 * f64::from(i));
        search
            .climb(&mut rough, StressQuantity::VonMises, ([0.0; 2], depth))
            .unwrap();
    }
    let kept = search
        .planes
        .iter()
        .map(|plane| plane.stresses.offsets().pow(2));
    assert!(kept.sum::<usize>() <= KEPT_OFFSETS && search.planes.len() > 20);
}

#[test]
fn far_below_a_small_contact_the_peak_is_that_of_its_force() {
    // Boussinesq: −σ_zz = 3 Q z³/(2π ρ⁵) is largest on the axis, and the shear σ_rz = 3 Q r z²/(2π ρ⁵) at r = z/2.
    let field = hertz(0.0);
    let force: f64 = field.loaded().pressure.iter().sum::<f64>() * 0.04;
    for z in [60.0, 4e3, 3e7] {
        for (quantity, power, radius) in [
            (StressQuantity::Compression, 0, 0.0),
            (StressQuantity::ShearTraction, 1, 0.5),
        ] {
            let (mut search, mut rough) = (PeakSearch::new(&field), rough(&field));
            let depth = Depth::above(z);
            let found = search.between(&mut rough, quantity, ([0.1, 0.3 * z], z), (&[depth], 0));
            let [x, y, _] = found.unwrap().0.at;
            let value = quantity.of(&search.state(&mut rough, [x, y], depth).unwrap());
            // With r in depths, at the place found.
            let r = x.hypot(y) / z;
            let part = r.powi(power) / (1.0 + r * r).powf(2.5);
            let wanted = 1.5 * part * force / (std::f64::consts::PI * z * z);
            // A contact of radius 1 differs from a force by some (1/z)².
            let error = (value / wanted - 1.0).abs();
            assert!(error < 2e-5 + 2.0 / (z * z), "{z}: {value}, {wanted}");
            // A flat peak is placed to the root of the error of its value.
            assert!((r - radius).abs() < 3e-3, "{x} {y}");
            // However deep, the tables are those of blocks as large as an eighth of the depth.
            assert!(
                search
                    .planes
                    .iter()
                    .all(|plane| plane.stresses.offsets() < 100)
            );
        }
    }
}
