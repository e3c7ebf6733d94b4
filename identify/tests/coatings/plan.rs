//! Expected intervals of planned measurements.

use pellicle_identify::{
    Curve, Expected, ForwardModel, Information, LinearNuisance, NoiseLevels, NullDirections, Plan,
    Prior, Unknown, Verdict,
};

use super::coating::{Coating, coating};

/// White noise of 1 % of the depth.
const NOISE: NoiseLevels = NoiseLevels {
    observed: 0.0,
    abscissa: 0.0,
    relative: 0.01,
    persistence: 0.0,
    white_fraction: 1.0,
};

fn unknowns() -> [Unknown; 3] {
    [
        Unknown::positive("E1", [1e9, 1e13]).unwrap(),
        Unknown::positive("E2", [1e8, 1e12]).unwrap(),
        Unknown::positive("H", [1e-9, 1e-4]).unwrap(),
    ]
}

/// A plan for these unknowns, each curve with its own zero.
fn plan_for(unknowns: &[Unknown], truth: &[f64], more: &[LinearNuisance]) -> Plan {
    Plan {
        unknowns: unknowns.to_vec(),
        truth: truth.to_vec(),
        nuisances: [&[LinearNuisance::shift()], more].concat(),
        noise: NOISE,
    }
}

/// The information from a curve on a coating.
fn information(plan: &Plan, coating: &Coating) -> Information {
    let curves = coating.curves(plan.truth.len());
    let prediction = curves.predict(&plan.truth).unwrap();
    let curve = Curve::new(coating.forces(), prediction.value.clone()).unwrap();
    plan.information(&prediction, &[curve]).unwrap()
}

fn expected(plan: &Plan, measurements: &[&Information]) -> Vec<Expected> {
    let none = NullDirections::default();
    plan.expected(measurements, &none, 0.95).unwrap()
}

fn errors(plan: &Plan, measurements: &[&Information]) -> Vec<f64> {
    let all = expected(plan, measurements);
    all.iter().map(|one| one.standard_error).collect()
}

/// The errors of the first of the unknowns from one curve, with an unknown zero and more.
fn planned(coating: &Coating, count: usize, more: &[LinearNuisance]) -> Vec<f64> {
    let plan = plan_for(&unknowns()[..count], &coating.truth()[..count], more);
    errors(&plan, &[&information(&plan, coating)])
}

/// Compares with errors computed earlier by another program, to two or three digits.
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found / expected - 1.0).abs() < tolerance,
            "{found} {expected}"
        );
    }
}

#[test]
fn each_further_unknown_makes_the_others_less_certain() {
    let of = |count, more: &[LinearNuisance]| planned(&coating(10e-6), count, more);
    // To the digits of the expected numbers.
    assert_near(&of(1, &[]), &[0.010], 0.03);
    assert_near(&of(2, &[]), &[0.034, 0.018], 0.03);
    assert_near(&of(3, &[]), &[0.106, 0.096, 0.155], 0.01);
    // Where the data determine almost nothing, the grid error of the derivatives matters.
    let frame = [LinearNuisance::frame_compliance()];
    assert_near(&of(3, &frame), &[0.20, 4.26, 1.22], 0.08);
}

#[test]
fn a_small_and_a_large_ball_together_determine_what_neither_does_alone() {
    let ball = |radius| Coating {
        radius,
        ..coating(20e-6)
    };
    let plan = plan_for(&unknowns(), &coating(1.0).truth(), &[]);
    let both = [1e-6, 100e-6].map(|radius| information(&plan, &ball(radius)));
    let together = errors(&plan, &[&both[0], &both[1]]);
    // The forces behind these numbers are unknown; 20 µN to 2 mN come close.
    assert_near(&together, &[0.027, 0.008, 0.027], 0.1);
    for one in &both {
        let alone = errors(&plan, &[one]);
        assert!((0..3).all(|j| alone[j] > 1.2 * together[j]));
    }
}

#[test]
fn a_prior_is_one_more_observation() {
    let coating = coating(10e-6);
    let of = |unknown: Unknown| {
        let plan = plan_for(&[unknown], &[100e9], &[]);
        errors(&plan, &[&information(&plan, &coating)])[0]
    };
    let [free, ..] = unknowns();
    let prior = Prior::Lognormal {
        median: 100e9,
        factor: 1.02,
    };
    let known = of(free.clone().with_prior(prior).unwrap());
    // 1/σ² = 1/σ₀² + 1/ln² 1.02, to rounding.
    let expected = (of(free).powi(-2) + 1.02_f64.ln().powi(-2)).sqrt().recip();
    assert!((known / expected - 1.0).abs() < 1e-9);
}

/// With a coating so thick or thin, or a frame so soft, that a parameter is lost, no error is below a factor of two.
#[test]
fn errors_of_lost_parameters_exceed_a_factor_of_two() {
    let lost = std::f64::consts::LN_2 / 1.96;
    let of = |thickness, more: &[LinearNuisance]| {
        let one = Coating {
            thickness,
            ..coating(10e-6)
        };
        planned(&one, 3, more)
    };
    let thick = of(4e-6, &[LinearNuisance::frame_compliance()]);
    assert!(thick[1] > lost && thick[2] > lost, "{thick:?}");
    let thin = of(0.05e-6, &[]);
    assert!(thin[0] > lost, "{thin:?}");
}

#[test]
fn two_equal_curves_halve_the_variance() {
    let coating = coating(10e-6);
    let plan = plan_for(&unknowns()[..1], &[100e9], &[]);
    let one = information(&plan, &coating);
    let single = errors(&plan, &[&one])[0];
    let pair = errors(&plan, &[&one, &one])[0];
    // 1/σ² is additive, to rounding.
    assert!((single / pair - 2_f64.sqrt()).abs() < 1e-9);
}

#[test]
fn an_exact_null_direction_is_reported_whatever_the_numbers() {
    let coating = coating(10e-6);
    let plan = plan_for(&unknowns()[..2], &coating.truth()[..2], &[]);
    let one = information(&plan, &coating);
    let names = ["E1", "E2"].map(String::from).to_vec();
    let directions = NullDirections::new(names, vec![vec![1.0, -2.0]]).unwrap();
    let found = plan.expected(&[&one], &directions, 0.95).unwrap();
    for one in &found {
        assert_eq!(one.verdict, Verdict::NotIdentifiable);
        assert_eq!(
            (one.interval, one.standard_error),
            ([None; 2], f64::INFINITY)
        );
    }
    let known = found[0].known_combination.as_ref().unwrap();
    // E1² E2 does not change along (1, −2).
    assert_eq!(known.expression, "E1 * E2^0.5");
    // With E2 held, the error is that of E1 alone, and the half interval of the product is 1.96 of these errors.
    let alone = plan_for(&unknowns()[..1], &coating.truth()[..1], &[]);
    let alone = errors(&alone, &[&information(&alone, &coating)])[0];
    let half = (known.interval[1].unwrap() / known.value).ln();
    assert!(
        (half / (1.959_964 * alone) - 1.0).abs() < 1e-6,
        "{half} {alone}"
    );
}
