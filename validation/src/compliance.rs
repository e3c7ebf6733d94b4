//! The compliance of layers in the wavenumber domain against values of 40 digits.

use pellicle_kernel::Interface::{Bonded, Frictionless};
use pellicle_kernel::{Foundation, Interface};

use crate::comparison::Comparison;
use crate::data::compliance::{OneLayerResponse, one_layer, stacks};
use crate::run::{ValidationError, ValidationRun};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Compliance of layers",
    source: "tests/data/compliance_*.json, 40 digits",
    because: "relative; a dozen roundings, and for Φ − 1 the rounding of s times 2s in e^(−2s)",
    rows,
};

/// A dozen roundings.
const ROUNDING: f64 = 2e-15;
/// The same, and the rounding of the difference of two terms that cancel in `Φ − 1`.
const DIFFERENCE: f64 = 1e-14;

fn rows(_: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let values = one_layer()?;
    Ok(vec![
        row("bonded to a half-space", &values, |value| {
            Some((Bonded, false, value.bonded))
        })?,
        row("sliding on a half-space", &values, |value| {
            Some((Frictionless, false, value.sliding?))
        })?,
        row("bonded to a rigid base", &values, |value| {
            Some((Bonded, true, value.bonded_to_rigid?))
        })?,
        row("sliding on a rigid base", &values, |value| {
            Some((Frictionless, true, value.sliding_on_rigid?))
        })?,
        difference_from_one(&values)?,
        stack_row()?,
    ])
}

/// The interface, whether the base is rigid, and `Φ`.
type Reference = fn(&OneLayerResponse) -> Option<(Interface, bool, f64)>;

fn row(
    what: &str,
    values: &[OneLayerResponse],
    reference: Reference,
) -> Result<Comparison, ValidationError> {
    let mut found = Vec::new();
    for value in values {
        if let Some((interface, rigid, wanted)) = reference(value) {
            let response = value.foundation(interface, rigid)?.response(value.s);
            found.push(([wanted, response], (response / wanted - 1.0).abs()));
        }
    }
    let check = format!("Φ of a layer {what}, {} values", found.len());
    Ok(Comparison::worst(check, found.into_iter(), ROUNDING))
}

fn difference_from_one(values: &[OneLayerResponse]) -> Result<Comparison, ValidationError> {
    let mut found = Vec::new();
    for value in values {
        let layer = value.foundation(Bonded, false)?;
        let (wanted, response) = (value.bonded_minus_one, layer.response_minus_one(value.s));
        // e^(−2s) magnifies the rounding of s by 2s.
        let scale = wanted.abs() * (1.0 + 2.0 * value.s);
        let error = (response - wanted).abs();
        let error = if error == 0.0 { 0.0 } else { error / scale };
        found.push(([wanted, response], error));
    }
    let check = format!("Φ − 1 of a bonded layer, {} values", found.len());
    Ok(Comparison::worst(check, found.into_iter(), DIFFERENCE))
}

fn stack_row() -> Result<Comparison, ValidationError> {
    let data = stacks()?;
    let mut found = Vec::new();
    for value in &data.values {
        let stack = data
            .stacks
            .get(&value.stack)
            .ok_or(ValidationError::NoSolution)?;
        let foundation: Foundation = stack.foundation()?;
        let computed = foundation.compliance(value.wavenumber);
        let error = (computed / value.compliance - 1.0).abs();
        found.push(([value.compliance, computed], error));
    }
    let (stacks, values) = (data.stacks.len(), found.len());
    let check = format!("C of {stacks} stacks of two and three layers, {values} values");
    Ok(Comparison::worst(check, found.into_iter(), ROUNDING))
}
