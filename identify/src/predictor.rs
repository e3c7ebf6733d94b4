//! The forward model, evaluated once for each set of parameters, with a count of the predictions.

use std::{ops::Range, rc::Rc};

use crate::{
    ForwardError, ForwardModel, IdentifyError, Prediction, Problem, Unknown, abscissa_zero,
    held_zeros, least_squares::Stopping,
};

/// The model evaluated at one point of the coordinates `x` of the unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Evaluation {
    /// Coordinates of the unknowns.
    pub position: Vec<f64>,
    /// The unknowns themselves.
    pub parameters: Vec<f64>,
    /// Observable at each point.
    pub value: Vec<f64>,
    /// `∂y/∂Q` at each point.
    pub slope: Vec<f64>,
    /// `∂y/∂x_j` at each point, one list per unknown.
    pub jacobian: Vec<Vec<f64>>,
    /// The origin of the abscissa of each point; empty where all are zero.
    pub origins: Vec<f64>,
}

impl Evaluation {
    /// A prediction, with its derivatives converted to the coordinates.
    pub fn of(unknowns: &[Unknown], parameters: &[f64], prediction: Prediction) -> Self {
        let mut jacobian = prediction.derivatives;
        for ((column, unknown), &value) in jacobian.iter_mut().zip(unknowns).zip(parameters) {
            let slope = unknown.value_slope(value);
            column.iter_mut().for_each(|d| *d *= slope);
        }
        let pairs = unknowns.iter().zip(parameters);
        Self {
            position: pairs
                .map(|(unknown, &value)| unknown.position(value))
                .collect(),
            parameters: parameters.to_vec(),
            value: prediction.value,
            slope: prediction.slope,
            jacobian,
            origins: prediction.origins,
        }
    }

    /// The evaluations of all curves, each at a point of its own, as one at this point.
    pub fn joined(unknowns: &[Unknown], position: Vec<f64>, curves: &[Self]) -> Self {
        let all = |part: &dyn Fn(&Self) -> &Vec<f64>| -> Vec<f64> {
            curves.iter().flat_map(part).copied().collect()
        };
        let pairs = unknowns.iter().zip(&position);
        Self {
            parameters: pairs.map(|(unknown, &x)| unknown.value(x)).collect(),
            value: all(&|at| &at.value),
            slope: all(&|at| &at.slope),
            jacobian: (0..unknowns.len())
                .map(|j| all(&|at| &at.jacobian[j]))
                .collect(),
            origins: all(&|at| &at.origins),
            position,
        }
    }

    /// The evaluation at some of the points.
    pub fn part(&self, points: &Range<usize>) -> Self {
        let part = |values: &Vec<f64>| values[points.clone()].to_vec();
        Self {
            position: self.position.clone(),
            parameters: self.parameters.clone(),
            value: part(&self.value),
            slope: part(&self.slope),
            jacobian: self.jacobian.iter().map(part).collect(),
            origins: self
                .origins
                .get(points.clone())
                .unwrap_or_default()
                .to_vec(),
        }
    }
}

/// One curve of a problem at a point.
pub(crate) struct OneCurve<'a> {
    /// Its points among those of all curves.
    pub points: Range<usize>,
    /// Its own problem.
    pub problem: &'a Problem,
    pub position: Vec<f64>,
}

/// A model of which only one curve is predicted.
struct OfOneCurve<'a> {
    model: &'a dyn ForwardModel,
    points: Range<usize>,
    /// The origins of all points, those of the others as they are.
    origins: &'a [f64],
}

impl ForwardModel for OfOneCurve<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        (self.model).predict_curve(self.points.clone(), parameters, &[])
    }

    fn predict_from(
        &self,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        let mut all = self.origins.to_vec();
        all[self.points.clone()].copy_from_slice(origins);
        (self.model).predict_curve(self.points.clone(), parameters, &all)
    }
}

impl OneCurve<'_> {
    fn evaluate(
        &self,
        model: &dyn ForwardModel,
        last: &Evaluation,
    ) -> Result<Option<Evaluation>, ForwardError> {
        let unknowns = self.problem.unknowns();
        let pairs = unknowns.iter().zip(&self.position);
        let parameters: Vec<f64> = pairs.map(|(unknown, &x)| unknown.value(x)).collect();
        let of_curve = OfOneCurve {
            model,
            points: self.points.clone(),
            origins: &last.origins,
        };
        let own = last.origins.get(self.points.clone());
        let prediction = abscissa_zero::prediction(&of_curve, self.problem, &parameters, own)?;
        Ok(prediction
            .is_complete(self.points.len(), unknowns.len())
            .then(|| Evaluation {
                position: self.position.clone(),
                ..Evaluation::of(unknowns, &parameters, prediction)
            }))
    }
}

/// A forward model with a memory, because predictions are expensive and memory is not.
pub(crate) struct Predictor<'a> {
    model: &'a dyn ForwardModel,
    problem: &'a Problem,
    memory: Vec<(Vec<f64>, Option<Rc<Evaluation>>)>,
    /// Predictions of single curves, and with zeros held.
    apart: usize,
    last_failure: Option<ForwardError>,
}

impl<'a> Predictor<'a> {
    pub fn new(model: &'a dyn ForwardModel, problem: &'a Problem) -> Self {
        Self {
            model,
            problem,
            memory: Vec::new(),
            apart: 0,
            last_failure: None,
        }
    }

    /// Evaluates the model at a point; `None` where it has no prediction.
    pub fn evaluate(&mut self, position: &[f64]) -> Result<Option<Rc<Evaluation>>, IdentifyError> {
        if let Some((_, known)) = self.memory.iter().find(|(at, _)| at == position) {
            return Ok(known.clone());
        }
        let evaluation = self.predict(position)?.map(Rc::new);
        self.memory.push((position.to_vec(), evaluation.clone()));
        Ok(evaluation)
    }

    /// The coordinates at which a search with the zeros held where the curves show them ends: see [`held_zeros`].
    pub fn with_zeros_held(
        &mut self,
        start: Vec<f64>,
        stopping: Stopping,
    ) -> Result<Vec<f64>, IdentifyError> {
        let (end, predictions) = held_zeros::search(self.model, self.problem, start, stopping)?;
        self.apart += predictions;
        Ok(end)
    }

    /// Number of evaluations of the model.
    pub fn predictions(&self) -> usize {
        self.memory.len() + self.apart
    }

    /// Evaluates curves, each alone and at a point of its own: `None` for one that has no prediction there. The origins
    /// of their abscissae are sought from those of `last`. Each counts as a prediction.
    pub fn evaluate_apart(
        &mut self,
        curves: &[OneCurve<'_>],
        last: &Evaluation,
    ) -> Result<Vec<Option<Evaluation>>, IdentifyError> {
        // Not in parallel: curves of one table share the memory of their last solution.
        let each = curves.iter().map(|of| {
            self.apart += 1;
            match of.evaluate(self.model, last) {
                Ok(at) => Ok(at),
                Err(ForwardError::Stopped) => Err(IdentifyError::Stopped {
                    predictions: self.predictions(),
                }),
                Err(_) => Ok(None),
            }
        });
        each.collect()
    }

    /// All predictions so far.
    pub fn evaluations(&self) -> impl Iterator<Item = &Rc<Evaluation>> {
        self.memory.iter().filter_map(|(_, known)| known.as_ref())
    }

    /// Takes the model's latest error.
    pub fn take_last_failure(&mut self) -> Option<ForwardError> {
        self.last_failure.take()
    }

    fn predict(&mut self, position: &[f64]) -> Result<Option<Evaluation>, IdentifyError> {
        let unknowns = self.problem.unknowns();
        let parameters: Vec<f64> = unknowns
            .iter()
            .zip(position)
            .map(|(unknown, &x)| unknown.value(x))
            .collect();
        let last = self.evaluations().last().map(|at| &at.origins[..]);
        let prediction = abscissa_zero::prediction(self.model, self.problem, &parameters, last);
        let prediction = match prediction {
            Ok(prediction) => prediction,
            Err(ForwardError::Stopped) => {
                return Err(IdentifyError::Stopped {
                    predictions: self.predictions() + 1,
                });
            }
            Err(failure) => {
                self.last_failure = Some(failure);
                return Ok(None);
            }
        };
        if !prediction.is_complete(self.problem.points(), unknowns.len()) {
            return Ok(None);
        }
        Ok(Some(Evaluation {
            position: position.to_vec(),
            ..Evaluation::of(unknowns, &parameters, prediction)
        }))
    }
}
