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

#[cfg(test)]
mod tests {
    use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};

    use super::*;

    #[test]
    fn the_integral_equation_reproduces_the_22_digit_penetrations_and_forces() {
        for case in axisymmetric().unwrap() {
            let coating = Material::new(case.e1, case.nu1).unwrap();
            let substrate = Material::new(1.0, case.nu2).unwrap();
            let body = Foundation::coated(case.thickness, coating, substrate).unwrap();
            let profile = match case.shape {
                AxisymmetricIndenter::Paraboloid => AxisymmetricProfile::Paraboloid { radius: 1.0 },
                AxisymmetricIndenter::Cone => AxisymmetricProfile::Cone {
                    slope: 1.0,
                    tip_radius: 0.0,
                },
            };
            let elasticity = AxisymmetricElasticity::new(&body.into());
            let found = elasticity.contact(profile, 1.0).unwrap();
            let errors = [
                found.penetration / case.penetration - 1.0,
                found.force / case.force - 1.0,
            ];
            // Rounding, times the cancellation of stiff coatings.
            for error in errors {
                assert!(error.abs() < 1e-11, "{case:?}: {errors:?}");
            }
        }
    }
}
