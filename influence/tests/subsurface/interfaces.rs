//! Surface and interfaces of stacks: the influence coefficient, continuity, depths outside the body.

use pellicle_influence::{Depth, ElementFields, ElementLoads, RadialTables};
use pellicle_kernel::{Base, Foundation, Side};

use super::{KEYS, nine, stacks};

#[test]
fn the_surface_sinks_by_the_influence_coefficient() {
    for foundation in stacks() {
        let tables = RadialTables::build(&foundation).unwrap();
        let plane = Depth {
            z: 0.0,
            side: Side::Below,
        };
        let fields = ElementFields::new(&foundation, 1.0, plane, 100.0).unwrap();
        let largest = tables.coefficient(1.0, [0, 0]);
        for offset in [[0, 0], [1, 0], [3, 2], [10, 0], [40, 60]] {
            let found = fields
                .at(offset.map(|count| count as f64))
                .normal
                .displacement[2];
            let error = (found - tables.coefficient(1.0, offset)).abs() / largest;
            assert!(error < 1e-11, "{foundation:?} {offset:?}: {error:e}");
        }
    }
}

#[test]
fn tractions_and_displacements_are_continuous_across_bonded_interfaces() {
    for foundation in stacks() {
        let depths = (1..=foundation.layers().len()).map(|i| foundation.interface_depth(i));
        for depth in depths {
            let [above, below] = [Side::Above, Side::Below].map(|side| {
                ElementFields::new(&foundation, 1.0, Depth { z: depth, side }, 20.0).unwrap()
            });
            let points = [
                [0.0, 0.0],
                [0.45, 0.2],
                [0.7, -0.7],
                [3.0, 2.0],
                [-9.0, 14.0],
            ];
            let states = points.map(|point| [above.at(point), below.at(point)]);
            for load in 0..2 {
                let of = |loads: &ElementLoads| nine([&loads.normal, &loads.tangential][load]);
                for f in [0, 1, 2, 5, 7, 8] {
                    let values = states
                        .each_ref()
                        .map(|sides| sides.each_ref().map(|side| of(side)[f]));
                    let is_base_rigid =
                        foundation.base() == Base::Rigid && below_is_base(&foundation, depth);
                    if is_base_rigid && f > 2 {
                        continue;
                    }
                    let scale = states.iter().flatten().fold(0.0, |most: f64, side| {
                        let size = |f: usize| of(side)[f].abs();
                        most.max(if f < 3 {
                            size(0).max(size(2))
                        } else {
                            size(5).max(size(7))
                        })
                    });
                    for ([above, below], point) in values.iter().zip(points) {
                        let error = (above - below).abs();
                        assert!(
                            error <= 1e-11 * scale + 1e-15,
                            "{foundation:?} {depth} {point:?} {}: {above:e} {below:e}",
                            KEYS[f]
                        );
                    }
                }
            }
        }
    }
}

fn below_is_base(foundation: &Foundation, depth: f64) -> bool {
    (depth - foundation.thickness()).abs() < 1e-12
}

#[test]
fn depths_outside_the_body_are_refused() {
    let layered = &stacks()[4];
    for depth in [-1e-9, 0.71, f64::NAN, f64::INFINITY] {
        let plane = Depth {
            z: depth,
            side: Side::Above,
        };
        let error = ElementFields::new(layered, 1.0, plane, 1.0).unwrap_err();
        assert!(
            error.to_string().contains("for a depth in the body"),
            "{error}"
        );
    }
}
