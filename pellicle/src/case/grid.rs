//! `[grid]`: the domain and its elements.

mod square_elements;

use pellicle_contact::{Boundary, Domain};
use pellicle_texture::Grid;
use serde::{Deserialize, Serialize};

use self::square_elements::{Elements, per_side};
use crate::declare::macros::record;
use crate::declare::{Codec, Scope, length, pair, word};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// Default number of elements per side.
const DEFAULT_ELEMENTS: usize = 256;

record! {
    /// The grid of a case.
    #[derive(Copy)]
    pub struct GridCase {
        side: Option<f64> = length().positive().optional("chosen from the load"), "side of the square domain";
        #[serde(skip_serializing_if = "Option::is_none")]
        sides: Option<[f64; 2]> = pair(length().positive(), LENGTHS).optional("a square"),
            "lengths of an oblong periodic cell along x and y";
        elements: usize = Elements.or(DEFAULT_ELEMENTS, "256"),
            "elements per side: one number, in an oblong cell along the longer side, or those along x and y";
        #[serde(skip_serializing_if = "BoundaryCase::is_free")]
        boundary: BoundaryCase = word(BOUNDARIES).or(BoundaryCase::Free, "\"free\""),
            "beyond the domain: a surface without load, or the same cell again";
    }
    check |grid: &GridCase, table: &TableReader<'_>, _: &Scope<'_>| {
        if grid.boundary == BoundaryCase::Periodic && grid.longer_side().is_none() {
            return Err(table.missing("side", "the side of the periodic cell".to_owned()));
        }
        check_sides(grid, table)?;
        square_elements::check(grid, table)
    };
}

const LENGTHS: &str = "two positive lengths, [\"7.5 um\", \"10 um\"]";

/// Rejects sides beside a side, and those of a free window.
fn check_sides(grid: &GridCase, table: &TableReader<'_>) -> Result<(), Diagnosis> {
    let Some(sides) = table.optional("sides") else {
        return Ok(());
    };
    if grid.side.is_some() {
        return Err(sides.unusable(
            &"beside a side",
            "one of them: side of a square, sides of an oblong cell",
        ));
    }
    if grid.boundary.is_free() {
        let wanted =
            "side: only a periodic cell may be oblong, a free surface is solved on a square";
        return Err(sides.unusable(&"with grid.boundary = \"free\"", wanted));
    }
    Ok(())
}

const BOUNDARIES: &[(&str, BoundaryCase)] = &[
    ("free", BoundaryCase::Free),
    ("periodic", BoundaryCase::Periodic),
];

/// The boundary condition of the square.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BoundaryCase {
    /// Beyond the square the surface continues without load.
    #[default]
    Free,
    /// The square is a periodic cell.
    Periodic,
}

impl BoundaryCase {
    /// Whether the square is not periodic.
    #[must_use]
    pub fn is_free(&self) -> bool {
        *self == Self::Free
    }
}

impl From<BoundaryCase> for Boundary {
    fn from(boundary: BoundaryCase) -> Self {
        match boundary {
            BoundaryCase::Free => Self::Free,
            BoundaryCase::Periodic => Self::Periodic,
        }
    }
}

impl Default for GridCase {
    fn default() -> Self {
        Self {
            side: None,
            sides: None,
            elements: DEFAULT_ELEMENTS,
            boundary: BoundaryCase::Free,
        }
    }
}

impl GridCase {
    /// Area of the periodic cell, m², on which a nominal pressure acts; NaN for a free square, which has none.
    #[must_use]
    pub fn nominal_area(&self) -> f64 {
        match (self.boundary, self.sides, self.side) {
            (BoundaryCase::Periodic, Some([x, y]), _) => x * y,
            (BoundaryCase::Periodic, None, Some(side)) => side * side,
            _ => f64::NAN,
        }
    }

    /// The longer side, m; none if it is chosen from the load.
    #[must_use]
    pub fn longer_side(&self) -> Option<f64> {
        self.sides.map_or(self.side, |[x, y]| Some(x.max(y)))
    }

    /// Takes a side that was chosen from the load, m; sides that are given stay.
    pub fn take_side(&mut self, chosen: f64) {
        if self.sides.is_none() {
            self.side.get_or_insert(chosen);
        }
    }

    /// The sides along x and y, m; none if they are chosen from the load.
    #[must_use]
    pub fn both_sides(&self) -> Option<[f64; 2]> {
        self.sides.or(self.side.map(|side| [side; 2]))
    }

    /// The elements along x and y; none if they would not be square.
    #[must_use]
    pub fn lengths(&self) -> Option<[usize; 2]> {
        match self.sides {
            Some(sides) => Grid::lengths_of(sides, self.elements),
            None => Some([self.elements; 2]),
        }
    }

    /// The number of all elements.
    #[must_use]
    pub fn count(&self) -> usize {
        self.lengths().map_or(0, |[x, y]| x * y)
    }

    /// Elements per side of a trial: at most so many, if that leaves them square.
    #[must_use]
    pub fn at_most(&self, most: usize) -> usize {
        let Some(sides) = self.sides.filter(|_| self.elements > most) else {
            return self.elements.min(most);
        };
        let is_possible = |size: &usize| Grid::lengths_of(sides, *size).is_some();
        (1..=most).rev().find(is_possible).unwrap_or(self.elements)
    }

    /// The periodic cell; none for a free surface or without its sides.
    #[must_use]
    pub fn cell(&self) -> Option<Domain> {
        match (self.boundary, self.sides, self.side) {
            (BoundaryCase::Periodic, Some(sides), _) => Some(Domain::Oblong(sides)),
            (BoundaryCase::Periodic, None, Some(side)) => Some(Domain::Periodic(side)),
            _ => None,
        }
    }

    /// Reads only the elements per side of a square.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the number is out of range, or there are two.
    pub fn read_elements(table: &TableReader<'_>) -> Result<usize, Diagnosis> {
        let elements = per_side().or(DEFAULT_ELEMENTS, "");
        elements.take("elements", table, &Scope::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::Record;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<GridCase, String> {
        read_table(text, |table| GridCase::read(&table, &Scope::default()))
    }

    #[test]
    fn everything_has_a_default() {
        assert_eq!(read(""), Ok(GridCase::default()));
    }

    #[test]
    fn a_periodic_cell_requires_a_side() {
        let cell = read("side = 2\nboundary = \"periodic\"").unwrap();
        assert_eq!(cell.boundary, BoundaryCase::Periodic);
        let message = read("boundary = \"periodic\"").unwrap_err();
        assert!(
            message.contains("the side of the periodic cell"),
            "{message}"
        );
    }

    #[test]
    fn an_oblong_cell_has_sides_and_square_elements() {
        let cell = |text: &str| read(&format!("boundary = \"periodic\"\n{text}"));
        let wanted = cell("sides = [7.5, 10]\nelements = 128").unwrap();
        assert_eq!(wanted.lengths(), Some([96, 128]));
        assert_eq!(
            (wanted.longer_side(), wanted.nominal_area()),
            (Some(10.0), 75.0)
        );
        assert_eq!((wanted.at_most(64), wanted.at_most(63)), (64, 60));
        assert_eq!(cell("sides = [7.5, 10]\nelements = [96, 128]"), Ok(wanted));
        // 256 elements are the default.
        assert_eq!(
            cell("sides = [10, 7.5]").unwrap().lengths(),
            Some([256, 192])
        );
        for (text, near) in [
            (
                "sides = [7, 10]\nelements = 64",
                "such as [42, 60] or [49, 70]",
            ),
            (
                "sides = [7.5, 10]\nelements = [128, 128]",
                "m, such as [96, 128]",
            ),
        ] {
            let message = cell(text).unwrap_err();
            assert!(message.contains("key `elements`"), "{message}");
            assert!(message.contains("which are not square"), "{message}");
            assert!(message.ends_with(near), "{message}");
        }
        let message = cell("side = 2\nelements = [3, 4]").unwrap_err();
        assert!(message.contains("as many along y as along x"), "{message}");
        assert_eq!(cell("side = 2\nelements = [4, 4]").unwrap().elements, 4);
        let message = cell("side = 2\nsides = [1, 2]").unwrap_err();
        assert!(message.contains("beside a side"), "{message}");
        let message = read("sides = [1, 2]").unwrap_err();
        assert!(
            message.contains("key `sides`") && message.contains("only a periodic cell"),
            "{message}"
        );
    }

    #[test]
    fn grids_with_too_few_or_too_many_elements_are_rejected() {
        for elements in ["0", "16385", "-4", "1_000_000_000", "1e9", "nan"] {
            let message = read(&format!("side = 1\nelements = {elements}")).unwrap_err();
            let start = format!(
                "case.toml, line 2, key `elements`: found {elements}, wanted an integer from 1 to 16384"
            );
            assert!(message.starts_with(&start), "{message}");
        }
        assert!(read("side = 0").is_err());
        assert!(read("boundary = \"round\"").is_err());
        assert!(read("side = \"3 N\"").is_err());
    }
}
