//! The reasons why a command ends early, and their exit codes.

use std::error::Error;
use std::io;
use std::iter;
use std::path::{Path, PathBuf};

use pellicle_contact::{ContactError, IndenterError};
use pellicle_identify::IdentifyError;
use pellicle_influence::InfluenceError;
use pellicle_kernel::KernelError;
use pellicle_texture::TextureError;

use crate::display::memory;
use crate::input::diagnosis::Diagnosis;
use crate::output::folder;
use crate::terminal::{NoOutput, clean};

/// The reason why a command ends early.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
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
    /// The relief is invalid.
    #[error("surface: {0}")]
    Texture(#[from] TextureError),
    /// The indenter is invalid.
    #[error("indenter: {0}")]
    Indenter(#[from] IndenterError),
    /// The contact problem cannot be posed or was cancelled.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A file or folder of that name exists.
    #[error("{}: found a file or folder of that name: give --force to replace it, or another --out", path.display())]
    Exists {
        /// The existing file or folder.
        path: PathBuf,
    },
    /// Something other than a results folder exists there; it is not touched.
    #[error("{}: found something other than a results folder: give another --out", path.display())]
    NoResults {
        /// The existing file or folder.
        path: PathBuf,
    },
    /// A file beside a run's summary has the name of one of the run's files but was not written by the run.
    #[error("{}: found a file that the run of the summary beside it did not write: move it away, or give another --out", path.display())]
    NotWritten {
        /// The file.
        path: PathBuf,
    },
    /// An option of `plot` that applies to a single results folder was given with several.
    #[error(
        "found several results, which are drawn as curves in one picture: --step, --section, --range and --colour-map are for a single one"
    )]
    OneResult,
    /// The folder holds no parts of a study.
    #[error("{}: found no parts of a study, wanted at least one", path.display())]
    NoParts {
        /// The folder.
        path: PathBuf,
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
    /// The file of a study's samples cannot be read, or a value in it is wrong.
    #[error("{}{place}: found {found}, wanted {wanted}", path.display())]
    Samples {
        /// The file.
        path: PathBuf,
        /// The position in the file, in words.
        place: String,
        /// The fault.
        found: String,
        /// The values allowed.
        wanted: String,
    },
    /// The environment names no task of a batch system.
    #[error("--shard auto: found {}, wanted the variables of a Slurm task, SLURM_ARRAY_TASK_ID, _COUNT and _MIN or SLURM_PROCID and SLURM_NTASKS", found.as_deref().unwrap_or("none"))]
    NoTask {
        /// The fault, if a variable is wrong.
        found: Option<String>,
    },
    /// A study has no cases.
    #[error("found no cases in the study, wanted at least one")]
    NoCases,
    /// The table belongs to a study with other values, or was written by another version of the program.
    #[error("{}: found results of another study or of another version: give --fresh to begin again, or another --out", path.display())]
    OtherStudy {
        /// The table.
        path: PathBuf,
    },
    /// The table of another study is where the merged one should be.
    #[error("{}: found the table of another study: give --force to replace it", path.display())]
    OtherTable {
        /// The table.
        path: PathBuf,
    },
    /// The results of another case are where those of a study's case should be.
    #[error("{}: found results of another case: give --fresh to begin again, or another --out", path.display())]
    OtherCase {
        /// The folder.
        path: PathBuf,
    },
    /// Something else is where the kept fields of a study should be.
    #[error("{}: found other fields than this study keeps: give --fresh to begin again, or move the file away", path.display())]
    NotKept {
        /// The file.
        path: PathBuf,
    },
    /// A field of one case is too large for the format.
    #[error(
        "study.keep: found {steps} loading steps of {elements} x {elements} elements, wanted at most 4 GiB of a field in a case: set output.fields = \"last\" to keep the last step alone"
    )]
    KeptTooLarge {
        /// Elements per side.
        elements: usize,
        /// Loading steps kept.
        steps: usize,
    },
    /// Another process is writing to a table or folder.
    #[error("{}: found another process writing to it: wait until it has ended", path.display())]
    Busy {
        /// The table or folder.
        path: PathBuf,
    },
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
    /// The model of a fit file has no curve.
    #[error("the measurement cannot be simulated: {0}")]
    NotSimulated(String),
    /// A curve of a plan cannot be solved.
    #[error("the curve cannot be planned: {0}")]
    NotPlanned(String),
    /// A fit cannot be posed, or has no start.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        cause: io::Error,
    },
    /// The cache's folder cannot be listed, or a file in it cannot be removed.
    #[error("{}: cannot be listed or cleared: {cause}", path.display())]
    Cache {
        /// The folder.
        path: PathBuf,
        /// The system's error.
        cause: io::Error,
    },
    /// A file of a results folder is missing or was not written by a run.
    #[error("{}: cannot be read as results: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
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
    /// A value cannot be written as JSON.
    #[error("cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A value cannot be written as TOML.
    #[error("cannot be written as TOML: {0}")]
    Toml(#[from] toml::ser::Error),
}

impl From<Diagnosis> for Failure {
    fn from(diagnosis: Diagnosis) -> Self {
        Self::Case(Box::new(diagnosis))
    }
}

impl Failure {
    /// Returns the failure to write a file or folder: where the user will look for it, and of its causes the system's.
    #[must_use]
    pub fn write(path: &Path, cause: io::Error) -> Self {
        let path = folder::visible(path);
        let of_system =
            causes(&cause).find_map(|cause| cause.downcast_ref::<io::Error>()?.raw_os_error());
        let cause = of_system.map_or(cause, io::Error::from_raw_os_error);
        Self::Write { path, cause }
    }

    /// Returns the failure of a results folder's file that is missing or was not written by a run.
    pub fn damaged(path: &Path, reason: &dyn std::fmt::Display) -> Self {
        Self::Damaged {
            path: path.to_owned(),
            reason: reason.to_string(),
        }
    }

    /// The exit code: 1 if a valid case could not be solved, 2 if something must be corrected first.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Contact(
                ContactError::NotPositiveDefinite { .. } | ContactError::DomainTooSmall { .. },
            )
            | Self::Influence(_)
            | Self::Inside(InfluenceError::Kernel(_)) => 1,
            _ => 2,
        }
    }

    /// The failure as shown on standard error; a diagnosis shows its line of the case.
    #[must_use]
    pub fn render(&self) -> String {
        match self {
            Self::Case(diagnosis) => diagnosis.render(),
            Self::Contact(ContactError::DomainTooSmall { .. }) => {
                clean(&format!("Error: {self} (`grid.side`)"))
            }
            other => clean(&format!("Error: {other}")),
        }
    }
}

/// The errors in an error, from the outermost on.
pub fn causes(error: &io::Error) -> impl Iterator<Item = &(dyn Error + 'static)> {
    iter::successors(Some(error as &(dyn Error + 'static)), cause_of)
}

/// The error within an error.
fn cause_of<'a>(error: &&'a (dyn Error + 'static)) -> Option<&'a (dyn Error + 'static)> {
    match error.downcast_ref::<io::Error>() {
        Some(error) => error.get_ref().map(|inner| inner as &(dyn Error + 'static)),
        None => (*error).source(),
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
        let failure = Failure::from(ContactError::DomainTooSmall {
            side: 2.0,
            trials: 100,
        });
        let message = failure.render();
        assert!(
            message.trim_end().ends_with("give its side (`grid.side`)"),
            "{message}"
        );
        assert_eq!(failure.exit_code(), 1);
    }

    #[test]
    fn a_failure_to_write_names_the_file_and_the_cause_of_the_system_alone() {
        let full = io::Error::from_raw_os_error(28);
        let words = full.to_string();
        let packed = zip::result::ZipError::Io(io::Error::other(full));
        let path = Path::new("results/a/.pellicle-run-x1/fields-000.npz");
        let failure = Failure::write(path, io::Error::other(packed));
        let wanted = format!("results/a/fields-000.npz: cannot be written: {words}");
        assert_eq!(failure.to_string(), wanted);
    }

    #[test]
    fn a_memory_error_states_the_largest_grid_that_fits() {
        let message = |fitting| {
            let (needed, available) = (2_000_000_000, 300_000_000);
            let failure = Failure::Memory {
                needed,
                available,
                fitting,
            };
            failure.to_string()
        };
        assert_eq!(
            message(1024),
            "found 300 MB for a case that needs 2.0 GB of memory, \
             wanted fewer elements, such as grid.elements = 1024"
        );
        assert!(message(0).ends_with("wanted more memory"));
    }
}
