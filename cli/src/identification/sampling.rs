//! Samples of the posterior, if the fit file requests them and the fit allows them.

use pellicle_identify::{
    Fit, FitVerdict, IdentifyError, PosteriorOptions, Surrogate, SurrogateOptions, Verdict,
    posterior,
};

use super::Identification;
use super::findings::WarningResult;

/// Fraction of the samples at the faces of the surrogate's box above which a warning is given.
const CUT_OFF: f64 = 0.01;

/// Samples of the posterior, with the warnings about them.
#[derive(Debug, Default)]
pub struct Sampling {
    /// The values of the unknowns and nuisances, in SI units, for each sample; may be empty.
    pub samples: Vec<Vec<f64>>,
    /// Warnings about the samples.
    pub warnings: Vec<WarningResult>,
}

impl Identification {
    /// Draws the samples that the fit file requests. There are none for a misfit, or if the data leave a direction of
    /// the unknowns undetermined.
    #[must_use]
    pub fn sample(&self, fit: &Fit) -> Sampling {
        let report = &self.file.report;
        if report.posterior == 0 {
            return Sampling::default();
        }
        if fit.stopped.is_some() {
            return Sampling::without("the fit was stopped");
        }
        let is_determined = |verdict: Verdict| verdict != Verdict::NotIdentifiable;
        let all_determined = fit
            .estimates
            .iter()
            .all(|estimate| is_determined(estimate.verdict));
        if fit.verdict != FitVerdict::Fitted || !all_determined {
            return Sampling::without(
                "there are none for a misfit or for unknowns that no data can determine",
            );
        }
        match self.drawn(fit) {
            Ok(sampling) => sampling,
            Err(error) => Sampling::without(&error.to_string()),
        }
    }

    fn drawn(&self, fit: &Fit) -> Result<Sampling, IdentifyError> {
        let report = &self.file.report;
        let options = SurrogateOptions {
            seed: report.seed,
            ..SurrogateOptions::default()
        };
        let surrogate = Surrogate::around(&self.model, &self.problem, fit, options)?;
        let options = PosteriorOptions {
            samples: report.posterior,
            seed: report.seed,
        };
        let found = posterior(&surrogate, &self.problem, fit, options)?;
        let mut warnings = Vec::new();
        let mut warn = |message: String| {
            warnings.push(WarningResult {
                code: "posterior".into(),
                message,
            });
        };
        if !found.convergence.is_converged() {
            let r_hat = found.convergence.r_hat;
            warn(format!(
                "the samples of the posterior have not converged, R-hat {r_hat:.3}: do not use them"
            ));
        }
        if found.cut_off > CUT_OFF {
            warn(format!(
                "{:.1} % of the samples of the posterior lie at the edge of the computed region: the tails are cut off",
                100.0 * found.cut_off
            ));
        }
        Ok(Sampling {
            samples: found.samples,
            warnings,
        })
    }
}

impl Sampling {
    fn without(reason: &str) -> Self {
        Self {
            samples: Vec::new(),
            warnings: vec![WarningResult {
                code: "posterior".into(),
                message: format!("no samples of the posterior: {reason}"),
            }],
        }
    }
}
