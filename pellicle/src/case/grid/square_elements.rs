//! `elements`: square elements along one side or both, and the numbers of them that given sides allow.

use pellicle_texture::Grid;

use super::GridCase;
use crate::declare::codec::Count;
use crate::declare::{Codec, Scope, Shape, count, pair};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree::TomlValue;
use crate::input::value_reader::ValueReader;

/// More than 16,384² elements do not fit in the memory of a workstation: this many take 14 GB where symmetry reduces
/// the solution to a quadrant, at some 50 bytes each. The available memory is checked before the solution begins
/// (`forecast/need.rs`).
const ELEMENTS: std::ops::RangeInclusive<usize> = 1..=16_384;

/// Elements per side, as one number or along x and y; of two the larger.
#[derive(Debug, Clone, Copy)]
pub struct Elements;

impl Elements {
    fn pair(value: &ValueReader<'_>) -> Result<[usize; 2], Diagnosis> {
        let wanted = "an integer, or two along x and y";
        pair(per_side(), wanted).read(value, &Scope::default())
    }
}

impl Codec for Elements {
    type Out = usize;

    fn shape(&self) -> Shape {
        let one = per_side().shape();
        Shape::Either(vec![one.clone(), Shape::List(Box::new(one), Some(2))])
    }

    fn wanted(&self) -> String {
        per_side().wanted()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<usize, Diagnosis> {
        if let TomlValue::List(_) = value.value() {
            let [x, y] = Self::pair(value)?;
            return Ok(x.max(y));
        }
        per_side().read(value, scope)
    }
}

/// One number of elements.
pub const fn per_side() -> Count {
    count(
        ELEMENTS,
        " per side (more do not fit in the memory of a workstation)",
    )
}

/// Rejects elements that are not square.
///
/// # Errors
///
/// A [`Diagnosis`] with numbers near them that would be.
pub fn check(grid: &GridCase, table: &TableReader<'_>) -> Result<(), Diagnosis> {
    let Some(elements) = table.optional("elements") else {
        return match grid.lengths() {
            Some(_) => Ok(()),
            None => Err(table.missing("elements", squares(grid))),
        };
    };
    let found = grid.lengths();
    let given = match elements.value() {
        TomlValue::List(_) => Elements::pair(&elements)?,
        _ => found.unwrap_or_default(),
    };
    if found == Some(given) {
        Ok(())
    } else {
        Err(elements.unusable(&"which are not square", squares(grid)))
    }
}

/// The numbers of square elements that the sides allow, in words.
fn squares(grid: &GridCase) -> String {
    let Some(sides) = grid.sides else {
        return "as many along y as along x, or sides of an oblong periodic cell".to_owned();
    };
    let possible = |size: usize| Grid::lengths_of(sides, size);
    let fewer = (1..=grid.elements).rev().find_map(possible);
    let more = (grid.elements..=*ELEMENTS.end()).find_map(possible);
    let near = fewer.into_iter().chain(more);
    let mut near: Vec<_> = near.map(|[x, y]| format!("[{x}, {y}]")).collect();
    // The same if only the other number is wrong.
    near.dedup();
    if near.is_empty() {
        return "sides that whole numbers of square elements divide".to_owned();
    }
    format!(
        "whole numbers of square elements along {:e} and {:e} m, such as {}",
        sides[0],
        sides[1],
        near.join(" or ")
    )
}
