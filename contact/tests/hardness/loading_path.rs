//! A path on its grids and in its domains.

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_contact::{
    ContactError, Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Paraboloid, SolverOptions,
    Step, reference, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_texture::Relief;

use super::{SIDE, body};

fn model(indenter: impl Into<Indenter>) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(&body(None)).unwrap()),
        relief: Relief::Bare,
        indenter: indenter.into(),
        cache: Cache::none(),
    }
}

/// Force and peak pressure of a Hertz contact of radius 0.2.
fn hertz() -> (f64, f64) {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0 / (1.0 - 0.3 * 0.3), 0.2);
    (hertz.force, hertz.peak_pressure)
}

fn path(part: f64, domain: Domain, elements: usize, options: SolverOptions) -> LoadingPath {
    let (force, peak) = hertz();
    let options = SolverOptions {
        hardness: part * peak,
        ..options
    };
    let paraboloid = model(Paraboloid::new(1.0).unwrap());
    let path = solve_path(
        &paraboloid,
        domain,
        elements,
        &[Load::Force(force)],
        &options,
        &mut (),
    );
    path.unwrap()
}

fn step(part: f64, elements: usize) -> Step {
    let mut path = path(part, Domain::Side(SIDE), elements, SolverOptions::default());
    let step = path.steps.remove(0);
    assert!(
        step.solution.certificate.is_satisfied(),
        "{:?}",
        step.solution.certificate
    );
    step
}

#[test]
fn a_lower_hardness_lets_the_indenter_sink_deeper_over_more_of_the_contact() {
    let (force, peak) = hertz();
    let mut before: Option<Step> = None;
    for part in [1.1, 0.9, 0.6, 0.4, 0.3] {
        let step = step(part, 64);
        let summary = step.summary;
        assert!(summary.max_pressure <= part * peak);
        assert_eq!(summary.area_at_limit > Some(0.0), part < 1.0);
        assert_eq!(summary.plastic_depth > Some(0.0), part < 1.0);
        if let Some(before) = before {
            assert!(step.solution.penetration >= before.solution.penetration);
            assert!(summary.contact_area >= before.summary.contact_area * (1.0 - 1e-9));
            assert!(summary.area_at_limit >= before.summary.area_at_limit);
            assert!(summary.plastic_depth >= before.summary.plastic_depth);
            assert!(step.contact_stiffness.unwrap() > 0.0);
        }
        assert!(summary.area_at_limit.unwrap() * part * peak <= force);
        before = Some(step);
    }
}

#[test]
fn a_hardness_above_the_peak_changes_nothing() {
    let (elastic, cut) = (step(f64::INFINITY, 64), step(1.1, 64));
    let difference = cut.solution.penetration / elastic.solution.penetration - 1.0;
    // both certified to 1e-8
    assert!(difference.abs() < 2e-8, "{difference}");
    assert_eq!(
        cut.summary.contact_elements,
        elastic.summary.contact_elements
    );
}

#[test]
fn far_beyond_the_limit_the_contact_area_is_force_over_hardness() {
    let (force, peak) = hertz();
    for (part, bound) in [(0.25, 1e-3), (0.15, 5e-4)] {
        let step = step(part, 256);
        let (summary, wanted) = (step.summary, force / (part * peak));
        // The edge is known to within half an element at the limit, with scatter along a circle of 100 to 130 elements;
        // beside it lies a rim of one element.
        assert!((summary.contact_area / wanted - 1.0).abs() < bound);
        assert!((0.995..1.0).contains(&(summary.area_at_limit.unwrap() / wanted)));
        // Measured: 35 and 53.
        let products = step.work.operator_applications;
        assert!(products <= 60, "{products}");
    }
}

#[test]
fn results_converge_with_the_grid() {
    let steps = [32, 64, 128, 256].map(|elements| step(0.6, elements));
    let changes = |number: fn(&Step) -> f64| {
        let values = steps.each_ref().map(number);
        [1, 2, 3].map(|i| ((values[i] - values[i - 1]) / values[3]).abs())
    };
    let penetration = changes(|step| step.solution.penetration);
    let depth = changes(|step| step.summary.plastic_depth.unwrap());
    assert!(
        penetration[2] < 0.5 * penetration[0] && penetration[2] < 1e-4,
        "{penetration:?}"
    );
    assert!(depth[2] < 0.5 * depth[0] && depth[2] < 1e-3, "{depth:?}");
    let area = changes(|step| step.summary.contact_area);
    assert!(area[2] < 2e-3, "{area:?}");
}

#[test]
fn quadrant_window_and_dense_method_agree_on_a_path() {
    let quadrant = step(0.5, 48);
    let options = SolverOptions {
        mirror_symmetry: false,
        ..SolverOptions::default()
    };
    let dense = SolverOptions {
        method: pellicle_contact::Method::ActiveSet,
        ..options
    };
    for options in [options, dense] {
        let other = path(0.5, Domain::Side(SIDE), 48, options).steps.remove(0);
        assert!(other.solution.certificate.is_satisfied());
        let peak = other.summary.max_pressure;
        for (one, other) in quadrant
            .solution
            .pressure
            .iter()
            .zip(&other.solution.pressure)
        {
            assert!((one - other).abs() < 1e-5 * peak, "{one} {other}");
        }
        let stiffness = quadrant.contact_stiffness.unwrap() / other.contact_stiffness.unwrap();
        // The accuracy of the sum itself, and a few elements within rounding of the limit.
        assert!((stiffness - 1.0).abs() < 1e-3, "{stiffness}");
    }
}

#[test]
fn an_automatic_domain_contains_the_plastic_contact() {
    let (force, peak) = hertz();
    // A contact of radius √(Q/π p_max), 2.3 times Hertz's.
    let path = path(0.125, Domain::Automatic, 64, SolverOptions::default());
    let step = &path.steps[0];
    assert_eq!(step.status(), pellicle_contact::Status::Certified);
    assert!(step.summary.contact_area > force / (0.125 * peak));
}

#[test]
fn a_force_beyond_the_hardness_of_a_punch_is_refused_before_anything_is_solved() {
    let punch = model(FlatPunch::new(0.3).unwrap());
    let options = SolverOptions {
        hardness: 0.1,
        ..SolverOptions::default()
    };
    let load = [Load::Force(0.2 * PI * 0.3 * 0.3)];
    for domain in [Domain::Side(SIDE), Domain::Automatic] {
        let refused = solve_path(&punch, domain, 64, &load, &options, &mut ()).unwrap_err();
        assert!(
            matches!(refused, ContactError::BeyondHardness { .. }),
            "{refused}"
        );
    }
}

#[test]
fn a_cell_under_nine_tenths_of_its_hardness_is_almost_closed() {
    let paraboloid = model(Paraboloid::new(1.0).unwrap());
    let options = SolverOptions {
        hardness: 0.1,
        ..SolverOptions::default()
    };
    let load = [Load::Force(0.09 * SIDE * SIDE)];
    let path = solve_path(
        &paraboloid,
        Domain::Periodic(SIDE),
        32,
        &load,
        &options,
        &mut (),
    )
    .unwrap();
    let step = &path.steps[0];
    assert!(
        step.solution.certificate.is_satisfied(),
        "{:?}",
        step.solution.certificate
    );
    assert!(step.summary.contact_area > 0.9 && step.summary.area_at_limit > Some(0.3));
    let more = [Load::Force(0.11 * SIDE * SIDE)];
    let refused = solve_path(
        &paraboloid,
        Domain::Periodic(SIDE),
        32,
        &more,
        &options,
        &mut (),
    );
    assert!(matches!(refused, Err(ContactError::BeyondHardness { .. })));
}

#[test]
fn tamaas_finds_the_same_contact() {
    // Tamaas 2.9.0, KatoSaturated on the non-periodic operator "dcfft" to 1e-13, E* = 1/0.91, 64² elements of a square
    // of side 1: elements in contact and at the limit, penetration and plastic depth from its pressure and operator,
    // whose gaps in contact are below 1e-11 of the penetration.
    for (part, in_contact, at_limit, penetration, plastic_depth) in [
        (
            0.6,
            616,
            532,
            0.042_722_155_480_277,
            0.010_487_780_110_249_5,
        ),
        (
            0.3,
            1160,
            1124,
            0.058_916_055_470_818_8,
            0.036_089_176_988_518_5,
        ),
    ] {
        let step = step(part, 64);
        let summary = step.summary;
        let elements = summary.area_at_limit.unwrap() * 64.0 * 64.0;
        assert_eq!(
            (summary.contact_elements, elements),
            (in_contact, f64::from(at_limit))
        );
        // our certificate's 1e-8
        assert!((step.solution.penetration / penetration - 1.0).abs() < 1e-8);
        assert!((summary.plastic_depth.unwrap() / plastic_depth - 1.0).abs() < 1e-7);
    }
}
