//! The likely cause of a misfit: what else, added to the model, would explain the residuals.

use pellicle::display::significant;
use pellicle_identify::fit_file::nuisance::FORCE_ZERO;
use pellicle_identify::measured::baseline::BeforeContactRows;
use pellicle_identify::{Amount, Fit, FitVerdict, FitWarning, Observable, Prediction, explained};

use super::findings::WarningResult;
use super::{Identification, observe, units};

/// A cause is named if it explains more than this part of the misfit.
const MOST_OF_IT: f64 = 0.5;

/// The noise is that of the force if it makes the residuals so much more likely, as a difference of logarithms: a
/// factor of 150.
const CLEARLY: f64 = 5.0;

/// Noise of a fit above this many times that before the contact is told. Of 100 random approaches that follow the model
/// none had more; with a repulsion of a tenth of the largest force 13 of 26 had, with three tenths 20 of 27.
const FAR_ABOVE: f64 = 1.4;

/// A possible cause: the change of the observable that it makes, and what to do.
struct Cause {
    change: Vec<f64>,
    advice: &'static str,
}

impl Identification {
    /// A pull-off, and the likely cause of a misfit: of the zeros and the baseline the one that explains most of it, or
    /// noise of the force that is taken for one of the depth, or a bound that holds the best fit; without a cause,
    /// noise in contact far above that before it.
    #[must_use]
    pub fn causes(&self, fit: &Fit) -> Vec<WarningResult> {
        let warning = |code: &str, message: String| WarningResult {
            code: code.into(),
            message,
        };
        let adhesion = self.adhesion().map(|found| warning("adhesion", found));
        let is_misfit = fit.verdict == FitVerdict::Misfit && fit.stopped.is_none();
        let cause = is_misfit.then(|| self.cause(fit)).flatten();
        let second = match cause {
            Some(cause) => Some(warning("likely-cause", cause)),
            None => {
                (self.scatter_in_contact(fit)).map(|found| warning("scatter-in-contact", found))
            }
        };
        adhesion.into_iter().chain(second).collect()
    }

    /// The likely cause of a misfit.
    fn cause(&self, fit: &Fit) -> Option<String> {
        let is_at_bound = |of: &FitWarning| matches!(of, FitWarning::AtBound(_));
        let unit = (fit.warnings.iter().any(is_at_bound)).then(|| {
            "a unit may be wrong: the best fit lies at a bound, where no value follows the curve".into()
        });
        self.of_readings(fit)
            .or_else(|| self.of_noise(fit))
            .or(unit)
    }

    /// The pull-off of a curve.
    fn adhesion(&self) -> Option<String> {
        let mut curves = self.model.curves().iter();
        if curves.any(|curve| curve.adhesion.is_some()) {
            return None;
        }
        self.sources.iter().find_map(|source| {
            let forces = source.measured.force()?.iter().copied();
            let largest = forces.fold(0.0, f64::max);
            let pull_off = source.measured.before_contact?.adhesion(largest)?;
            let scale = units::scale(pull_off, "N");
            Some(format!(
                "adhesion: the force of {} falls {} {} below its baseline, which this model does not follow; \
                 segment.from at some three times that force lessens its effect, and load.work_of_adhesion in [model] \
                 is one that follows it",
                source.measured.file.display(),
                significant(pull_off / scale.divisor, 2),
                scale.label,
            ))
        })
    }

    /// Residuals far above the noise before the contact: what a correlation takes for noise may be a model that does
    /// not follow the curves.
    fn scatter_in_contact(&self, fit: &Fit) -> Option<String> {
        let is_estimated = self.problem.noise().observed == Amount::Estimated;
        if !is_estimated || observe(&self.file) != Observable::ForceAtDepth {
            return None;
        }
        let each = self.sources.iter().map(|of| of.measured.before_contact);
        let squares: Vec<_> = each.flatten().map(|of| of.line.noise.powi(2)).collect();
        let before = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        let ratio = fit.noise.observed / before;
        (ratio.is_finite() && ratio > FAR_ABOVE).then(|| {
            format!(
                "the forces scatter about the model by {} times their noise before the contact: the model may not \
                 follow them, as with repulsion, drift or saturation, and the interval be too narrow",
                significant(ratio, 2)
            )
        })
    }

    /// Of the zeros and the baseline, the one that would explain most of the misfit.
    fn of_readings(&self, fit: &Fit) -> Option<String> {
        let at_fit = self.prediction_of(fit).ok()?;
        let causes = self.candidates(fit, &at_fit);
        let changes: Vec<Vec<f64>> = causes.iter().map(|cause| cause.change.clone()).collect();
        let parts = explained(&self.problem, fit, at_fit, &changes).ok()?;
        let pairs = causes.into_iter().zip(parts);
        let (cause, part) = pairs.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
        (part > MOST_OF_IT).then(|| {
            let percent = significant(100.0 * part, 2);
            format!(
                "{}: this would explain {percent} % of the misfit",
                cause.advice
            )
        })
    }

    /// The noise of the force, where it describes residuals that are taken for noise of the depth, unless the curves
    /// depart from the model together.
    fn of_noise(&self, fit: &Fit) -> Option<String> {
        let is_estimated = self.problem.noise().observed == Amount::Estimated;
        let is_of_depth = is_estimated && observe(&self.file) == Observable::DepthAtForce;
        if !is_of_depth || fit.departure.is_some() {
            return None;
        }
        let slope = self.prediction_of(fit).ok()?.slope;
        let points = || fit.points.residual.iter().zip(&slope);
        let count = slope.len() as f64;
        let rms = |squares: f64| (squares / count).sqrt();
        let of_depth = rms(points().map(|(r, _)| r * r).sum());
        let of_force = rms(points().map(|(r, slope)| (r / slope).powi(2)).sum());
        // Each normal, the one with σ_D at every point, the other with σ_Q |∂D/∂Q|.
        let slopes: f64 = slope.iter().map(|slope| slope.abs().ln()).sum();
        let gain = count * (of_depth / of_force).ln() - slopes;
        (gain > CLEARLY).then(|| {
            let scale = units::scale(of_force, "N");
            format!(
                "the noise is that of the force, larger in depth where the curve is steep: \
                 noise = {{ force = \"{} {}\" }} in [[data]] says so",
                significant(of_force / scale.divisor, 2),
                scale.label
            )
        })
    }

    fn candidates(&self, fit: &Fit, at_fit: &Prediction) -> Vec<Cause> {
        let zeros = self.exact_zeros(fit, &at_fit.slope).into_iter();
        let mut causes: Vec<Cause> = zeros
            .map(|zero| Cause {
                change: zero.change,
                advice: if zero.name == FORCE_ZERO {
                    "the zero of the force is off: nuisance.force_zero = { per = \"curve\" } seeks it"
                } else {
                    "the zero of the depth is off: nuisance.depth_zero = { per = \"curve\" } seeks it"
                },
            })
            .collect();
        let mut stretches = self.sources.iter().map(|of| of.measured.before_contact);
        let has_slope = |of: Option<BeforeContactRows>| of.is_some_and(|of| !of.is_subtracted);
        if !stretches.any(has_slope) {
            return causes;
        }
        // A baseline that rises with the depth adds s D to the force.
        let change = match observe(&self.file) {
            Observable::ForceAtDepth => self
                .problem
                .curves()
                .iter()
                .flat_map(|of| of.abscissa().to_vec())
                .collect(),
            Observable::DepthAtForce => (at_fit.value.iter())
                .zip(&at_fit.slope)
                .map(|(depth, slope)| -depth * slope)
                .collect(),
            _ => return causes,
        };
        causes.push(Cause {
            change,
            advice: "the force has a slope of its own: baseline = \"before contact\" in [[data]] removes it",
        });
        causes
    }
}
