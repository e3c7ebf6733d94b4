//! Models that the data refuse, and how often a true one is refused.

use pellicle_identify::{
    Amount, Correlation, Fit, FitOptions, FitVerdict, Intervals, LinearNuisance, Noise, Problem,
    identify,
};

use super::toys::{
    Normals, Point, Toy, coating_moduli, hertz_modulus, logarithmic, noisy, unknown,
};

const SIGMA: f64 = 0.02;

const CORRELATED: Noise = Noise {
    observed: Amount::Estimated,
    abscissa: Amount::Given(0.0),
    relative: Amount::Given(0.0),
    correlation: Correlation::Estimated,
};

/// Sixty points of a coating, fitted by a law of one or two moduli.
fn fit(law: fn(f64, &[f64]) -> Point, unknowns: usize, noise: Noise, seed: u64) -> Fit {
    fit_series(law, unknowns, noise, &Normals::new(seed).white(60))
}

fn fit_series(law: fn(f64, &[f64]) -> Point, unknowns: usize, noise: Noise, series: &[f64]) -> Fit {
    let forces = logarithmic(0.01, 100.0, 60);
    let truth = Toy::new(forces.clone(), coating_moduli).values(&[10.0, 1.5]);
    let curve = noisy(&forces, &truth, SIGMA, series);
    let both = [
        unknown("E1", [0.1, 100.0], 5.0),
        unknown("E2", [0.2, 10.0], 1.0),
    ];
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], both[..unknowns].to_vec(), &shift, noise).unwrap();
    let options = FitOptions {
        intervals: Intervals::Wald,
        ..FitOptions::default()
    };
    identify(&Toy::new(forces, law), &problem, &options).unwrap()
}

#[test]
fn a_half_space_fitted_to_a_coating_is_refused() {
    // An autoregression would absorb the misfit, but its persistence reveals it.
    for noise in [Noise::white(SIGMA), Noise::default(), CORRELATED] {
        let fit = fit(hertz_modulus, 1, noise, 1);
        assert_eq!(fit.verdict, FitVerdict::Misfit, "{:?}", fit.goodness);
        assert!(fit.goodness.misfit_p < 1e-6, "{:?}", fit.goodness);
    }
}

#[test]
fn a_true_model_is_refused_at_most_once_in_a_hundred() {
    for noise in [Noise::white(SIGMA), Noise::default(), CORRELATED] {
        let fits: Vec<Fit> = (0..400)
            .map(|seed| fit(coating_moduli, 2, noise, seed))
            .collect();
        let refused = fits
            .iter()
            .filter(|fit| fit.verdict == FitVerdict::Misfit)
            .count();
        // One in a hundred, out of 400.
        assert!(refused <= 4, "{refused} of 400 refused");
        assert!(
            fits.iter()
                .all(|fit| fit.verdict != FitVerdict::NotConverged)
        );
    }
}

#[test]
fn correlated_noise_is_not_taken_for_a_misfit() {
    let refused = |noise, replicates| {
        (0..replicates)
            .map(|seed| Normals::new(seed).autoregressive(60, 0.8, 0.2))
            .filter(|series| {
                fit_series(coating_moduli, 2, noise, series).verdict == FitVerdict::Misfit
            })
            .count()
    };
    let refusals = refused(CORRELATED, 400);
    // One in a hundred, out of 400.
    assert!(refusals <= 4, "{refusals} of 400 refused");
    // Control: if the correlation is not declared, most are refused.
    let undeclared = refused(Noise::default(), 100);
    assert!(undeclared > 50, "{undeclared} of 100 refused");
}
