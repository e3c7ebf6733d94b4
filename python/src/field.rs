//! A field of a solution that NumPy reads in place, without a copy.

use std::sync::Arc;

use pellicle::Run as SolvedCase;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The pressure of a loading step. `numpy.asarray` makes a read-only array of it in the solution's own memory, and
/// keeps the solution alive.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Field {
    solved: Arc<SolvedCase>,
    step: usize,
}

impl Field {
    /// The pressure of this step; `None` if there is no such step.
    pub fn pressure(solved: &Arc<SolvedCase>, step: usize) -> Option<Self> {
        (step < solved.path.steps.len()).then(|| Self {
            solved: Arc::clone(solved),
            step,
        })
    }
}

#[pymethods]
impl Field {
    /// NumPy's array interface, version 3.
    #[getter(__array_interface__)]
    fn array_interface<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        const IS_READ_ONLY: bool = true;
        let values = &self.solved.path.steps[self.step].solution.pressure;
        let [along_x, along_y] = self.solved.path.grid.lengths();
        let order = if cfg!(target_endian = "big") {
            ">f8"
        } else {
            "<f8"
        };
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", (along_x, along_y))?;
        interface.set_item("typestr", order)?;
        interface.set_item("data", (values.as_ptr().expose_provenance(), IS_READ_ONLY))?;
        Ok(interface)
    }
}
