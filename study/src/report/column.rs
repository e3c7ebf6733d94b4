//! A column of a study's table: numbers with their range, or words.

use pellicle::display::significant;
use serde::Serialize;

/// Most distinct words of a column; all others are drawn as one.
const MAX_WORDS: usize = 40;

/// The word for all others.
const OTHERS: &str = "others";

/// A column with a summary of all its cells.
#[derive(Debug, Serialize)]
pub struct StudyColumn {
    /// Its name, with the unit.
    pub name: String,
    /// Whether it is a varied key.
    is_key: bool,
    values: ColumnValues,
    /// Cells that are not empty.
    cells: usize,
}

/// The values of a column; its first cell decides their kind.
#[derive(Debug, Serialize)]
#[serde(rename_all = "lowercase")]
enum ColumnValues {
    /// No cell yet.
    Unknown,
    /// The smallest and the largest number.
    Numbers([f64; 2]),
    /// Distinct words, in the order of their first occurrence.
    Words(Vec<String>),
}

/// A column in the page's list.
pub struct ColumnRow {
    /// Its name.
    pub name: String,
    /// Whether it is a varied key.
    pub is_key: bool,
    /// Number of cells that are not empty.
    pub cells: usize,
    /// Its range or its words.
    pub values: String,
}

impl StudyColumn {
    /// Returns a column without cells.
    #[must_use]
    pub fn new(name: String, is_key: bool) -> Self {
        Self {
            name,
            is_key,
            values: ColumnValues::Unknown,
            cells: 0,
        }
    }

    /// Whether all its cells are empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cells == 0
    }

    /// Adds a cell. Returns its number or the index of its word; `None` if it is empty, or not a number in a column of
    /// numbers.
    pub fn add(&mut self, cell: &str) -> Option<f64> {
        if cell.is_empty() {
            return None;
        }
        self.cells += 1;
        let number = cell.parse().ok().filter(|number: &f64| number.is_finite());
        if let ColumnValues::Unknown = self.values {
            self.values = match number {
                Some(number) => ColumnValues::Numbers([number; 2]),
                None => ColumnValues::Words(Vec::new()),
            };
        }
        match &mut self.values {
            ColumnValues::Numbers([low, high]) => {
                let number = number?;
                (*low, *high) = (low.min(number), high.max(number));
                Some(rounded(number))
            }
            ColumnValues::Words(words) => Some(place(words, cell) as f64),
            ColumnValues::Unknown => None,
        }
    }

    /// Returns its line in the page's list.
    #[must_use]
    pub fn row(&self) -> ColumnRow {
        ColumnRow {
            name: self.name.clone(),
            is_key: self.is_key,
            cells: self.cells,
            values: match &self.values {
                ColumnValues::Unknown => String::new(),
                ColumnValues::Numbers([low, high]) if low.to_bits() == high.to_bits() => {
                    significant(*low, 5)
                }
                ColumnValues::Numbers([low, high]) => {
                    format!("{} to {}", significant(*low, 5), significant(*high, 5))
                }
                ColumnValues::Words(words) => words.join(", "),
            },
        }
    }
}

/// Returns the index of a word, adding it if it is new.
fn place(words: &mut Vec<String>, word: &str) -> usize {
    if let Some(place) = words.iter().position(|known| known == word) {
        return place;
    }
    if words.len() > MAX_WORDS {
        return MAX_WORDS;
    }
    let word = if words.len() == MAX_WORDS {
        OTHERS
    } else {
        word
    };
    words.push(word.to_owned());
    words.len() - 1
}

/// Rounds to six digits: more are not visible on a page and take twice the space.
fn rounded(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_cell_makes_a_column_numeric_or_text() {
        let mut numbers = StudyColumn::new("force [N]".into(), true);
        let found = ["", "2e-6", "1.23456789", "oops", "inf"].map(|cell| numbers.add(cell));
        assert_eq!(found, [None, Some(2e-6), Some(1.23457), None, None]);
        assert!(
            numbers.row().values.contains("to 1.2346"),
            "{}",
            numbers.row().values
        );
        let mut words = StudyColumn::new("kind".into(), false);
        let found = ["film", "bare", "film", "3"].map(|cell| words.add(cell));
        assert_eq!(found, [Some(0.0), Some(1.0), Some(0.0), Some(2.0)]);
        for i in 0..100 {
            words.add(&format!("w{i}"));
        }
        let ColumnValues::Words(all) = &words.values else {
            panic!("words")
        };
        assert_eq!((all.len(), &*all[MAX_WORDS]), (MAX_WORDS + 1, OTHERS));
    }
}
