//! Zeros of the abscissa, eliminated, against the same zeros as unknowns of the fit.

use approx::assert_relative_eq;
use pellicle_identify::{
    Correlation, Curve, Fit, FitOptions, LinearNuisance, Noise, Problem, Unknown, Verdict, identify,
};

use super::toys::{Normals, Point, Toy};

/// A ball on a half-space, `F = E h^1.5` from the contact on; one parameter.
fn ball(h: f64, parameters: &[f64]) -> Point {
    let e = parameters[0];
    if h <= 0.0 {
        return (0.0, 0.0, vec![0.0]);
    }
    (e * h.powf(1.5), 1.5 * e * h.sqrt(), vec![h.powf(1.5)])
}

/// The same with its zero as the second parameter.
fn ball_from_zero(h: f64, parameters: &[f64]) -> Point {
    let (y, slope, by_e) = ball(h - parameters[1], parameters);
    (y, slope, vec![by_e[0], -slope])
}

const E: f64 = 2.0;

fn modulus() -> Unknown {
    Unknown::positive("E", [0.02, 200.0])
        .unwrap()
        .starting_at(0.2)
        .unwrap()
}

fn depths(points: u32) -> Vec<f64> {
    (0..points)
        .map(|i| 3.0 * f64::from(i) / f64::from(points))
        .collect()
}

/// A force at depths with its contact at `zero`, a constant `offset`, and white noise.
fn observed(depths: &[f64], zero: f64, offset: f64, sigma: f64, seed: u64) -> Vec<f64> {
    let mut normal = Normals::new(seed);
    let force = |h: &f64| ball(h - zero, &[E]).0 + offset + sigma * normal.next();
    depths.iter().map(force).collect()
}

fn fit(curves: Vec<Curve>, nuisances: &[LinearNuisance], noise: Noise) -> Fit {
    let abscissa = curves.iter().flat_map(|c| c.abscissa().to_vec()).collect();
    let problem = Problem::new(curves, vec![modulus()], nuisances, noise).unwrap();
    identify(&Toy::new(abscissa, ball), &problem, &FitOptions::default()).unwrap()
}

#[test]
fn an_eliminated_zero_gives_the_fit_and_the_interval_of_a_zero_that_is_sought() {
    for (zero, sigma, seed) in [(1.0, 0.05, 1), (-0.4, 0.02, 2), (2.0, 0.1, 3)] {
        let depths = depths(120);
        let force = observed(&depths, zero, 0.3, sigma, seed);
        let curve = Curve::new(depths.clone(), force).unwrap();
        let noise = Noise::white(sigma);
        let offset = LinearNuisance::shift();
        let nuisances = [offset.clone(), LinearNuisance::abscissa_zero()];
        let eliminated = fit(vec![curve.clone()], &nuisances, noise);
        let sought = Unknown::signed("z", [-3.0, 3.0]).unwrap().as_nuisance();
        let sought = sought.starting_at(zero + 0.1).unwrap();
        let problem = Problem::new(vec![curve], vec![modulus(), sought], &[offset], noise);
        let model = Toy::new(depths, ball_from_zero);
        let sought = identify(&model, &problem.unwrap(), &FitOptions::default()).unwrap();
        let (one, other) = (&eliminated.estimates[0], &sought.estimates[0]);
        // The search ends within a hundredth of a standard error.
        let error = (other.value.ln() - other.wald.unwrap()[0].ln()).abs() / 1.96;
        assert!((one.value / other.value).ln().abs() < 0.02 * error);
        for side in 0..2 {
            let [a, b] = [one.interval[side].unwrap(), other.interval[side].unwrap()];
            assert!((a / b).ln().abs() < 0.03 * error, "{zero}: {a} {b}");
        }
        let found = eliminated
            .coefficients
            .iter()
            .find(|c| c.name == "abscissa_zero[0]");
        assert_relative_eq!(
            found.unwrap().value,
            sought.estimates[1].value,
            epsilon = 1e-3
        );
        let [low, high] = found.unwrap().interval;
        assert!((low..high).contains(&zero), "{zero}: {low} {high}");
    }
}

#[test]
fn intervals_hold_the_modulus_of_whole_approaches_and_of_curves_begun_in_contact() {
    let mut held = [0, 0];
    for seed in 0..200_u32 {
        for (kind, zero) in [(0, 1.5), (1, -0.3)] {
            let depths = depths(150);
            let force = observed(
                &depths,
                zero + 0.001 * f64::from(seed),
                0.1,
                0.05,
                seed.into(),
            );
            let curve = Curve::new(depths, force).unwrap();
            let nuisances = [LinearNuisance::shift(), LinearNuisance::abscissa_zero()];
            let noise = Noise {
                correlation: Correlation::Estimated,
                ..Noise::default()
            };
            let fit = fit(vec![curve], &nuisances, noise);
            assert_eq!(
                fit.estimates[0].verdict,
                Verdict::Identified,
                "{seed} {kind}"
            );
            let [low, high] = fit.estimates[0].interval.map(Option::unwrap);
            held[kind] += usize::from((low..=high).contains(&E));
        }
    }
    // 95 % of 200, three standard deviations of the count on each side.
    for held in held {
        assert!((181..=199).contains(&held), "{held}");
    }
}

#[test]
fn each_repeat_has_its_own_zero_and_a_prior_holds_it() {
    let curves = [0.4, 0.9, 1.4].into_iter().zip(10..);
    let curves = curves.map(|(zero, seed)| {
        let force = observed(&depths(100), zero, 0.0, 0.05, seed);
        Curve::new(depths(100), force).unwrap()
    });
    let curves: Vec<Curve> = curves.collect();
    let zero = LinearNuisance::abscissa_zero();
    let free = fit(
        curves.clone(),
        std::slice::from_ref(&zero),
        Noise::white(0.05),
    );
    for (coefficient, wanted) in free.coefficients.iter().zip([0.4, 0.9, 1.4]) {
        assert_relative_eq!(coefficient.value, wanted, epsilon = 0.05);
    }
    assert_relative_eq!(free.estimates[0].value, E, max_relative = 0.05);
    // A tight prior at a wrong place holds the zeros there.
    let held = zero.with_normal_prior(0.9, 1e-6).unwrap();
    let held = fit(curves, &[held], Noise::white(0.05));
    for coefficient in &held.coefficients {
        assert_relative_eq!(coefficient.value, 0.9, epsilon = 1e-4);
    }
}
