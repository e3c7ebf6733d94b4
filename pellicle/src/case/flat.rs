//! The check of what a plane without end is pressed on.

use super::grid::{BoundaryCase, GridCase};
use super::indenter::IndenterCase;
use super::surface::SurfaceCase;
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// Rejects a plane on a body that it touches everywhere, or without end.
///
/// # Errors
///
/// A [`Diagnosis`] of `indenter.kind`.
pub fn check(
    root: &TableReader<'_>,
    surface: &SurfaceCase,
    indenter: &IndenterCase,
    grid: &GridCase,
) -> Result<(), Diagnosis> {
    if !indenter.is_flat() {
        return Ok(());
    }
    let is_free = grid.boundary == BoundaryCase::Free;
    let (reason, wanted) = match surface {
        SurfaceCase::Bare | SurfaceCase::Film(_) => (
            "a plane without end on a smooth body, whose contact has no edge",
            "kind = \"flat-punch\" with a radius, or a surface of kind \"rough\", \"map\", \"cylinders\", \"dimples\" or \"grooves\"",
        ),
        SurfaceCase::Cylinders(_) | SurfaceCase::Dimples(_) | SurfaceCase::Grooves(_)
            if is_free =>
        {
            (
                "a plane without end on a pattern without end, which no force presses",
                "grid.boundary = \"periodic\" with a force on one cell, or kind = \"flat-punch\" with a radius",
            )
        }
        SurfaceCase::Function(_) if is_free && grid.side.is_none() => (
            "a plane without end on a relief without end",
            "grid.side, the side of the square that it is pressed on",
        ),
        _ => return Ok(()),
    };
    let kind = root
        .required("indenter", "")?
        .table()?
        .required("kind", "")?;
    Err(kind.unusable(&reason, wanted))
}
