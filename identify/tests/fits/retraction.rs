//! Modulus and work of adhesion from retractions of a ball.

use pellicle_contact::adhesion::{Adhesion, AdhesionLaw, AdhesiveCurve};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_identify::{
    Control, Curve, Fit, FitOptions, ForwardModel, LinearNuisance, Noise, Problem, Retraction,
    Unknown, Verdict, identify,
};
use pellicle_influence::{ElasticBodies, ElasticParameter};
use pellicle_kernel::{Base, Foundation, FoundationParameter, Interface, Layer, Material};

use super::toys::Normals;

const MODULUS: ElasticParameter =
    ElasticParameter::Foundation(FoundationParameter::YoungModulus { body: 0 });
const BALL: AxisymmetricProfile = AxisymmetricProfile::Paraboloid { radius: 10e-6 };

/// A gel of 2e6 Pa, and a work of adhesion of 0.05 J/m².
const TRUTH: [f64; 2] = [2e6, 0.05];

fn half_space() -> ElasticBodies {
    Foundation::half_space(Material::new(TRUTH[0], 0.5).unwrap()).into()
}

fn thin_gel() -> ElasticBodies {
    let layer = Layer::new(
        3e-6,
        Material::new(TRUTH[0], 0.45).unwrap(),
        Interface::Bonded,
    )
    .unwrap();
    Foundation::new(vec![layer], Base::Rigid).unwrap().into()
}

fn curve(bodies: &ElasticBodies, law: AdhesionLaw) -> AdhesiveCurve {
    let adhesion = Adhesion {
        work: TRUTH[1],
        law,
    };
    AdhesiveCurve::new(AxisymmetricElasticity::new(bodies), BALL, adhesion).unwrap()
}

fn retraction(
    bodies: &ElasticBodies,
    law: AdhesionLaw,
    control: Control,
    abscissae: Vec<f64>,
) -> Retraction {
    Retraction {
        bodies: bodies.clone(),
        profile: BALL,
        law,
        sought: vec![MODULUS],
        control,
        abscissae,
    }
}

/// 40 points from a part of the least penetration to 1 µm.
fn penetrations(bodies: &ElasticBodies, part: f64) -> Vec<f64> {
    let least = part * curve(bodies, AdhesionLaw::Jkr).last_contact().penetration;
    (0..40)
        .map(|i| least + (1e-6 - least) * f64::from(i) / 39.0)
        .collect()
}

#[test]
fn a_retraction_is_the_branch_of_the_curve() {
    for (bodies, law) in [
        (half_space(), AdhesionLaw::Jkr),
        (thin_gel(), AdhesionLaw::Jkr),
        (half_space(), AdhesionLaw::Dmt),
    ] {
        let curve = curve(&bodies, law);
        let forces = [0.8, 0.3, -0.5, -10.0].map(|part| part * curve.pull_off().force);
        let found = retraction(&bodies, law, Control::Force, forces.to_vec());
        let predicted = found.predict(&TRUTH).unwrap();
        let scale = curve.at_force(forces[3]).unwrap().penetration;
        for (force, depth) in forces.into_iter().zip(&predicted.value) {
            let wanted = curve.at_force(force).unwrap().penetration;
            assert!(
                (depth - wanted).abs() < 1e-8 * scale,
                "{law:?} {force} {depth} {wanted}"
            );
        }
        for (unknown, column) in predicted.derivatives.iter().enumerate() {
            let at = |factor: f64| {
                let mut changed = TRUTH;
                changed[unknown] *= factor;
                found.predict(&changed).unwrap().value
            };
            let (more, less) = (at(1.0001), at(0.9999));
            for ((more, less), slope) in more.iter().zip(&less).zip(column) {
                let wanted = (more - less) / (0.0002 * TRUTH[unknown]);
                // The square of the step, near the pull-off some hundred times as large.
                assert!(
                    (slope - wanted).abs() < 1e-4 * wanted.abs(),
                    "{unknown} {slope:e} {wanted:e}"
                );
            }
        }
    }
}

/// A fit of modulus, work of adhesion and zero of the force to a retraction with noise of a hundredth of the pull-off.
fn fit(bodies: &ElasticBodies, seed: u64) -> Fit {
    let model = retraction(
        bodies,
        AdhesionLaw::Jkr,
        Control::Penetration,
        penetrations(bodies, 0.7),
    );
    let mut normals = Normals::new(seed);
    let forces = model.predict(&TRUTH).unwrap().value;
    let noisy = forces.iter().map(|force| force + 30e-9 * normals.next());
    let curve = Curve::new(model.abscissae.clone(), noisy.collect()).unwrap();
    let unknowns = [("E", [5e5, 8e6], 1.5e6), ("w", [0.01, 0.3], 0.08)];
    let unknowns = unknowns.map(|(name, range, start)| {
        Unknown::positive(name, range)
            .unwrap()
            .starting_at(start)
            .unwrap()
    });
    let problem = Problem::new(
        vec![curve],
        unknowns.to_vec(),
        &[LinearNuisance::shift()],
        Noise::default(),
    )
    .unwrap();
    identify(&model, &problem, &FitOptions::default()).unwrap()
}

fn holds(fit: &Fit, unknown: usize) -> bool {
    let [low, high] = fit.estimates[unknown].interval;
    low.is_some_and(|low| low <= TRUTH[unknown]) && high.is_some_and(|high| TRUTH[unknown] <= high)
}

/// 100 intervals of level 0.95 hold 95 times, with a standard deviation of 2.2.
#[test]
fn intervals_of_modulus_and_work_of_adhesion_hold_in_92_to_98_of_100_retractions() {
    let bodies = half_space();
    let fits: Vec<Fit> = (0..100).map(|seed| fit(&bodies, seed)).collect();
    for unknown in [0, 1] {
        let held = fits.iter().filter(|fit| holds(fit, unknown)).count();
        assert!((92..=98).contains(&held), "{unknown}: {held}");
        assert!(
            fits.iter()
                .all(|fit| fit.estimates[unknown].verdict == Verdict::Identified)
        );
    }
}

#[test]
fn a_thin_gel_s_modulus_and_work_of_adhesion_are_found_together() {
    let found = fit(&thin_gel(), 7);
    for unknown in [0, 1] {
        let estimate = &found.estimates[unknown];
        assert!(
            (estimate.value / TRUTH[unknown] - 1.0).abs() < 0.05,
            "{estimate:?}"
        );
        assert_eq!(estimate.verdict, Verdict::Identified);
    }
}
