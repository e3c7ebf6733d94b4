//! Validation of a problem's fields, and detection of rough surfaces.

use rayon::prelude::*;

use crate::ContactError;

/// Values checked together: checking after each value whether another thread has found a wrong one took a ninth of the
/// time of a Hertz contact at N = 2048.
pub const VALUES_AT_ONCE: usize = 4096;

/// Fraction of elements that are crests above which a surface is rough.
const CRESTS: f64 = 0.3;

/// Whether an initial gap with `size` elements per row is that of a rough surface: the gap of a smooth indenter is
/// convex except at the outlines of a relief, and above a rough surface every other element is a crest.
pub fn is_rough(size: usize, g0: &[f64]) -> bool {
    let inner = |lines: usize| 1..lines.saturating_sub(1);
    let (rows, columns) = (inner(g0.len() / size), inner(size));
    let is_crest = |element: usize| {
        let around = [element - size, element - 1, element + 1, element + size];
        around.map(|other| g0[other]).iter().sum::<f64>() < 4.0 * g0[element]
    };
    let in_row = |row: usize| {
        let elements = columns.clone().map(|column| row * size + column);
        elements.filter(|element| is_crest(*element)).count()
    };
    let elements = rows.len() * columns.len();
    let crests: Vec<usize> = rows.into_par_iter().map(in_row).collect();
    crests.iter().sum::<usize>() as f64 > CRESTS * elements as f64
}

/// Returns an error if a hardness (Pa) is not positive and finite.
pub fn check_hardness(hardness: f64) -> Result<(), ContactError> {
    if hardness > 0.0 && hardness.is_finite() {
        Ok(())
    } else {
        Err(ContactError::Hardness { hardness })
    }
}

/// Returns an error if a field does not have one value per element.
pub fn check_length(field: &'static str, found: usize, wanted: usize) -> Result<(), ContactError> {
    if found == wanted {
        Ok(())
    } else {
        Err(ContactError::FieldLength {
            field,
            found,
            wanted,
        })
    }
}

/// Whether all parts of a field are allowed; compiled once for all conditions.
fn all_parts(values: &[f64], are_allowed: &(dyn Fn(&[f64]) -> bool + Sync)) -> bool {
    values.par_chunks(VALUES_AT_ONCE).all(are_allowed)
}

/// Returns an error if a field has a value that is not `is_allowed`.
pub fn check_values(
    field: &'static str,
    values: &[f64],
    wanted: &'static str,
    is_allowed: impl Fn(f64) -> bool + Sync,
) -> Result<(), ContactError> {
    let are_allowed = |values: &[f64]| {
        values
            .iter()
            .fold(true, |all, value| all & is_allowed(*value))
    };
    if all_parts(values, &are_allowed) {
        return Ok(());
    }
    match values.iter().position(|value| !is_allowed(*value)) {
        None => Ok(()),
        Some(element) => Err(ContactError::FieldValue {
            field,
            element,
            wanted,
            found: values[element],
        }),
    }
}
