//! Fits of contacts, with predictions computed on grids.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use pellicle_contact::{IndenterQuantity, Model, ModelParameter, Paraboloid};
use pellicle_identify::{
    Amount, ContactCurve, ContactCurves, Curve, CurveOptions, Fit, FitOptions, FitVerdict,
    ForwardModel as _, Intervals, LinearNuisance, Noise, Observable, Problem, Unknown, Verdict,
    exponents, identify,
};
use pellicle_influence::{Cache, ElasticBodies, ElasticParameter};
use pellicle_kernel::{Foundation, FoundationParameter, Material};
use pellicle_texture::Relief;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};

/// Moduli of coating and base in Pa, thickness in m.
const TRUTH: [f64; 3] = [100e9, 10e9, 0.5e-6];
const NOISE: f64 = 0.01;

fn young_modulus(body: usize) -> ModelParameter {
    ModelParameter::Elastic(ElasticParameter::Foundation(
        FoundationParameter::YoungModulus { body },
    ))
}

/// A half-micrometre coating under a ball of ten micrometres, between 0.1 and 10 mN.
fn coating(parameters: usize) -> (ContactCurves, Vec<f64>) {
    let [hard, soft] =
        [(TRUTH[0], 0.25), (TRUTH[1], 0.3)].map(|(e, nu)| Material::new(e, nu).unwrap());
    let bodies: ElasticBodies = Foundation::coated(TRUTH[2], hard, soft).unwrap().into();
    let cache = Cache::of_shapes();
    let model = Model {
        tables: cache.radial_tables_of(&bodies).unwrap().value,
        relief: Relief::Bare,
        indenter: Paraboloid::new(10e-6).unwrap().into(),
        cache,
    };
    let forces: Vec<f64> = (0..24)
        .map(|i| 1e-4 * 100_f64.powf(f64::from(i) / 23.0))
        .collect();
    let thickness = ModelParameter::Elastic(ElasticParameter::Foundation(
        FoundationParameter::Thickness { layer: 0 },
    ));
    let all = [young_modulus(0), young_modulus(1), thickness];
    let curve = ContactCurve {
        model,
        observable: Observable::DepthAtForce,
        abscissae: forces.clone(),
        own: Vec::new(),
        origins: Vec::new(),
        thinned: None,
        adhesion: None,
        series: 0.0,
    };
    let options = CurveOptions::default();
    (
        ContactCurves::new(vec![curve], all[..parameters].to_vec(), options).unwrap(),
        forces,
    )
}

/// Fits the first of the coating's parameters to its own curve with noise of 1 % and an unknown zero.
fn fit(parameters: usize) -> Fit {
    let (curves, forces) = coating(parameters);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let observed = curves
        .predict(&TRUTH[..parameters])
        .unwrap()
        .value
        .iter()
        .map(|depth| {
            let normal: f64 = StandardNormal.sample(&mut random);
            depth * (1.0 + NOISE * normal) + 3e-9
        })
        .collect();
    let unknown = |name: &str, range, start| {
        Unknown::positive(name, range)
            .unwrap()
            .starting_at(start)
            .unwrap()
    };
    let unknowns = [
        unknown("E1", [20e9, 500e9], 60e9),
        unknown("E2", [1e9, 100e9], 20e9),
        unknown("H", [0.05e-6, 5e-6], 0.8e-6),
    ];
    let noise = Noise {
        observed: Amount::Given(0.0),
        relative: Amount::Given(NOISE),
        ..Noise::default()
    };
    let curve = Curve::new(forces, observed).unwrap();
    let shift = [LinearNuisance::shift()];
    let problem =
        Problem::new(vec![curve], unknowns[..parameters].to_vec(), &shift, noise).unwrap();
    identify(&curves, &problem, &FitOptions::default()).unwrap()
}

fn assert_truth_inside(fit: &Fit) {
    assert_eq!(fit.verdict, FitVerdict::Fitted, "{:?}", fit.goodness);
    for (estimate, truth) in fit.estimates.iter().zip(TRUTH) {
        let [low, high] = estimate.interval;
        assert!(low < Some(truth) && high > Some(truth), "{estimate:?}");
    }
}

#[test]
fn two_moduli_of_a_coating_and_their_intervals_take_a_dozen_curves() {
    let fit = fit(2);
    assert_truth_inside(&fit);
    assert!(
        fit.estimates
            .iter()
            .all(|estimate| estimate.verdict == Verdict::Identified)
    );
    assert!(
        fit.work.search <= 8 && fit.work.curves_solved <= 12,
        "{:?}",
        fit.work
    );
}

#[test]
fn with_the_thickness_unknown_the_modulus_of_the_coating_is_weak() {
    let fit = fit(3);
    assert_truth_inside(&fit);
    assert_eq!(fit.estimates[0].verdict, Verdict::Weak);
    assert_eq!(fit.estimates[1].verdict, Verdict::Identified);
    // At most six to the best fit and two to each of the six ends.
    assert!(
        fit.work.search <= 12 && fit.work.curves_solved <= 20,
        "{:?}",
        fit.work
    );
}

#[test]
fn moduli_and_thickness_scale_with_an_exact_radius_as_the_gauge_predicts() {
    let (curves, forces) = coating(3);
    let observed = curves.predict(&TRUTH).unwrap().value;
    let curve = Curve::new(forces, observed).unwrap();
    let unknown = |name: &str, value: f64| {
        let range = [value / 10.0, value * 10.0];
        Unknown::positive(name, range).unwrap()
    };
    let unknowns = ["E1", "E2", "H"].into_iter().zip(TRUTH);
    let unknowns = unknowns.map(|(name, value)| unknown(name, value)).collect();
    let noise = Noise::white(1e-10);
    let problem = Problem::new(vec![curve], unknowns, &[], noise).unwrap();
    let options = FitOptions {
        intervals: Intervals::Wald,
        ..FitOptions::default()
    };
    let fit = identify(&curves, &problem, &options).unwrap();
    let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
    let numbers = curves.curves()[0].model.parameters();
    let (at_fit, fixed) = curves.predict_with_fixed(&values, &[], &[numbers]).unwrap();
    let kinds: Vec<_> = fixed.iter().map(|of| of.parameter).collect();
    let radius = ModelParameter::Indenter(IndenterQuantity::Radius);
    // Two Poisson's ratios and the radius.
    assert_eq!((kinds.len(), kinds[2]), (3, radius));
    assert_eq!(fixed[2].value.to_bits(), 10e-6_f64.to_bits());
    let changes: Vec<Vec<f64>> = fixed
        .iter()
        .map(|of| of.derivative.iter().map(|d| d * of.value).collect())
        .collect();
    let found = exponents(&problem, &fit, at_fit, &changes).unwrap();
    // (R, H, E) and (b² R, b H, E/b) give the same curve; the derivatives come from two grids.
    for (exponent, gauge) in found[2].iter().zip([-0.5, -0.5, 0.5]) {
        assert!((exponent.unwrap() - gauge).abs() < 2e-3, "{:?}", found[2]);
    }
}
