//! An elastic body by itself: its compliance, its influence coefficients and the product with a pressure.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pellicle_cli::solved::FoundationCase;
use pellicle_cli::{Failure, Source};
use pellicle_influence::{CoefficientTable, ConvolutionOperator, ElasticOperator};
use pellicle_kernel::Foundation;
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::process::{self, Threads};

/// A layered body.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Body(Foundation);

#[pymethods]
impl Body {
    /// Reads the table `[foundation]` of a text that goes by the name `source`.
    #[new]
    fn new(text: String, source: String) -> Result<Self, Refusal> {
        let source = Arc::new(Source::new(source, text));
        Ok(Self(FoundationCase::parse(&source)?.split()?.foundation))
    }

    /// The compliances at these wavenumbers (1/m), which must be positive, m/Pa.
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn compliance<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
    ) -> Bound<'py, PyArray1<f64>> {
        let wavenumbers = wavenumbers.as_array();
        let compliances = wavenumbers.iter().map(|k| self.0.compliance(*k));
        PyArray1::from_vec(py, compliances.collect())
    }
}

/// The product `u = K p` on a grid.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Operator {
    table: Arc<CoefficientTable>,
    operator: Mutex<ConvolutionOperator>,
}

#[pymethods]
impl Operator {
    /// The operator of a body under `elements` × `elements` elements of this side (m).
    #[new]
    fn new(py: Python<'_>, body: &Body, element_side: f64, elements: usize) -> PyResult<Self> {
        let shared = process::shared();
        let made = Threads::work(py, || {
            let tables = shared.cache.radial_tables(&body.0)?.value;
            let table = shared
                .cache
                .coefficients(&tables, element_side, elements)?
                .value;
            let operator = Mutex::new(ConvolutionOperator::new(&table));
            Ok::<_, Failure>(Self { table, operator })
        })?;
        Ok(made.map_err(Refusal::from)?)
    }

    /// The coefficients by offset, m/Pa.
    fn coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let size = self.table.size();
        let offsets = (0..size).flat_map(|i| (0..size).map(move |j| [i, j]));
        let values = offsets.map(|offset| self.table.coefficient(offset));
        PyArray1::from_vec(py, values.collect()).reshape([size, size])
    }

    /// The displacement (m) under a pressure (Pa) of as many elements.
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn apply<'py>(
        &self,
        py: Python<'py>,
        pressure: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let size = self.table.size();
        let pressure: Vec<f64> = pressure.as_array().iter().copied().collect();
        if pressure.len() != size * size {
            let field = "pressure";
            let (found, wanted) = (pressure.len(), size * size);
            let error = pellicle_contact::ContactError::FieldLength {
                field,
                found,
                wanted,
            };
            return Err(Refusal::from(error).into());
        }
        let displacement = Threads::work(py, || {
            let mut displacement = vec![0.0; size * size];
            let mut operator = self.operator.lock().unwrap_or_else(PoisonError::into_inner);
            operator.apply_into(&pressure, &mut displacement);
            displacement
        })?;
        PyArray1::from_vec(py, displacement).reshape([size, size])
    }
}
