//! The likelihood compared with closed forms and with the ends of intervals.

use pellicle_identify::{
    Curve, Fit, FitOptions, ForwardModel as _, IdentifyError, Likelihood, LinearNuisance, Noise,
    Prior, Problem, Unknown, identify,
};

use super::toys::{Point, Toy};

/// `y = b q²`.
fn parabola(q: f64, parameters: &[f64]) -> Point {
    let b = parameters[0];
    (b * q * q, 2.0 * b * q, vec![q * q])
}

/// Thirty points of a parabola with an offset and deviations of some tenths.
fn problem(model: &Toy, prior: Option<Prior>, noise: Noise) -> Problem {
    let deviation = |i: usize| 0.2 * (7.0 * (i * i) as f64).sin();
    let values = model.values(&[2.0]).into_iter().enumerate();
    let observed = values.map(|(i, y)| y + 0.5 + deviation(i)).collect();
    let curve = Curve::new(model.abscissa.clone(), observed).unwrap();
    let unknown = Unknown::signed("b", [-3.0, 8.0]).unwrap();
    let unknown = match prior {
        Some(prior) => unknown.with_prior(prior).unwrap(),
        None => unknown,
    };
    Problem::new(
        vec![curve],
        vec![unknown],
        &[LinearNuisance::shift()],
        noise,
    )
    .unwrap()
}

fn model() -> Toy {
    Toy::new((1..=30).map(|i| f64::from(i) / 10.0).collect(), parabola)
}

fn likelihood(model: &Toy, problem: &Problem) -> (Fit, Likelihood) {
    let fit = identify(model, problem, &FitOptions::default()).unwrap();
    let best = model.predict(&[fit.estimates[0].value]).unwrap();
    let likelihood = Likelihood::new(problem, &fit, &best).unwrap();
    (fit, likelihood)
}

/// `Σ (r − r̄)²` of the residuals `r`: their squares with the shift eliminated.
fn squares(model: &Toy, problem: &Problem, b: f64) -> f64 {
    let observed = problem.curves()[0].observed();
    let pairs = observed.iter().zip(model.values(&[b]));
    let residuals: Vec<f64> = pairs.map(|(y, f)| y - f).collect();
    let mean = residuals.iter().sum::<f64>() / residuals.len() as f64;
    residuals.iter().map(|r| (r - mean).powi(2)).sum()
}

#[test]
fn under_given_noise_the_likelihood_is_that_of_normal_residuals_about_their_mean() {
    let model = model();
    let prior = Prior::Normal { mean: 2.5, sd: 0.1 };
    for prior in [None, Some(prior)] {
        let problem = problem(&model, prior, Noise::white(0.15));
        let (fit, likelihood) = likelihood(&model, &problem);
        let best = squares(&model, &problem, fit.estimates[0].value);
        for b in [1.7, 2.0, 2.4] {
            let found = likelihood.logarithm(&model.predict(&[b]).unwrap()).unwrap();
            let wanted = -0.5 * (squares(&model, &problem, b) - best) / 0.15_f64.powi(2);
            // Rounding of sums of thirty squares.
            assert!(
                (found - wanted).abs() < 1e-9 * wanted.abs().max(1.0),
                "{found} {wanted}"
            );
        }
    }
}

#[test]
fn under_estimated_noise_the_likelihood_at_the_end_of_an_interval_is_that_of_student() {
    let model = model();
    let problem = problem(&model, None, Noise::default());
    let (fit, likelihood) = likelihood(&model, &problem);
    let estimate = &fit.estimates[0];
    let nu = estimate.degrees_of_freedom;
    assert!(nu.is_finite());
    // At an end of the interval t² is its threshold; Student's density is (1 + t²/ν)^(−(ν + 1)/2).
    let wanted = -0.5 * (nu + 1.0) * (estimate.threshold(0.95) / nu).ln_1p();
    for end in estimate.interval.map(Option::unwrap) {
        let found = likelihood
            .logarithm(&model.predict(&[end]).unwrap())
            .unwrap();
        // Profiles end within a twentieth of the threshold.
        assert!((found / wanted - 1.0).abs() < 0.05, "{found} {wanted}");
    }
}

#[test]
fn a_prediction_of_other_points_is_refused() {
    let model = model();
    let problem = problem(&model, None, Noise::white(0.15));
    let (fit, likelihood) = likelihood(&model, &problem);
    let short = Toy::new(vec![1.0, 2.0], parabola).predict(&[2.0]).unwrap();
    let is_refused = |error: IdentifyError| {
        matches!(
            error,
            IdentifyError::Length {
                found: 2,
                wanted: 30,
                ..
            }
        )
    };
    assert!(is_refused(likelihood.logarithm(&short).unwrap_err()));
    assert!(is_refused(
        Likelihood::new(&problem, &fit, &short).unwrap_err()
    ));
}
