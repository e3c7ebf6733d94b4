//! An elastic body on its own: its compliance, its influence coefficients and the product with a pressure.

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{
    PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pellicle::case::foundation::FoundationCase;
use pellicle::case::stress::StressCase;
use pellicle::input::span::Source;
use pellicle_cli::Failure;
use pellicle_cli::solved::StressFields;
use pellicle_contact::{ContactError, StressField};
use pellicle_influence::{CoefficientTable, ConvolutionOperator, ElasticOperator};
use pellicle_texture::Grid;
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::planes::Planes;
use crate::process::{self, Threads};

/// A layered foundation.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Foundation {
    case: FoundationCase,
    foundation: pellicle_kernel::Foundation,
}

#[pymethods]
impl Foundation {
    /// Reads the table `[foundation]` of a text named `source`.
    #[new]
    fn new(text: String, source: String) -> Result<Self, Refusal> {
        let source = Arc::new(Source::new(source, text));
        let case = FoundationCase::parse(&source)?;
        let foundation = case.split()?.foundation;
        Ok(Self { case, foundation })
    }

    /// The compliances (m/Pa) at these wavenumbers (1/m), which must be positive.
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn compliance<'py>(
        &self,
        py: Python<'py>,
        wavenumbers: PyReadonlyArray1<'py, f64>,
    ) -> Bound<'py, PyArray1<f64>> {
        let wavenumbers = wavenumbers.as_array();
        let compliances = wavenumbers.iter().map(|k| self.foundation.compliance(*k));
        PyArray1::from_vec(py, compliances.collect())
    }

    /// The stresses requested by the table `[stress]` of a text, under a pressure (Pa) on a square of this side (m),
    /// carried by a contact of this radius (m).
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn stress(
        &self,
        py: Python<'_>,
        pressure: PyReadonlyArray2<'_, f64>,
        side: f64,
        contact_radius: f64,
        text: String,
    ) -> PyResult<Planes> {
        let size = pressure.shape()[0];
        let pressure: Vec<f64> = pressure.as_array().iter().copied().collect();
        let shared = process::shared();
        let found = Threads::work(py, || {
            let grid = Grid::new(side, size)?;
            check_length(pressure.len(), grid.len())?;
            let source = Arc::new(Source::new("stress", text));
            let stress = StressCase::parse(&source, (&self.case, None), side)?;
            let tables = shared.cache.radial_tables(&self.foundation)?.value;
            let field = StressField::of(tables, grid, &pressure, stress.sliding());
            StressFields::of(
                (&self.case, &self.foundation),
                field,
                contact_radius,
                &stress,
            )
        })?;
        let found = found.map_err(Refusal::from)?;
        Ok(Planes::new(found, &self.case.body_names()))
    }
}

/// Refuses a pressure of the wrong length.
fn check_length(found: usize, wanted: usize) -> Result<(), ContactError> {
    let field = "pressure";
    let error = ContactError::FieldLength {
        field,
        found,
        wanted,
    };
    if found == wanted { Ok(()) } else { Err(error) }
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
    fn new(
        py: Python<'_>,
        foundation: &Foundation,
        element_side: f64,
        elements: usize,
    ) -> PyResult<Self> {
        let shared = process::shared();
        let made = Threads::work(py, || {
            let tables = shared.cache.radial_tables(&foundation.foundation)?.value;
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

    /// The displacement (m) under a pressure (Pa) on the same elements.
    #[expect(clippy::needless_pass_by_value, reason = "Python hands over a borrow")]
    fn apply<'py>(
        &self,
        py: Python<'py>,
        pressure: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let size = self.table.size();
        let pressure: Vec<f64> = pressure.as_array().iter().copied().collect();
        check_length(pressure.len(), size * size).map_err(Refusal::from)?;
        let displacement = Threads::work(py, || {
            let mut displacement = vec![0.0; size * size];
            let mut operator = self.operator.lock().unwrap_or_else(PoisonError::into_inner);
            operator.apply_into(&pressure, &mut displacement);
            displacement
        })?;
        PyArray1::from_vec(py, displacement).reshape([size, size])
    }
}
