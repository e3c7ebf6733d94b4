//! Hamilton's stresses compared with the equations that they solve, and with Huber's on the axis.

use super::super::hertz;
use super::*;

type Field = fn(&HertzContact, HalfSpace, [f64; 3]) -> SubsurfaceState;

const LOADS: [Field; 2] = [under_pressure, under_traction];
const POINTS: [[f64; 3]; 5] = [
    [0.3, 0.2, 0.4],
    [-0.9, 0.5, 0.1],
    [1.4, -1.1, 0.7],
    [0.2, 0.1, 1.0],
    [0.0, -2.0, 0.05],
];

fn body(poisson_ratio: f64) -> HalfSpace {
    HalfSpace {
        shear_modulus: 1.3,
        poisson_ratio,
    }
}

/// Contact radius 1, largest pressure 1.
fn unit_contact(body: HalfSpace) -> HertzContact {
    let modulus = 2.0 * body.shear_modulus / (1.0 - body.poisson_ratio);
    let contact = hertz::from_contact_radius(2.0 * modulus / std::f64::consts::PI, modulus, 1.0);
    assert!((contact.peak_pressure - 1.0).abs() < 1e-15);
    contact
}

/// `∂/∂x_i` of all fields by differences of fourth order over steps of 1e-3.
fn slope(field: Field, body: HalfSpace, point: [f64; 3], axis: usize) -> SubsurfaceState {
    let step = 1e-3;
    let mut sum = SubsurfaceState::default();
    for (count, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
        let mut beside = point;
        beside[axis] += count * step;
        sum += field(&unit_contact(body), body, beside) * (weight / (12.0 * step));
    }
    sum
}

/// The tensor of a state's stresses.
fn tensor(state: &SubsurfaceState) -> [[f64; 3]; 3] {
    let [xx, yy, zz, xy, xz, yz] = state.stress;
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// The error of the differences is a thirtieth of h⁴ times the fifth derivative. Near the rim, where stresses vary like
/// the square root of the distance d, it is about `6 h⁴/30 d^4.5`, 6e-9 at a tenth of a radius.
const DIFFERENCE: f64 = 2e-8;

#[test]
fn stresses_are_in_equilibrium_everywhere() {
    for field in LOADS {
        for point in POINTS {
            let slopes = [0, 1, 2].map(|axis| tensor(&slope(field, body(0.3), point, axis)));
            let sums = [0, 1, 2].map(|row| (0..3).map(|axis| slopes[axis][axis][row]).sum::<f64>());
            assert!(
                sums.iter().all(|sum| sum.abs() < DIFFERENCE),
                "{point:?}: {sums:?}"
            );
        }
    }
}

#[test]
fn stresses_follow_from_the_displacements_by_hookes_law() {
    for (field, nu) in LOADS
        .into_iter()
        .flat_map(|load| [(load, 0.0), (load, 0.3)])
    {
        let body = body(nu);
        for point in POINTS {
            let slopes = [0, 1, 2].map(|axis| slope(field, body, point, axis).displacement);
            let dilatation: f64 = (0..3).map(|axis| slopes[axis][axis]).sum();
            let found = tensor(&field(&unit_contact(body), body, point));
            for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)] {
                // σ = G (∂_i u_j + ∂_j u_i) + 2Gν/(1 − 2ν) Σ ∂u δ_ij
                let shear = slopes[i][j] + slopes[j][i];
                let volume = 2.0 * nu / (1.0 - 2.0 * nu) * dilatation;
                let wanted = body.shear_modulus * (shear + if i == j { volume } else { 0.0 });
                let error = (found[i][j] - wanted).abs();
                assert!(error < DIFFERENCE, "{nu} {point:?} {i}{j}: {error:e}");
            }
        }
    }
}

#[test]
fn surface_tractions_are_the_load_alone() {
    let body = body(0.3);
    let contact = unit_contact(body);
    let points: [[f64; 2]; 5] = [[0.0, 0.0], [0.3, -0.4], [0.6, 0.7], [0.9, 0.9], [-3.0, 1.0]];
    for [x, y] in points {
        let pressure = contact.pressure(x.hypot(y));
        let [_, _, zz, _, xz, yz] = under_pressure(&contact, body, [x, y, 0.0]).stress;
        let dragged = under_traction(&contact, body, [x, y, 0.0]).stress;
        let errors = [
            zz + pressure,
            xz,
            yz,
            dragged[2],
            dragged[4] + pressure,
            dragged[5],
        ];
        for error in errors {
            assert!(error.abs() < 1e-13, "{x} {y}: {errors:?}");
        }
    }
}

#[test]
fn the_surface_displacement_is_that_of_hertz() {
    let body = body(0.3);
    let contact = unit_contact(body);
    let radius = contact.contact_radius.powi(2) / contact.penetration;
    for r in [0.0, 0.4, 1.0] {
        let sinking = under_pressure(&contact, body, [r, 0.0, 0.0]).displacement[2];
        // u_z = D − r²/2R
        let wanted = contact.penetration - r * r / (2.0 * radius);
        assert!((sinking - wanted).abs() < 1e-14, "{r}: {sinking} {wanted}");
    }
}

#[test]
fn stresses_on_the_axis_are_those_of_huber() {
    for nu in [0.0, 0.28, 0.5] {
        let body = body(nu);
        for z in [0.0, 0.01, 0.481, 1.0, 7.0] {
            let found = under_pressure(&unit_contact(body), body, [0.0, 0.0, z]).stress;
            // σ_zz = −p₀/(1 + z²), σ_rr = −p₀ ((1 + ν)(1 − z atan 1/z) − ½/(1 + z²))
            let axial = 1.0 / (1.0 + z * z);
            let radial = (1.0 + nu) * (1.0 - z * 1.0_f64.atan2(z)) - 0.5 * axial;
            let wanted = [-radial, -radial, -axial, 0.0, 0.0, 0.0];
            for (found, wanted) in found.iter().zip(wanted) {
                assert!(
                    (found - wanted).abs() < 3e-14 * (1.0 + z * z),
                    "{nu} {z}: {found:e} {wanted:e}"
                );
            }
        }
    }
}

#[test]
fn the_radial_tension_at_the_rim_is_a_third_of_one_minus_two_nu_times_the_peak() {
    let body = body(0.3);
    let contact = unit_contact(body);
    // Outside, σ_rr = p₀ (1 − 2ν) a²/3r²
    for r in [1.0 + 1e-9, 1.5, 4.0] {
        let radial = under_pressure(&contact, body, [0.0, r, 0.0]).stress[1];
        let wanted = (1.0 - 0.6) / (3.0 * r * r);
        assert!((radial - wanted).abs() < 1e-8, "{r}: {radial}");
    }
}

#[test]
fn the_largest_von_mises_stress_is_0_620_at_0_481_radii() {
    let body = body(0.3);
    let contact = unit_contact(body);
    let at = |z: f64| under_pressure(&contact, body, [0.0, 0.0, z]).von_mises();
    let depths = (1..1000).map(|count| f64::from(count) * 1e-3);
    let deepest = depths.max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap();
    assert_eq!(deepest, 0.481);
    assert!((at(deepest) - 0.620).abs() < 5e-4, "{}", at(deepest));
}
