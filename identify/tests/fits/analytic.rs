//! Linear problems with closed-form solutions.

use approx::assert_relative_eq;
use pellicle_identify::{
    FitOptions, LinearNuisance, Noise, NoiseLevels, NuisanceShape, Prior, Problem, Scope, Unknown,
    identify,
};

use super::toys::{Normals, Toy, line, noisy};

fn signed(name: &str, range: [f64; 2]) -> Unknown {
    Unknown::signed(name, range).unwrap()
}

/// Intercept and slope with their variances, from the normal equations with unit weights.
fn normal_equations(x: &[f64], y: &[f64]) -> ([f64; 2], [f64; 2]) {
    let n = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxx: f64 = x.iter().map(|x| (x - mean_x).powi(2)).sum();
    let sxy: f64 = x
        .iter()
        .zip(y)
        .map(|(x, y)| (x - mean_x) * (y - mean_y))
        .sum();
    let slope = sxy / sxx;
    (
        [mean_y - slope * mean_x, slope],
        [1.0 / n + mean_x * mean_x / sxx, 1.0 / sxx],
    )
}

#[test]
fn a_straight_line_has_the_solution_and_intervals_of_the_normal_equations() {
    let x: Vec<f64> = (0..40).map(|i| 0.1 * f64::from(i)).collect();
    let toy = Toy::new(x.clone(), line);
    let sigma = 0.3;
    let curve = noisy(
        &x,
        &toy.values(&[2.0, -1.5]),
        sigma,
        &Normals::new(1).white(40),
    );
    let (wanted, variance) = normal_equations(&x, curve.observed());
    let unknowns = vec![signed("a", [-10.0, 10.0]), signed("b", [-9.0, 10.0])];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::white(sigma)).unwrap();
    let options = FitOptions {
        tolerance: 1e-12,
        ..FitOptions::default()
    };
    let fit = identify(&toy, &problem, &options).unwrap();
    for (j, estimate) in fit.estimates.iter().enumerate() {
        // χ² is within 1e-12 of its minimum: 1e-6 standard errors, which are 5 % of the values.
        assert_relative_eq!(estimate.value, wanted[j], max_relative = 1e-7);
        let half = 1.959_963_985 * sigma * variance[j].sqrt();
        let wald = estimate.wald.unwrap();
        assert_relative_eq!(wald[1] - estimate.value, half, max_relative = 1e-6);
        // On a linear problem the profile is a parabola and the scan is exact.
        assert_relative_eq!(estimate.interval[0].unwrap(), wald[0], max_relative = 1e-6);
        assert_relative_eq!(estimate.interval[1].unwrap(), wald[1], max_relative = 1e-6);
    }
}

#[test]
fn eliminating_a_nuisance_gives_the_result_of_the_full_fit() {
    // The same line, with its intercept as an unknown or a shift, and its slope as a frame compliance.
    let x: Vec<f64> = (0..30).map(|i| 1.0 + 0.2 * f64::from(i)).collect();
    let toy = Toy::new(x.clone(), |q, p| (p[0] * q, p[0], vec![q]));
    let sigma = 0.1;
    let values: Vec<f64> = x.iter().map(|q| 0.7 + 2.0 * q).collect();
    let curve = noisy(&x, &values, sigma, &Normals::new(2).white(30));
    let (wanted, variance) = normal_equations(&x, curve.observed());
    let shift = [LinearNuisance::shift()];
    let unknowns = vec![signed("b", [-9.0, 10.0])];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::white(sigma)).unwrap();
    let options = FitOptions {
        tolerance: 1e-12,
        ..FitOptions::default()
    };
    let fit = identify(&toy, &problem, &options).unwrap();
    // As in the test above.
    assert_relative_eq!(fit.estimates[0].value, wanted[1], max_relative = 1e-7);
    assert_relative_eq!(fit.coefficients[0].value, wanted[0], max_relative = 1e-6);
    let half = |width: [f64; 2]| 0.5 * (width[1] - width[0]);
    let expected = |j: usize| 1.959_963_985 * sigma * variance[j].sqrt();
    assert_relative_eq!(
        half(fit.estimates[0].wald.unwrap()),
        expected(1),
        max_relative = 1e-7
    );
    assert_relative_eq!(
        half(fit.coefficients[0].interval),
        expected(0),
        max_relative = 1e-7
    );
}

#[test]
fn a_prior_counts_as_one_more_observation() {
    // One constant observed n times with σ, with a prior m ± s: precision n/σ² + 1/s², mean weighted by precision.
    let (n, sigma, mean, sd) = (5, 0.4, 3.0, 0.1);
    let x = vec![1.0; n];
    let toy = Toy::new(x.clone(), |_, p| (p[0], 0.0, vec![1.0]));
    let curve = noisy(&x, &[3.5; 5], sigma, &[0.0; 5]);
    let precision = n as f64 / (sigma * sigma) + 1.0 / (sd * sd);
    let wanted = (3.5 * n as f64 / (sigma * sigma) + mean / (sd * sd)) / precision;
    let prior = Prior::Normal { mean, sd };
    let unknown = signed("c", [0.0, 10.0]).with_prior(prior).unwrap();
    let problem =
        Problem::new(vec![curve.clone()], vec![unknown], &[], Noise::white(sigma)).unwrap();
    let options = FitOptions {
        tolerance: 1e-14,
        ..FitOptions::default()
    };
    let fit = identify(&toy, &problem, &options).unwrap();
    // A linear problem, solved to 1e-7 standard errors.
    assert_relative_eq!(fit.estimates[0].value, wanted, max_relative = 1e-8);

    // The same as a nuisance, beside an unknown that does not affect it.
    let toy = Toy::new(x, |_, p| (p[0], 0.0, vec![1.0]));
    let constant = LinearNuisance::new("c", NuisanceShape::Constant, Scope::Common)
        .with_normal_prior(mean, sd)
        .unwrap();
    let zero = signed("zero", [-1.0, 1.5]).with_prior(Prior::Normal {
        mean: 0.0,
        sd: 1e-9,
    });
    let problem = Problem::new(
        vec![curve],
        vec![zero.unwrap()],
        &[constant],
        Noise::white(sigma),
    )
    .unwrap();
    let fit = identify(&toy, &problem, &options).unwrap();
    // The other unknown may absorb 1e-9 of it.
    assert_relative_eq!(fit.coefficients[0].value, wanted, max_relative = 1e-8);
    let half = 1.959_963_985 / precision.sqrt();
    assert_relative_eq!(
        fit.coefficients[0].interval[1] - wanted,
        half,
        max_relative = 1e-6
    );
}

#[test]
fn errors_of_the_abscissa_are_weighted_by_the_slope() {
    // y = b q with errors in both axes has the constant variance σ_y² + b² σ_q², so b is the plain least-squares
    // estimate, with that variance over Σ q².
    let x: Vec<f64> = (1..=50).map(f64::from).collect();
    let toy = Toy::new(x.clone(), |q, p| (p[0] * q, p[0], vec![q]));
    let curve = noisy(&x, &toy.values(&[2.0]), 0.5, &Normals::new(3).white(50));
    let sum_qq: f64 = x.iter().map(|q| q * q).sum();
    let b = x
        .iter()
        .zip(curve.observed())
        .map(|(q, y)| q * y)
        .sum::<f64>()
        / sum_qq;
    let noise = Noise {
        abscissa: pellicle_identify::Amount::Given(0.4),
        ..Noise::white(0.5)
    };
    let unknowns = vec![Unknown::positive("b", [0.1, 10.0]).unwrap()];
    let problem = Problem::new(vec![curve], unknowns, &[], noise).unwrap();
    let options = FitOptions {
        tolerance: 1e-14,
        ..FitOptions::default()
    };
    let fit = identify(&toy, &problem, &options).unwrap();
    // Solved to 1e-7 standard errors of 0.3 %.
    assert_relative_eq!(fit.estimates[0].value, b, max_relative = 1e-8);
    let wanted = ((0.25 + b * b * 0.16) / sum_qq).sqrt() / b;
    assert_relative_eq!(fit.covariance[0][0].sqrt(), wanted, max_relative = 1e-6);
    let NoiseLevels {
        observed, abscissa, ..
    } = fit.noise;
    assert_eq!([observed, abscissa], [0.5, 0.4]);
}
