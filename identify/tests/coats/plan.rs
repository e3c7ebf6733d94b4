//! Expected intervals of planned measurements.

use pellicle_identify::{
    ContactCurves, Design, LinearNuisance, NoiseLevels, Plan, Prior, Unknown, plan,
};

use crate::coat::{Coat, coat};

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

/// The plan of some designs with the first of the unknowns, an unknown zero, and more.
fn planned(coats: &[Coat], count: usize, more: &[LinearNuisance]) -> Plan {
    let curves: Vec<ContactCurves> = coats.iter().map(|coat| coat.curves(count)).collect();
    let designs: Vec<Design> = coats
        .iter()
        .zip(&curves)
        .map(|(coat, model)| Design {
            model,
            abscissae: vec![coat.forces()],
        })
        .collect();
    let truth = coats[0].truth();
    let nuisances = [&[LinearNuisance::shift()], more].concat();
    plan(
        &designs,
        &unknowns()[..count],
        &truth[..count],
        &nuisances,
        NOISE,
    )
    .unwrap()
}

/// Errors computed before by another program, to two or three digits.
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found / expected - 1.0).abs() < tolerance,
            "{found} {expected}"
        );
    }
}

#[test]
fn each_unknown_more_makes_the_others_less_certain() {
    let of = |count, more: &[LinearNuisance]| planned(&[coat(10e-6)], count, more).together;
    // The digits of the expected numbers.
    assert_near(&of(1, &[]), &[0.010], 0.03);
    assert_near(&of(2, &[]), &[0.034, 0.018], 0.03);
    assert_near(&of(3, &[]), &[0.106, 0.096, 0.155], 0.01);
    // Where nearly nothing is told, the grid's error in the derivatives counts.
    let frame = [LinearNuisance::frame_compliance()];
    assert_near(&of(3, &frame), &[0.20, 4.26, 1.22], 0.08);
}

#[test]
fn a_small_and_a_large_ball_together_tell_what_neither_does() {
    let ball = |radius| Coat {
        radius,
        ..coat(20e-6)
    };
    let plan = planned(&[ball(1e-6), ball(100e-6)], 3, &[]);
    // The forces of these numbers are not known; 20 µN to 2 mN come near them.
    assert_near(&plan.together, &[0.027, 0.008, 0.027], 0.1);
    for j in 0..3 {
        assert!(
            plan.alone
                .iter()
                .all(|alone| alone[j] > 1.2 * plan.together[j])
        );
    }
}

#[test]
fn a_prior_is_one_more_observation() {
    let coat = coat(10e-6);
    let curves = coat.curves(1);
    let design = || Design {
        model: &curves,
        abscissae: vec![coat.forces()],
    };
    let of = |unknown: Unknown| {
        let shift = [LinearNuisance::shift()];
        plan(&[design()], &[unknown], &[100e9], &shift, NOISE)
            .unwrap()
            .together[0]
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

/// A coat so thick or so thin, or a frame so soft, that a parameter is lost: never an error below a factor of two.
#[test]
fn no_certainty_where_a_parameter_is_lost() {
    let lost = std::f64::consts::LN_2 / 1.96;
    let of = |thickness, more: &[LinearNuisance]| {
        let one = Coat {
            thickness,
            ..coat(10e-6)
        };
        planned(&[one], 3, more).together
    };
    let thick = of(4e-6, &[LinearNuisance::frame_compliance()]);
    assert!(thick[1] > lost && thick[2] > lost, "{thick:?}");
    let thin = of(0.05e-6, &[]);
    assert!(thin[0] > lost, "{thin:?}");
}
