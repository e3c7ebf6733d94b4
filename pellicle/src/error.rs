//! The reasons why a case cannot be read or solved.

use std::io;
use std::path::PathBuf;

use pellicle_contact::{ContactError, IndenterError};
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::TextureError;

use crate::display::memory;
use crate::input::clean::clean;
use crate::input::diagnosis::Diagnosis;

/// The reason why a case cannot be read or solved.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The case is wrong at one place in its text.
    #[error(transparent)]
    Case(#[from] Box<Diagnosis>),
    /// There is no such file, or it cannot be read.
    #[error("{}: cannot be read as a case file: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's error.
        cause: io::Error,
    },
    /// The kernel rejects the foundation.
    #[error("foundation: {0}")]
    Kernel(#[from] KernelError),
    /// The influence coefficients cannot be computed.
    #[error("influence coefficients: {0}")]
    Influence(#[from] InfluenceError),
    /// The relief is invalid.
    #[error("surface: {0}")]
    Texture(#[from] TextureError),
    /// The indenter is invalid.
    #[error("indenter: {0}")]
    Indenter(#[from] IndenterError),
    /// The contact problem cannot be posed or was cancelled.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// There is too little memory for the case.
    #[error("found {} for a case that needs {} of memory, wanted {}", memory(*available), memory(*needed), fitting_in_words(*fitting))]
    Memory {
        /// Memory needed, bytes.
        needed: u64,
        /// Memory available, bytes.
        available: u64,
        /// Elements per side with which the case would fit; 0 if none would.
        fitting: usize,
    },
    /// A value cannot be written as JSON.
    #[error("cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<Diagnosis> for Error {
    fn from(diagnosis: Diagnosis) -> Self {
        Self::Case(Box::new(diagnosis))
    }
}

impl Error {
    /// Whether the case is valid but could not be solved; otherwise something must be corrected first.
    #[must_use]
    pub fn is_unsolved(&self) -> bool {
        matches!(
            self,
            Self::Contact(
                ContactError::NotPositiveDefinite { .. } | ContactError::DomainTooSmall { .. },
            ) | Self::Influence(_)
        )
    }

    /// The error as shown on a terminal; a diagnosis shows its line of the case.
    #[must_use]
    pub fn render(&self) -> String {
        match self {
            Self::Case(diagnosis) => diagnosis.render(),
            Self::Contact(ContactError::DomainTooSmall { .. }) => {
                clean(&format!("Error: {self} (`grid.side`)"))
            }
            Self::Contact(ContactError::AveragingLength { .. }) => {
                clean(&format!("Error: {self} (`output.mean_pressure_over`)"))
            }
            other => clean(&format!("Error: {other}")),
        }
    }
}

/// Describes the change that would make a case fit in memory.
fn fitting_in_words(fitting: usize) -> String {
    match fitting {
        0 => "more memory".into(),
        elements => format!("fewer elements, such as grid.elements = {elements}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_larger_than_any_domain_is_reported_with_the_key_grid_side() {
        let error = Error::from(ContactError::DomainTooSmall {
            side: 2.0,
            trials: 100,
        });
        let message = error.render();
        assert!(
            message.trim_end().ends_with("give its side (`grid.side`)"),
            "{message}"
        );
        assert!(error.is_unsolved());
    }

    #[test]
    fn a_memory_error_states_the_largest_grid_that_fits() {
        let message = |fitting| {
            let (needed, available) = (2_000_000_000, 300_000_000);
            let error = Error::Memory {
                needed,
                available,
                fitting,
            };
            error.to_string()
        };
        assert_eq!(
            message(1024),
            "found 300 MB for a case that needs 2.0 GB of memory, \
             wanted fewer elements, such as grid.elements = 1024"
        );
        assert!(message(0).ends_with("wanted more memory"));
    }
}
