//! What the head of a text says about the shape of its map: how many numbers are in a row, and how many rows.

use super::error::MapError;
use super::map_file::MapFile;

/// The counts of a head.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Counts {
    /// Numbers in a row, and rows: lines may be wrapped anywhere.
    own: [Option<usize>; 2],
    /// The same by keys of other programs, which only confirm them.
    told: [Option<usize>; 2],
}

impl Counts {
    /// Reads a line of the head.
    ///
    /// # Errors
    ///
    /// [`MapError::Header`] for a count that is none.
    pub fn read(&mut self, key: &str, value: &str) -> Result<(), MapError> {
        const KEYS: [&[&str]; 2] = [
            &["x pixel", "nx", "xre", "samples/line", "column"],
            &["y pixel", "ny", "yre", "line", "row"],
        ];
        match key {
            "ncols" => self.own[0] = Some(count("ncols", value)?),
            "nrows" => self.own[1] = Some(count("nrows", value)?),
            _ => {
                for (keys, told) in KEYS.iter().zip(&mut self.told) {
                    if keys.contains(&key) {
                        *told = value.parse().ok().or(*told);
                    }
                }
            }
        }
        Ok(())
    }

    /// Numbers in a row of the picture: those of each line, or as the head says, however the lines are wrapped.
    ///
    /// # Errors
    ///
    /// [`MapError::Count`] if there are not as many numbers as the head says, [`MapError::Exchanged`] if all lines are
    /// alike and as many as there should be numbers on each.
    pub fn columns(
        &self,
        of_lines: usize,
        numbers: usize,
        are_alike: bool,
    ) -> Result<usize, MapError> {
        let said = match self.own {
            [Some(columns), Some(rows)]
                if are_alike
                    && columns != rows
                    && of_lines == rows
                    && numbers == columns * rows =>
            {
                return Err(MapError::Exchanged { columns, rows });
            }
            _ if numbers == 0 => return Err(MapError::Empty),
            [Some(columns), Some(rows)] => columns.checked_mul(rows),
            [Some(columns), None] => Some(numbers).filter(|all| all.is_multiple_of(columns)),
            [None, Some(rows)] => of_lines.checked_mul(rows),
            [None, None] => return Ok(of_lines),
        };
        if said == Some(numbers) {
            return Ok(self.own[0].unwrap_or(of_lines));
        }
        let words = |count: Option<usize>| count.map(|count| count.to_string());
        let [columns, rows] = self.own.map(words);
        let (key, said) = match (columns, rows) {
            (Some(columns), None) => ("ncols", columns),
            (None, rows) => ("nrows", rows.unwrap_or_default()),
            (Some(columns), Some(rows)) => ("ncols", format!("{columns} times nrows {rows}")),
        };
        Err(MapError::Count {
            key,
            said,
            found: numbers,
        })
    }

    /// Whether the head says how many numbers a row has.
    pub fn has_columns(&self) -> bool {
        self.own[0].is_some()
    }

    /// Whether the head says how many rows there are.
    pub fn has_rows(&self) -> bool {
        self.own[1].is_some()
    }

    /// Checks that they agree with a map; above points they may be those of their table.
    ///
    /// # Errors
    ///
    /// [`MapError::OtherShape`] for one that does not.
    pub fn check(&self, map: &MapFile) -> Result<(), MapError> {
        let [columns, lines] = map.shape;
        let found = [(columns, "columns"), (lines, "rows")];
        for (told, (found, key)) in self.told.iter().zip(found) {
            if let Some(told) = told.filter(|told| *told != found && !map.has_one_unit) {
                return Err(MapError::OtherShape {
                    key,
                    said: told.to_string(),
                    columns,
                    lines,
                });
            }
        }
        Ok(())
    }
}

fn count(key: &'static str, value: &str) -> Result<usize, MapError> {
    let count = value.parse().ok().filter(|count| *count > 0);
    count.ok_or_else(|| MapError::header(key, value, "a positive number"))
}
