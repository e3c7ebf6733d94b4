//! Why the program ends without a certified result, and the exit code that says so.

use std::io;
use std::path::PathBuf;

use pellicle_contact::ContactError;
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::TextureError;

use crate::case::diagnosis::Diagnosis;

/// Everything that ends a command early.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The case is wrong, at one place in its text.
    #[error(transparent)]
    Case(#[from] Box<Diagnosis>),
    /// There is no such file, or it cannot be read.
    #[error("{}: cannot be read as a case file: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// The kernel refuses the foundation.
    #[error("the foundation is refused: {0}")]
    Kernel(#[from] KernelError),
    /// The influence coefficients cannot be computed.
    #[error("no influence coefficients for this foundation: {0}")]
    Influence(#[from] InfluenceError),
    /// The relief is refused.
    #[error("the surface is refused: {0}")]
    Texture(#[from] TextureError),
    /// The contact problem cannot be posed or was cancelled.
    #[error(transparent)]
    Contact(#[from] ContactError),
}

impl From<Diagnosis> for Failure {
    fn from(diagnosis: Diagnosis) -> Self {
        Self::Case(Box::new(diagnosis))
    }
}

impl Failure {
    /// The failure as it is shown on standard error: one diagnosis, drawn where there is a place for it.
    #[must_use]
    pub fn render(&self) -> String {
        match self {
            Self::Case(diagnosis) => diagnosis.render(),
            other => format!("Error: {other}"),
        }
    }
}
