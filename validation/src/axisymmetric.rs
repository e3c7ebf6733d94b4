//! Paraboloids and cones on coated half-spaces against axisymmetric solutions to 22 digits.

use std::f64::consts::FRAC_PI_4;

use pellicle_contact::{Cone, Indenter, Load};
use pellicle_kernel::{Foundation, Material};
use rayon::prelude::*;

use crate::comparison::Comparison;
use crate::data::contact::{AxisymmetricContact, AxisymmetricIndenter, axisymmetric};
use crate::run::{ContactSetup, ValidationError, ValidationRun, paraboloid};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Layered bodies, axisymmetric",
    source: "tests/data/axisymmetric_contact.json, 22 digits",
    because: "relative; the grid: of second order in the element's side, which is 1/107 of the contact's radius",
    rows,
};

/// Elements per side.
const ELEMENTS: usize = 256;
/// Side of the domain, in contact radii.
const SIDE: f64 = 2.4;
/// (1/107)² = 9e-5 times a factor that depends on where the grid meets the contact's edge.
const SECOND_ORDER: f64 = 1e-5;

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let cases = axisymmetric()?;
    Ok(cases.par_iter().map(|case| row(run, case)).collect())
}

fn row(run: ValidationRun, case: &AxisymmetricContact) -> Comparison {
    let shape = match case.shape {
        AxisymmetricIndenter::Paraboloid => "paraboloid",
        AxisymmetricIndenter::Cone => "cone",
    };
    let check = format!(
        "{shape}, χ = {}, H/a = {}: penetration",
        case.e1, case.thickness
    );
    let found = contact(case).and_then(|contact| run.penetration(&contact));
    match found {
        Ok(found) => Comparison::relative(check, case.penetration, found, SECOND_ORDER),
        Err(error) => Comparison::failed(check, &error),
    }
}

/// The contact of a case under its force.
fn contact(case: &AxisymmetricContact) -> Result<ContactSetup, ValidationError> {
    let coating = Material::new(case.e1, case.nu1)?;
    let substrate = Material::new(1.0, case.nu2)?;
    let body = Foundation::coated(case.thickness, coating, substrate)?;
    let indenter = match case.shape {
        AxisymmetricIndenter::Paraboloid => paraboloid(1.0)?,
        // z = r: 45 degrees between axis and side.
        AxisymmetricIndenter::Cone => Indenter::Cone(Cone::new(FRAC_PI_4, 0.0)?),
    };
    let (grid, load) = ((SIDE, ELEMENTS), Load::Force(case.force));
    Ok(ContactSetup::bare(body, indenter, grid, load))
}
