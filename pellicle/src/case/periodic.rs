//! The check that the other tables of a case are compatible with a periodic cell.

use super::indenter::IndenterCase;
use super::map::preparation::EdgesCase;
use super::map::{MapCase, Repetition};
use super::surface::{LatticeCase, SurfaceCase};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// The reason why a key is rejected.
const BECAUSE: &str = "with grid.boundary = \"periodic\"";
/// Relative difference allowed between lengths, for rounding in the user's numbers.
const LEEWAY: f64 = 1e-6;

/// Makes maps periodic, and rejects keys that are incompatible with a cell of this side (m).
///
/// # Errors
///
/// A [`Diagnosis`] of the first incompatible key.
pub fn fit(
    root: &TableReader<'_>,
    side: f64,
    surface: &mut SurfaceCase,
    indenter: &mut IndenterCase,
) -> Result<(), Diagnosis> {
    refuse_what_is_not_computed(root)?;
    if let SurfaceCase::Cylinders(cylinders) = surface {
        let count = side / cylinders.period;
        let fits = (count - count.round()).abs() <= LEEWAY * count && count > 0.5;
        if cylinders.lattice != LatticeCase::Square {
            return Err(unusable(root, "surface", &["lattice"], "\"square\""));
        }
        if !fits {
            let wanted = "a period that divides the side of the cell";
            return Err(unusable(root, "surface", &["period"], wanted));
        }
    }
    let repetition = indenter.repetition();
    let maps = [
        ("surface", surface.map_mut(), Repetition::InPlace),
        ("indenter", indenter.map_mut(), repetition),
    ];
    for (table, map, how) in maps {
        let Some(map) = map else { continue };
        if map
            .sides
            .iter()
            .any(|own| (own / side - 1.0).abs() > LEEWAY)
        {
            let wanted = format!("a map as large as the cell, {side:e} by {side:e} m");
            return Err(unusable(root, table, &["sides", "side", "file"], &wanted));
        }
        map.repeat(how);
    }
    Ok(())
}

/// Refuses maps of a free case whose edges would be changed for a cell.
///
/// # Errors
///
/// A [`Diagnosis`] of the first such map.
pub fn refuse_tapered(
    root: &TableReader<'_>,
    maps: [(&str, Option<&MapCase>); 2],
) -> Result<(), Diagnosis> {
    let is_tapered =
        |(_, map): &(&str, Option<&MapCase>)| map.is_some_and(|map| map.edges == EdgesCase::Taper);
    let Some((table, _)) = maps.into_iter().find(is_tapered) else {
        return Ok(());
    };
    let table = root.required(table, "")?.table()?;
    let edges = table.required("edges", "")?;
    Err(edges.unusable(&"without grid.boundary = \"periodic\"", "\"as measured\""))
}

fn refuse_what_is_not_computed(root: &TableReader<'_>) -> Result<(), Diagnosis> {
    if let Some(stress) = root.optional("stress") {
        return Err(stress.unusable(
            &BECAUSE,
            "no stresses: they are computed only for a single contact",
        ));
    }
    let Some(load) = root.optional("load") else {
        return Ok(());
    };
    let load = load.table()?;
    for key in ["penetration", "penetrations"] {
        if let Some(field) = load.optional(key) {
            let wanted = "force or forces on the cell: its mean displacement may be unbounded";
            return Err(field.unusable(&BECAUSE, wanted));
        }
    }
    match load.optional("sensitivities") {
        Some(field) if field.switch()? => Err(field.unusable(&BECAUSE, "false")),
        _ => Ok(()),
    }
}

/// Returns the diagnosis of the last of these keys that the table has.
fn unusable(root: &TableReader<'_>, table: &str, keys: &[&str], wanted: &str) -> Diagnosis {
    let inside = root.optional(table).and_then(|field| field.table().ok());
    let key = inside.as_ref().and_then(|table| {
        let mut given = keys.iter().filter_map(|key| table.optional(key));
        given
            .next_back()
            .map(|field| field.unusable(&BECAUSE, wanted))
    });
    key.unwrap_or_else(|| root.missing(table, wanted.to_owned()))
}
