//! The reasons why a command ends early, and their exit codes.

use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};

use pellicle::input::clean::clean;
use pellicle::input::diagnosis::Diagnosis;
use pellicle_contact::{ContactError, IndenterError};
use pellicle_files::FileError;
use pellicle_identify::IdentifyError;
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_study::StudyError;
use pellicle_texture::TextureError;

use crate::terminal::NoOutput;

/// The reason why a command ends early.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The case cannot be read or solved.
    #[error(transparent)]
    Case(#[from] pellicle::Error),
    /// A file or folder of results cannot be written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A study cannot be read, continued or merged.
    #[error(transparent)]
    Study(StudyError),
    /// The fields inside the body cannot be computed, at all or at that depth.
    #[error("fields inside the body: {0}")]
    Inside(InfluenceError),
    /// A point inside the rigid base.
    #[error("found a depth of {found:e}, wanted 0 to {bottom:e}, the depth of the rigid base")]
    InRigidBase {
        /// Its depth, m.
        found: f64,
        /// Depth of the rigid base, m.
        bottom: f64,
    },
    /// The case has no such loading step.
    #[error("found step {found} on the command line, wanted 0 to {last}, the steps of the case")]
    NoStep {
        /// The step.
        found: usize,
        /// The last step of the case.
        last: usize,
    },
    /// An option of `plot` that applies to a single results folder was given with several.
    #[error(
        "found several results, which are drawn as curves in one picture: --step, --section, --range and --colour-map are for a single one"
    )]
    OneResult,
    /// An option of `plot` that applies to a study or a search was given with other results.
    #[error(
        "found no study or search to draw: --result, --over, --as, --format, --width and --dpi are for the folder of one"
    )]
    OneStudy,
    /// A study that cannot be drawn as asked for.
    #[error("{message}")]
    StudyPicture {
        /// The fault, and what is wanted.
        message: String,
    },
    /// The fields of a loading step were not written.
    #[error("{}: found no fields of step {step} to draw: run the case with --fields all", path.display())]
    NoFields {
        /// The results folder.
        path: PathBuf,
        /// The loading step, counted from 0.
        step: usize,
    },
    /// A rough surface that cannot be made.
    #[error("{message}")]
    RoughSurface {
        /// The value found and the values allowed.
        message: String,
    },
    /// The environment names no task of a batch system.
    #[error("--shard auto: found {}, wanted the variables of a Slurm task, SLURM_ARRAY_TASK_ID, _COUNT and _MIN or SLURM_PROCID and SLURM_NTASKS", found.as_deref().unwrap_or("none"))]
    NoTask {
        /// The fault, if a variable is wrong.
        found: Option<String>,
    },
    /// No fit can be drafted from the measured curves.
    #[error(transparent)]
    Draft(#[from] pellicle_identify::draft::DraftError),
    /// A template that is not drafted from measured curves.
    #[error(
        "found --from with a template of a case, wanted fit, fit-afm or fit-unloading: pellicle init fit --from CURVE"
    )]
    NotDrafted,
    /// Curves of a fit file that give nothing when fitted alone; the others are written.
    #[error(
        "{failed} of {total} curves failed: their cause is in each.csv, with the results of the others"
    )]
    CurvesFailed {
        /// Number of curves that failed.
        failed: usize,
        /// Number of all curves.
        total: usize,
    },
    /// The model of a fit file has no curve.
    #[error("the measurement cannot be simulated: {0}")]
    NotSimulated(String),
    /// A curve of a plan cannot be solved.
    #[error("the curve cannot be planned: {0}")]
    NotPlanned(String),
    /// A fit cannot be posed, or has no start.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// The cache's folder cannot be listed, or a file in it cannot be removed.
    #[error("{}: cannot be listed or cleared: {cause}", path.display())]
    Cache {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        cause: io::Error,
    },
    /// The page of `explore` cannot be served.
    #[error("the page cannot be served: {cause}")]
    Page {
        /// The system's error.
        cause: io::Error,
    },
    /// Standard input cannot be read.
    #[error("standard input: cannot be read: {cause}")]
    Input {
        /// The system's error.
        cause: io::Error,
    },
    /// A line of standard input does not have the form that `solve --stream` reads.
    #[error("standard input, line {line}: found {found}, wanted {wanted}")]
    Line {
        /// The line, counted from 1.
        line: usize,
        /// The fault.
        found: String,
        /// The expected form.
        wanted: &'static str,
    },
    /// Standard output cannot be written to.
    #[error(transparent)]
    Output(#[from] NoOutput),
    /// The threads cannot be started.
    #[error("the threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A value cannot be written as TOML.
    #[error("cannot be written as TOML: {0}")]
    Toml(#[from] toml::ser::Error),
}

/// Failures that are those of a case.
macro_rules! of_a_case {
    ($($error:ty),*) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::Case(error.into())
            }
        }
    )*};
}

of_a_case!(
    Diagnosis,
    Box<Diagnosis>,
    KernelError,
    InfluenceError,
    TextureError,
    IndenterError,
    ContactError,
    serde_json::Error
);

/// The failure of a case or a file in a study is that of the case or file.
impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Case(error) => Self::Case(error),
            StudyError::File(error) => Self::File(error),
            other => Self::Study(other),
        }
    }
}

impl Failure {
    /// Returns the failure to write a file or folder: where the user will look for it, and of its causes the system's.
    #[must_use]
    pub fn write(path: &Path, cause: io::Error) -> Self {
        Self::File(FileError::write(path, cause))
    }

    /// Returns the failure of a results folder's file that is missing or was not written by a run.
    pub fn damaged(path: &Path, reason: &dyn Display) -> Self {
        Self::File(FileError::damaged(path, reason))
    }

    /// The exit code: 1 if a valid case could not be solved, 2 if something must be corrected first.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Case(error) if error.is_unsolved() => 1,
            Self::Inside(InfluenceError::Kernel(_)) => 1,
            _ => 2,
        }
    }

    /// The failure as shown on standard error; a diagnosis shows its line of the case.
    #[must_use]
    pub fn render(&self) -> String {
        match self {
            Self::Case(error) => error.render(),
            other => clean(&format!("Error: {other}")),
        }
    }
}
