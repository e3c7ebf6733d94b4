//! Shapes given by Python functions, evaluated at whole arrays of points at once.
//!
//! They are called on the solving threads, one at a time, with the interpreter attached each time: a thread that waits
//! for the solving threads has detached from it. A shape cannot return an error, so an exception unwinds the work like
//! a panic and is raised where the work is awaited.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::panic::resume_unwind;
use std::sync::{Mutex, MutexGuard, PoisonError};

use numpy::{PyArray1, PyReadonlyArray1};
use pellicle::case::map_sources::MapSources;
use pellicle_contact::{Indenter, Profile};
use pellicle_texture::{CustomRelief, ReliefShape, mean_points};
use pyo3::prelude::*;

use crate::error::InternalError;

/// Ratio of the radii of neighbouring circles over which an indenter is averaged.
const RATIO: f64 = 1.1;
/// Points on such a circle, some of which may lie beyond the indenter's end.
const ANGLES: u32 = 360;

/// The functions of a case by their names: `indenter`; `profile` and `compliance` of a surface. Each takes two arrays
/// of equal length and returns one of that length, checked by the package.
pub type Functions = BTreeMap<String, Function>;

/// The purpose of values, which determines how strictly they are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Purpose {
    /// The problem itself: every value must be valid.
    Problem,
    /// A guess, which may evaluate distant points.
    Estimate,
}

/// A function of arrays of x and y, and of whether they are for an estimate, that returns an array of numbers.
#[derive(Debug, FromPyObject)]
#[pyo3(transparent)]
pub struct Function(Py<PyAny>);

impl Clone for Function {
    fn clone(&self) -> Self {
        Python::attach(|py| Self(self.0.clone_ref(py)))
    }
}

impl Function {
    fn call(&self, py: Python<'_>, points: &[[f64; 2]], purpose: Purpose) -> PyResult<Vec<f64>> {
        let axis = |axis: usize| PyArray1::from_iter(py, points.iter().map(|point| point[axis]));
        let is_estimate = purpose == Purpose::Estimate;
        let found = self.0.bind(py).call1((axis(0), axis(1), is_estimate))?;
        let values: PyReadonlyArray1<'_, f64> = found.extract()?;
        let values: Vec<f64> = values.as_array().iter().copied().collect();
        if values.len() == points.len() {
            return Ok(values);
        }
        Err(InternalError::new_err("a function's values are unchecked"))
    }

    /// Its values at the given points.
    fn values(&self, points: &[[f64; 2]], purpose: Purpose) -> Vec<f64> {
        if points.is_empty() {
            return Vec::new();
        }
        // There is no interpreter if Python has ended before the work.
        let values = Python::try_attach(|py| self.call(py, points, purpose));
        let values = values.unwrap_or_else(|| Err(InternalError::new_err("Python has ended")));
        values.unwrap_or_else(|error| resume_unwind(Box::new(error)))
    }
}

/// An indenter given by a function.
#[derive(Debug)]
struct FunctionProfile {
    function: Function,
    /// Means over circles of radius `RATIOᵏ`, by k. No lock is held while the function is called.
    means: Mutex<BTreeMap<i32, f64>>,
}

impl FunctionProfile {
    fn new(function: Function) -> Self {
        let means = Mutex::default();
        Self { function, means }
    }

    fn means(&self) -> MutexGuard<'_, BTreeMap<i32, f64>> {
        self.means.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The mean of the finite values on the circle of radius `RATIOᵏ`; infinite if there are none.
    fn mean(&self, k: i32) -> f64 {
        if let Some(known) = self.means().get(&k) {
            return *known;
        }
        let radius = RATIO.powi(k);
        let point = |step: u32| {
            let (sine, cosine) = ((f64::from(step) + 0.5) * TAU / f64::from(ANGLES)).sin_cos();
            [radius * cosine, radius * sine]
        };
        let points: Vec<_> = (0..ANGLES).map(point).collect();
        let mut heights = self.function.values(&points, Purpose::Estimate);
        heights.retain(|height| height.is_finite());
        let mean = if heights.is_empty() {
            f64::INFINITY
        } else {
            heights.iter().sum::<f64>() / heights.len() as f64
        };
        self.means().insert(k, mean);
        mean
    }
}

impl Profile for FunctionProfile {
    fn height(&self, x: f64, y: f64) -> f64 {
        self.heights(&[[x, y]])[0]
    }

    fn heights(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.function.values(points, Purpose::Problem)
    }

    /// Interpolates between cached radii, because the first guess of a domain needs about a thousand values per load.
    fn mean_profile(&self, radius: f64) -> f64 {
        if radius == 0.0 {
            return self.function.values(&[[0.0; 2]], Purpose::Estimate)[0];
        }
        let place = (radius.ln() / RATIO.ln()).floor();
        if !place.is_finite() {
            return f64::INFINITY;
        }
        #[expect(clippy::cast_possible_truncation, reason = "a logarithm is small")]
        let k = place as i32;
        let (low, high) = (self.mean(k), self.mean(k + 1));
        let ratio = radius / RATIO.powi(k);
        if low.is_infinite() || high.is_infinite() {
            f64::INFINITY
        } else if low > 0.0 && high > 0.0 {
            // f ∝ ρⁿ
            low * ratio.powf((high / low).ln() / RATIO.ln())
        } else {
            low + (high - low) * (ratio - 1.0) / (RATIO - 1.0)
        }
    }
}

/// A relief given by a function; its compliance is another function, or a number of the case.
#[derive(Debug)]
struct FunctionRelief {
    profile: Function,
    compliance: Option<Function>,
}

impl ReliefShape for FunctionRelief {
    fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.profile.values(points, Purpose::Problem)
    }

    fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let values = |function: &Function| function.values(points, Purpose::Problem);
        (self.compliance.as_ref()).map_or_else(|| vec![0.0; points.len()], values)
    }

    /// The mean of the valid values, since the radius may be far beyond any element.
    fn mean_compliance(&self, radius: f64) -> f64 {
        let Some(function) = &self.compliance else {
            return 0.0;
        };
        let mut values = function.values(&mean_points(radius), Purpose::Estimate);
        values.retain(|value| *value >= 0.0 && value.is_finite());
        values.iter().sum::<f64>() / values.len().max(1) as f64
    }
}

/// Adds the shapes given by these functions to the sources.
pub fn with_functions(mut sources: MapSources, functions: &Functions) -> MapSources {
    let function = |name| functions.get(name).cloned();
    if let Some(function) = function("indenter") {
        sources = sources.with_indenter(Indenter::custom(FunctionProfile::new(function)));
    }
    if let Some(profile) = function("profile") {
        let compliance = function("compliance");
        sources = sources.with_relief(CustomRelief::new(FunctionRelief {
            profile,
            compliance,
        }));
    }
    sources
}
