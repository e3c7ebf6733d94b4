//! A loaded square on a half-space, compared with sums of point loads.

use std::f64::consts::PI;

use pellicle_influence::{Depth, ElementFields};
use pellicle_kernel::{Foundation, Material, Side};

use super::{KEYS, nine, stacks};

/// Boussinesq's and Cerruti's solutions for unit forces on the surface of a half-space (Johnson 1985, (3.18), (3.75)).
fn point_loads(material: Material, [x, y, z]: [f64; 3]) -> [[f64; 9]; 2] {
    let (nu, r) = (material.poisson_ratio(), x.hypot(y).hypot(z));
    let (c, depth) = (1.0 - 2.0 * nu, r + z);
    let displacement = 1.0 / (4.0 * PI * material.shear_modulus());
    let stress = 1.0 / (2.0 * PI);
    let r5 = r.powi(5);
    // for the horizontal force: c (x²/(r³ (r+z)²) + 2 x²/(r² (r+z)³)) and similar terms
    let mixed = c * (1.0 / (r.powi(3) * depth.powi(2)) + 2.0 / (r.powi(2) * depth.powi(3)));
    let along = |u: f64| {
        c * (z / r.powi(3) - 1.0 / (r * depth)
            + u * u * (2.0 * r + z) / (r.powi(3) * depth.powi(2)))
    };
    let normal = [
        displacement * (x * z / r.powi(3) - c * x / (r * depth)),
        displacement * (y * z / r.powi(3) - c * y / (r * depth)),
        displacement * (z * z / r.powi(3) + 2.0 * (1.0 - nu) / r),
        stress * (along(x) - 3.0 * x * x * z / r5),
        stress * (along(y) - 3.0 * y * y * z / r5),
        stress * (-3.0 * z.powi(3) / r5),
        stress * (c * x * y * (2.0 * r + z) / (r.powi(3) * depth.powi(2)) - 3.0 * x * y * z / r5),
        stress * (-3.0 * x * z * z / r5),
        stress * (-3.0 * y * z * z / r5),
    ];
    let tangential = [
        displacement
            * (1.0 / r + x * x / r.powi(3) + c * (1.0 / depth - x * x / (r * depth * depth))),
        displacement * (x * y / r.powi(3) - c * x * y / (r * depth * depth)),
        displacement * (x * z / r.powi(3) + c * x / (r * depth)),
        stress
            * x
            * (-3.0 * x * x / r5
                + c * (1.0 / r.powi(3) - 3.0 / (r * depth * depth))
                + x * x * mixed),
        stress
            * x
            * (-3.0 * y * y / r5
                + c * (1.0 / r.powi(3) - 1.0 / (r * depth * depth))
                + y * y * mixed),
        stress * (-3.0 * x * z * z / r5),
        stress * y * (-3.0 * x * x / r5 - c / (r * depth * depth) + x * x * mixed),
        stress * (-3.0 * x * x * z / r5),
        stress * (-3.0 * x * y * z / r5),
    ];
    [normal, tangential]
}

/// Nodes and weights of Gauss's rule of six points on −1 … 1 (Abramowitz and Stegun 1964, table 25.4).
const GAUSS: [[f64; 2]; 3] = [
    [0.238_619_186_083_196_9, 0.467_913_934_572_691],
    [0.661_209_386_466_264_5, 0.360_761_573_048_138_6],
    [0.932_469_514_203_152, 0.171_324_492_379_170_3],
];

#[test]
fn a_square_is_the_sum_of_its_points() {
    for nu in [0.0, 0.3, 0.5] {
        let material = Material::new(2.0, nu).unwrap();
        let foundation = Foundation::half_space(material);
        for [x, y, z] in [
            [4.0, 2.5, 0.15],
            [-4.0, 3.0, 0.15],
            [0.2, 3.0, 0.0],
            [0.1, -0.2, 4.0],
            [-2.0, -7.0, 1.0],
        ] {
            let plane = Depth {
                z,
                side: Side::Above,
            };
            let fields = ElementFields::new(&foundation, 1.0, plane, 9.0)
                .unwrap()
                .at([x, y]);
            let mut sums = [[0.0; 9]; 2];
            let nodes = || {
                GAUSS
                    .iter()
                    .flat_map(|[at, weight]| [[*at, *weight], [-at, *weight]])
            };
            for [a, one] in nodes() {
                for [b, other] in nodes() {
                    let loads = point_loads(material, [x - a / 2.0, y - b / 2.0, z]);
                    for (sums, values) in sums.iter_mut().zip(loads) {
                        for (sum, value) in sums.iter_mut().zip(values) {
                            *sum += one * other / 4.0 * value;
                        }
                    }
                }
            }
            for (found, expected) in [fields.normal, fields.tangential].iter().zip(sums) {
                for (f, (found, expected)) in nine(found).iter().zip(expected).enumerate() {
                    // The error of the rule is 3e-12 of the nearest point's value.
                    let scale = 0.1;
                    assert!(
                        (found - expected).abs() < 1e-11 * scale,
                        "{nu} {x} {y} {z} {}: {found:e}, {expected:e}",
                        KEYS[f]
                    );
                }
            }
        }
    }
}

/// Depending on the distance, an element's fields come from the closed form and Gauss points, from four points, or from
/// functions of its own, and those of its sixteenths from others.
#[test]
fn an_element_is_the_sum_of_its_sixteenths() {
    for (foundation, z) in stacks().iter().zip([0.0, 0.3, 20.0, 0.6, 0.2, 60.0, 3.0]) {
        let plane = Depth {
            z,
            side: Side::Above,
        };
        let whole = ElementFields::new(foundation, 1.0, plane, 800.0).unwrap();
        let part = ElementFields::new(foundation, 0.25, plane, 800.0).unwrap();
        let parts: Vec<_> = (0..16)
            .map(|i| [i / 4, i % 4].map(|along| f64::from(along) / 4.0 - 0.375))
            .map(|centre| (centre, 1.0))
            .collect();
        let distances = [0.1, 1.0, 5.0, 11.0, 39.7, 40.5, 100.0, 298.0, 301.0, 790.0];
        // Off the axes of symmetry, where some fields vanish.
        let points: Vec<[f64; 2]> = [0.1_f64, 0.5, 2.0]
            .iter()
            .flat_map(|angle| distances.map(|r| [r * angle.cos(), r * angle.sin()]))
            .collect();
        for friction in [[0.0; 2], [1.0, 0.0], [0.5, -2.0]] {
            let of = |fields: &ElementFields, loaded: &[([f64; 2], f64)]| -> Vec<[f64; 9]> {
                let state = |point: &[f64; 2]| nine(&fields.sum_over(loaded, friction, *point));
                points.iter().map(state).collect()
            };
            let (found, expected) = (of(&whole, &[([0.0; 2], 1.0)]), of(&part, &parts));
            for f in 0..9 {
                let largest = expected
                    .iter()
                    .fold(0.0, |most: f64, values| most.max(values[f].abs()));
                for ((found, expected), point) in found.iter().zip(&expected).zip(&points) {
                    let error = (found[f] - expected[f]).abs();
                    // On the surface under a pressure the shear stresses are 0 except for rounding.
                    assert!(
                        error < 3e-12 * largest + 1e-15,
                        "{foundation:?} {z} {friction:?} {point:?} {}: {error:e}",
                        KEYS[f]
                    );
                }
            }
        }
    }
}
