//! `[grid]`: the square domain and its elements.

use pellicle_contact::Boundary;
use serde::{Deserialize, Serialize};

use crate::declare::codec::Count;
use crate::declare::macros::record;
use crate::declare::{Codec, Scope, count, length, word};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// Default number of elements per side.
const DEFAULT_ELEMENTS: usize = 256;

/// More than 16,384² elements do not fit in the memory of a workstation: this many take 14 GB where symmetry reduces
/// the solution to a quadrant, at some 50 bytes each. The available memory is checked before the solution begins
/// (`forecast/need.rs`).
const ELEMENTS: std::ops::RangeInclusive<usize> = 1..=16_384;

record! {
    /// The grid of a case.
    #[derive(Copy)]
    pub struct GridCase {
        side: Option<f64> = length().positive().optional("chosen from the load"), "side of the square domain";
        elements: usize = per_side().or(DEFAULT_ELEMENTS, "256"), "elements per side";
        #[serde(skip_serializing_if = "BoundaryCase::is_free")]
        boundary: BoundaryCase = word(BOUNDARIES).or(BoundaryCase::Free, "\"free\""),
            "beyond the square: a surface without load, or the same square again";
    }
    check |grid: &GridCase, table: &TableReader<'_>, _: &Scope<'_>| {
        if grid.boundary == BoundaryCase::Periodic && grid.side.is_none() {
            return Err(table.missing("side", "the side of the periodic cell".to_owned()));
        }
        Ok(())
    };
}

const BOUNDARIES: &[(&str, BoundaryCase)] = &[
    ("free", BoundaryCase::Free),
    ("periodic", BoundaryCase::Periodic),
];

const fn per_side() -> Count {
    count(
        ELEMENTS,
        " per side (more do not fit in the memory of a workstation)",
    )
}

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
            elements: DEFAULT_ELEMENTS,
            boundary: BoundaryCase::Free,
        }
    }
}

impl GridCase {
    /// Area of the periodic cell, m², on which a nominal pressure acts; NaN for a free square, which has none.
    #[must_use]
    pub fn nominal_area(&self) -> f64 {
        let side = self.side.filter(|_| !self.boundary.is_free());
        side.map_or(f64::NAN, |side| side * side)
    }

    /// Reads only the elements per side.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the number is out of range.
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
