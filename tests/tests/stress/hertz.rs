//! The stress below a Hertzian contact on grids.

use pellicle_contact::reference::hertz::from_contact_radius;
use pellicle_contact::reference::hertz_stress::{HalfSpace, under_pressure, under_traction};
use pellicle_contact::{Load, Sliding, StressField};
use pellicle_influence::Depth;
use pellicle_kernel::{Foundation, Material, Side};
use pellicle_tests::convergence::demand;
use pellicle_validation::{
    ValidationRun,
    run::{ContactSetup, paraboloid},
};

const GRIDS: [usize; 7] = [64, 80, 104, 128, 160, 208, 256];

/// Points in contact radii, all deeper than the elements of the coarsest grid are wide.
const POINTS: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.481],
    [0.0, 0.0, 1.5],
    [0.5, 0.3, 0.25],
    [-0.8, 0.6, 0.2],
    [1.1, -0.2, 0.2],
    [-1.4, 1.5, 0.6],
];

/// The largest error of six stresses at the points, in units of the largest pressure, on each grid.
fn errors(nu: f64, friction: f64) -> Vec<(usize, f64)> {
    let material = Material::new(1.0 - nu * nu, nu).unwrap();
    let body = HalfSpace {
        shear_modulus: material.shear_modulus(),
        poisson_ratio: nu,
    };
    let wanted = from_contact_radius(1.0, 1.0, 0.1);
    let sliding = Sliding {
        friction,
        direction: 0.0,
    };
    let error = |elements| {
        let path = ValidationRun::default().solve(&ContactSetup::bare(
            Foundation::half_space(material),
            paraboloid(1.0).unwrap(),
            (0.27, elements),
            Load::Force(wanted.force),
        ));
        let field = StressField::new(&path.unwrap(), 0, sliding).unwrap();
        let of_point = |point: &[f64; 3]| {
            let [x, y, z] = point.map(|along| along * wanted.contact_radius);
            let side = Side::Above;
            let found = field.at([x, y], Depth { z, side }).unwrap().stress;
            let exact = under_pressure(&wanted, body, [x, y, z])
                + under_traction(&wanted, body, [x, y, z]) * friction;
            let pairs = found.iter().zip(exact.stress);
            pairs.fold(0.0_f64, |worst, (found, exact)| {
                worst.max((found - exact).abs())
            })
        };
        let worst = POINTS.iter().map(of_point).fold(0.0, f64::max);
        (elements, worst / wanted.peak_pressure)
    };
    GRIDS.map(error).to_vec()
}

#[test]
fn stresses_converge_to_hubers_with_second_order() {
    for nu in [0.0, 0.3, 0.5] {
        let errors = errors(nu, 0.0);
        let order = demand(&errors, 1.6, 1.5e-4);
        assert!(order.is_ok(), "{nu}: {order:?} {errors:?}");
    }
}

#[test]
fn stresses_under_sliding_converge_to_hamiltons_with_second_order() {
    let errors = errors(0.3, 0.4);
    let order = demand(&errors, 1.6, 1.5e-4);
    assert!(order.is_ok(), "{order:?} {errors:?}");
}

#[test]
fn a_poisson_ratio_wrong_by_a_hundredth_changes_the_stress() {
    // Control: the closed form for ν = 0.31 is off by 1e-2.
    let body = |poisson_ratio| HalfSpace {
        shear_modulus: 1.0,
        poisson_ratio,
    };
    let contact = from_contact_radius(1.0, 1.0, 0.1);
    let [one, other] = [0.3, 0.31].map(|nu| under_pressure(&contact, body(nu), [0.0, 0.0, 0.02]));
    let change = (one.stress[0] - other.stress[0]).abs() / contact.peak_pressure;
    assert!(change > 5e-3, "{change}");
}
