//! A fit compared with certified values.

use approx::assert_relative_eq;
use pellicle_identify::{Curve, FitOptions, Intervals, Noise, Problem, Unknown, identify};

use super::toys::{Point, Toy};

/// `y = b1 (1 − exp(−b2 x))`.
fn misra(x: f64, parameters: &[f64]) -> Point {
    let (b1, b2) = (parameters[0], parameters[1]);
    let rest = (-b2 * x).exp();
    (
        b1 * (1.0 - rest),
        b1 * b2 * rest,
        vec![1.0 - rest, b1 * x * rest],
    )
}

/// Misra1a of the Statistical Reference Datasets of NIST (D. Misra, Dental Research Monomolecular Adsorption Study,
/// NIST 1978): certified to eleven digits. The fit begins at the first of the certified starts, 500 and 0.0001.
#[test]
fn values_and_standard_deviations_are_those_certified_by_nist() {
    let x = [
        77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1,
        760.0,
    ];
    let y = [
        10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
        81.78,
    ];
    let unknowns = vec![
        Unknown::positive("b1", [50.0, 5000.0])
            .unwrap()
            .starting_at(500.0)
            .unwrap(),
        Unknown::positive("b2", [1e-5, 1e-2])
            .unwrap()
            .starting_at(1e-4)
            .unwrap(),
    ];
    let curve = Curve::new(x.to_vec(), y.to_vec()).unwrap();
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::default()).unwrap();
    let options = FitOptions {
        tolerance: 1e-14,
        intervals: Intervals::Wald,
        ..FitOptions::default()
    };
    let fit = identify(&Toy::new(x.to_vec(), misra), &problem, &options).unwrap();
    // The search ends 1e-7 standard errors, of 1 %, from the minimum.
    assert_relative_eq!(
        fit.estimates[0].value,
        2.389_421_291_8e2,
        max_relative = 1e-8
    );
    assert_relative_eq!(
        fit.estimates[1].value,
        5.501_564_318_1e-4,
        max_relative = 1e-8
    );
    let deviation = |j: usize| fit.estimates[j].value * fit.covariance[j][j].sqrt();
    // The logarithm of the noise is estimated to 1e-4, the tolerance of the simplex search.
    assert_relative_eq!(deviation(0), 2.707_007_524_1, max_relative = 2e-4);
    assert_relative_eq!(deviation(1), 7.266_868_843_6e-6, max_relative = 2e-4);
    // Fourteen points, two unknowns.
    assert_relative_eq!(
        fit.estimates[0].degrees_of_freedom,
        12.0,
        max_relative = 1e-2
    );
}
