//! `pellicle influence`: influence coefficients of a foundation on the case's own elements.

use pellicle_influence::direct;
use serde::Serialize;

use crate::arguments::InfluenceArguments;
use crate::case::Case;
use crate::case::units::Units;
use crate::failure::Failure;
use crate::program::Outcome;
use crate::{cache, output, terminal};

/// The coefficient at one offset.
#[derive(Debug, Clone, Copy, Serialize)]
struct CoefficientRow {
    /// Distance in elements along x and y.
    offset: [usize; 2],
    /// Displacement there for unit pressure on one element, m/Pa.
    coefficient: f64,
}

/// Prints a row for each offset.
///
/// # Errors
///
/// [`Failure`] if the case cannot be read or a coefficient cannot be computed to its accuracy.
pub fn influence(arguments: &InfluenceArguments) -> Result<Outcome, Failure> {
    let case = Case::read(&arguments.case.path, &arguments.case.sets)?;
    let cache = cache::open();
    let model = case.model(&cache)?.value;
    cache::tell_warnings(&cache);
    let element_side =
        case.side(&model).map_err(|error| case.blame(error))? / case.grid.elements as f64;
    let row = |&offset: &[usize; 2]| {
        let coefficient = if arguments.direct {
            direct::coefficient(model.tables.foundation(), element_side, offset)?
        } else {
            model.tables.coefficient(element_side, offset)
        };
        Ok(CoefficientRow {
            offset,
            coefficient,
        })
    };
    let rows = arguments
        .offsets
        .iter()
        .map(row)
        .collect::<Result<Vec<_>, Failure>>()?;
    let text = if arguments.json {
        output::json(&rows)?
    } else {
        table(&rows, element_side, case.units)
    };
    terminal::print(&text)?;
    Ok(Outcome::Done)
}

fn table(rows: &[CoefficientRow], element_side: f64, units: Units) -> String {
    let (metre, metre_per_pascal) = (units.name("m"), units.name("m/Pa"));
    let coefficient = format!("k [{metre_per_pascal}]");
    let row = |row: &CoefficientRow| {
        let ([m, n], coefficient) = (row.offset, row.coefficient);
        format!("{m:>8}{n:>8}{coefficient:>26e}\n")
    };
    let rows: String = rows.iter().map(row).collect();
    format!(
        "element side {element_side:e} {metre}\n{:>8}{:>8}{coefficient:>26}\n{rows}",
        "m", "n"
    )
}
