//! A file of stresses, of any format, that is written plane by plane.

use super::plane_values::PlaneValues;
use crate::case::foundation::depths::BodyPlane;
use crate::case::stress::StressCase;
use crate::failure::Failure;
use crate::output::summary::RunSummary;

/// The header of the files of a step: everything but the values.
#[derive(Debug)]
pub struct StressHead<'a> {
    pub summary: &'a RunSummary,
    pub step: usize,
    pub stress: &'a StressCase,
    /// Names of the bodies, from the surface down.
    pub bodies: Vec<String>,
    /// The coordinates of the points along x, and along y, m.
    pub centres: &'a [f64],
    pub planes: &'a [BodyPlane],
}

/// A file that is written plane by plane.
pub trait StressFile {
    fn add(&mut self, plane: usize, values: &PlaneValues) -> Result<(), Failure>;
    fn finish(self: Box<Self>) -> Result<(), Failure>;
}
