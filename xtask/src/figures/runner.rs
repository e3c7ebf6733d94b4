//! Runs the paper's cases with the program itself. A solution that is not certified is an error.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use pellicle_cli::drawing::{Style, Subject, accuracy};
use pellicle_cli::results::{
    Fields, RunSummary, StepSummary, StoredFields, fields_file, read_summary,
};

use super::sheet::Caption;
use crate::XtaskError;

/// Elements along a side for final figures.
pub(super) const FULL: usize = 1024;
/// Elements along a side for quick figures.
pub(super) const QUICK: usize = 256;

/// The release build of `pellicle`, which cargo makes first.
const RELEASE: &str = "cargo run --release --quiet --bin pellicle --";

/// Options of every run, to be completed by the steps whose fields are written.
const OPTIONS: &str = "--force --pictures none --formats npz --fields";

/// The program, the cases it runs, and their grid.
#[derive(Debug, Clone)]
pub struct Runner {
    /// Root of the workspace, which holds `cases`.
    pub root: PathBuf,
    /// Folder of the results, with one folder per case.
    pub results: PathBuf,
    /// A program that takes the command line of `pellicle`, with its leading arguments.
    pub program: Vec<OsString>,
    /// Elements along a side of every grid; pictures with fewer than 1024 are marked as coarse.
    pub elements: usize,
    /// Receives progress messages.
    pub tell: fn(&str),
}

/// A certified loading step with its fields.
pub(super) struct SolvedStep {
    /// Name of its case, such as `fig2a`.
    pub case: &'static str,
    /// Folder of the results.
    pub folder: PathBuf,
    pub summary: RunSummary,
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
            program: RELEASE.split(' ').map(OsString::from).collect(),
            elements,
            tell,
        }
    }

    /// Solves a case, such as `cases/fig2a` or `cases/paper/fig4-soft-60`, with values replaced as by `--set`.
    ///
    /// # Errors
    /// [`XtaskError::NotCertified`] if a step is not, [`XtaskError::Refused`] if the program refuses the case, or any
    /// error in running it or reading its results.
    pub fn run(&self, case: &str, sets: &[&str]) -> Result<RunSummary, XtaskError> {
        self.solve(case, sets, "none")?;
        Ok(read_summary(&self.folder(case))?)
    }

    /// One step of a case, by its number, with its fields.
    pub(super) fn step(
        &self,
        case: &'static str,
        sets: &[&str],
        index: usize,
    ) -> Result<SolvedStep, XtaskError> {
        self.solve(case, sets, "all")?;
        let folder = self.folder(case);
        Ok(SolvedStep {
            case: name(case),
            summary: read_summary(&folder)?,
            index,
            stored: StoredFields::read(&folder.join(fields_file(index)))?,
            folder,
        })
    }

    /// A caption; a coarse picture is marked in its subtitle.
    pub(super) fn caption(
        &self,
        title: &'static str,
        subtitle: &str,
        notes: Vec<String>,
    ) -> Caption {
        let subtitle = format!("{}{subtitle}", self.mark());
        Caption {
            title,
            subtitle,
            notes,
        }
    }

    /// The mark of a coarse picture.
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

    /// Solves a case and writes the fields of these steps, `all` or `none`.
    fn solve(&self, case: &str, sets: &[&str], fields: &str) -> Result<(), XtaskError> {
        let elements = format!("grid.elements={}", self.elements);
        let sets = [&[elements.as_str()], sets].concat();
        let run = format!("{}, {}", name(case), sets.join(", "));
        (self.tell)(&format!("solve:  {run}"));
        let mut command = Command::new(&self.program[0]);
        command.current_dir(&self.root).args(&self.program[1..]);
        command.arg("run").arg(format!("{case}.toml"));
        command.arg("--out").arg(self.folder(case));
        command.args(OPTIONS.split(' ')).arg(fields);
        command.args(sets.iter().flat_map(|set| ["--set", set]));
        let ran = command.output().map_err(|cause| XtaskError::Start {
            program: self.program[0].clone().into(),
            cause,
        })?;
        match ran.status.code() {
            Some(0) => Ok(()),
            Some(1) => Err(XtaskError::NotCertified { run }),
            _ => {
                let message = String::from_utf8_lossy(&ran.stderr).trim().to_owned();
                Err(XtaskError::Refused { run, message })
            }
        }
    }
}

/// The last part of a case's path, such as `fig2a` for `cases/fig2a`.
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

    /// A note on its data: grid, certificate, grid error.
    pub(super) fn note(&self, name: &str) -> String {
        let elements = self.summary.grid.elements;
        format!("{name}: {}", accuracy::of_step(elements, self.numbers()))
    }

    /// The subject of a picture in the program's style.
    pub(super) fn subject<'a>(&'a self, title: &'a str) -> Subject<'a> {
        Subject {
            title,
            units: self.summary.units,
            relief_height: self.summary.relief_height(),
            step: self.numbers(),
            fields: self.fields(),
            style: Style::default(),
        }
    }
}
