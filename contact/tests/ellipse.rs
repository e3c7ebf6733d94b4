//! Ellipses: paraboloids with two radii of curvature, against Hertz's closed form and turned by 90°.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::reference::elliptic_hertz::{self, EllipticHertzContact};
use pellicle_contact::{
    Domain, EllipticParaboloid, IndenterQuantity, Load, LoadingPath, Model, ModelParameter,
    SolverOptions, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{Film, Relief};

/// On a body of plane-strain modulus 1.
fn model(radii: [f64; 2], body: &Foundation, relief: Relief) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(body).unwrap()),
        relief,
        indenter: EllipticParaboloid::new(radii).unwrap().into(),
        cache: Cache::in_memory(),
    }
}

fn half_space() -> Foundation {
    Foundation::half_space(Material::new(1.0, 0.0).unwrap())
}

fn solve(model: &Model, domain: Domain, elements: usize) -> LoadingPath {
    let options = SolverOptions::default();
    let force = [Load::Force(1.0)];
    solve_path(model, domain, elements, &force, &options, &mut ()).unwrap()
}

/// Relative errors of the penetration, the largest pressure and the larger semi-axis under a unit force.
fn errors(
    ratio: f64,
    elements: usize,
    domain: impl Fn(&EllipticHertzContact) -> Domain,
) -> [f64; 3] {
    let wanted = elliptic_hertz::from_force([ratio, 1.0], 1.0, 1.0);
    let model = model([ratio, 1.0], &half_space(), Relief::Bare);
    let path = solve(&model, domain(&wanted), elements);
    let step = &path.steps[0];
    let found = [
        (step.solution.penetration, wanted.penetration),
        (step.summary.max_pressure, wanted.peak_pressure),
        (step.summary.contact_radius, wanted.semi_axes[0]),
    ];
    found.map(|(found, wanted)| (found / wanted - 1.0).abs())
}

#[test]
fn hertzs_ellipses_have_the_penetration_and_peak_of_the_closed_form() {
    // A margin of a tenth around the longer semi-axis, of 233 elements; the shorter one has 52 at 1:10 and 16 at 1:50.
    // As measured, of second order in an element over the shorter semi-axis: 7.5e-7, 1.3e-6, 5.8e-6 and 2.4e-5 of the
    // penetration, 8e-7, 1.3e-6, 7.8e-6 and 1.1e-4 of the peak.
    for (ratio, within) in [(1.0, 1e-5), (2.0, 1e-5), (10.0, 1e-5), (50.0, 1.5e-4)] {
        let margin = |of: &EllipticHertzContact| Domain::Side(2.2 * of.semi_axes[0]);
        let [penetration, peak, radius] = errors(ratio, 512, margin);
        assert!(
            penetration < within && peak < within,
            "{ratio}: {penetration:e} {peak:e}"
        );
        // A tenth of an element.
        assert!(radius < 4.3e-4, "{ratio}: {radius:e}");
    }
}

#[test]
fn the_square_chosen_for_a_long_ellipse_holds_it() {
    for ratio in [2.0, 10.0, 50.0] {
        let [penetration, peak, _] = errors(ratio, 256, |_| Domain::Automatic);
        // As measured: 6e-6, 3.7e-5, 7e-5 and 6e-6, 4.7e-5, 4.4e-4.
        assert!(
            penetration < 1e-4 && peak < 6e-4,
            "{ratio}: {penetration:e} {peak:e}"
        );
    }
}

#[test]
fn swapping_the_radii_swaps_the_axes_of_every_field() {
    let film = Film::new(0.05, 0.5).unwrap();
    let coated = Foundation::coated(
        0.3,
        Material::new(5.0, 0.25).unwrap(),
        Material::new(1.0, 0.4).unwrap(),
    );
    for (body, relief) in [
        (half_space(), Relief::Bare),
        (coated.unwrap(), Relief::Film(film)),
    ] {
        let [along_x, along_y] = [[7.0, 1.5], [1.5, 7.0]].map(|radii| {
            let options = SolverOptions {
                tolerance: 1e-11,
                ..SolverOptions::default()
            };
            let (model, force) = (model(radii, &body, relief.clone()), [Load::Force(0.5)]);
            let path = solve_path(&model, Domain::Side(4.0), 64, &force, &options, &mut ());
            path.unwrap().steps.remove(0)
        });
        let ratio = along_y.solution.penetration / along_x.solution.penetration;
        assert!((ratio - 1.0).abs() < 1e-10, "{ratio}");
        let peak = along_x.summary.max_pressure;
        for i in 0..64 {
            for j in 0..64 {
                let [one, other] = [
                    along_x.solution.pressure[i * 64 + j],
                    along_y.solution.pressure[j * 64 + i],
                ];
                assert!((one - other).abs() < 1e-8 * peak, "{i} {j}: {one} {other}");
            }
        }
    }
}

#[test]
fn derivatives_by_each_radius_are_those_of_the_closed_form() {
    let radii = [4.0, 1.0];
    let model = model(radii, &half_space(), Relief::Bare);
    let path = solve(&model, Domain::Automatic, 256);
    let along = [
        IndenterQuantity::RadiusAlongX,
        IndenterQuantity::RadiusAlongY,
    ];
    let parameters = along.map(ModelParameter::Indenter);
    let derivatives = model.derivatives(&parameters).unwrap();
    let found = derivatives.of_path(&path).unwrap().at(0);
    for (axis, found) in found.iter().enumerate() {
        let step = 1e-4;
        let at = |change: f64| {
            let mut radii = radii;
            radii[axis] += change;
            elliptic_hertz::from_force(radii, 1.0, 1.0).penetration
        };
        let wanted = (at(step) - at(-step)) / (2.0 * step);
        // The elements in contact are held: of first order in an element, 1/40 of the shorter semi-axis.
        let error = found.penetration.unwrap() / wanted - 1.0;
        assert!(error.abs() < 3e-3, "{axis}: {error:e}");
    }
}

#[test]
fn an_area_of_two_elements_across_is_not_resolved() {
    let wanted = elliptic_hertz::from_force([1e4, 1.0], 1.0, 1.0);
    let side = 2.2 * wanted.semi_axes[0];
    let area = std::f64::consts::PI * wanted.semi_axes[0] * wanted.semi_axes[1];
    let mut resolved = 0;
    for elements in [32_usize, 64, 256, 512, 1024] {
        let width = 2.0 * wanted.semi_axes[1] * elements as f64 / side;
        let model = model([1e4, 1.0], &half_space(), Relief::Bare);
        let path = solve(&model, Domain::Side(side), elements);
        let step = &path.steps[0];
        let error = step.grid_error.contact_area.unwrap();
        let off = (step.summary.contact_area - area).abs();
        if error.resolved {
            resolved += 1;
            assert!(width > 2.0, "{width} elements: {error:?}");
            assert!(off <= error.estimate, "{width} elements: {off:e} {error:?}");
        }
    }
    assert!(resolved > 0, "no grid is fine enough");
}
