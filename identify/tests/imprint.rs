//! The effective indenter of an unloading in a case: its contact at the largest force, and the stresses inside.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

use std::path::Path;
use std::sync::Arc;

use pellicle::Case;
use pellicle::input::span::Source;
use pellicle::run::Run;
use pellicle_contact::reference::power_law::{self, PowerLawContact};
use pellicle_identify::fit_file::{FitFile, FitSources, Measurements};
use pellicle_identify::indentation::{EffectiveIndenter, UnloadingPoint};
use pellicle_influence::ElasticBodies;
use pellicle_kernel::{Foundation, Material};

const OXIDE: [f64; 2] = [72e9, 0.17];
const SILICON: [f64; 2] = [170e9, 0.22];
const UNLOADING: UnloadingPoint = UnloadingPoint {
    force: 2e-3,
    stiffness: 50e3,
    exponent: 1.3,
};

fn material([young, poisson]: [f64; 2]) -> Material {
    Material::new(young, poisson).unwrap()
}

/// The run of a case with this foundation, under the largest force.
fn solved(foundation: &str, indenter: &EffectiveIndenter) -> Run {
    let text = format!(
        "[foundation]\n{foundation}\n[indenter]\nkind = \"power\"\nexponent = {:e}\ncoefficient = {:e}\n\
         [load]\nforce = {:e}\n[grid]\nelements = 128\n[stress]\nonly = [\"max_von_mises\"]\n",
        indenter.shape.exponent(),
        indenter.shape.coefficient(),
        UNLOADING.force,
    );
    let source = Arc::new(Source::new("imprint.toml", text));
    let case = Case::parse(&source, "imprint", Path::new(""), &[]).unwrap();
    case.solve(&mut ()).unwrap()
}

fn assert_near(found: f64, wanted: f64, within: f64) {
    let error = found / wanted - 1.0;
    assert!(error.abs() < within, "{found:e}, {wanted:e}: {error:e}");
}

/// Largest von Mises stress on the axis below a pressure: that of a ring's forces by Boussinesq,
///
/// ```text
/// σ_z = −∫ 3 p z³ r/R⁵ dr,    σ_r = ∫ p r ½ ((1 − 2ν) z/R³ − 3 r² z/R⁵) dr,    R² = r² + z²
/// ```
fn largest_on_the_axis(contact: &PowerLawContact, nu: f64) -> f64 {
    let a = contact.contact_radius;
    // r = a sin θ removes the root at the edge: midpoints.
    let rings: Vec<[f64; 2]> = (0..400)
        .map(|k| {
            let theta = (f64::from(k) + 0.5) / 400.0 * std::f64::consts::FRAC_PI_2;
            let r = a * theta.sin();
            let width = a * theta.cos() * std::f64::consts::FRAC_PI_2 / 400.0;
            [r, contact.pressure(r) * r * width]
        })
        .collect();
    let mises = |z: f64| {
        let [along, across] = rings.iter().fold([0.0; 2], |[along, across], [r, force]| {
            let distance = r.hypot(z);
            let cubes = z / distance.powi(3);
            let fifth = z / distance.powi(5);
            [
                along - 3.0 * force * z * z * fifth,
                across + 0.5 * force * ((1.0 - 2.0 * nu) * cubes - 3.0 * r * r * fifth),
            ]
        });
        (along - across).abs()
    };
    (1..200)
        .map(|k| mises(0.01 * f64::from(k) * a))
        .fold(0.0, f64::max)
}

#[test]
fn on_a_half_space_the_imprint_has_the_closed_forms_pressure_and_stress() {
    let [young, poisson] = OXIDE;
    let body = Foundation::half_space(material(OXIDE));
    // Up to n = 2.5 or so the largest von Mises stress is on the axis, under flatter indenters around it.
    let unloading = UnloadingPoint {
        exponent: 1.45,
        ..UNLOADING
    };
    let indenter = EffectiveIndenter::of(&unloading, &body.into()).unwrap();
    let shape = [indenter.shape.exponent(), indenter.shape.coefficient()];
    let modulus = material(OXIDE).plane_strain_modulus();
    let wanted = power_law::from_force(shape, modulus, UNLOADING.force);
    assert_near(
        wanted.contact_radius,
        0.5 * UNLOADING.stiffness / modulus,
        1e-9,
    );

    let run = solved(
        &format!("substrate = {{ young_modulus = {young}, poisson_ratio = {poisson} }}"),
        &indenter,
    );
    let step = &run.summary.steps[0];
    // 1.45 P/S; of second order in the element, 1/40 of the contact radius.
    assert_near(step.penetration, 1.45 * 2e-3 / 50e3, 1e-4);
    let solution = &run.path.steps[0].solution;
    let mut compared = 0;
    for (pressure, [x, y]) in solution.pressure.iter().zip(run.path.grid.centres()) {
        let distance = x.hypot(y);
        if distance < 0.9 * wanted.contact_radius {
            // The mean over an element against its middle.
            assert_near(*pressure, wanted.pressure(distance), 5e-3);
            compared += 1;
        }
    }
    assert!(compared > 3000, "{compared}");
    let extremes = &step.stress.as_ref().unwrap().extremes;
    let found = extremes.bodies[0].max_von_mises.unwrap();
    let on_axis = largest_on_the_axis(&wanted, poisson);
    assert_near(found.value, on_axis, 1e-3);
    assert!(found.at[0].hypot(found.at[1]) < 0.05 * wanted.contact_radius);
}

#[test]
fn on_a_coating_the_case_has_the_unloadings_force_depth_and_stiffness_and_tells_where_it_yields() {
    let body = Foundation::coated(500e-9, material(OXIDE), material(SILICON)).unwrap();
    let indenter = EffectiveIndenter::of(&UNLOADING, &ElasticBodies::from(body)).unwrap();
    let [[e1, nu1], [e2, nu2]] = [OXIDE, SILICON];
    let run = solved(
        &format!(
            "substrate = {{ young_modulus = {e2}, poisson_ratio = {nu2} }}\n\
             layer = [{{ thickness = \"500 nm\", young_modulus = {e1}, poisson_ratio = {nu1} }}]"
        ),
        &indenter,
    );
    let step = &run.summary.steps[0];
    assert_near(step.penetration, 1.3 * 2e-3 / 50e3, 1e-4);
    // The stiffness of whole elements, of first order.
    assert_near(step.contact_stiffness.unwrap(), 50e3, 5e-3);
    assert_near(step.summary.contact_radius, indenter.contact_radius, 2e-3);
    let extremes = &step.stress.as_ref().unwrap().extremes;
    let names: Vec<&str> = extremes
        .bodies
        .iter()
        .map(|body| body.name.as_str())
        .collect();
    assert_eq!(names, ["layer[0]", "substrate"]);
    let [coat, base] = [0, 1].map(|body: usize| extremes.bodies[body].max_von_mises.unwrap());
    // The coating yields first, below the middle of the contact.
    assert!(coat.resolved && base.resolved && coat.value > base.value);
    assert!((0.0..500e-9).contains(&coat.at[2]) && base.at[2] >= 500e-9);
}

#[test]
fn an_exponent_is_sought_where_it_has_neighbours_and_a_cone_has_none_to_seek() {
    let fit = |exponent: &str| {
        let text = format!(
            "[model.foundation]\nsubstrate = {{ young_modulus = \"72 GPa\", poisson_ratio = 0.17 }}\n\
             [model.indenter]\nkind = \"power\"\nexponent = {exponent}\ncoefficient = \"1 um\"\n\
             [unknown]\n\"indenter.exponent\" = {{ from = 0.5, to = 80 }}\n\
             \"indenter.coefficient\" = {{ from = \"0.1 um\", to = \"10 um\" }}\n"
        );
        let source = Arc::new(Source::new("fit.toml", text));
        let sources = FitSources::in_folder(Path::new(""));
        FitFile::parse(&source, "fit", &sources, Measurements::Optional)
    };
    let unknowns = fit("3.3").unwrap().all_unknowns();
    // In the order of their keys.
    let [low, high] = unknowns[1].range;
    assert!((low - 1.001).abs() + (high - 49.0).abs() < 1e-12);
    assert_eq!([unknowns[0].unit(), unknowns[1].unit()], ["m", "1"]);
    // At exponent 1 the coefficient is of no effect and the exponent at its end.
    assert!(fit("1").is_err());
}
