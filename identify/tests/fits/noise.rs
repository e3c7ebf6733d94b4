//! The noise estimated from the residuals.

use approx::assert_relative_eq;
use pellicle_identify::{
    Amount, Correlation, Curve, Fit, FitOptions, Intervals, LinearNuisance, Noise, Problem,
    identify,
};

use super::toys::{
    Normals, Toy, coating_moduli, hertz_modulus, line, logarithmic, noisy, two_moduli, unknown,
};

fn options() -> FitOptions {
    FitOptions {
        intervals: Intervals::Wald,
        ..FitOptions::default()
    }
}

/// A Hertz contact at `points` loads with correlated noise.
fn correlated(points: i32, noise: Noise, seed: u64) -> Fit {
    let forces: Vec<f64> = (1..=points).map(|i| 0.1 * f64::from(i)).collect();
    let toy = Toy::new(forces.clone(), hertz_modulus);
    let series = Normals::new(seed).autoregressive(forces.len(), 0.85, 0.2);
    let curve = noisy(&forces, &toy.values(&[5.0]), 0.02, &series);
    let shift = [LinearNuisance::shift()];
    let unknowns = vec![unknown("E", [1.0, 100.0], 10.0)];
    let problem = Problem::new(vec![curve], unknowns, &shift, noise).unwrap();
    identify(&toy, &problem, &options()).unwrap()
}

const ESTIMATED: Noise = Noise {
    observed: Amount::Estimated,
    abscissa: Amount::Given(0.0),
    relative: Amount::Given(0.0),
    correlation: Correlation::Estimated,
};

#[test]
fn a_long_series_determines_its_correlation() {
    let noise = correlated(10_000, ESTIMATED, 1).noise;
    // Of 10 000 points about 800 are independent: 3.5 % for the size, and 0.01 for a correlation.
    assert_relative_eq!(noise.observed, 0.02, max_relative = 0.07);
    assert_relative_eq!(noise.persistence, 0.85, max_relative = 0.03);
    assert_relative_eq!(noise.white_fraction, 0.2, max_relative = 0.15);
}

#[test]
fn a_given_correlation_gives_the_generalised_least_squares_of_a_line() {
    // Without a white part the innovations are e_i = r_i − φ r_{i−1}, and the first is r_0 √(1 − φ²): plain least
    // squares on columns transformed in this way (S. J. Prais and C. B. Winsten, Cowles Commission Discussion Paper
    // 383, 1954).
    let (phi, sigma, points) = (0.7, 0.3, 50);
    let x: Vec<f64> = (0..points).map(|i| 0.1 * i as f64).collect();
    let toy = Toy::new(x.clone(), line);
    let series = Normals::new(5).autoregressive(points, phi, 0.0);
    let curve = noisy(&x, &toy.values(&[2.0, 1.5]), sigma, &series);
    let transform = |v: &[f64]| -> Vec<f64> {
        let first = v[0] * (1.0 - phi * phi).sqrt();
        std::iter::once(first)
            .chain(v.windows(2).map(|w| w[1] - phi * w[0]))
            .collect()
    };
    let (a, b, y) = (
        transform(&vec![1.0; points]),
        transform(&x),
        transform(curve.observed()),
    );
    let dot = |u: &[f64], v: &[f64]| u.iter().zip(v).map(|(p, q)| p * q).sum::<f64>();
    let determinant = dot(&a, &a) * dot(&b, &b) - dot(&a, &b).powi(2);
    let slope = (dot(&a, &a) * dot(&b, &y) - dot(&a, &b) * dot(&a, &y)) / determinant;
    // The innovations have the variance σ² (1 − φ²).
    let variance = sigma * sigma * (1.0 - phi * phi) * dot(&a, &a) / determinant;

    let noise = Noise {
        correlation: Correlation::Given {
            persistence: phi,
            white_fraction: 0.0,
        },
        ..Noise::white(sigma)
    };
    let unknowns =
        ["a", "b"].map(|name| pellicle_identify::Unknown::signed(name, [-9.0, 10.0]).unwrap());
    let problem = Problem::new(vec![curve], unknowns.to_vec(), &[], noise).unwrap();
    let fit = identify(
        &toy,
        &problem,
        &FitOptions {
            tolerance: 1e-12,
            ..options()
        },
    )
    .unwrap();
    // Solved to 1e-6 of a standard error of 5 %.
    assert_relative_eq!(fit.estimates[1].value, slope, max_relative = 1e-7);
    let [low, high] = fit.estimates[1].wald.unwrap();
    assert_relative_eq!(
        high - low,
        2.0 * 1.959_963_985 * variance.sqrt(),
        max_relative = 1e-7
    );
}

#[test]
fn correlated_noise_treated_as_white_gives_too_narrow_intervals() {
    // Control for the coverage test with correlated noise, where 95 % contain the true value.
    let held = (0..200)
        .filter(|&seed| {
            let [low, high] = correlated(300, Noise::default(), seed).estimates[0]
                .wald
                .unwrap();
            low <= 5.0 && 5.0 <= high
        })
        .count();
    assert!(held < 140, "{held} of 200");
}

#[test]
fn noise_of_the_two_axes_is_separated_where_the_slope_varies() {
    let forces = logarithmic(0.2, 100.0, 2000);
    let mut normals = Normals::new(8);
    let actual = forces.iter().map(|q| q + 0.02 * normals.next()).collect();
    let values = Toy::new(actual, coating_moduli).values(&[10.0, 1.5]);
    let curve = noisy(&forces, &values, 0.01, &normals.white(2000));
    let noise = Noise {
        abscissa: Amount::Estimated,
        ..Noise::default()
    };
    let problem = Problem::new(vec![curve], two_moduli(), &[], noise).unwrap();
    let fit = identify(&Toy::new(forces, coating_moduli), &problem, &options()).unwrap();
    // 2000 points determine one size to 1.6 %; with slopes of 0.02 … 0.4, the errors of the abscissa are the smaller
    // part.
    assert_relative_eq!(fit.noise.observed, 0.01, max_relative = 0.08);
    assert_relative_eq!(fit.noise.abscissa, 0.02, max_relative = 0.3);
}

#[test]
fn relative_noise_is_distinguished_from_constant_noise() {
    let forces = logarithmic(0.01, 100.0, 2000);
    let toy = Toy::new(forces.clone(), coating_moduli);
    let mut normals = Normals::new(9);
    let observed = toy
        .values(&[10.0, 1.5])
        .iter()
        .map(|v| v * (1.0 + 0.01 * normals.next()) + 0.005 * normals.next())
        .collect();
    let curve = Curve::new(forces, observed).unwrap();
    let noise = Noise {
        relative: Amount::Estimated,
        ..Noise::default()
    };
    let problem = Problem::new(vec![curve], two_moduli(), &[], noise).unwrap();
    let fit = identify(&toy, &problem, &options()).unwrap();
    // 2000 points, each of which mostly determines one of the two.
    assert_relative_eq!(fit.noise.observed, 0.005, max_relative = 0.08);
    assert_relative_eq!(fit.noise.relative, 0.01, max_relative = 0.08);
}
