//! `[grid]`: the square domain and its elements.

use serde::Serialize;

use super::diagnosis::Diagnosis;
use super::dimension::Dimension;
use super::table_reader::TableReader;
use super::value_reader::Sign;

/// Elements per side unless given.
const DEFAULT_ELEMENTS: usize = 256;

/// More than 8192² elements are beyond the memory of a workstation: at some 240 bytes each, these take 16 GB.
const ELEMENTS: std::ops::RangeInclusive<usize> = 1..=8192;

/// The grid of a case.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GridCase {
    /// Side of the square domain, m; none if it is to be chosen from the load.
    pub side: Option<f64>,
    /// Elements per side.
    pub elements: usize,
}

impl Default for GridCase {
    fn default() -> Self {
        Self {
            side: None,
            elements: DEFAULT_ELEMENTS,
        }
    }
}

impl GridCase {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&["side", "elements"])?;
        let side = (table.optional("side"))
            .map(|field| field.quantity(Dimension::Length, Sign::Positive))
            .transpose()?;
        let why = " per side (more do not fit in the memory of a workstation)";
        let elements = (table.optional("elements"))
            .map_or(Ok(DEFAULT_ELEMENTS), |field| field.count(ELEMENTS, why))?;
        Ok(Self { side, elements })
    }
}

#[cfg(test)]
mod tests {
    use super::super::table_reader::tests::read_table;
    use super::*;

    fn read(text: &str) -> Result<GridCase, String> {
        read_table(text, |table| GridCase::read(&table))
    }

    #[test]
    fn everything_has_a_default() {
        assert_eq!(read(""), Ok(GridCase::default()));
    }

    #[test]
    fn grids_without_elements_or_beyond_memory_are_refused() {
        for elements in ["0", "8193", "-4", "1_000_000_000", "1e9", "nan"] {
            let message = read(&format!("side = 1\nelements = {elements}")).unwrap_err();
            let start = format!(
                "case.toml, line 2, key `elements`: found {elements}, wanted an integer from 1 to 8192"
            );
            assert!(message.starts_with(&start), "{message}");
        }
        assert!(read("side = 0").is_err());
        assert!(read("side = \"3 N\"").is_err());
    }
}
