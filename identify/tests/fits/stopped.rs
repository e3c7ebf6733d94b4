//! Fits ended by their model: results found by then are kept, and nothing more is claimed.

use std::sync::atomic::{AtomicUsize, Ordering};

use pellicle_identify::{
    Fit, FitOptions, FitVerdict, ForwardError, ForwardModel, IdentifyError, LinearNuisance, Noise,
    Prediction, Problem, Stopped, identify,
};

use super::toys::{Normals, Toy, coating_moduli, logarithmic, noisy, unknown};

const TRUTH: [f64; 2] = [10.0, 1.5];

/// A model that stops after a given number of predictions.
struct Limited {
    toy: Toy,
    left: AtomicUsize,
}

impl ForwardModel for Limited {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let left = self.left.load(Ordering::Relaxed);
        self.left.store(
            left.checked_sub(1).ok_or(ForwardError::Stopped)?,
            Ordering::Relaxed,
        );
        self.toy.predict(parameters)
    }
}

/// Fits both moduli of a coating with at most `predictions` predictions.
fn fit_of(predictions: usize) -> Result<Fit, IdentifyError> {
    let forces = logarithmic(0.01, 100.0, 60);
    let toy = Toy::new(forces.clone(), coating_moduli);
    let noise = Normals::new(3).white(60);
    let curve = noisy(&forces, &toy.values(&TRUTH), 0.002, &noise);
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 2.5),
        unknown("E2", [0.2, 10.0], 0.5),
    ];
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::default()).unwrap();
    let left = AtomicUsize::new(predictions);
    identify(&Limited { toy, left }, &problem, &FitOptions::default())
}

fn whole() -> Fit {
    let whole = fit_of(usize::MAX).unwrap();
    assert_eq!((whole.verdict, &whole.stopped), (FitVerdict::Fitted, &None));
    whole
}

#[test]
fn without_a_prediction_there_is_no_fit() {
    let stopped = fit_of(0);
    assert!(
        matches!(stopped, Err(IdentifyError::Stopped { predictions: 1 })),
        "{stopped:?}"
    );
}

#[test]
fn a_stopped_search_leaves_its_best_values_without_intervals() {
    let whole = whole();
    let mut misfits = Vec::new();
    for predictions in 1..whole.work.search {
        let fit = fit_of(predictions).unwrap();
        assert_eq!(fit.stopped, Some(Stopped::Search), "{predictions}");
        assert_eq!(fit.verdict, FitVerdict::NotConverged);
        assert_eq!(fit.work.curves_solved, predictions);
        for estimate in &fit.estimates {
            assert_eq!((estimate.interval, estimate.wald), ([None, None], None));
            assert!(estimate.why.contains("stopped"), "{}", estimate.why);
        }
        misfits.push(fit.points.residual.iter().map(|r| r * r).sum::<f64>());
    }
    // A further prediction can only improve the fit; the estimated noise changes the misfit only by rounding.
    let falls = |pair: &[f64]| pair[1] <= pair[0] * (1.0 + 1e-9);
    assert!(misfits.windows(2).all(falls), "{misfits:?}");
    let spread = misfits[0] / misfits[misfits.len() - 1];
    assert!(spread > 100.0, "{misfits:?}");
}

#[test]
fn finished_profiles_are_kept_and_unfinished_ones_leave_the_covariance() {
    let whole = whole();
    let mut missing_first = 0;
    for predictions in whole.work.search..whole.work.curves_solved {
        let fit = fit_of(predictions).unwrap();
        let Some(Stopped::Profiles(missing)) = &fit.stopped else {
            panic!("{:?} after {predictions}", fit.stopped);
        };
        missing_first += usize::from(missing.contains(&0));
        assert_eq!(fit.verdict, FitVerdict::Fitted);
        assert!(missing.contains(&1), "the last unknown is the last scanned");
        for (j, (found, wanted)) in fit.estimates.iter().zip(&whole.estimates).enumerate() {
            assert_eq!((found.value, found.wald), (wanted.value, wanted.wald));
            if missing.contains(&j) {
                assert_eq!(found.interval, [None, None]);
                assert!(found.why.contains("stopped"), "{}", found.why);
            } else {
                assert_eq!(found, wanted);
            }
        }
    }
    // Both cases occur: two profiles missing, and one.
    let stops = whole.work.curves_solved - whole.work.search;
    assert!(
        0 < missing_first && missing_first < stops,
        "{missing_first} of {stops}"
    );
    assert_eq!(fit_of(whole.work.curves_solved).unwrap(), whole);
}
