//! Limits beyond the rows of `pellicle validate`: how a coating comes to be felt, and the area on springs alone.

use pellicle_contact::{Load, reference};
use pellicle_kernel::{Foundation, Material};
use pellicle_tests::scene::{coated, material, model, paraboloid, relative, solve};
use pellicle_texture::{Film, Relief};

/// Penetration and pressures of a paraboloid on a body, on 64 elements per side.
fn pressed(foundation: &Foundation) -> (f64, Vec<f64>) {
    let model = model(foundation, Relief::Bare, paraboloid(1.0));
    let mut path = solve(&model, 0.3, 64, Load::Force(1.3e-3));
    let solution = path.steps.remove(0).solution;
    (solution.penetration, solution.pressure)
}

#[test]
fn a_coating_of_the_substrates_own_material_is_not_felt() {
    for nu in [0.0, 0.3, 0.5] {
        let body = material(0.91, nu);
        let (penetration, pressure) = pressed(&Foundation::half_space(body));
        // The same but for a bit, so that it is computed as a coating: equal materials are known for a half-space at
        // once.
        let coating = material(0.91_f64.next_up(), nu);
        for thickness in [1e-4, 0.05, 10.0] {
            let (found, pressures) = pressed(&coated(thickness, coating, body));
            // The solver's own tolerance, 1e-8, bounds what rounding of the coefficients may start.
            assert!(relative(found, penetration) < 1e-9, "{found} {penetration}");
            for (p, q) in pressure.iter().zip(pressures) {
                assert!((p - q).abs() < 1e-6 * 0.06);
            }
        }
    }
}

/// How much less or more the paraboloid sinks in than into a homogeneous body.
fn felt(thickness: f64, coating: Material, substrate: Material, alone: Material) -> f64 {
    let (wanted, _) = pressed(&Foundation::half_space(alone));
    relative(pressed(&coated(thickness, coating, substrate)).0, wanted)
}

#[test]
fn a_thin_coating_is_felt_in_proportion_to_its_thickness() {
    let (coating, substrate) = (material(5.0, 0.2), material(0.91, 0.3));
    let [more, less] = [1e-5, 1e-6].map(|h| felt(h, coating, substrate, substrate));
    // First order in H/a: ten times thinner, ten times less.
    assert!((more / less - 10.0).abs() < 0.5, "{more} {less}");
    assert!(less < 1e-4, "{less}");
}

#[test]
fn a_thick_coating_hides_its_substrate_in_proportion_to_its_thickness() {
    let (coating, substrate) = (material(0.91, 0.3), material(5.0, 0.2));
    let [more, less] = [10.0, 100.0].map(|h| felt(h, coating, substrate, coating));
    // First order in a/H.
    assert!((more / less - 10.0).abs() < 0.5, "{more} {less}");
    assert!(less < 1e-2, "{less}");
}

#[test]
fn the_contact_area_on_springs_alone_is_winklers() {
    // Film compliance 0.01; the body gives way by less than 1e-9 of that.
    let foundation = Foundation::half_space(material(1e9, 0.3));
    let film = Relief::Film(Film::new(0.01, 1.0).expect("a film"));
    let winkler = reference::winkler::from_penetration(1.0, 0.01, 0.005);
    let load = Load::Penetration(winkler.penetration);
    let path = solve(&model(&foundation, film, paraboloid(1.0)), 0.25, 256, load);
    let found = path.steps[0].summary.contact_area;
    assert!(relative(found, winkler.contact_area) < 1e-2, "{found}");
}
