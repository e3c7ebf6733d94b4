//! Rough stresses compared with the exact ones.

use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::subsurface::depth::Depth;
use crate::subsurface::element_table::ElementStates;
use crate::subsurface::{ElementFields, SurfaceLoad};

/// A body of one material, one with a thick and one with a thin stiff coating, in sides of an element.
fn foundations() -> [Foundation; 3] {
    let [coating, base] = [5.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
    [
        Foundation::half_space(base),
        Foundation::coated(12.0, coating, base).unwrap(),
        Foundation::coated(0.8, coating, base).unwrap(),
    ]
}

#[test]
fn rough_stresses_differ_from_exact_ones_by_two_millionths_at_every_depth_and_distance() {
    for foundation in foundations() {
        let mut depths = RoughDepths::new(&foundation, 1.0, [0.3, 0.0]).unwrap();
        for z in [
            0.0, 0.3, 0.6, 1.9, 2.1, 4.6, 5.0, 11.9, 12.1, 20.1, 40.0, 300.0,
        ] {
            // Elements of other sides share the functions of a depth.
            for side in [1.0, 0.37] {
                let depth = Depth::below(z * side);
                let farthest = 90.0 * side;
                let exact = ElementFields::new(&foundation, side, depth, farthest).unwrap();
                let kernels = depths.at(depth, side, farthest).unwrap();
                let normal = RoughPressure::under_pressure(&kernels, side);
                let tangential = RoughTraction::under_traction(&kernels, side).unwrap();
                let places = (0..40).map(|i| {
                    let i = f64::from(i);
                    [0.7 * i * (0.4 * i).cos() + 0.04 * i * i, 0.53 * i]
                });
                let places: Vec<_> = places.filter(|[x, y]| x.hypot(*y) < 60.0).collect();
                let states = |load: SurfaceLoad| {
                    let of = |place: &[f64; 2]| match load {
                        SurfaceLoad::Pressure => normal.at(*place),
                        SurfaceLoad::Traction => tangential.at(*place),
                    };
                    places.iter().map(of).collect::<Vec<_>>()
                };
                for load in [SurfaceLoad::Pressure, SurfaceLoad::Traction] {
                    let found = states(load);
                    let at = |place: &[f64; 2]| exact.state(load, place.map(|along| along * side));
                    let exact: Vec<_> = places.iter().map(at).collect();
                    let all = exact.iter().flat_map(|state| state.stress);
                    let largest = all.fold(0.0, |most: f64, stress| most.max(stress.abs()));
                    for ((found, exact), place) in found.iter().zip(&exact).zip(&places) {
                        for (found, exact) in found.stress.iter().zip(exact.stress) {
                            let error = (found - exact).abs() / largest;
                            assert!(error < 2e-6, "{load:?} {z} {side} {place:?}: {error:e}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn states_at_exchanged_places_are_those_at_each() {
    let [_, foundation, _] = foundations();
    let mut depths = RoughDepths::new(&foundation, 1.0, [0.0, 1.0]).unwrap();
    for z in [0.5, 3.0] {
        let kernels = depths.at(Depth::below(z), 1.0, 20.0).unwrap();
        let element = RoughTraction::under_traction(&kernels, 1.0).unwrap();
        for [x, y] in [[1.0, 0.0], [3.0, 2.0], [11.0, 5.0]] {
            let [own, other] = element.at_both([x, y]);
            for (found, place) in [(own, [x, y]), (other, [y, x])] {
                let wanted = element.at(place);
                for (found, wanted) in found.stress.iter().zip(wanted.stress) {
                    assert!((found - wanted).abs() < 1e-12, "{z} {place:?}");
                }
            }
        }
    }
}

#[test]
fn a_depth_is_computed_once_for_all_elements_below_the_surface() {
    let [_, foundation, _] = foundations();
    let mut depths = RoughDepths::new(&foundation, 1.0, [0.0; 2]).unwrap();
    for (z, side, computed) in [
        (9.0, 1.0, 1),
        (9.0, 0.5, 1),
        (4.0, 1.0, 2),
        (1.0, 1.0, 3),
        (1.0, 0.5, 4),
    ] {
        depths.at(Depth::below(z), side, 20.0).unwrap();
        assert_eq!(depths.computed(), computed, "{z} {side}");
    }
    depths.at(Depth::below(9.0), 1.0, 200.0).unwrap();
    assert_eq!(depths.computed(), 5, "farther than before");
}
