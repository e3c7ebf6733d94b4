//! Single points far off: named, and the fit refused. Good points of noisy curves are not.

use pellicle_identify::{
    Amount, Correlation, Curve, Fit, FitOptions, FitVerdict, Intervals, LinearNuisance, Noise,
    Problem, identify,
};

use super::toys::{Normals, Toy, hertz_modulus, logarithmic, unknown};

const SIGMA: f64 = 0.02;
const POINTS: usize = 60;

const ESTIMATED: Noise = Noise {
    observed: Amount::Estimated,
    abscissa: Amount::Given(0.0),
    relative: Amount::Given(0.0),
    correlation: Correlation::Estimated,
};

/// A Hertz contact under 0.1 to 30 with this noise, and points moved by some multiples of [`SIGMA`].
fn fit(series: &[f64], moved: &[(usize, f64)], noise: Noise) -> (Fit, Vec<f64>) {
    let forces = logarithmic(0.1, 30.0, series.len());
    let toy = Toy::new(forces.clone(), hertz_modulus);
    let exact = toy.values(&[5.0]);
    let mut observed: Vec<f64> = (exact.iter().zip(series))
        .map(|(v, n)| v + SIGMA * n)
        .collect();
    for (point, deviations) in moved {
        observed[*point] += deviations * SIGMA;
    }
    let curve = Curve::new(forces, observed).unwrap();
    let shift = [LinearNuisance::shift()];
    let unknowns = vec![unknown("E", [0.5, 50.0], 10.0)];
    let problem = Problem::new(vec![curve], unknowns, &shift, noise).unwrap();
    let options = FitOptions {
        intervals: Intervals::Wald,
        ..FitOptions::default()
    };
    (identify(&toy, &problem, &options).unwrap(), exact)
}

#[test]
fn outliers_of_any_size_and_place_are_named_and_nothing_else_is() {
    // From fifteen standard deviations up to a point lost altogether, which leaves the fit at a bound.
    let cases: [&[(usize, f64)]; 7] = [
        &[(31, 15.0)],
        &[(31, -15.0)],
        &[(31, 2.5e5)],
        &[(0, 30.0)],
        &[(59, -30.0)],
        &[(20, 40.0), (21, 40.0)],
        &[(3, 20.0), (17, -25.0), (18, 3e3), (40, 15.0), (55, -40.0)],
    ];
    for noise in [Noise::default(), ESTIMATED, Noise::white(SIGMA)] {
        for moved in cases {
            let (fit, exact) = fit(&Normals::new(2).white(POINTS), moved, noise);
            let named: Vec<usize> = fit.outliers.iter().map(|one| one.point).collect();
            let wanted: Vec<usize> = moved.iter().map(|one| one.0).collect();
            assert_eq!(named, wanted, "{moved:?} {noise:?}: {:?}", fit.outliers);
            assert_eq!(fit.verdict, FitVerdict::Misfit);
            for (found, (point, deviations)) in fit.outliers.iter().zip(moved) {
                // Ten neighbours determine a value to half a standard deviation; at an end, to twice that.
                let error = (found.expected - exact[*point]).abs();
                assert!(error < 4.0 * SIGMA, "{found:?} {}", exact[*point]);
                assert!(found.deviations * deviations > 0.0);
            }
        }
    }
}

#[test]
fn noise_of_any_kind_has_no_outliers() {
    let named = |noise: Noise, series: &dyn Fn(&mut Normals) -> Vec<f64>| {
        let fits = (0..200).map(|seed| fit(&series(&mut Normals::new(seed)), &[], noise).0);
        fits.filter(|fit| !fit.outliers.is_empty()).count()
    };
    assert_eq!(named(Noise::default(), &|normals| normals.white(POINTS)), 0);
    assert_eq!(named(Noise::default(), &|normals| normals.white(20)), 0);
    assert_eq!(
        named(ESTIMATED, &|normals| normals
            .autoregressive(POINTS, 0.85, 0.2)),
        0
    );
    // Noise of 1 % of the reading taken for one of constant size: the readings span a factor of 45.
    let growing = |normals: &mut Normals| -> Vec<f64> {
        let readings = Toy::new(logarithmic(0.1, 30.0, POINTS), hertz_modulus).values(&[5.0]);
        let pairs = readings.iter().zip(normals.white(POINTS));
        pairs.map(|(v, n)| 0.01 * v * n / SIGMA).collect()
    };
    // Beyond the noise model, one in a hundred.
    let found = named(Noise::default(), &growing);
    assert!(found <= 2, "{found} of 200");
}

#[test]
fn a_step_of_the_curve_is_no_outlier() {
    // All points from the fortieth on lie thirty standard deviations deeper: a pop-in.
    let moved: Vec<(usize, f64)> = (40..POINTS).map(|point| (point, 30.0)).collect();
    let (fit, _) = fit(&Normals::new(4).white(POINTS), &moved, Noise::default());
    assert_eq!(fit.outliers, []);
    assert_eq!(fit.verdict, FitVerdict::Misfit);
}
