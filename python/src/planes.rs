//! Displacements and stresses on planes in the body, as arrays.

use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pellicle_cli::solved::{FIELDS, StressFields};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Displacements and stresses on planes.
#[pyclass(frozen, module = "pellicle._pellicle")]
pub struct Planes {
    found: StressFields,
    /// The name of the body of each plane.
    bodies: Vec<String>,
}

impl Planes {
    /// Planes in bodies with these names, from the surface down.
    pub fn new(found: StressFields, names: &[String]) -> Self {
        let of_plane = found.planes.iter().map(|plane| &names[plane.body]);
        let bodies = of_plane.cloned().collect();
        Self { found, bodies }
    }
}

#[pymethods]
impl Planes {
    /// Coordinates of the points, the same along x and y, m.
    fn centres<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.found.centres)
    }

    /// Depths of the planes, m; two for an interface.
    fn depths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let depths = self.found.planes.iter().map(|plane| plane.depth.z);
        PyArray1::from_vec(py, depths.collect())
    }

    /// The body of each plane.
    fn bodies(&self) -> Vec<String> {
        self.bodies.clone()
    }

    /// Each field by its name: its unit, its meaning, and its values over plane, x and y.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (planes, size) = (self.found.planes.len(), self.found.centres.len());
        let fields = PyDict::new(py);
        for (number, field) in FIELDS.iter().enumerate() {
            let of_planes = self.found.values.iter();
            let values: Vec<f64> = of_planes
                .flat_map(|plane| plane[number].iter().copied())
                .collect();
            let array: Bound<'py, PyArray3<f64>> =
                PyArray1::from_vec(py, values).reshape([planes, size, size])?;
            fields.set_item(field.name, (field.unit, field.meaning, array))?;
        }
        Ok(fields)
    }
}
