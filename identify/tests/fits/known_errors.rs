//! Points with known errors of their own, as contacts of different depths have: they weigh by these, and scatter beside
//! them is found.

use approx::assert_relative_eq;
use pellicle_identify::{
    Amount, Curve, Fit, FitOptions, FitVerdict, Intervals, Noise, PointErrors, Problem, identify,
};

use super::toys::{Normals, Point, Toy, logarithmic, unknown};

const MODULUS: f64 = 5.0;
/// Noise that does not count.
const NEXT_TO_NONE: Amount = Amount::Given(1e-9);

/// The stiffness of a flat punch, `S = E q`.
fn punch(q: f64, parameters: &[f64]) -> Point {
    let modulus = parameters[0];
    (modulus * q, modulus, vec![q])
}

fn fit(curve: Curve, relative: Amount) -> Fit {
    let toy = Toy::new(curve.abscissa().to_vec(), punch);
    let noise = Noise {
        observed: Amount::Given(0.0),
        relative,
        ..Noise::default()
    };
    let problem = Problem::new(
        vec![curve],
        vec![unknown("E", [0.5, 50.0], 4.0)],
        &[],
        noise,
    )
    .unwrap();
    let options = FitOptions {
        intervals: Intervals::Wald,
        tolerance: 1e-16,
        ..FitOptions::default()
    };
    identify(&toy, &problem, &options).unwrap()
}

#[test]
fn points_weigh_by_their_own_errors_of_both_axes_and_the_covariance_of_these() {
    let radii = logarithmic(1.0, 10.0, 6);
    let observed: Vec<f64> = (1..)
        .zip(&radii)
        .map(|(i, q)| q * (MODULUS + 0.3 * f64::from(i).sin()))
        .collect();
    let errors: Vec<PointErrors> = (1..)
        .zip(&radii)
        .map(|(i, q)| PointErrors {
            observed: (q * 0.5 / f64::from(i)).powi(2),
            abscissa: (0.02 * q).powi(2),
            covariance: 0.004 * q * q / f64::from(i),
        })
        .collect();
    let curve = Curve::new(radii.clone(), observed.clone()).unwrap();
    let fit = fit(curve.with_errors(errors.clone()).unwrap(), NEXT_TO_NONE);
    let found = fit.estimates[0].value;
    // σ² = σ_y² − 2 E σ_yq + E² σ_q², and E = Σ q y/σ² / Σ q²/σ².
    let (mut normal, mut pull) = (0.0, 0.0);
    for ((q, y), of) in radii.iter().zip(&observed).zip(&errors) {
        let variance = of.observed - 2.0 * found * of.covariance + found * found * of.abscissa;
        normal += q * q / variance;
        pull += q * y / variance;
    }
    // To the tolerance of the search.
    assert_relative_eq!(found, pull / normal, max_relative = 1e-7);
    let [low, high] = fit.estimates[0].wald.unwrap();
    // In the logarithm of the modulus.
    let wanted = 2.0 * 1.959_963_985 / normal.sqrt() / found;
    assert_relative_eq!((high / low).ln(), wanted, max_relative = 1e-6);
}

/// Of 400 sets of eight contacts with errors of 5.6 to 0.6 % of their own and a scatter beside: how many intervals hold
/// the modulus, how many fits are misfits, and the mean half width of the intervals.
fn sets(scatter: f64, knows_errors: bool) -> (usize, usize, f64) {
    const SETS: u64 = 400;
    let radii = logarithmic(1.0, 10.0, 8);
    let own = |q: f64| 0.056 / q.powf(0.97);
    let (mut held, mut misfits, mut width) = (0, 0, 0.0);
    for seed in 0..SETS {
        let mut normals = Normals::new(seed);
        let reading = |q: &f64| {
            let part = own(*q) * normals.next() + scatter * normals.next();
            MODULUS * q * (1.0 + part)
        };
        let observed: Vec<f64> = radii.iter().map(reading).collect();
        let errors = radii.iter().zip(&observed).map(|(q, y)| PointErrors {
            observed: (own(*q) * y).powi(2),
            ..PointErrors::default()
        });
        let errors = errors.collect();
        let curve = Curve::new(radii.clone(), observed).unwrap();
        let curve = if knows_errors {
            curve.with_errors(errors).unwrap()
        } else {
            curve
        };
        let fit = fit(curve, Amount::Estimated);
        let [low, high] = fit.estimates[0].wald.unwrap();
        held += usize::from((low..=high).contains(&MODULUS));
        misfits += usize::from(fit.verdict == FitVerdict::Misfit);
        width += (high - low) / (2.0 * MODULUS * SETS as f64);
    }
    (held, misfits, width)
}

#[test]
fn intervals_hold_with_known_errors_alone_and_with_a_scatter_beside_them() {
    // 380 of 400 are expected, with a standard deviation of 4.4; a scatter that is not there can only widen them.
    let (held, misfits, width) = sets(0.0, true);
    assert!((368..=398).contains(&held), "{held} of 400");
    // Refused at a probability of 1 %.
    assert!(misfits <= 12, "{misfits} of 400");
    // The weighted mean alone has 1.96/√Σ s⁻² = 0.8 %; where a scatter is found by chance, its size is hardly known.
    assert!((0.008..0.015).contains(&width), "{width}");
    let (held, misfits, width) = sets(0.02, true);
    // The size of a scatter of eight is known to a third.
    assert!((360..=396).contains(&held), "{held} of 400");
    assert!(misfits <= 12, "{misfits} of 400");
    assert!((0.02..0.03).contains(&width), "{width}");
    // One relative noise for all is that of the worst.
    let (_, _, width) = sets(0.0, false);
    assert!(width > 0.018, "{width}");
}
