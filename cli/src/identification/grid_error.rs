//! Fits whose noise is smaller than the error of the grid: their intervals include that error.
//!
//! A curve without noise, from finite elements or a digitised figure, is followed more closely than a grid can predict.
//! Every point would be left out. Instead all stay in the fit, and each interval is widened on both sides by the change
//! of the unknown that the estimated error of all predictions would make.

use pellicle::display::significant;
use pellicle_identify::{Fit, FitVerdict, exponents};

use super::Identification;

/// If no more than this fraction of the residuals is larger than the grid's error, no test of them is one of the model.
const LARGER: f64 = 0.05;

impl Identification {
    /// Widens the intervals of a fit by the error of the grid. A misfit whose residuals are smaller than that error is
    /// none.
    ///
    /// # Errors
    ///
    /// The reason in words, if the contact cannot be solved on the finer grid; the fit is then unchanged.
    pub(super) fn include_grid_error(&self, fit: &mut Fit) -> Result<(), String> {
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        let at_fit = self.prediction_of(fit).map_err(in_words)?;
        let errors = self.model.grid_errors(&values, &at_fit).map_err(in_words)?;
        let residuals = fit.points.residual.iter().zip(&errors);
        let larger = residuals.filter(|(r, e)| r.abs() > e.abs()).count();
        let is_below = (larger as f64) <= LARGER * errors.len() as f64;
        let moved = exponents(&self.problem, fit, at_fit, &[errors]).map_err(in_words)?;
        for (estimate, exponent) in fit.estimates.iter_mut().zip(moved.iter().flatten()) {
            let Some(exponent) = exponent else { continue };
            let half = (estimate.value * exponent).abs();
            let [low, high] = estimate.interval;
            estimate.interval = [low.map(|low| low - half), high.map(|high| high + half)];
            estimate.wald = estimate.wald.map(|[low, high]| [low - half, high + half]);
            let percent = significant(100.0 * exponent.abs(), 2);
            estimate.why = format!(
                "The error of the grid is {percent} %, larger than that of the noise; the interval includes it."
            );
        }
        if fit.verdict == FitVerdict::Misfit && is_below && fit.outliers.is_empty() {
            fit.verdict = FitVerdict::Fitted;
            fit.goodness.misfit_p = 1.0;
        }
        if is_below {
            fit.departure = None;
        }
        Ok(())
    }
}

fn in_words(error: impl std::error::Error) -> String {
    error.to_string()
}
