//! `pellicle influence`: one loaded element of the case's own grid, on the surface and inside.

mod inside;

use pellicle::case::Case;
use pellicle::input::units::Units;
use pellicle_contact::Model;
use pellicle_files::json;
use pellicle_influence::{ElasticBody, direct};
use serde::Serialize;

use crate::arguments::InfluenceArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::{cache, terminal};

/// The coefficient at one offset.
#[derive(Debug, Clone, Copy, Serialize)]
struct CoefficientRow {
    /// Distance in elements along x and y.
    offset: [isize; 2],
    /// Displacement there under unit pressure on one element, m/Pa.
    coefficient: f64,
}

/// Prints a row for each offset, or for each offset at each depth.
///
/// # Errors
///
/// [`Failure`] if the case cannot be read or a coefficient cannot be computed to its accuracy.
pub fn influence(arguments: &InfluenceArguments) -> Result<Outcome, Failure> {
    let case = Case::read(&arguments.case.path, &arguments.case.sets)?;
    let cache = cache::open();
    let model = case.model(&cache)?.value;
    cache::report_warnings(&cache);
    let element_side =
        case.side(&model).map_err(|error| case.blame(error))? / case.grid.elements as f64;
    let text = if arguments.depths.is_empty() {
        let rows = coefficients(&model, element_side, arguments)?;
        if arguments.json {
            json(&rows)?
        } else {
            table(&rows, element_side, case.units)
        }
    } else {
        let foundation = model.tables.foundation();
        let rows = inside::rows(foundation, &case.foundation, element_side, arguments)?;
        if arguments.json {
            json(&rows)?
        } else {
            inside::table(&rows, case.units)
        }
    };
    terminal::print(&text)?;
    Ok(Outcome::Done)
}

fn coefficients(
    model: &Model,
    element_side: f64,
    arguments: &InfluenceArguments,
) -> Result<Vec<CoefficientRow>, Failure> {
    let row = |&offset: &[isize; 2]| {
        // Coefficients are the same on all sides of the element.
        let distance = offset.map(isize::unsigned_abs);
        let coefficient = if arguments.direct {
            direct::coefficient(model.tables.foundation(), element_side, distance)?
        } else {
            let of = ElasticBody::Foundation;
            model.tables.coefficient_of(of, element_side, distance)
        };
        Ok(CoefficientRow {
            offset,
            coefficient,
        })
    };
    arguments.offsets.iter().map(row).collect()
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
