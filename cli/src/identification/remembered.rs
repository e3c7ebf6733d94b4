//! A model that remembers its predictions, reports each, and stops on request.

use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use pellicle_identify::{ContactCurves, ForwardError, ForwardModel, Prediction, StopFlag};

use crate::interrupt;

/// A model that remembers its predictions: a fit that repeats the search of another from the same start computes only
/// the new ones.
pub struct Remembered<'a> {
    model: &'a ContactCurves,
    memory: Mutex<Vec<Known>>,
    stop: &'a StopFlag,
    report: &'a (dyn Fn() + Sync),
}

/// A remembered prediction: of one curve, by its first point, or of all.
struct Known {
    first: Option<usize>,
    parameters: Vec<f64>,
    prediction: Prediction,
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
        self.known_from(None, parameters, &[])
    }

    fn known_from(
        &self,
        first: Option<usize>,
        parameters: &[f64],
        origins: &[f64],
    ) -> Option<Prediction> {
        let memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same =
            |known: &&Known| known.is_of(first, parameters) && known.prediction.origins == origins;
        let known = memory.iter().find(is_same);
        known.map(|known| known.prediction.clone())
    }

    /// The prediction of all curves, or of one, from the memory or by the model.
    fn predicted(
        &self,
        first: Option<usize>,
        parameters: &[f64],
        origins: &[f64],
        predict: impl FnOnce() -> Result<Prediction, ForwardError>,
    ) -> Result<Prediction, ForwardError> {
        if let Some(known) = self.known_from(first, parameters, origins) {
            return Ok(known);
        }
        if self.stop.is_raised() {
            return Err(ForwardError::Stopped);
        }
        let prediction = predict();
        let is_last = |memory: &[Known]| {
            memory
                .last()
                .is_some_and(|known| known.is_of(first, parameters))
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
        memory.push(Known {
            first,
            parameters: parameters.to_vec(),
            prediction: prediction.clone(),
        });
        Ok(prediction)
    }
}

impl Known {
    fn is_of(&self, first: Option<usize>, parameters: &[f64]) -> bool {
        self.first == first && self.parameters == parameters
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
        self.predicted(None, parameters, origins, || {
            self.model.predict_from(parameters, origins)
        })
    }

    fn predict_curve(
        &self,
        points: Range<usize>,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        let own = origins.get(points.clone()).unwrap_or_default();
        self.predicted(Some(points.start), parameters, own, || {
            (self.model).predict_curve(points, parameters, origins)
        })
    }
}
