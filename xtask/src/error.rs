//! What can go wrong before a rule is checked or a program compared.

use std::io;
use std::path::PathBuf;
use std::process::ExitStatus;

use pellicle_cli::failure::Failure;
use pellicle_contact::{ContactError, IndenterError};
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::TextureError;
use thiserror::Error;

use crate::ClaimsError;

/// Why a chore could not be done.
#[derive(Debug, Error)]
pub enum XtaskError {
    /// A file or folder could not be read.
    #[error("cannot read {path}: {source}", path = path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The root holds no `Cargo.toml`, so there is nothing to check.
    #[error("no Cargo.toml in {root}: not the root of a workspace", root = root.display())]
    NotAWorkspace {
        /// The folder that was given.
        root: PathBuf,
    },
    /// A file or folder could not be written.
    #[error("cannot write {path}: {source}", path = path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// A program could not be started or waited for.
    #[error("cannot run {program}: {source}", program = program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// A release build failed.
    #[error("cargo could not build {package} in release ({status})")]
    Build {
        /// What was built.
        package: &'static str,
        /// How cargo ended.
        status: ExitStatus,
    },
    /// A number of elements that whole periods of pillars do not fill.
    #[error("elements per side must be a positive multiple of {period}, got {found}")]
    Size {
        /// Elements per side found.
        found: usize,
        /// Elements per period of the pillars.
        period: usize,
    },
    /// A run of a case of the paper did not converge: nothing may be said from it.
    #[error("not certified: {run}: nothing is drawn or claimed from it")]
    NotCertified {
        /// The case, its elements and values.
        run: String,
    },
    /// The program refused a case of the paper.
    #[error("pellicle refused {run}: {message}")]
    Refused {
        /// The case, its elements and values.
        run: String,
        /// What the program said.
        message: String,
    },
    /// Results of a run that cannot be read.
    #[error(transparent)]
    Results(#[from] Failure),
    /// A claim that could not be judged.
    #[error(transparent)]
    Claims(#[from] ClaimsError),
    /// A material or foundation that cannot be.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// From the influence coefficients.
    #[error(transparent)]
    Influence(#[from] InfluenceError),
    /// A relief that cannot be.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// An indenter that cannot be.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// Pellicle refused the problem.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The threads of a run could not be started.
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A pressure could not be written.
    #[error(transparent)]
    Pressure(#[from] ndarray_npy::WriteNpyError),
    /// A result could not be written as JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}
