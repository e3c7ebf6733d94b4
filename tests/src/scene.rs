//! Bodies, models, certified solutions and the panels of the paper's Fig. 2, shared by the test binaries. A
//! scene that cannot be built or is not certified fails its test.

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

/// One panel of the paper's Fig. 2, a textured surface in its units: indenter radius 1, coating modulus 1.
#[derive(Debug, Clone)]
pub struct Fig2Panel {
    /// Its letter.
    pub name: &'static str,
    /// Foundation, relief and indenter.
    pub model: Model,
    /// Side of the domain.
    pub side: f64,
    /// Force `Q' = Q/(E1 R²)`.
    pub load: Load,
}

/// The four panels (a)–(d) of the paper's Fig. 2.
#[must_use]
pub fn figure_2() -> [Fig2Panel; 4] {
    let soft = || textured(material(1.0, 0.4), material(10.0, 0.3));
    let stiff = || textured(material(1.0, 0.3), material(0.1, 0.4));
    let panel = |name, model, side, force| Fig2Panel {
        name,
        model,
        side,
        load: Load::Force(force),
    };
    [
        panel("2a", soft(), 0.08, 0.3571e-4),
        panel("2b", stiff(), 0.08, 0.3571e-5),
        panel("2c", soft(), 0.12, 2.1426e-4),
        panel("2d", stiff(), 0.14, 2.1426e-5),
    ]
}

/// Coating `H = 1e-4` with cylinders `r = 5e-3`, `h = 1e-4`, period 1/80, of the coating's modulus 1.
fn textured(coating: Material, substrate: Material) -> Model {
    let relief = cylinders(5e-3, 1e-4, 1.0 / 80.0, 1.0);
    Model {
        cache: Cache::in_memory(),
        ..model(&coated(1e-4, coating, substrate), relief, paraboloid(1.0))
    }
}
