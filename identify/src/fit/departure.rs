//! A smooth part of the residuals that an estimated correlation of the noise has absorbed.
//!
//! If the curve departs smoothly from the model, the noise of highest likelihood is one whose correlation is long
//! enough to leave as much. The noise is therefore estimated once more with smooth departures among the fitted columns;
//! what remains of its correlation is that of the noise alone, and the departures are tested against it. A single curve
//! cannot tell whether its noise wanders or its model is wrong: this is a warning, not a misfit.

use super::Fitting;
use crate::{
    Correlation, Departure, FitVerdict, FittedPoints, REFUSAL,
    departure::{HIGHEST_DEGREE, largest_deviation, range, smooth_columns},
    goodness::{NoiseScale, score},
    metric::Metric,
    noise::restricted_likelihood::{Part, RestrictedLikelihood},
    refinement::Refined,
};

/// A departure is told below this probability, the level of a refusal over the number of its tests. Of 200 curves of
/// 240 points each whose noise had correlations of 0.4 and 0.7 from point to point, none to three were told of.
const TOLD: f64 = REFUSAL / 6.0;

impl Fitting<'_> {
    /// The smooth part of the residuals of a fit, if only long correlation explains it.
    pub(super) fn departure(
        &self,
        refined: &Refined,
        verdict: FitVerdict,
        points: &FittedPoints,
    ) -> Option<Departure> {
        let is_estimated = self.problem.noise().correlation == Correlation::Estimated;
        if verdict != FitVerdict::Fitted || !is_estimated {
            return None;
        }
        let probability = self.departure_p(refined)?;
        if probability >= TOLD {
            return None;
        }
        let (curves, spans) = (self.problem.curves(), self.problem.spans());
        let curves: Vec<_> = (curves.iter().zip(spans))
            .map(|(curve, span)| (curve.abscissa(), &points.residual[span.clone()]))
            .collect();
        let (range, largest) = largest_deviation(&curves)?;
        Some(Departure {
            curves: curves.len(),
            range,
            largest,
            probability,
        })
    }

    /// The probability of as large a smooth departure under noise estimated beside it.
    fn departure_p(&self, refined: &Refined) -> Option<f64> {
        let at = &*refined.minimum.at;
        let abscissa = self.problem.abscissa();
        let range = range(abscissa.iter().copied());
        let columns = smooth_columns(&abscissa, &at.value, range, HIGHEST_DEGREE);
        let part = Part {
            problem: self.problem,
            at,
            free: &self.determined,
            departures: &columns,
        };
        let likelihood =
            |levels| RestrictedLikelihood::new(vec![part.clone()], *self.problem.noise(), levels);
        let levels = likelihood(refined.levels).estimate();
        let degrees = likelihood(levels).degrees_of_freedom().ok()?;
        let least = degrees.into_iter().fold(f64::INFINITY, f64::min);
        let metric = Metric::at(self.problem, &levels, at);
        let found = score(&metric, at, &self.determined, columns.into_iter());
        NoiseScale::OfCorrelated(least).probability(found)
    }
}
