//! The largest tension at the edge of the contact as an extreme of the topmost body.

use pellicle_influence::Depth;

use super::edge_tension::{EdgeContact, edge_tension, edge_tension_from, edge_tension_near};
use super::extreme::Extreme;
use super::field::StressField;
use crate::{ContactError, LoadingPath, Step};

/// Parts of the tension and of the largest pressure by which the continuation may be off on every grid; the second
/// counts where the tension is a small difference, without friction on bodies that hardly change their volume.
const PART_OF_TENSION: f64 = 0.005;
const PART_OF_PRESSURE: f64 = 2e-4;

/// What is wanted of an extreme at the edge.
#[derive(Clone, Copy)]
pub enum Wanted<'a> {
    /// Only its value, reached along the edge from a point (x, y; m), or the largest one.
    Value(Option<[f64; 2]>),
    /// Its error as well, from the next coarser grid; without one it is not known.
    Error(Option<&'a StressField>),
}

/// The extreme of the tension at the edge under a step; none if no edge determines one, or all are in compression.
///
/// ± is the sum of the change of the continuation from one order to another, its change from the next coarser grid and
/// a constant part.
pub fn edge_extreme(
    path: &LoadingPath,
    step: &Step,
    field: &StressField,
    wanted: Wanted,
) -> Result<Option<Extreme<3>>, ContactError> {
    let bodies = (&path.relief, &path.indenter);
    let contact = EdgeContact::new(field, bodies, step.solution.penetration, path.hardness);
    // Under a stiff coating at rest the edge may be in compression.
    let found = match wanted {
        Wanted::Value(Some(from)) => edge_tension_from(&contact, from)?,
        Wanted::Value(None) | Wanted::Error(_) => edge_tension(&contact)?,
    };
    let residual = field.residual().at(Depth::below(0.0));
    let Some(found) = found.filter(|found| found.value + residual > 0.0) else {
        return Ok(None);
    };
    let on_coarser = match wanted {
        Wanted::Error(Some(coarse)) => {
            let levels = step.grid_error.levels.iter();
            let mut penetrations = levels.filter(|level| level.elements == coarse.grid().size());
            let penetration = penetrations
                .next()
                .map_or(f64::NAN, |level| level.penetration);
            let contact = EdgeContact::new(coarse, bodies, penetration, path.hardness);
            edge_tension_near(&contact, found.at)?
        }
        Wanted::Error(None) | Wanted::Value(_) => None,
    };
    let pressure = field
        .loaded()
        .pressure
        .iter()
        .fold(0.0_f64, |largest, p| largest.max(*p));
    let accuracy = step.solution.certificate.worst() + path.tables.error_estimate();
    let estimate = on_coarser.map(|coarse| {
        let constant =
            (PART_OF_TENSION + accuracy) * found.value.abs() + PART_OF_PRESSURE * pressure;
        found.uncertainty + (found.value - coarse.value).abs() + constant
    });
    let [x, y] = found.at;
    Ok(Some(Extreme {
        // Both principal stresses along a free surface are shifted alike.
        value: found.value + residual,
        at: [x, y, 0.0],
        resolved: found.is_resolved && (estimate.is_some() || matches!(wanted, Wanted::Value(_))),
        estimate,
    }))
}

/// Whether the edge of the contact is within some elements of a point (x, y), in m.
pub fn is_near_edge(field: &StressField, at: [f64; 2], elements: isize) -> bool {
    let (grid, loaded) = (field.grid(), field.loaded());
    let place = [0, 1].map(|axis: usize| {
        super::nearest((at[axis] - grid.centre(loaded.origin[axis])) / grid.element_side())
    });
    let is_loaded = |[i, j]: [isize; 2]| match (usize::try_from(i), usize::try_from(j)) {
        (Ok(i), Ok(j)) if i < loaded.size && j < loaded.size => {
            loaded.pressure[i * loaded.size + j] > 0.0
        }
        _ => false,
    };
    let own = is_loaded(place);
    let around = (-elements..=elements).flat_map(|m| (-elements..=elements).map(move |n| [m, n]));
    around
        .filter(|[m, n]| m * m + n * n < elements * elements)
        .any(|[m, n]| is_loaded([place[0] + m, place[1] + n]) != own)
}

#[cfg(test)]
mod tests;
