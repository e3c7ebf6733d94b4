//! A second valley of a profile, in which the others may reach a lower misfit than along the scan.

use super::{LikelihoodProfile, Scan, TRUSTED};
use crate::{
    IdentifyError,
    least_squares::farthest,
    metric::System,
    predictor::{Evaluation, Predictor},
};

/// A point found from elsewhere counts as lower than the end if its `z` is below this fraction of the target.
const LOWER: f64 = 0.95;
/// A scan continues if a linearisation predicts less than this fraction of `Δ` at the end.
const PREDICTED_LOWER: f64 = 0.75;
/// Only evaluations with at most this multiple of the end's `Δ` are linearised.
const NEARLY_AS_GOOD: f64 = 2.0;

impl LikelihoodProfile<'_, '_> {
    /// Continues the scan from the end of a side, if an evaluation from elsewhere predicts that the profile is lower
    /// there: the others may have two valleys, and a scan follows one. `None` if no evaluation does.
    pub fn beyond(
        &self,
        predictor: &mut Predictor,
        end: f64,
        sign: f64,
    ) -> Result<Option<Scan>, IdentifyError> {
        let Some(predicted) = self.predicted(predictor, end)? else {
            return Ok(None);
        };
        let Some(start) = predictor.evaluate(&predicted)? else {
            return Ok(None);
        };
        // The evaluation there may refute the prediction.
        let (_, system) = self.search().linear_minimum(&start, self.unknown, end)?;
        let lower = LOWER * self.target;
        if system.chi_squared - self.best.system.chi_squared >= lower * lower {
            return Ok(None);
        }
        match self.constrained(predictor, start, sign)? {
            Err(better) => Ok(Some(Scan::Better(better))),
            Ok(point) if point.z < lower => self.outward(predictor, point, None, sign).map(Some),
            Ok(_) => Ok(None),
        }
    }

    /// The point with the lowest predicted profile at `x`, from linearisations of fits nearly as good as the end.
    fn predicted(&self, predictor: &Predictor, x: f64) -> Result<Option<Vec<f64>>, IdentifyError> {
        let search = self.search();
        let end = self.target * self.target;
        let above = |system: &System| system.chi_squared - self.best.system.chi_squared;
        let mut least = PREDICTED_LOWER * end;
        let mut found = None;
        for known in predictor
            .evaluations()
            .filter(|known| self.is_beside(known))
        {
            if above(&self.metric.system(known)) > NEARLY_AS_GOOD * end {
                continue;
            }
            let (position, system) = search.linear_minimum(known, self.unknown, x)?;
            if above(&system) < least && farthest(&position, &known.position) <= TRUSTED {
                (least, found) = (above(&system), Some(position));
            }
        }
        Ok(found)
    }

    /// Whether the same unknowns are held at the same values.
    fn is_beside(&self, known: &Evaluation) -> bool {
        let best = &self.best.at.position;
        let is_held = |j: &usize| *j != self.unknown && !self.others.contains(j);
        let mut held = (0..best.len()).filter(is_held);
        held.all(|j| known.position[j].to_bits() == best[j].to_bits())
    }
}
