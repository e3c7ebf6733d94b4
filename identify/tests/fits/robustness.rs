//! Models that are not smooth, not defined everywhere, or have more than one minimum.

use pellicle_identify::{
    Fit, FitOptions, FitVerdict, FitWarning, ForwardError, ForwardModel, IdentifyError,
    LinearNuisance, Noise, Prediction, Problem, Scatter, identify,
};

use super::toys::{Normals, Point, Toy, coating_moduli, logarithmic, noisy, unknown};

/// A toy whose predictions jump with the parameters, like those on a grid.
struct Jagged {
    toy: Toy,
    /// Jitter of the values.
    jitter: f64,
    /// Error of the derivatives.
    error: f64,
}

impl ForwardModel for Jagged {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let mut prediction = self.toy.predict(parameters)?;
        let seed = parameters
            .iter()
            .fold(0, |seed: u64, p| seed.rotate_left(7) ^ p.to_bits());
        let mut normals = Normals::new(seed);
        for value in &mut prediction.value {
            *value *= 1.0 + self.jitter * normals.next();
        }
        for column in &mut prediction.derivatives {
            let factor = 1.0 + self.error * normals.next();
            column.iter_mut().for_each(|d| *d *= factor);
        }
        Ok(prediction)
    }
}

fn jagged_fit(jitter: f64, error: f64, seed: u64) -> Fit {
    let forces = logarithmic(0.01, 100.0, 60);
    let toy = Toy::new(forces.clone(), coating_moduli);
    let curve = noisy(
        &forces,
        &toy.values(&[10.0, 1.5]),
        0.01,
        &Normals::new(seed).white(60),
    );
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 3.0),
        unknown("E2", [0.2, 10.0], 3.0),
    ];
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::default()).unwrap();
    identify(
        &Jagged { toy, jitter, error },
        &problem,
        &FitOptions::default(),
    )
    .unwrap()
}

#[test]
fn jitter_and_rough_derivatives_cost_a_few_predictions_but_not_convergence() {
    for seed in 0..20 {
        let smooth = jagged_fit(0.0, 0.0, seed);
        // The jitter of a contact on a grid, and the error of derivatives of its discrete map.
        let jagged = jagged_fit(3e-5, 0.03, seed);
        assert_eq!(
            jagged.verdict,
            FitVerdict::Fitted,
            "seed {seed}: {:?}",
            jagged.goodness
        );
        assert!(jagged.work.search <= 20, "seed {seed}: {:?}", jagged.work);
        assert!(
            jagged.work.curves_solved <= 40,
            "seed {seed}: {:?}",
            jagged.work
        );
        for (a, b) in smooth.estimates.iter().zip(&jagged.estimates) {
            let [low, high] = a.wald.unwrap();
            // A fifth of the half interval of two standard errors.
            assert!(
                (a.value - b.value).abs() < 0.1 * (high - low),
                "seed {seed}: {a:?} {b:?}"
            );
        }
    }
}

/// `y = cos(3 ln θ) + q ln θ`, whose misfit has several minima.
fn waves(q: f64, parameters: &[f64]) -> Point {
    let x = parameters[0].ln();
    let value = (3.0 * x).cos() + 0.1 * q * x;
    (
        value,
        0.1 * x,
        vec![(-3.0 * (3.0 * x).sin() + 0.1 * q) / parameters[0]],
    )
}

#[test]
fn the_best_of_several_minima_is_found_and_the_others_are_reported() {
    let q: Vec<f64> = (0..30).map(|i| 0.1 * f64::from(i)).collect();
    let toy = Toy::new(q.clone(), waves);
    let truth = 0.5_f64.exp();
    let curve = noisy(&q, &toy.values(&[truth]), 0.02, &Normals::new(1).white(30));
    let unknowns = vec![unknown("x", [0.05, 20.0], 12.0)];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::white(0.02)).unwrap();
    let options = FitOptions {
        starts: 8,
        ..FitOptions::default()
    };
    let fit = identify(&toy, &problem, &options).unwrap();
    assert!(
        (fit.estimates[0].value - truth).abs() < 0.05,
        "{:?}",
        fit.estimates[0]
    );
    assert!(fit.warnings.contains(&FitWarning::SeveralMinima));
}

/// A model that never has a prediction, or ends the fit.
struct Refusing {
    stop: bool,
}

impl ForwardModel for Refusing {
    fn predict(&self, _: &[f64]) -> Result<Prediction, ForwardError> {
        Err(if self.stop {
            ForwardError::Stopped
        } else {
            ForwardError::OutOfRange {
                source: "no tables".into(),
            }
        })
    }
}

#[test]
fn a_model_without_predictions_and_a_stopped_fit_are_errors() {
    let curve = noisy(&[1.0, 2.0], &[1.0, 2.0], 0.0, &[0.0, 0.0]);
    let unknowns = vec![unknown("x", [0.1, 10.0], 1.0)];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::white(1.0)).unwrap();
    let fit = |stop| identify(&Refusing { stop }, &problem, &FitOptions::default());
    assert!(matches!(
        fit(false),
        Err(IdentifyError::NoStart { starts: 4, .. })
    ));
    assert!(matches!(
        fit(true),
        Err(IdentifyError::Stopped { predictions: 1 })
    ));
}

#[test]
fn data_without_any_noise_are_fitted_exactly() {
    let forces = logarithmic(0.01, 100.0, 40);
    let toy = Toy::new(forces.clone(), coating_moduli);
    let curve = noisy(&forces, &toy.values(&[10.0, 1.5]), 0.0, &[0.0; 40]);
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 3.0),
        unknown("E2", [0.2, 10.0], 3.0),
    ];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::default()).unwrap();
    let fit = identify(&toy, &problem, &FitOptions::default()).unwrap();
    for (estimate, truth) in fit.estimates.iter().zip([10.0, 1.5]) {
        // Quadratic convergence reaches far below the first guess of the noise, which is absent here.
        assert!((estimate.value / truth - 1.0).abs() < 1e-6, "{estimate:?}");
    }
    assert!(fit.work.curves_solved <= 40, "{:?}", fit.work);
}

#[test]
fn a_value_beyond_its_range_ends_at_the_bound_with_a_warning() {
    let forces = logarithmic(0.01, 100.0, 40);
    let toy = Toy::new(forces.clone(), coating_moduli);
    let curve = noisy(
        &forces,
        &toy.values(&[10.0, 1.5]),
        0.01,
        &Normals::new(3).white(40),
    );
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 3.0),
        unknown("E2", [2.0, 10.0], 3.0),
    ];
    for scatter in [Scatter::None, Scatter::BetweenCurves] {
        let twice: Vec<f64> = forces.iter().chain(&forces).copied().collect();
        let curves = vec![curve.clone(), curve.clone()];
        let problem = Problem::new(curves, unknowns.clone(), &[], Noise::white(0.01))
            .unwrap()
            .with_scatter(scatter);
        let model = Toy::new(twice, coating_moduli);
        let fit = identify(&model, &problem, &FitOptions::default()).unwrap();
        assert_eq!(fit.estimates[1].value, 2.0, "{scatter:?}: {fit:?}");
        assert!(
            fit.warnings.contains(&FitWarning::AtBound(1)),
            "{scatter:?}: {fit:?}"
        );
        assert_eq!(fit.estimates[1].interval[0], None);
    }
}
