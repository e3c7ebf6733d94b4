//! Modulus and work of adhesion from retractions of a ball.

use pellicle_contact::adhesion::{Adhesion, AdhesionLaw, AdhesiveCurve};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{Model, ModelParameter, Paraboloid};
use pellicle_identify::{
    ContactCurve, ContactCurves, Curve, CurveOptions, Fit, FitOptions, ForwardModel,
    LinearNuisance, Noise, Observable, Problem, Unknown, Verdict, identify,
};
use pellicle_influence::{Cache, ElasticBodies, ElasticParameter};
use pellicle_kernel::{Base, Foundation, FoundationParameter, Interface, Layer, Material};

use pellicle_texture::Relief;

use super::toys::Normals;

const MODULUS: ModelParameter = ModelParameter::Elastic(ElasticParameter::Foundation(
    FoundationParameter::YoungModulus { body: 0 },
));
const RADIUS: f64 = 10e-6;
const BALL: AxisymmetricProfile = AxisymmetricProfile::Paraboloid { radius: RADIUS };

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

/// Observed readings of a retraction with the compliance of a cantilever.
fn retraction(
    bodies: &ElasticBodies,
    law: AdhesionLaw,
    (observable, series): (Observable, f64),
    abscissae: Vec<f64>,
) -> ContactCurves {
    let cache = Cache::of_shapes();
    let curve = ContactCurve {
        model: Model {
            tables: cache.radial_tables_of(bodies).unwrap().value,
            relief: Relief::Bare,
            indenter: Paraboloid::new(RADIUS).unwrap().into(),
            cache,
        },
        adhesion: Some(Adhesion { work: 1.0, law }),
        observable,
        series,
        abscissae,
        own: Vec::new(),
        origins: Vec::new(),
        thinned: None,
    };
    let sought = vec![MODULUS, ModelParameter::WorkOfAdhesion];
    ContactCurves::new(vec![curve], sought, CurveOptions::default()).unwrap()
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
        let depths = forces.map(|force| curve.at_force(force).unwrap().penetration);
        // As stiff as a cantilever that bends by the penetration.
        let series = depths[3] / forces[3];
        let approaches = [0, 1, 2, 3].map(|i| depths[i] + series * forces[i]);
        for (observed, abscissae, wanted) in [
            ((Observable::DepthAtForce, 0.0), forces, depths),
            ((Observable::ForceAtDepth, 0.0), depths, forces),
            ((Observable::ForceAtDepth, series), approaches, forces),
        ] {
            let found = retraction(&bodies, law, observed, abscissae.to_vec());
            let predicted = found.predict(&TRUTH).unwrap();
            for (found, wanted_here) in predicted.value.iter().zip(wanted) {
                let error = (found - wanted_here).abs();
                assert!(
                    error < 1e-8 * wanted[3],
                    "{law:?} {observed:?} {found} {wanted_here}"
                );
            }
            derivatives_are_those_of_differences(&found);
        }
    }
}

fn derivatives_are_those_of_differences(curves: &ContactCurves) {
    let predicted = curves.predict(&TRUTH).unwrap();
    for (unknown, column) in predicted.derivatives.iter().enumerate() {
        let at = |factor: f64| {
            let mut changed = TRUTH;
            changed[unknown] *= factor;
            curves.predict(&changed).unwrap().value
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

/// A fit of modulus, work of adhesion and zero of the force to a retraction with noise of a hundredth of the pull-off.
fn fit(bodies: &ElasticBodies, seed: u64) -> Fit {
    let model = retraction(
        bodies,
        AdhesionLaw::Jkr,
        (Observable::ForceAtDepth, 0.0),
        penetrations(bodies, 0.7),
    );
    let mut normals = Normals::new(seed);
    let forces = model.predict(&TRUTH).unwrap().value;
    let noisy = forces.iter().map(|force| force + 30e-9 * normals.next());
    let curve = Curve::new(model.curves()[0].abscissae.clone(), noisy.collect()).unwrap();
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
