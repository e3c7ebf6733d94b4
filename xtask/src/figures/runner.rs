//! Runs cases of the paper by the program that users have. A solution that is not certified is an error.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use pellicle_cli::Case;
use pellicle_cli::drawing::accuracy;
use pellicle_cli::results::{
    Fields, SUMMARY_FILE, StepSummary, StoredFields, StressView, Summary, fields_file,
    read_stresses, stresses_file,
};

use crate::XtaskError;

/// Elements along a side for print.
pub(super) const FULL: usize = 1024;
/// Elements along a side for a look.
pub(super) const QUICK: usize = 256;

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

/// The domain of Fig. 2(c): the axes of all panels of Fig. 2 have one length, so smaller domains are widened to it.
const WIDER: &str = "grid.side=0.12";
const WIDENED: [&str; 2] = ["cases/fig2a", "cases/fig2b"];

/// The program, the cases it runs, and their grid.
#[derive(Debug, Clone)]
pub struct Runner {
    /// Root of the workspace, which holds `cases`.
    pub root: PathBuf,
    /// Folder of the results, one folder a case.
    pub results: PathBuf,
    /// A program that takes the command line of `pellicle`, and the arguments before that.
    pub program: Vec<OsString>,
    /// Elements along a side of every grid; pictures of fewer than 1024 say that they are coarse.
    pub elements: usize,
    /// Receives the progress.
    pub tell: fn(&str),
}

/// A certified loading step with its fields.
pub(super) struct SolvedStep {
    /// Name of its case, `fig2a`.
    pub case: &'static str,
    pub summary: Summary,
    index: usize,
    stored: StoredFields,
}

impl Runner {
    /// A runner of the release build.
    #[must_use]
    pub fn release(root: &Path, elements: usize, tell: fn(&str)) -> Self {
        Self {
            root: root.into(),
            results: root.join("target/paper/runs"),
            program: RELEASE.map(OsString::from).to_vec(),
            elements,
            tell,
        }
    }

    /// Solves a case, `cases/fig2a` or `cases/paper/fig4-soft-60`, with values replaced as `--set` takes them.
    ///
    /// # Errors
    /// [`XtaskError::NotCertified`] if a step is not, [`XtaskError::Refused`] if the program refuses the case, or
    /// whatever prevents running it or reading its results.
    pub fn run(&self, case: &'static str, sets: &[&str]) -> Result<Summary, XtaskError> {
        self.solve(case, sets, "none")
    }

    /// The step of this number of a case of figures 2, 3 and 5, with its fields.
    pub(super) fn step(&self, case: &'static str, index: usize) -> Result<SolvedStep, XtaskError> {
        let sets: &[&str] = if WIDENED.contains(&case) {
            &[WIDER]
        } else {
            &[]
        };
        let summary = self.solve(case, sets, "all")?;
        let stored = StoredFields::read(&self.folder(case).join(fields_file(index)))?;
        Ok(SolvedStep {
            case: name(case),
            summary,
            index,
            stored,
        })
    }

    /// The only step of a case of figure 2 with its stresses; `stress` asks for them as `--set` takes it.
    pub(super) fn stressed_step(
        &self,
        case: &'static str,
        stress: &str,
    ) -> Result<(SolvedStep, StressView), XtaskError> {
        let summary = self.solve(case, &[stress], "all")?;
        let stored = StoredFields::read(&self.folder(case).join(fields_file(0)))?;
        let view = read_stresses(&self.folder(case).join(stresses_file(0)))?;
        let step = SolvedStep {
            case: name(case),
            summary,
            index: 0,
            stored,
        };
        Ok((step, view))
    }

    /// The mark of a coarse picture, for its subtitle.
    pub(super) fn mark(&self) -> &'static str {
        if self.elements < FULL {
            "QUICK, COARSE GRIDS.  "
        } else {
            ""
        }
    }

    fn folder(&self, case: &str) -> PathBuf {
        self.results.join(name(case))
    }

    fn solve(&self, case: &str, sets: &[&str], fields: &str) -> Result<Summary, XtaskError> {
        let elements = format!("grid.elements={}", self.elements);
        let sets: Vec<_> = [elements.as_str()]
            .iter()
            .chain(sets)
            .map(|set| (*set).to_owned())
            .collect();
        let run = format!("{}, {}", name(case), sets.join(", "));
        (self.tell)(&format!("solve:  {run}"));
        let (file, folder) = (self.root.join(format!("{case}.toml")), self.folder(case));
        let mut command = Command::new(&self.program[0]);
        command.current_dir(&self.root).args(&self.program[1..]);
        command.arg("run").arg(&file).arg("--out").arg(&folder);
        command.args([
            "--force",
            "--pictures",
            "none",
            "--formats",
            "npz",
            "--fields",
            fields,
        ]);
        command.args(sets.iter().flat_map(|set| ["--set", set]));
        let ran = command.output().map_err(|source| XtaskError::Start {
            program: self.program[0].clone().into(),
            source,
        })?;
        match ran.status.code() {
            Some(0) => {}
            Some(1) => return Err(XtaskError::NotCertified { run }),
            _ => {
                let message = String::from_utf8_lossy(&ran.stderr).trim().to_owned();
                return Err(XtaskError::Refused { run, message });
            }
        }
        let path = folder.join(SUMMARY_FILE);
        let text = fs::read_to_string(&path).map_err(|source| XtaskError::Read { path, source })?;
        // The summary does not name its units; the case does.
        let summary = Summary::parse(&text, Case::read(&file, &sets)?.units)?;
        if summary.steps.is_empty() || summary.steps.iter().any(|s| !s.certificate.satisfied) {
            return Err(XtaskError::NotCertified { run });
        }
        Ok(summary)
    }
}

/// `fig2a` of `cases/fig2a`.
fn name(case: &str) -> &str {
    case.rsplit('/').next().unwrap_or(case)
}

impl SolvedStep {
    /// Its numbers.
    pub(super) fn numbers(&self) -> &StepSummary {
        &self.summary.steps[self.index]
    }

    /// Its fields, N × N values each, first index along x.
    pub(super) fn fields(&self) -> Fields<'_> {
        self.stored.fields(self.summary.grid.side)
    }

    /// The note on its data: grid, certificate, grid error.
    pub(super) fn note(&self, name: &str) -> String {
        let elements = self.summary.grid.elements;
        format!("{name}: {}", accuracy::of_step(elements, self.numbers()))
    }
}
