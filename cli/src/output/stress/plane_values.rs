//! The displacements and stresses on a plane in the body, the names of these fields in the files, and the files that
//! are written plane by plane.

use pellicle::case::foundation::depths::BodyPlane;
use pellicle::case::stress::StressCase;
use pellicle::summary::RunSummary;
use pellicle_contact::StressPlanes;
use pellicle_influence::SubsurfaceState;
use rayon::prelude::*;

use crate::failure::Failure;

/// A field in the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FieldName {
    /// Its name.
    pub name: &'static str,
    /// Its unit in SI.
    pub unit: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
}

/// Number of fields of a state of the body.
const STATE: usize = 9;

/// The fields: those of [`SubsurfaceState`] in its order, and two derived from them.
pub const FIELDS: [FieldName; 11] = [
    named("ux", "m", "displacement along x"),
    named("uy", "m", "displacement along y"),
    named("uz", "m", "displacement along z, into the body"),
    named("sxx", "Pa", "normal stress along x, tension positive"),
    named("syy", "Pa", "normal stress along y, tension positive"),
    named("szz", "Pa", "normal stress along z, tension positive"),
    named("sxy", "Pa", "shear stress xy"),
    named("sxz", "Pa", "shear stress xz"),
    named("syz", "Pa", "shear stress yz"),
    named("von_mises", "Pa", "von Mises' equivalent stress"),
    named(
        "max_principal",
        "Pa",
        "largest principal stress, tension positive",
    ),
];

const fn named(name: &'static str, unit: &'static str, meaning: &'static str) -> FieldName {
    FieldName {
        name,
        unit,
        meaning,
    }
}

/// The fields on one plane, one row per coordinate along x.
#[derive(Debug)]
pub struct PlaneValues {
    /// The values of each of [`FIELDS`].
    pub fields: [Vec<f64>; FIELDS.len()],
    /// Number of points of a row.
    pub size: usize,
}

impl PlaneValues {
    pub fn new(size: usize) -> Self {
        Self {
            fields: std::array::from_fn(|_| vec![0.0; size * size]),
            size,
        }
    }

    pub fn compute(&mut self, planes: &mut StressPlanes, plane: BodyPlane) -> Result<(), Failure> {
        let take = |field: usize, values: &[f64]| self.fields[field].copy_from_slice(values);
        planes
            .fields_on(plane.depth, take)
            .map_err(Failure::Inside)?;
        self.derive();
        Ok(())
    }

    /// Creates planes of given values, for tests.
    #[cfg(test)]
    pub fn filled(size: usize, value: impl Fn(usize, usize, usize) -> f64) -> Self {
        let value = &value;
        let field = |field| {
            let points = (0..size).flat_map(|i| (0..size).map(move |j| value(field, i, j)));
            points.collect()
        };
        Self {
            fields: std::array::from_fn(field),
            size,
        }
    }

    pub fn von_mises(&self) -> &[f64] {
        &self.fields[STATE]
    }

    pub fn max_principal(&self) -> &[f64] {
        &self.fields[STATE + 1]
    }

    /// `σ_zz`
    pub fn normal_traction(&self) -> &[f64] {
        &self.fields[5]
    }

    /// `τ = |(σ_xz, σ_yz)|`
    pub fn shear_traction(&self) -> Vec<f64> {
        let [sxz, syz] = [7, 8].map(|field| &self.fields[field]);
        sxz.iter().zip(syz).map(|(x, y)| x.hypot(*y)).collect()
    }

    /// Computes the derived fields.
    fn derive(&mut self) {
        let (state, derived) = self.fields.split_at_mut(STATE);
        let [von_mises, principal] = derived else {
            return;
        };
        let points = von_mises.par_iter_mut().zip(principal).enumerate();
        points.for_each(|(i, (von_mises, principal))| {
            let state = SubsurfaceState {
                displacement: [0.0; 3],
                stress: std::array::from_fn(|component| state[3 + component][i]),
            };
            *von_mises = state.von_mises();
            *principal = state.principal()[0];
        });
    }
}

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
