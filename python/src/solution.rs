//! A solved case: its numbers as JSON and columns, its fields as arrays.

use std::sync::{Arc, OnceLock};

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pellicle::Completeness;
use pellicle::Run as SolvedCase;
use pellicle::case::stress::StressCase;
use pellicle::input::span::Source;
use pellicle::summary::WarningSummary;
use pellicle_cli::Failure;
use pellicle_cli::solved::{self, StressFields};
use pellicle_contact::SampledModel;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::field::Field;
use crate::planes::Planes;
use crate::process::Threads;

/// N × N values.
type Array<'py> = Bound<'py, PyArray2<f64>>;

/// A solved case.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Solution {
    case: Arc<pellicle::Case>,
    solved: Arc<SolvedCase>,
    /// Relief and indenter on the grid. They are kept if given by functions, which are not called again; otherwise
    /// `None`.
    kept_geometry: Option<OnceLock<Arc<SampledModel>>>,
}

impl Solution {
    /// The solution of a case, whose shapes may be Python functions.
    pub fn new(case: Arc<pellicle::Case>, solved: SolvedCase, has_functions: bool) -> Self {
        Self {
            case,
            solved: Arc::new(solved),
            kept_geometry: has_functions.then(OnceLock::new),
        }
    }

    /// Relief and indenter on the grid. The caller must have detached from the interpreter, which functions need.
    fn sampled(&self) -> Arc<SampledModel> {
        let sample = || Arc::new(self.solved.path.geometry());
        match &self.kept_geometry {
            Some(kept) => Arc::clone(kept.get_or_init(sample)),
            None => sample(),
        }
    }

    /// A value for each element as an array, first index along x, without a copy.
    fn array<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        values: Vec<T>,
    ) -> PyResult<Bound<'py, PyArray2<T>>> {
        let lengths = self.solved.path.grid.lengths();
        PyArray1::from_vec(py, values).reshape(lengths)
    }

    fn check(&self, step: usize) -> PyResult<()> {
        if step < self.solved.path.steps.len() {
            return Ok(());
        }
        Err(PyIndexError::new_err("the path has no such step"))
    }
}

#[pymethods]
impl Solution {
    /// The text of `summary.json`.
    fn summary(&self) -> Result<String, Refusal> {
        Ok(pellicle_files::json(&self.solved.summary)?)
    }

    /// The text of `curve.csv`.
    fn curve(&self) -> String {
        pellicle::result::table::csv(&self.solved.summary)
    }

    /// Whether everything that the case requests is there.
    #[getter]
    fn is_whole(&self) -> bool {
        self.solved.completeness == Completeness::Whole
    }

    /// The page of the run as HTML, with the pictures of its last step.
    fn report(&self, py: Python<'_>) -> PyResult<String> {
        Threads::work(py, || solved::report(&self.solved))
    }

    /// The codes and messages of the path's warnings about this step.
    fn warnings_of(&self, step: usize) -> Vec<(String, String)> {
        let warnings = self.solved.path.warnings.iter();
        let of_step = warnings.filter(|warning| warning.step() == Some(step));
        let told = of_step.map(|warning| WarningSummary::of(&self.case, warning));
        told.map(|told| (told.code, told.message)).collect()
    }

    /// The pressure of a step, in the solution's own memory.
    fn pressure(&self, step: usize) -> PyResult<Field> {
        self.check(step)?;
        Field::pressure(&self.solved, step).ok_or_else(|| PyIndexError::new_err(step))
    }

    /// Displacement, gap and shortening of a step, computed from its pressure.
    fn surface<'py>(&self, py: Python<'py>, step: usize) -> PyResult<[Array<'py>; 3]> {
        self.check(step)?;
        let path = &self.solved.path;
        let surface = Threads::work(py, || path.surface(&self.sampled(), step));
        let surface = surface?.ok_or_else(|| PyIndexError::new_err(step))?;
        let array = |values| self.array(py, values);
        Ok([
            array(surface.displacement)?,
            array(surface.gap)?,
            array(surface.shortening)?,
        ])
    }

    /// The stresses of a step, as requested by the table `[stress]` of a text.
    fn stress(&self, py: Python<'_>, step: usize, text: String) -> PyResult<Planes> {
        self.check(step)?;
        let (case, path) = (&self.case, &self.solved.path);
        let found = Threads::work(py, || {
            let source = Arc::new(Source::new("stress", text));
            let bodies = (&case.foundation, Some(&case.indenter));
            let stress = StressCase::parse(&source, bodies, path.grid.side())?;
            let body = stress.body;
            let found = StressFields::new(case, path, step, &stress)?;
            Ok::<_, Failure>(found.map(|found| (found, body)))
        })?;
        let found: Option<_> = found.map_err(Refusal::from)?;
        let (found, body) = found.ok_or_else(|| PyIndexError::new_err(step))?;
        let bodies = body.of(&case.foundation, Some(&case.indenter));
        let names = bodies.body_names().into_iter();
        let names: Vec<_> = names
            .map(|name| format!("{}{name}", body.prefix()))
            .collect();
        Ok(Planes::new(found, &names))
    }

    /// Profile and mask of the relief.
    fn geometry<'py>(&self, py: Python<'py>) -> PyResult<(Array<'py>, Bound<'py, PyArray2<bool>>)> {
        let geometry = Threads::work(py, || self.sampled())?;
        let relief = &geometry.relief;
        Ok((
            self.array(py, relief.profile().to_vec())?,
            self.array(py, relief.mask().to_vec())?,
        ))
    }
}
