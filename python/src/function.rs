//! Shapes that are functions of Python, asked for whole arrays of points at once.
//!
//! They are called on the threads that solve, one at a time, each time with the interpreter attached: whoever waits for
//! those threads has detached from it. A shape cannot fail, so an exception unwinds the work as a panic would, and is
//! raised where the work is waited for.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::resume_unwind;

use numpy::{PyArray1, PyReadonlyArray1};
use pellicle_cli::solved::MapSources;
use pellicle_contact::{Indenter, Profile};
use pellicle_texture::{CustomRelief, ReliefShape};
use pyo3::prelude::*;

use crate::error::InternalError;

/// The functions of a case by their names: `indenter`; `profile` and `compliance` of a surface. Each takes two arrays
/// of as many numbers and gives one of as many, checked by the package.
pub type Functions = BTreeMap<String, Function>;

/// A function of arrays of x and y that gives an array of numbers.
#[derive(Debug, FromPyObject)]
#[pyo3(transparent)]
pub struct Function(Py<PyAny>);

impl Clone for Function {
    fn clone(&self) -> Self {
        Python::attach(|py| Self(self.0.clone_ref(py)))
    }
}

impl Function {
    fn call(&self, py: Python<'_>, points: &[[f64; 2]]) -> PyResult<Vec<f64>> {
        let axis = |axis: usize| PyArray1::from_iter(py, points.iter().map(|point| point[axis]));
        let found = self.0.bind(py).call1((axis(0), axis(1)))?;
        let values: PyReadonlyArray1<'_, f64> = found.extract()?;
        let values: Vec<f64> = values.as_array().iter().copied().collect();
        if values.len() == points.len() {
            return Ok(values);
        }
        Err(InternalError::new_err("a function's values are unchecked"))
    }

    /// Its values at some points.
    fn values(&self, points: &[[f64; 2]]) -> Vec<f64> {
        if points.is_empty() {
            return Vec::new();
        }
        // There is no interpreter any more where Python has ended before the work.
        let values = Python::try_attach(|py| self.call(py, points));
        let values = values.unwrap_or_else(|| Err(InternalError::new_err("Python has ended")));
        values.unwrap_or_else(|error| resume_unwind(Box::new(error)))
    }
}

/// The exception that has unwound some work; the panic itself if it is none.
pub fn exception(panic: Box<dyn Any + Send>) -> Result<PyErr, Box<dyn Any + Send>> {
    panic.downcast::<PyErr>().map(|error| *error)
}

/// An indenter that is a function.
#[derive(Debug)]
struct FunctionProfile(Function);

impl Profile for FunctionProfile {
    fn height(&self, x: f64, y: f64) -> f64 {
        self.0.values(&[[x, y]])[0]
    }

    fn heights(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.0.values(points)
    }
}

/// A relief that is a function; its compliance is another, or a number of the case.
#[derive(Debug)]
struct FunctionRelief {
    profile: Function,
    compliance: Option<Function>,
}

impl ReliefShape for FunctionRelief {
    fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.profile.values(points)
    }

    fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let values = |function: &Function| function.values(points);
        (self.compliance.as_ref()).map_or_else(|| vec![0.0; points.len()], values)
    }
}

/// The sources, and the shapes that these functions are.
pub fn with_functions(mut sources: MapSources, functions: &Functions) -> MapSources {
    let function = |name| functions.get(name).cloned();
    if let Some(function) = function("indenter") {
        sources = sources.with_indenter(Indenter::custom(FunctionProfile(function)));
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
