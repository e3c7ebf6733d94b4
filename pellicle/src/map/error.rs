//! The reasons why a file is not a height map.

use std::io;

use super::grid_points::PointsError;

/// The fault of a map's file, as a clause that follows the name of the file.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// The file cannot be read.
    #[error("which cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// The file is too large.
    #[error("which is larger than {} MiB", largest >> 20)]
    TooLarge {
        /// The largest size, bytes.
        largest: u64,
    },
    /// The file name has an unknown extension.
    #[error("a file of the unknown kind \".{found}\"")]
    Ending {
        /// The extension, without its dot.
        found: String,
    },
    /// Not a NumPy array, or not a two-dimensional one of numbers.
    #[error("which is not a two-dimensional NumPy array of numbers: {0}")]
    Npy(String),
    /// Not text.
    #[error("which is not text: a byte in line {line} is not {encoding}")]
    NotText {
        /// The name of the encoding.
        encoding: String,
        /// Line, from 1.
        line: usize,
    },
    /// A profile, or a list of numbers.
    #[error("which holds {} of {lines} lines, a profile and no map", if *columns == 1 { "one column" } else { "two columns" })]
    Columns {
        /// Numbers on each line.
        columns: usize,
        /// Number of lines.
        lines: usize,
    },
    /// Points that form no grid.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// Coordinates or counts in a column or line at the rim.
    #[error(
        "whose {which} rises or falls in equal steps, as coordinates do, and the next does not: delete it if it is no heights, or let lines \"ncols\" and \"nrows\" above say that it is"
    )]
    Axis {
        /// `first column`, `last column` or `first line`.
        which: &'static str,
    },
    /// Points of a grid with more columns.
    #[error(
        "whose {columns} columns hold the points x, y, z of a grid and more: keep the columns of x, y and z alone"
    )]
    MoreThanPoints {
        /// Numbers on each line.
        columns: usize,
    },
    /// A word where a number should be.
    #[error("where line {line} holds \"{found}\", which is not a number")]
    NotANumber {
        /// Line, from 1.
        line: usize,
        /// The word.
        found: String,
    },
    /// A comma that is neither a decimal mark nor the separator.
    #[error(
        "where line {line} holds \"{found}\": next to semicolons or blanks a comma can only be a decimal mark, once in a number that has no point"
    )]
    Comma {
        /// Line, from 1.
        line: usize,
        /// The word.
        found: String,
    },
    /// Commas that may be decimal marks or separators.
    #[error(
        "where \"{found}\", like every other line, may be one number or two: write a decimal point; or end each line with a semicolon if the comma is a decimal mark; or put a blank after each comma that separates numbers"
    )]
    CommaOrPoint {
        /// The first line.
        found: String,
    },
    /// A line with a different count of numbers than the lines before.
    #[error("where line {line} holds {found} numbers and those before it {wanted}")]
    Ragged {
        /// Line, from 1.
        line: usize,
        /// Numbers on the line.
        found: usize,
        /// Numbers on the first line.
        wanted: usize,
    },
    /// Two maps in one file.
    #[error(
        "where line {line} begins a second map: a file holds one; if it is the same map, delete the line without numbers before it"
    )]
    Several {
        /// Line, from 1.
        line: usize,
    },
    /// No numbers.
    #[error("which holds no numbers")]
    Empty,
    /// Not a Gwyddion Simple Field.
    #[error("which does not begin with the line \"Gwyddion Simple Field 1.0\"")]
    NotGsf,
    /// A field of the header that is missing or invalid.
    #[error("whose header has {key} = {found}, not {wanted}")]
    Header {
        /// Its name.
        key: &'static str,
        /// Its value.
        found: String,
        /// The values wanted.
        wanted: &'static str,
    },
    /// Another number of numbers than the head states.
    #[error("which holds {found} numbers, and not {key} {said} as its head says")]
    Count {
        /// What the head gives: `ncols`, `nrows` or both.
        key: &'static str,
        /// The counts in the head.
        said: String,
        /// Numbers found.
        found: usize,
    },
    /// The counts of the head, exchanged.
    #[error(
        "which holds {columns} lines of {rows} numbers, though its head says ncols {columns} and nrows {rows}: exchange the two"
    )]
    Exchanged {
        /// `ncols`.
        columns: usize,
        /// `nrows`.
        rows: usize,
    },
    /// Another shape than the head tells.
    #[error("which holds {lines} lines of {columns} numbers, though its head says {key} {said}")]
    OtherShape {
        /// What the head gives.
        key: &'static str,
        /// Its value.
        said: String,
        /// Numbers on each line.
        columns: usize,
        /// Number of lines.
        lines: usize,
    },
    /// Fewer or more data than the header states.
    #[error("which holds {found} bytes of data, but its header says {wanted}")]
    DataSize {
        /// Bytes found.
        found: usize,
        /// Bytes wanted.
        wanted: usize,
    },
}

impl MapError {
    /// A line of a head with an impossible value, of which a message shows the beginning.
    pub(super) fn header(key: &'static str, found: &str, wanted: &'static str) -> Self {
        const SHOWN: usize = 40;
        Self::Header {
            key,
            found: found.chars().take(SHOWN).collect(),
            wanted,
        }
    }
}
