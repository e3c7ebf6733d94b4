//! Planes of fields by convolution, compared with sums over the elements.

use pellicle_influence::{
    CentreStresses, Depth, ElementFields, PlaneFields, Squares, SubsurfaceState,
};
use pellicle_kernel::{Foundation, Side};

use super::{KEYS, stacks};

/// A pressure without mirror symmetry, by the element and the number of elements along a side.
fn uneven(element: usize, _: usize) -> f64 {
    1.0 + (element * element % 7) as f64
}

/// A pressure that is symmetric in x and y, but not under their exchange.
fn mirrored(element: usize, loaded: usize) -> f64 {
    let [i, j] = [element / loaded, element % loaded].map(|i| i.min(loaded - 1 - i));
    1.0 + ((3 * i + 5 * j) % 4) as f64
}

/// Compares the fields on a plane with sums over the elements, under pressures of order 1 and each friction.
fn check_plane(
    foundation: &Foundation,
    squares: Squares,
    pressure: fn(usize, usize) -> f64,
    plane: Depth,
    frictions: &[[f64; 2]],
) {
    let Squares {
        loaded,
        shown,
        before,
    } = squares;
    let pressure: Vec<f64> = (0..loaded * loaded).map(|e| pressure(e, loaded)).collect();
    let element = ElementFields::new(foundation, 1.0, plane, 2.0 * shown as f64).unwrap();
    // The states at all offsets from an element.
    let width = 2 * shown + 1;
    let offset = |n: usize| n as f64 - shown as f64;
    let loads: Vec<_> = (0..width * width)
        .map(|place| element.at([offset(place / width), offset(place % width)]))
        .collect();
    for friction in frictions {
        let state_at = |i: usize, j: usize| {
            let mut sum = SubsurfaceState::default();
            for (e, p) in pressure.iter().enumerate() {
                let x = shown + i - (before[0] + e / loaded);
                let y = shown + j - (before[1] + e % loaded);
                let of_load = loads[x * width + y];
                let along_y = loads[y * width + x].tangential.transposed();
                let state = of_load.normal + of_load.tangential * friction[0];
                sum += (state + along_y * friction[1]) * *p;
            }
            sum
        };
        let states: Vec<_> = (0..shown * shown)
            .map(|e| state_at(e / shown, e % shown))
            .collect();
        let largest_of = |f: usize| {
            let values = states.iter().map(|state| state.field(f).abs());
            values.fold(0.0, f64::max)
        };
        // The sums under single centres have stresses only.
        let mut centres = CentreStresses::new(foundation, 1.0, shown, *friction);
        centres.move_to(plane).unwrap();
        // Under a traction and less than two elements deep they hold what its steps take, which the sums do not.
        let has_steps = friction[0].hypot(friction[1]) > 0.0 && plane.z < 2.0;
        for (e, state) in states.iter().enumerate().filter(|_| !has_steps) {
            let place = [e / shown, e % shown].map(usize::cast_signed);
            let place = [0, 1].map(|axis: usize| place[axis] - before[axis].cast_signed());
            let found = centres.at(&pressure, loaded, place);
            for (f, key) in KEYS.iter().enumerate().skip(3) {
                let error = (found.field(f) - state.field(f)).abs();
                assert!(
                    error <= 1e-12 * largest_of(f) + 1e-14,
                    "{plane:?} {e} {key}"
                );
            }
        }
        let mut grid = PlaneFields::new(foundation, 1.0, squares, &pressure, *friction);
        grid.fields_on(plane, |f, field| {
            let expected: Vec<f64> = states.iter().map(|state| state.field(f)).collect();
            let largest = largest_of(f);
            for (e, (found, expected)) in field.iter().zip(&expected).enumerate() {
                let error = (found - expected).abs();
                assert!(
                    error <= 1e-12 * largest + 1e-14,
                    "{foundation:?} {plane:?} {friction:?} {} {e}: {found:e} {expected:e}",
                    KEYS[f]
                );
            }
        })
        .unwrap();
    }
}

const FRICTIONS: [[f64; 2]; 3] = [[0.0, 0.0], [0.3, 0.0], [-0.2, 0.4]];

#[test]
fn planes_are_the_sums_over_the_elements() {
    let squares = Squares {
        loaded: 5,
        shown: 9,
        before: [3, 1],
    };
    for (foundation, depth) in stacks().iter().zip([0.0, 0.01, 2.0, 1.0, 0.3, 1.0, 0.0]) {
        let plane = Depth {
            z: depth,
            side: Side::Above,
        };
        check_plane(foundation, squares, uneven, plane, &FRICTIONS);
    }
}

/// Here a quadrant stands for the whole grid.
#[test]
fn planes_under_a_mirrored_pressure_are_the_sums_over_the_elements() {
    for (loaded, shown) in [(4, 8), (2, 14), (6, 6)] {
        let squares = Squares {
            loaded,
            shown,
            before: [(shown - loaded) / 2; 2],
        };
        for (foundation, depth) in stacks().iter().zip([0.0, 0.01, 2.0, 1.0, 0.3, 1.0, 0.0]) {
            let plane = Depth {
                z: depth,
                side: Side::Above,
            };
            check_plane(foundation, squares, mirrored, plane, &FRICTIONS);
        }
    }
}

/// Beyond 20 elements the tables hold means instead of integrals.
#[test]
fn planes_reach_far_from_the_load() {
    let squares = Squares {
        loaded: 2,
        shown: 48,
        before: [1, 30],
    };
    for (foundation, depth) in stacks().iter().zip([0.0, 0.02, 2.0, 0.8, 0.3, 1.0, 0.0]) {
        let plane = Depth {
            z: depth,
            side: Side::Above,
        };
        check_plane(foundation, squares, uneven, plane, &[[0.1, 0.2]]);
    }
}
