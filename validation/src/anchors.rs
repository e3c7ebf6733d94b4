//! Reference cases from the literature: punches on layers and square punches.

use pellicle_contact::axisymmetric::punch_stiffness;
use pellicle_contact::{FlatPunch, Indenter, Load, Profile};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use crate::comparison::Comparison;
use crate::run::{ContactSetup, ValidationError, ValidationRun, unit_material};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Punches from the literature",
    source: "an integral equation solved here in another way (W. C. Hayes and others 1972); H. Gao, C.-H. Chiu, J. Lee 1992; \
             the capacity of a square plate, 0.36679 of its side",
    because: "relative; a limit extrapolated over grids, of first order in the element's side at a rim; the integral \
              equation itself has 1e-11",
    rows,
};

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let mut rows = Vec::new();
    for (ratio, nu) in LAYERS {
        rows.push(layer_on_rigid_base(run, ratio, nu)?);
    }
    rows.extend(film_of_almost_equal_modulus(run)?);
    rows.push(square_punch(run)?);
    Ok(rows)
}

/// Ratio of contact radius to thickness, and Poisson's ratio.
const LAYERS: [(f64, f64); 4] = [(0.4, 0.3), (1.0, 0.5), (2.0, 0.4), (2.0, 0.5)];
/// Error of the staircase boundary beyond a change of the radius: of second order in the element's side, which is 1/96
/// of the radius.
const STAIRCASE: f64 = 2e-5;
/// Error left after extrapolation over the grids; the capacity has five digits.
const EXTRAPOLATED: f64 = 3e-5;

/// A layer of thickness 1 bonded to a rigid base.
fn layer(nu: f64) -> Result<Foundation, ValidationError> {
    let layer = Layer::new(1.0, Material::new(1.0, nu)?, Interface::Bonded)?;
    Ok(Foundation::new(vec![layer], Base::Rigid)?)
}

/// Compares the force under a flat punch relative to that on a half-space, `κ` of Hayes and others.
fn layer_on_rigid_base(
    run: ValidationRun,
    radius: f64,
    nu: f64,
) -> Result<Comparison, ValidationError> {
    let body = layer(nu)?;
    // Q = 2 E* a D on a half-space
    let unit = 2.0 * body.surface_material().plane_strain_modulus() * radius;
    let wanted = punch_stiffness(&body.clone().into(), radius)?[0] / unit;
    let disc = radius / effective_radius(run, PUNCH)?;
    let found = punch_force(run, &body, disc, PUNCH)? / unit;
    let check = format!("layer on a rigid base, a/H = {radius}, ν = {nu}: κ");
    Ok(Comparison::relative(check, wanted, found, STAIRCASE))
}

/// Elements along the diameter of a round punch.
const PUNCH: usize = 192;

/// Radius of the disc equivalent to a round punch of radius 1 on a grid, from its force on a half-space: the elements
/// follow the rim as a staircase, with a finite pressure there.
fn effective_radius(run: ValidationRun, elements: usize) -> Result<f64, ValidationError> {
    // With plane-strain modulus 1: Q = 2 a D
    let body = Foundation::half_space(unit_material()?);
    Ok(punch_force(run, &body, 1.0, elements)? / 2.0)
}

/// Elements along the side of a square punch.
const GRIDS: [usize; 3] = [48, 96, 192];

/// Extrapolates values whose errors begin with the first and second power of the element's side.
fn extrapolated(
    value: impl Fn(usize) -> Result<f64, ValidationError>,
) -> Result<f64, ValidationError> {
    let [coarse, middle, fine] = [value(GRIDS[0])?, value(GRIDS[1])?, value(GRIDS[2])?];
    let (first, second) = (2.0 * middle - coarse, 2.0 * fine - middle);
    Ok((4.0 * second - first) / 3.0)
}

/// Force at a penetration of 1.
fn punch_force(
    run: ValidationRun,
    body: &Foundation,
    radius: f64,
    elements: usize,
) -> Result<f64, ValidationError> {
    let punch = Indenter::FlatPunch(FlatPunch::new(radius)?);
    let grid = (2.0 * radius * 4.0 / 3.0, elements * 4 / 3);
    let contact = ContactSetup::bare(body.clone(), punch, grid, Load::Penetration(1.0));
    Ok(run.solve(&contact)?.steps[0].solution.force)
}

/// Thicknesses of the film, in punch radii.
const FILMS: [f64; 3] = [0.2, 1.0, 3.0];
/// Relative change of the film's modulus; the error of the derivative is its square.
const CHANGE: f64 = 1e-4;
/// That square, and the rounding divided by the change.
const DIFFERENCE: f64 = 2e-8;

/// `d ln Q/d ln E₁` of a flat punch on a film at `E₁ = E₂` and equal ν, the weight `I₀` of the film.
fn film_of_almost_equal_modulus(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let nu = 0.3;
    let film = |thickness, change: f64| {
        let base = Material::new(1.0, nu)?;
        let film = Material::new(1.0 + change, nu)?;
        Foundation::coated(thickness, film, base).map_err(ValidationError::from)
    };
    let derivative = |force: &dyn Fn(f64) -> Result<f64, ValidationError>| {
        let [more, less] = [force(CHANGE)?, force(-CHANGE)?];
        Ok::<_, ValidationError>((more / less).ln() / (2.0 * CHANGE))
    };
    let disc = 1.0 / effective_radius(run, PUNCH)?;
    let mut rows = Vec::new();
    for thickness in FILMS {
        let wanted = weight_of_film(thickness, nu);
        let by_equation =
            derivative(&|change| Ok(punch_stiffness(&film(thickness, change)?.into(), 1.0)?[0]))?;
        let by_grid =
            derivative(&|change| punch_force(run, &film(thickness, change)?, disc, PUNCH))?;
        let check = |how| format!("I₀ of a film, H/a = {thickness}: {how}");
        rows.push(Comparison::relative(
            check("integral equation"),
            wanted,
            by_equation,
            DIFFERENCE,
        ));
        rows.push(Comparison::relative(
            check("grid"),
            wanted,
            by_grid,
            STAIRCASE,
        ));
    }
    Ok(rows)
}

/// `I₀ = 2/π atan ξ + 1/(2π(1 − ν)) ((1 − 2ν) ξ ln((1 + ξ²)/ξ²) − ξ/(1 + ξ²))`, `ξ = H/a`.
fn weight_of_film(xi: f64, nu: f64) -> f64 {
    let square = xi * xi;
    let bracket = (1.0 - 2.0 * nu) * xi * ((1.0 + square) / square).ln() - xi / (1.0 + square);
    std::f64::consts::FRAC_2_PI * xi.atan() + bracket / (std::f64::consts::TAU * (1.0 - nu))
}

/// The flat end of a square column of side 1.
#[derive(Debug)]
struct SquarePunch;

impl Profile for SquarePunch {
    fn height(&self, x: f64, y: f64) -> f64 {
        if x.abs().max(y.abs()) < 0.5 {
            0.0
        } else {
            f64::INFINITY
        }
    }

    fn is_mirrored(&self) -> bool {
        true
    }

    fn distance_to_rim(&self, x: f64, y: f64) -> f64 {
        0.5 - x.abs().max(y.abs())
    }
}

/// A punch corresponds to a charged plate: `Q = π E* C D` with the capacity C, which is `2a/π` for a disc.
fn square_punch(run: ValidationRun) -> Result<Comparison, ValidationError> {
    let body = Foundation::half_space(unit_material()?);
    let capacity = extrapolated(|elements| {
        let (punch, grid) = (Indenter::custom(SquarePunch), (4.0 / 3.0, elements * 4 / 3));
        let contact = ContactSetup::bare(body.clone(), punch, grid, Load::Penetration(1.0));
        Ok(run.solve(&contact)?.steps[0].solution.force / std::f64::consts::PI)
    })?;
    let check = "square punch: capacity of a square plate".into();
    Ok(Comparison::relative(
        check,
        0.366_79,
        capacity,
        EXTRAPOLATED,
    ))
}
