//! Bodies, models and certified solutions shared by the test binaries. A scene that cannot be built or is not certified
//! fails its test.

use std::sync::Arc;

use pellicle_contact::{
    Domain, Indenter, Load, LoadingPath, Model, Paraboloid, SolverOptions, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

/// A material.
///
/// # Panics
/// If the numbers are invalid.
#[must_use]
pub fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).expect("a material")
}

/// A half-space of plane-strain modulus 1.
#[must_use]
pub fn unit_half_space() -> Foundation {
    Foundation::half_space(material(0.91, 0.3))
}

/// A coated half-space: thickness, coating, substrate.
///
/// # Panics
/// If the body is invalid.
#[must_use]
pub fn coated(thickness: f64, coating: Material, substrate: Material) -> Foundation {
    Foundation::coated(thickness, coating, substrate).expect("a coated body")
}

/// A paraboloid.
///
/// # Panics
/// Unless the radius is positive.
#[must_use]
pub fn paraboloid(radius: f64) -> Indenter {
    Indenter::Paraboloid(Paraboloid::new(radius).expect("a positive radius"))
}

/// Cylinders on a square lattice, one on the axis.
///
/// # Panics
/// If the cylinders overlap.
#[must_use]
pub fn cylinders(radius: f64, height: f64, period: f64, young_modulus: f64) -> Relief {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius,
        height,
        period,
        offset: [0.0, 0.0],
        young_modulus,
    };
    Relief::Cylinders(Cylinders::new(spec).expect("cylinders apart"))
}

/// A model without a cache of coefficients.
///
/// # Panics
/// If the foundation has no tables.
#[must_use]
pub fn model(foundation: &Foundation, relief: Relief, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).expect("within the tables' reach")),
        relief,
        indenter,
        cache: Cache::none(),
    }
}

/// Solves the path of one load on a square of side `side`.
///
/// # Panics
/// If it cannot be solved.
#[must_use]
pub fn path(model: &Model, side: f64, elements: usize, load: Load) -> LoadingPath {
    let (domain, options) = (Domain::Side(side), SolverOptions::default());
    solve_path(model, domain, elements, &[load], &options, &mut ()).expect("a solution")
}

/// Solves the same path, and requires a certified solution.
///
/// # Panics
/// If it cannot be solved to its tolerance.
#[must_use]
pub fn solve(model: &Model, side: f64, elements: usize, load: Load) -> LoadingPath {
    let path = path(model, side, elements, load);
    let certificate = &path.steps[0].solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    path
}

/// Penetration of a certified solution.
#[must_use]
pub fn penetration(model: &Model, side: f64, elements: usize, load: Load) -> f64 {
    solve(model, side, elements, load).steps[0]
        .solution
        .penetration
}

/// `|found/wanted − 1|`.
#[must_use]
pub fn relative(found: f64, wanted: f64) -> f64 {
    (found / wanted - 1.0).abs()
}

/// Largest difference of two pressures over the peak of the first.
#[must_use]
pub fn largest_difference(one: &[f64], other: impl Fn(usize) -> f64) -> f64 {
    let peak = one.iter().copied().fold(0.0, f64::max);
    let differences = one.iter().enumerate().map(|(e, p)| (p - other(e)).abs());
    differences.fold(0.0, f64::max) / peak
}
