//! Paraboloids and cones on coated bodies converge to the axisymmetric solutions of 22 digits.

use std::f64::consts::FRAC_PI_4;

use pellicle_contact::{Cone, Indenter, Load};
use pellicle_tests::convergence::{GRIDS, demand};
use pellicle_tests::scene::{coated, material, model, paraboloid, penetration, relative};
use pellicle_texture::Relief;
use pellicle_validation::data::contact::{AxisymmetricContact, AxisymmetricIndenter, axisymmetric};

/// Side of the domain, in contact radii.
const SIDE: f64 = 2.4;
/// Elements per side beyond [`GRIDS`], for thin coatings.
const FINER: [usize; 2] = [512, 640];
/// With fewer than five elements in its thickness a soft coating is not resolved.
const ELEMENTS_IN_COATING: f64 = 5.0;

/// Errors of the penetration over the nine coarsest grids that resolve the coating.
fn errors(case: &AxisymmetricContact, perturbation: f64) -> Vec<(usize, f64)> {
    let foundation = coated(
        case.thickness,
        material(case.e1, case.nu1),
        material(1.0, case.nu2),
    );
    let indenter = match case.shape {
        AxisymmetricIndenter::Paraboloid => paraboloid(1.0),
        // z = r: 45 degrees between axis and side.
        AxisymmetricIndenter::Cone => Indenter::Cone(Cone::new(FRAC_PI_4, 0.0).expect("a cone")),
    };
    let mut model = model(&foundation, Relief::Bare, indenter);
    model.tables = model.tables.perturbed(perturbation).into();
    let resolves =
        |elements: &usize| SIDE / *elements as f64 <= case.thickness / ELEMENTS_IN_COATING;
    let error = |elements| {
        let found = penetration(&model, SIDE, elements, Load::Force(case.force));
        (elements, relative(found, case.penetration))
    };
    let grids = GRIDS.into_iter().chain(FINER).filter(resolves);
    grids.take(GRIDS.len()).map(error).collect()
}

fn cases(shape: AxisymmetricIndenter) -> impl Iterator<Item = AxisymmetricContact> {
    let cases = axisymmetric().expect("the data");
    cases.into_iter().filter(move |case| case.shape == shape)
}

#[test]
fn paraboloids_on_coatings_approach_the_continuum_with_order_two() {
    for case in cases(AxisymmetricIndenter::Paraboloid) {
        let found = demand(&errors(&case, 0.0), 1.8, 3e-6);
        assert!(found.is_ok(), "{case:?}: {found:?}");
    }
}

#[test]
fn cones_on_coatings_approach_the_continuum_with_order_two() {
    for case in cases(AxisymmetricIndenter::Cone) {
        let found = demand(&errors(&case, 0.0), 1.8, 3e-6);
        assert!(found.is_ok(), "{case:?}: {found:?}");
    }
}

#[test]
fn coefficients_wrong_by_a_thousandth_converge_to_a_wrong_limit_and_are_refused() {
    let case = cases(AxisymmetricIndenter::Paraboloid)
        .next()
        .expect("a case");
    let found = demand(&errors(&case, 1e-3), 1.8, 1.0);
    assert!(found.is_err(), "{found:?}");
}
