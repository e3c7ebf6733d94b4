//! Every warning, with a case that triggers it and a neighbour that does not.

use std::f64::consts::FRAC_PI_4;

use pellicle_contact::{
    Cone, Domain, FlatPunch, Indenter, Load, Model, SolverOptions, Warning, solve_path,
};
use pellicle_tests::scene::{coated, cylinders, material, model, paraboloid, unit_half_space};
use pellicle_texture::{Film, Relief};

/// Hertz's contact radius is 0.1.
const LOAD: Load = Load::Force(4e-3 / 3.0);
const SIDE: f64 = 0.3;
/// Enough for three grids, which resolving a peak requires.
const ELEMENTS: usize = 128;

/// Codes of the warnings.
fn codes_with(
    model: &Model,
    side: f64,
    elements: usize,
    options: &SolverOptions,
) -> Vec<&'static str> {
    let path = solve_path(
        model,
        Domain::Side(side),
        elements,
        &[LOAD],
        options,
        &mut (),
    );
    path.unwrap().warnings.iter().map(Warning::code).collect()
}

fn codes(model: &Model, side: f64, elements: usize) -> Vec<&'static str> {
    codes_with(model, side, elements, &SolverOptions::default())
}

fn on_half_space(relief: Relief, indenter: Indenter) -> Model {
    model(&unit_half_space(), relief, indenter)
}

fn bare(indenter: Indenter) -> Model {
    on_half_space(Relief::Bare, indenter)
}

/// One case warns; the other, which differs in one number, does not.
fn assert_warns_in_case_only(code: &str, case: &[&str], neighbour: &[&str]) {
    assert!(case.contains(&code), "{code} not in {case:?}");
    assert!(!neighbour.contains(&code), "{code} in {neighbour:?}");
}

#[test]
fn a_plain_contact_gives_no_warning() {
    let found = codes(&bare(paraboloid(1.0)), SIDE, ELEMENTS);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn domain_edge() {
    let model = bare(paraboloid(1.0));
    let [case, neighbour] = [0.206, 0.25].map(|side| codes(&model, side, ELEMENTS));
    assert_warns_in_case_only("domain-edge", &case, &neighbour);
}

#[test]
fn cut_off() {
    let model = bare(paraboloid(1.0));
    let [case, neighbour] = [0.19, 0.206].map(|side| codes(&model, side, ELEMENTS));
    assert_warns_in_case_only("cut-off", &case, &neighbour);
    assert!(!case.contains(&"domain-edge"), "{case:?}");
}

#[test]
fn domain_much_larger() {
    let model = bare(paraboloid(1.0));
    let [case, neighbour] = [4.0, 2.0].map(|side| codes(&model, side, ELEMENTS));
    assert_warns_in_case_only("domain-much-larger", &case, &neighbour);
}

#[test]
fn film_shortening() {
    // The same compliance, hence the same shortening, at a tenth of the thickness.
    let [case, neighbour] = [1e-3, 1e-2].map(|thickness| {
        let film = Relief::Film(Film::new(thickness, thickness / 0.05).unwrap());
        codes(&on_half_space(film, paraboloid(1.0)), SIDE, ELEMENTS)
    });
    assert_warns_in_case_only("film-shortening", &case, &neighbour);
}

#[test]
fn texture_under_resolved() {
    let model = on_half_space(cylinders(0.008, 1e-3, 0.02, 1.0), paraboloid(1.0));
    // 3.4 and 5.1 elements per radius.
    let [case, neighbour] = [128, 192].map(|elements| codes(&model, SIDE, elements));
    assert_warns_in_case_only("texture-under-resolved", &case, &neighbour);
}

#[test]
fn layer_under_resolved() {
    // 0.013 and 0.043 elements.
    let [case, neighbour] = [3e-5, 1e-4].map(|thickness| {
        let body = coated(thickness, material(2.0, 0.3), material(1.0, 0.3));
        codes(&model(&body, Relief::Bare, paraboloid(1.0)), SIDE, ELEMENTS)
    });
    assert_warns_in_case_only("layer-under-resolved", &case, &neighbour);
}

#[test]
fn peak_not_resolved() {
    let punch = Indenter::FlatPunch(FlatPunch::new(0.1).unwrap());
    let [case, neighbour] =
        [punch, paraboloid(1.0)].map(|indenter| codes(&bare(indenter), SIDE, ELEMENTS));
    assert_warns_in_case_only("peak-not-resolved", &case, &neighbour);
}

#[test]
fn steep_indenter() {
    // Slopes 1 and 0.27.
    let [case, neighbour] = [FRAC_PI_4, 1.31].map(|half_angle| {
        let cone = Indenter::Cone(Cone::new(half_angle, 0.0).unwrap());
        codes(&bare(cone), SIDE, ELEMENTS)
    });
    assert_warns_in_case_only("steep-indenter", &case, &neighbour);
}

#[test]
fn not_converged() {
    let [case, neighbour] = [2, 100].map(|max_applications| {
        let options = SolverOptions {
            max_applications,
            ..SolverOptions::default()
        };
        codes_with(&bare(paraboloid(1.0)), SIDE, ELEMENTS, &options)
    });
    assert_warns_in_case_only("not-converged", &case, &neighbour);
}
