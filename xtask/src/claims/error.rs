//! Why a claim could not be judged.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// Why the claims could not be read or computed.
#[derive(Debug, Error)]
pub enum ClaimsError {
    /// A file could not be read.
    #[error("cannot read {path}: {source}", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file of claims is not what it should be; the message holds line and column.
    #[error("the file of claims: {0}")]
    Syntax(#[from] toml::de::Error),
    /// A claim is incomplete or contradicts itself.
    #[error("the file of claims, line {line}, claim `{id}`: {problem}")]
    Claim {
        /// Its id.
        id: String,
        /// The line where it begins.
        line: usize,
        /// What was found and what is wanted.
        problem: String,
    },
    /// No claim has that name.
    #[error("no claim is called `{found}`; there are: {known}")]
    Unknown {
        /// The name given.
        found: String,
        /// The ids there are.
        known: String,
    },
    /// A case is not `NAME` or `NAME:STEP`.
    #[error("a case is called `{found}`, wanted is NAME or NAME:STEP")]
    Case {
        /// What was found.
        found: String,
    },
    /// Fields that do not fill their grid.
    #[error("a field holds {found} values, its grid wants {wanted}")]
    Fields {
        /// Elements of the grid.
        wanted: usize,
        /// Values of the field.
        found: usize,
    },
    /// A curve that cannot be judged.
    #[error(
        "a curve of {points} loads: at least three rising ones are wanted, with as many finite numbers of each kind"
    )]
    Curve {
        /// Its loads.
        points: usize,
    },
    /// A run whose result is not what its case should give.
    #[error("the result of {case} at N = {elements}: {problem}")]
    Result {
        /// The case.
        case: String,
        /// Elements per side.
        elements: usize,
        /// What is missing or wrong.
        problem: String,
    },
}
