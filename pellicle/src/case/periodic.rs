//! The check that the other tables of a case are compatible with a periodic cell.

use pellicle_texture::{Lattice, RecessShape, Relief};

use super::foundation::FoundationCase;
use super::foundation::substrate::SubstrateCase;
use super::indenter::IndenterCase;
use super::map::preparation::EdgesCase;
use super::map::{MapCase, Repetition};
use super::surface::SurfaceCase;
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// The reason why a key is rejected.
const BECAUSE: &str = "with grid.boundary = \"periodic\"";
/// Relative difference allowed between lengths, for rounding in the user's numbers.
const LEEWAY: f64 = 1e-6;
/// Elements along x and y whose sides have nearly the ratio `1 : √3` of the cell of a hexagonal lattice, to 5.3e-5, and
/// the misfit allowed for it, over a side: a two-hundredth of an element of so many.
const HEXAGONAL: [u32; 2] = [56, 97];
const HEXAGONAL_LEEWAY: f64 = 6e-5;

/// Makes maps periodic, and rejects keys that are incompatible with a cell of these sides (m).
///
/// # Errors
///
/// A [`Diagnosis`] of the first incompatible key.
pub fn fit(
    root: &TableReader<'_>,
    foundation: &FoundationCase,
    sides: [f64; 2],
    surface: &mut SurfaceCase,
    indenter: &mut IndenterCase,
) -> Result<(), Diagnosis> {
    refuse_what_is_not_computed(root)?;
    if let Some(half_space) = half_space(foundation, indenter) {
        refuse_penetration(root, half_space)?;
    }
    refuse_pattern(root, surface, sides)?;
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
            .zip(sides)
            .any(|(own, side)| (own / side - 1.0).abs() > LEEWAY)
        {
            let ([x, y], own) = (sides, map.sides);
            let wanted = format!(
                "a map as large as the cell, {x:e} by {y:e} m, or a cell as large as the map: grid.sides = [{:e}, {:e}] for side",
                own[0], own[1]
            );
            return Err(unusable(root, table, &["file", "side", "sides"], &wanted));
        }
        map.repeat(how);
    }
    Ok(())
}

/// Rejects a pattern that does not continue from one cell to the next.
fn refuse_pattern(
    root: &TableReader<'_>,
    surface: &SurfaceCase,
    [x, y]: [f64; 2],
) -> Result<(), Diagnosis> {
    let Ok(relief) = surface.build() else {
        return Ok(());
    };
    let pattern = match &relief {
        Relief::Cylinders(cylinders) => Some(cylinders.pattern()),
        Relief::Recesses(recesses) => match recesses.shape() {
            RecessShape::Dimples(dimples) => Some(dimples.pattern()),
            RecessShape::Grooves(_) => None,
        },
        _ => None,
    };
    let hexagonal = pattern.filter(|pattern| pattern.lattice() == Lattice::Hexagonal);
    let leeway = hexagonal.map_or(LEEWAY, |_| HEXAGONAL_LEEWAY);
    let fits = |vector: [f64; 2], side: f64| {
        let misfit = relief.distance_to_translation(vector);
        misfit.is_none_or(|misfit| misfit <= leeway * side)
    };
    if fits([x, 0.0], x) && fits([0.0, y], y) {
        return Ok(());
    }
    if let Some(pattern) = hexagonal {
        let [along, across] = HEXAGONAL;
        let period = pattern.period();
        let longer = period * f64::from(across) / f64::from(along);
        let wanted = format!(
            "\"square\", or an oblong cell without rotation: grid.sides = [{period}, {longer}] m, or multiples of \
             them, and grid.elements = [{along}, {across}] times a whole number"
        );
        return Err(unusable(root, "surface", &["lattice"], &wanted));
    }
    let wanted = "a period that divides the sides of the cell, along the pattern's rotation";
    let keys = ["period", "area_fraction"];
    Err(unusable(root, "surface", &keys, wanted))
}

/// Rejects a nominal pressure on a square that does not repeat: the area on which it acts is that of the cell.
///
/// # Errors
///
/// A [`Diagnosis`] of its key.
pub fn refuse_nominal_pressure(root: &TableReader<'_>) -> Result<(), Diagnosis> {
    let Some(load) = root.optional("load") else {
        return Ok(());
    };
    let load = load.table()?;
    let given = ["pressure", "pressures"].map(|key| load.optional(key));
    match given.into_iter().flatten().next() {
        Some(field) => Err(field.unusable(
            &"with grid.boundary = \"free\"",
            "force or forces, or grid.boundary = \"periodic\": a free surface has no nominal area",
        )),
        None => Ok(()),
    }
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
    match load.optional("sensitivities") {
        Some(field) if field.switch()? => Err(field.unusable(&BECAUSE, "false")),
        _ => Ok(()),
    }
}

/// The half-space whose mean displacement in a cell is infinite, with what bounds it; none between rigid bases.
fn half_space(foundation: &FoundationCase, indenter: &IndenterCase) -> Option<&'static str> {
    match foundation.substrate {
        SubstrateCase::Elastic(_) => Some("the substrate's, unless it is \"rigid\""),
        SubstrateCase::Rigid => {
            let other = indenter.foundation()?;
            (other.substrate != SubstrateCase::Rigid).then_some("an elastic indenter's")
        }
    }
}

fn refuse_penetration(root: &TableReader<'_>, half_space: &str) -> Result<(), Diagnosis> {
    let Some(load) = root.optional("load") else {
        return Ok(());
    };
    let load = load.table()?;
    let given = ["penetration", "penetrations"].map(|key| load.optional(key));
    given.into_iter().flatten().next().map_or(Ok(()), |field| {
        let wanted = format!(
            "force or forces, or pressure or pressures: the mean displacement of a half-space is unbounded, here {half_space}"
        );
        Err(field.unusable(&BECAUSE, wanted))
    })
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
