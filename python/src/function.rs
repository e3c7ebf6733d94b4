//! Shapes that are functions of Python, asked for whole arrays of points at once.
//!
//! They are called on the threads that solve, each time with the interpreter attached: whoever waits for those threads
//! must have detached from it. Shapes cannot fail, so what goes wrong first is kept for the end of the work: from then
//! on heights are NaN, which no solution survives.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pellicle_contact::{Indenter, Profile};
use pellicle_texture::{Relief, ReliefShape};
use pyo3::prelude::*;

/// What went wrong first in the functions of one piece of work.
#[derive(Debug, Clone, Default)]
pub struct Fault(Arc<Mutex<Option<PyErr>>>);

impl Fault {
    fn tell(&self, error: PyErr) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }

    /// Whether anything went wrong.
    pub fn is_there(&self) -> bool {
        let first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.is_some()
    }

    /// Raises what went wrong, once.
    pub fn raise(&self) -> PyResult<()> {
        let first = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        first.map_or(Ok(()), Err)
    }
}

/// A function of arrays of x and y that gives an array of numbers.
#[derive(Debug)]
struct Function {
    callable: Py<PyAny>,
    fault: Fault,
}

impl Function {
    fn call(&self, points: &[[f64; 2]]) -> PyResult<Vec<f64>> {
        Python::attach(|py| {
            let axis = |axis: usize| PyArray1::from_iter(py, points.iter().map(|point| point[axis]));
            let found = self.callable.bind(py).call1((axis(0), axis(1)))?;
            let values: PyReadonlyArray1<'_, f64> = found.extract()?;
            Ok(values.as_array().iter().copied().collect())
        })
    }

    /// Its values at some points; NaN once anything went wrong.
    fn values(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let nothing = || vec![f64::NAN; points.len()];
        if points.is_empty() || self.fault.is_there() {
            return nothing();
        }
        self.call(points).unwrap_or_else(|error| {
            self.fault.tell(error);
            nothing()
        })
    }
}

/// An indenter that is a function.
#[derive(Debug)]
struct FunctionProfile(Function);

impl Profile for FunctionProfile {
    fn height(&self, x: f64, y: f64) -> f64 {
        self.heights(&[[x, y]])[0]
    }

    fn heights(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.0.values(points)
    }
}

/// A relief that is two functions.
#[derive(Debug)]
struct FunctionRelief {
    profile: Function,
    compliance: Function,
}

impl ReliefShape for FunctionRelief {
    fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.profile.values(points)
    }

    fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.compliance.values(points)
    }
}

/// The functions of a case by their names: `indenter`; `profile` and `compliance` of a surface. Each takes two arrays
/// of as many numbers, and gives an array of as many numbers that are valid.
#[derive(Debug, Default)]
pub struct Functions(BTreeMap<String, Py<PyAny>>);

impl Functions {
    /// The functions of these names.
    pub fn new(functions: BTreeMap<String, Py<PyAny>>) -> Self {
        Self(functions)
    }

    /// Whether the case has none.
    pub fn are_none(&self) -> bool {
        self.0.is_empty()
    }

    fn function(&self, py: Python<'_>, name: &str, fault: &Fault) -> Option<Function> {
        Some(Function {
            callable: self.0.get(name)?.clone_ref(py),
            fault: fault.clone(),
        })
    }

    /// The indenter, which tells faults to this one.
    pub fn indenter(&self, py: Python<'_>, fault: &Fault) -> Option<Indenter> {
        let function = self.function(py, "indenter", fault)?;
        Some(Indenter::custom(FunctionProfile(function)))
    }

    /// The relief, which tells faults to this one.
    pub fn relief(&self, py: Python<'_>, fault: &Fault) -> Option<Relief> {
        Some(Relief::custom(FunctionRelief {
            profile: self.function(py, "profile", fault)?,
            compliance: self.function(py, "compliance", fault)?,
        }))
    }

    /// Whether these are equal to others, as Python has it.
    pub fn are_equal(&self, py: Python<'_>, others: &Self) -> PyResult<bool> {
        if !self.0.keys().eq(others.0.keys()) {
            return Ok(false);
        }
        for (mine, other) in self.0.values().zip(others.0.values()) {
            if !mine.bind(py).eq(other)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
