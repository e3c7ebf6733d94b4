//! Cases of the paper, solved by the program that users have; what is not certified is an error.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use pellicle_cli::Case;
use pellicle_cli::results::{SUMMARY_FILE, StepSummary, Summary};
use pellicle_cli::results::{StoredFields, fields_file};

use crate::XtaskError;

/// `pellicle` in release, which cargo builds first.
const RELEASE: [&str; 7] = [
    "cargo",
    "run",
    "--release",
    "--quiet",
    "--bin",
    "pellicle",
    "--",
];

/// Runs cases of the workspace at `root`, each in a folder of its own under `results`.
#[derive(Debug, Clone)]
pub struct Runner {
    root: PathBuf,
    results: PathBuf,
    program: Vec<OsString>,
}

/// A run whose every step is certified.
#[derive(Debug, Clone)]
pub struct PaperRun {
    /// The name of its case: `fig2a`, `fig4-soft-60`.
    pub case: &'static str,
    /// Its summary; the steps are in the order of the loads.
    pub summary: Summary,
    folder: PathBuf,
}

impl Runner {
    /// A runner of the release build.
    #[must_use]
    pub fn release(root: &Path) -> Self {
        let results = root.join("target").join("paper").join("runs");
        Self::new(root, results, &RELEASE)
    }

    /// A runner of any program that takes the command line of `pellicle` after these arguments.
    #[must_use]
    pub fn new(root: &Path, results: PathBuf, program: &[&str]) -> Self {
        let program = program.iter().map(OsString::from).collect();
        Self {
            root: root.into(),
            results,
            program,
        }
    }

    /// Solves a case, `cases/fig2a` or `cases/paper/fig4-soft-60`, with values replaced as `--set` takes them, and
    /// keeps the fields of every step if asked.
    ///
    /// # Errors
    /// [`XtaskError::NotCertified`] if a step is not, [`XtaskError::Refused`] if the program refuses the case, or
    /// whatever stands against starting it or reading its results.
    pub fn run(
        &self,
        case: &'static str,
        sets: &[String],
        fields: bool,
    ) -> Result<PaperRun, XtaskError> {
        let name = case.rsplit('/').next().unwrap_or(case);
        let described = format!("{name}, {}", sets.join(", "));
        let (file, folder) = (
            self.root.join(format!("{case}.toml")),
            self.results.join(name),
        );
        let mut command = Command::new(&self.program[0]);
        command.current_dir(&self.root).args(&self.program[1..]);
        command.arg("run").arg(&file).args(["--force", "--out"]);
        command.arg(&folder).args(["--pictures", "none"]);
        command.args(["--fields", if fields { "all" } else { "none" }]);
        command.args(["--formats", "npz"]);
        command.args(sets.iter().flat_map(|set| ["--set", set]));
        let ran = command.output().map_err(|source| XtaskError::Start {
            program: self.program[0].clone().into(),
            source,
        })?;
        match ran.status.code() {
            Some(0) => {}
            Some(1) => return Err(XtaskError::NotCertified { run: described }),
            _ => {
                let message = String::from_utf8_lossy(&ran.stderr).trim().to_owned();
                return Err(XtaskError::Refused {
                    run: described,
                    message,
                });
            }
        }
        let path = folder.join(SUMMARY_FILE);
        let text = fs::read_to_string(&path).map_err(|source| XtaskError::Read { path, source })?;
        // The summary does not name its units; the case does.
        let summary = Summary::parse(&text, Case::read(&file, sets)?.units)?;
        if summary.steps.is_empty() || summary.steps.iter().any(|s| !s.certificate.satisfied) {
            return Err(XtaskError::NotCertified { run: described });
        }
        Ok(PaperRun {
            case: name,
            summary,
            folder,
        })
    }
}

impl PaperRun {
    /// The loading steps.
    #[must_use]
    pub fn steps(&self) -> &[StepSummary] {
        &self.summary.steps
    }

    /// The last loading step, the only one of a case with a single load.
    ///
    /// # Panics
    /// Never: a run without steps is refused when it is read.
    #[must_use]
    pub fn last(&self) -> &StepSummary {
        self.steps().last().expect("a run has a step")
    }

    /// Side of the square domain, in the case's unit of length.
    #[must_use]
    pub fn side(&self) -> f64 {
        self.summary.grid.side
    }

    /// The largest line of the certificate over all steps.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let worst = self.steps().iter().map(|step| step.certificate.worst);
        worst.fold(0.0, f64::max)
    }

    /// The fields of a step: N × N values each, first index along x.
    ///
    /// # Errors
    /// [`XtaskError::Results`] if they were not kept or the file is damaged.
    pub fn fields(&self, step: usize) -> Result<StoredFields, XtaskError> {
        Ok(StoredFields::read(&self.folder.join(fields_file(step)))?)
    }
}
