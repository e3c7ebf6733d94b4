//! Against closed forms: Hertz, cone, flat punch, Winkler, and the limits in which a coating is not felt.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_contact::{
    Cone, Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Paraboloid, SolverOptions,
    reference, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_tests::convergence::{GRIDS, observed_order};
use pellicle_texture::{Film, Relief};

/// Plane-strain modulus 1 with Poisson's ratio 0.3.
fn body() -> Material {
    Material::new(0.91, 0.3).unwrap()
}

fn model(foundation: &Foundation, relief: Relief, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter,
        cache: Cache::none(),
    }
}

fn solve(model: &Model, side: f64, elements: usize, load: Load) -> LoadingPath {
    let path = solve_path(
        model,
        Domain::Side(side),
        elements,
        &[load],
        &SolverOptions::default(),
        &mut (),
    )
    .unwrap();
    assert!(
        path.steps[0].solution.certificate.is_satisfied(),
        "{:?}",
        path.steps[0].solution.certificate
    );
    path
}

fn paraboloid(radius: f64) -> Indenter {
    Indenter::Paraboloid(Paraboloid::new(radius).unwrap())
}

/// Observed order of an error over all grids.
fn order(error: impl Fn(usize) -> f64) -> f64 {
    let errors = GRIDS.map(|elements| (elements, error(elements)));
    observed_order(&errors)
}

fn relative(found: f64, wanted: f64) -> f64 {
    (found / wanted - 1.0).abs()
}

/// Root mean square of the pressure's error over the closed form's own.
fn pressure_error(path: &LoadingPath, pressure: impl Fn(f64) -> f64) -> f64 {
    let (mut difference, mut total) = (0.0, 0.0);
    for (found, [x, y]) in path.steps[0]
        .solution
        .pressure
        .iter()
        .zip(path.grid.centres())
    {
        let wanted = pressure(x.hypot(y));
        difference += (found - wanted).powi(2);
        total += wanted.powi(2);
    }
    (difference / total).sqrt()
}

#[test]
fn a_paraboloid_on_a_homogeneous_body_is_hertzs_contact() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let model = model(
        &Foundation::half_space(body()),
        Relief::Bare,
        paraboloid(1.0),
    );
    let path = |elements| solve(&model, 0.3, elements, Load::Force(hertz.force));
    let penetration = order(|n| relative(path(n).steps[0].solution.penetration, hertz.penetration));
    let pressure = order(|n| pressure_error(&path(n), |distance| hertz.pressure(distance)));
    // Smooth but for the square root at the edge: two for the penetration, one for the pressure's mean square.
    assert!(penetration > 1.8, "{penetration}");
    assert!(pressure > 0.9, "{pressure}");
    let fine = path(256);
    let summary = fine.steps[0].summary;
    assert!(relative(fine.steps[0].solution.penetration, hertz.penetration) < 1e-5);
    // The peak lies a quarter of an element off the nearest centre; the area is that of whole elements.
    assert!(
        relative(summary.max_pressure, hertz.peak_pressure) < 1e-3,
        "{summary:?}"
    );
    assert!(
        relative(summary.contact_area, PI * 0.01) < 1e-2,
        "{summary:?}"
    );
    assert!(
        relative(summary.mean_pressure, hertz.mean_pressure()) < 1e-2,
        "{summary:?}"
    );
}

#[test]
fn a_given_penetration_has_hertzs_force() {
    let hertz = reference::hertz::from_penetration(1.0, 1.0, 0.01);
    let model = model(
        &Foundation::half_space(body()),
        Relief::Bare,
        paraboloid(1.0),
    );
    let force = order(|n| {
        let path = solve(&model, 0.3, n, Load::Penetration(hertz.penetration));
        relative(path.steps[0].solution.force, hertz.force)
    });
    assert!(force > 1.8, "{force}");
}

#[test]
fn a_cone_on_a_homogeneous_body_is_sneddons_contact() {
    let half_angle = 1.2;
    let cone = reference::cone::from_penetration(half_angle, 1.0, 0.1);
    let indenter = Indenter::Cone(Cone::new(half_angle, 0.0).unwrap());
    let model = model(&Foundation::half_space(body()), Relief::Bare, indenter);
    let path = |elements| {
        solve(
            &model,
            3.0 * cone.contact_radius,
            elements,
            Load::Force(cone.force),
        )
    };
    let penetration = order(|n| relative(path(n).steps[0].solution.penetration, cone.penetration));
    assert!(penetration > 1.8, "{penetration}");
    assert!(relative(path(256).steps[0].solution.penetration, cone.penetration) < 1e-5);
}

#[test]
fn a_flat_punch_on_a_homogeneous_body_is_sneddons_contact() {
    let punch = reference::flat_punch::from_force(0.1, 1.0, 0.02);
    let indenter = Indenter::FlatPunch(FlatPunch::new(0.1).unwrap());
    let model = model(&Foundation::half_space(body()), Relief::Bare, indenter);
    let path = |elements| solve(&model, 0.25, elements, Load::Force(punch.force));
    let penetration = order(|n| relative(path(n).steps[0].solution.penetration, punch.penetration));
    // The rim is a staircase and the pressure at it infinite: first order.
    assert!(penetration > 0.8, "{penetration}");
    let fine = path(256);
    assert!(relative(fine.steps[0].solution.penetration, punch.penetration) < 1e-2);
    let middle = fine.steps[0].solution.pressure[128 * 256 + 128];
    assert!(
        relative(middle, punch.central_pressure) < 1e-2,
        "{middle} {punch:?}"
    );
}

#[test]
fn a_soft_film_on_an_all_but_rigid_body_is_a_winkler_foundation() {
    // Film compliance 0.01; the body gives way by less than 1e-9 of that.
    let foundation = Foundation::half_space(Material::new(1e9, 0.3).unwrap());
    let film = Relief::Film(Film::new(0.01, 1.0).unwrap());
    let winkler = reference::winkler::from_penetration(1.0, 0.01, 0.005);
    let path = solve(
        &model(&foundation, film, paraboloid(1.0)),
        0.25,
        256,
        Load::Penetration(winkler.penetration),
    );
    let step = &path.steps[0];
    for (found, [x, y]) in step.solution.pressure.iter().zip(path.grid.centres()) {
        let wanted = winkler.pressure(x.hypot(y));
        assert!(
            (found - wanted).abs() < 1e-7 * winkler.peak_pressure,
            "{found} {wanted}"
        );
    }
    // Sums over whole elements.
    assert!(relative(step.solution.force, winkler.force) < 1e-3);
    assert!(relative(step.summary.contact_area, winkler.contact_area) < 1e-2);
}

/// Penetration and pressures of a paraboloid on a body coated with thickness `h`, on 64 elements per side.
fn coated(h: f64, coating: Material, substrate: Material) -> (f64, Vec<f64>) {
    let foundation = Foundation::coated(h, coating, substrate).unwrap();
    let path = solve(
        &model(&foundation, Relief::Bare, paraboloid(1.0)),
        0.3,
        64,
        Load::Force(1.3e-3),
    );
    let solution = path.steps[0].solution.clone();
    (solution.penetration, solution.pressure)
}

fn homogeneous(material: Material) -> (f64, Vec<f64>) {
    let model = model(
        &Foundation::half_space(material),
        Relief::Bare,
        paraboloid(1.0),
    );
    let path = solve(&model, 0.3, 64, Load::Force(1.3e-3));
    let solution = path.steps[0].solution.clone();
    (solution.penetration, solution.pressure)
}

#[test]
fn a_coating_of_the_substrates_own_material_is_not_felt() {
    for nu in [0.0, 0.3, 0.5] {
        let material = Material::new(0.91, nu).unwrap();
        let (penetration, pressure) = homogeneous(material);
        for thickness in [1e-4, 0.05, 10.0] {
            let (found, pressures) = coated(thickness, material, material);
            // The solver's own tolerance, 1e-8, bounds what rounding of the coefficients may start.
            assert!(relative(found, penetration) < 1e-9, "{found} {penetration}");
            for (p, q) in pressure.iter().zip(pressures) {
                assert!((p - q).abs() < 1e-6 * 0.06);
            }
        }
    }
}

#[test]
fn a_thin_coating_is_felt_in_proportion_to_its_thickness() {
    let (coating, substrate) = (Material::new(5.0, 0.2).unwrap(), body());
    let (bare, _) = homogeneous(substrate);
    let [felt, felt_less] = [1e-5, 1e-6].map(|h| relative(coated(h, coating, substrate).0, bare));
    // First order in H/a: ten times thinner, ten times less.
    assert!((felt / felt_less - 10.0).abs() < 0.5, "{felt} {felt_less}");
    assert!(felt_less < 1e-4, "{felt_less}");
}

#[test]
fn a_thick_coating_hides_its_substrate_in_proportion_to_its_thickness() {
    let (coating, substrate) = (body(), Material::new(5.0, 0.2).unwrap());
    let (thick, _) = homogeneous(coating);
    let [felt, felt_less] = [10.0, 100.0].map(|h| relative(coated(h, coating, substrate).0, thick));
    // First order in a/H.
    assert!((felt / felt_less - 10.0).abs() < 0.5, "{felt} {felt_less}");
    assert!(felt_less < 1e-2, "{felt_less}");
}
