//! Hertz's contact, solved on a grid: the stress inside against closed forms.

use pellicle_contact::reference::hertz::{HertzContact, from_contact_radius};
use pellicle_contact::reference::hertz_stress::{HalfSpace, under_pressure, under_traction};
use pellicle_contact::{
    BodyPart, BodyStrengths, Load, LoadingPath, Sliding, StressField, StressModel, stress_extremes,
};
use pellicle_influence::{Depth, SubsurfaceState};
use pellicle_kernel::{Foundation, Side};

use super::super::comparison::Comparison;
use super::super::run::{ContactSetup, ValidationError, ValidationRun, paraboloid, unit_material};
use super::super::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Stress inside: Hertz",
    source: "Huber 1904, Hamilton 1983 (contact::reference::hertz_stress); K. L. Johnson 1985: 0.620 p₀ at 0.481 a",
    because: "in units of the largest pressure; the grid: of second order in the element's side, which is 1/85 of the \
              contact's radius",
    rows,
};

/// Elements per side of a domain three contact radii wide.
const ELEMENTS: usize = 256;
/// (1/85)² = 1.4e-4.
const SECOND_ORDER: f64 = 2e-4;
/// Three printed digits.
const THIRD_DIGIT: f64 = 5e-4;
/// A maximum is flat: its position is known to the square root of the accuracy of its value.
const FLAT: f64 = 1e-2;
/// Coefficient of friction under sliding.
const FRICTION: f64 = 0.3;

/// Points, in contact radii.
const POINTS: [[f64; 3]; 12] = [
    [0.0, 0.0, 0.1],
    [0.0, 0.0, 0.25],
    [0.0, 0.0, 0.481],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, 2.0],
    [0.5, 0.3, 0.2],
    [-0.4, 0.6, 0.5],
    [-0.8, 0.6, 0.1],
    [1.0, 0.0, 0.1],
    [-1.3, 0.2, 0.1],
    [0.2, -1.9, 0.3],
    [1.5, 1.5, 1.5],
];

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let wanted = from_contact_radius(1.0, 1.0, 0.1);
    let body = Foundation::half_space(unit_material()?);
    let (grid, load) = ((0.3, ELEMENTS), Load::Force(wanted.force));
    let path = run.solve(&ContactSetup::bare(body, paraboloid(1.0)?, grid, load))?;
    let mut rows = vec![
        closed_form("Huber", &path, &wanted, 0.0)?,
        closed_form("Hamilton, μ = 0.3", &path, &wanted, FRICTION)?,
    ];
    rows.extend(largest(&path, &wanted)?);
    Ok(rows)
}

fn closed_form(
    name: &str,
    path: &LoadingPath,
    wanted: &HertzContact,
    friction: f64,
) -> Result<Comparison, ValidationError> {
    let material = unit_material()?;
    let body = HalfSpace {
        shear_modulus: material.shear_modulus(),
        poisson_ratio: material.poisson_ratio(),
    };
    let sliding = Sliding {
        friction,
        direction: 0.0,
    };
    let field = StressField::new(path, 0, sliding).ok_or(ValidationError::NoSolution)?;
    let mut pairs = Vec::new();
    for point in POINTS {
        let [x, y, z] = point.map(|along| along * wanted.contact_radius);
        let side = Side::Above;
        let found = field.at([x, y], Depth { z, side })?;
        let tangential = under_traction(wanted, body, [x, y, z]) * friction;
        let exact: SubsurfaceState = under_pressure(wanted, body, [x, y, z]) + tangential;
        for (found, exact) in found.stress.iter().zip(exact.stress) {
            pairs.push((
                [exact, *found],
                (found - exact).abs() / wanted.peak_pressure,
            ));
        }
    }
    let check = format!("{name}: 6 stresses at {} points", POINTS.len());
    Ok(Comparison::worst(check, pairs.into_iter(), SECOND_ORDER))
}

/// Compares the largest von Mises stress found by the search.
fn largest(path: &LoadingPath, wanted: &HertzContact) -> Result<[Comparison; 2], ValidationError> {
    let model = StressModel {
        sliding: Sliding::default(),
        bodies: vec![BodyPart {
            name: "substrate".into(),
            top: 0.0,
            bottom: f64::INFINITY,
            strengths: BodyStrengths::default(),
        }],
        interfaces: Vec::new(),
        ..StressModel::default()
    };
    let extremes = stress_extremes(path, 0, &model)?;
    let found = extremes
        .bodies
        .first()
        .and_then(|body| body.max_von_mises)
        .ok_or(ValidationError::NoSolution)?;
    let share = found.value / wanted.peak_pressure;
    let depth = found.at[2] / wanted.contact_radius;
    let row = |what: &str, wanted: f64, found: f64, tolerance| {
        let check = format!("largest von Mises stress, ν = 0.3: {what}");
        Comparison::compare(check, [wanted, found], (found - wanted).abs(), tolerance)
    };
    Ok([
        row("p₀", 0.620, share, THIRD_DIGIT + SECOND_ORDER),
        row("depth, a", 0.481, depth, FLAT),
    ])
}
