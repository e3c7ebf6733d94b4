//! A model that remembers its predictions, reports each, and stops on request.

use std::sync::{Mutex, PoisonError};

use pellicle_identify::{ContactCurves, ForwardError, ForwardModel, Prediction, StopFlag};

use crate::interrupt;

/// A model that remembers its predictions: a fit that repeats the search of another from the same start computes only
/// the new ones.
pub struct Remembered<'a> {
    model: &'a ContactCurves,
    memory: Mutex<Vec<(Vec<f64>, Prediction)>>,
    stop: &'a StopFlag,
    report: &'a (dyn Fn() + Sync),
}

impl<'a> Remembered<'a> {
    /// Creates a model without remembered predictions that calls `report` after each prediction.
    pub fn new(
        model: &'a ContactCurves,
        stop: &'a StopFlag,
        report: &'a (dyn Fn() + Sync),
    ) -> Self {
        Self {
            model,
            memory: Mutex::default(),
            stop,
            report,
        }
    }

    /// The prediction for these parameters from zero, if it is remembered.
    #[must_use]
    pub fn known(&self, parameters: &[f64]) -> Option<Prediction> {
        self.known_from(parameters, &[])
    }

    fn known_from(&self, parameters: &[f64], origins: &[f64]) -> Option<Prediction> {
        let memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same = |(known, prediction): &&(Vec<f64>, Prediction)| {
            known == parameters && prediction.origins == origins
        };
        let known = memory.iter().find(is_same);
        known.map(|(_, prediction)| prediction.clone())
    }
}

impl ForwardModel for Remembered<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        self.predict_from(parameters, &[])
    }

    fn predict_from(
        &self,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        if let Some(known) = self.known_from(parameters, origins) {
            return Ok(known);
        }
        if self.stop.is_raised() {
            return Err(ForwardError::Stopped);
        }
        let prediction = self.model.predict_from(parameters, origins);
        let is_last = |memory: &[(Vec<f64>, Prediction)]| {
            memory.last().is_some_and(|(known, _)| known == parameters)
        };
        // From another origin the same curves are only read elsewhere.
        if !is_last(&self.memory.lock().unwrap_or_else(PoisonError::into_inner)) {
            (self.report)();
        }
        let prediction = prediction?;
        let mut memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        if memory.is_empty() {
            // From here on there is a result to write if the user stops.
            interrupt::hold();
        }
        memory.push((parameters.to_vec(), prediction.clone()));
        Ok(prediction)
    }
}
