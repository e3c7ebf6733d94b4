//! The discrete problem of a case, for user-written solvers, and the certificate of any pressure.

use std::sync::{Mutex, MutexGuard, PoisonError};

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pellicle::case::grid::BoundaryCase;
use pellicle_cli::Failure;
use pellicle_contact::{Certificate, ContactError, Load, Solution};
use pyo3::prelude::*;

use crate::case::Case;
use crate::error::Refusal;
use crate::process::{self, Threads};

/// The lines of a certificate as in a summary: complementarity, gap in contact, overlap, load, smallest pressure, the
/// worst, and whether it is satisfied.
type Lines = (f64, f64, f64, f64, f64, f64, bool);

/// The discrete problem of a case on its grid.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct DiscreteProblem {
    problem: Mutex<pellicle_contact::DiscreteProblem>,
    #[pyo3(get)]
    side: f64,
    #[pyo3(get)]
    elements: usize,
    tolerance: f64,
}

impl DiscreteProblem {
    fn problem(&self) -> MutexGuard<'_, pellicle_contact::DiscreteProblem> {
        self.problem.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn array<'py>(&self, py: Python<'py>, values: Vec<f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        PyArray1::from_vec(py, values).reshape([self.elements; 2])
    }

    /// The values of a pressure, row by row.
    fn values(&self, pressure: &PyReadonlyArray2<'_, f64>) -> Result<Vec<f64>, Refusal> {
        let pressure: Vec<f64> = pressure.as_array().iter().copied().collect();
        let (found, wanted) = (pressure.len(), self.elements * self.elements);
        if found == wanted {
            return Ok(pressure);
        }
        let field = "pressure";
        let error = ContactError::FieldLength {
            field,
            found,
            wanted,
        };
        Err(error.into())
    }
}

#[pymethods]
impl DiscreteProblem {
    /// The problem of a case, on the side that it specifies or one chosen for its loads.
    #[new]
    fn new(py: Python<'_>, case: &Case) -> PyResult<Self> {
        let (case, shared) = (case.inner(), process::shared());
        let made = Threads::work(py, || {
            if case.grid.sides.is_some() {
                let wanted = "side: the discrete problem of an oblong cell is not available";
                let refused = case.document.wanted("grid.sides", wanted);
                return Err(Failure::from(pellicle::Error::from(refused)));
            }
            let model = case.model(&shared.cache)?.value;
            let (side, elements) = (case.side(&model)?, case.grid.elements);
            let sampled = model.sample(side, elements)?;
            let problem = match case.grid.boundary {
                BoundaryCase::Free => model.discretize(&sampled)?.value,
                BoundaryCase::Periodic => model.discretize_cell(&sampled)?.value,
            };
            let problem = Mutex::new(problem);
            Ok::<_, Failure>(Self {
                problem,
                side,
                elements,
                tolerance: case.solver.tolerance,
            })
        })?;
        Ok(made.map_err(Refusal::from)?)
    }

    /// Initial gap `g0 = f − f*`, m; infinite where nothing can touch.
    fn initial_gap<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = py.detach(|| self.problem().initial_gap().to_vec());
        self.array(py, values)
    }

    /// Compliance `η` of the relief at rest, m/Pa.
    fn relief_compliance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = py.detach(|| self.problem().relief_compliance().to_vec());
        self.array(py, values)
    }

    /// The displacement `K p` (m) under a pressure (Pa).
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn displacement<'py>(
        &self,
        py: Python<'py>,
        pressure: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let pressure = self.values(&pressure)?;
        let displacement = Threads::work(py, || {
            let mut displacement = vec![0.0; pressure.len()];
            let mut problem = self.problem();
            problem
                .operator_mut()
                .apply_into(&pressure, &mut displacement);
            displacement
        })?;
        self.array(py, displacement)
    }

    /// Penetration (m), force (N) and certificate of a pressure (Pa) under a force (N), or else at a penetration (m).
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn judge(
        &self,
        py: Python<'_>,
        pressure: PyReadonlyArray2<'_, f64>,
        force: Option<f64>,
        penetration: f64,
    ) -> PyResult<(f64, f64, Lines)> {
        let pressure = self.values(&pressure)?;
        let load = force.map_or(Load::Penetration(penetration), Load::Force);
        let judged = Threads::work(py, || {
            Solution::judge(&mut self.problem(), load, pressure, self.tolerance)
        })?;
        let lines = lines(&judged.certificate);
        Ok((judged.penetration, judged.force, lines))
    }
}

fn lines(certificate: &Certificate) -> Lines {
    (
        certificate.complementarity,
        certificate.gap_in_contact,
        certificate.overlap,
        certificate.load,
        certificate.min_pressure,
        certificate.worst(),
        certificate.is_satisfied(),
    )
}
