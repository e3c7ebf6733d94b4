//! The unfinished result of a stopped fit: the best so far, without the missing intervals.

use std::rc::Rc;

use super::{
    Fitting,
    intervals::{Reach, Sought},
};
use crate::{
    Estimate, Fit, FitVerdict, IdentifyError, Stopped, Verdict,
    predictor::{Evaluation, Predictor},
};

impl Fitting<'_> {
    /// The fit as far as it got: the best prediction, with the noise estimated from its residuals.
    pub(super) fn unfinished(
        self,
        predictor: &Predictor,
        best: Rc<Evaluation>,
    ) -> Result<Fit, IdentifyError> {
        let refined = self
            .refinement()
            .unfinished(best, self.problem.first_levels())?;
        let sought = self.sought(&refined)?;
        let intervals = sought.iter().map(|_| Sought::no_interval(Reach::Nowhere));
        let intervals = intervals.collect();
        let search = predictor.predictions();
        Ok(Fit {
            verdict: FitVerdict::NotConverged,
            stopped: Some(Stopped::Search),
            ..self.finish(predictor, &refined, &sought, intervals, search)
        })
    }
}

impl Estimate {
    /// Removes the profile's interval: the unknown is judged by the covariance alone.
    pub(super) fn leave_to_covariance(&mut self) {
        self.interval = [None, None];
        self.why
            .push_str(" This is by the covariance alone: the fit was stopped before its profile.");
    }

    /// Removes all intervals, since the values are not those of the best fit.
    pub(super) fn leave_without_interval(&mut self) {
        (self.interval, self.wald) = ([None, None], None);
        if self.verdict != Verdict::NotIdentifiable {
            self.verdict = Verdict::NotIdentified;
            "The fit was stopped before the best one was found: this is the best value so far."
                .clone_into(&mut self.why);
        }
    }
}
