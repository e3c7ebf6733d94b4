//! Runs the paper's cases with the program itself. A solution that is not certified is an error.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use pellicle::result::fields::Fields;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_cli::drawing::{accuracy, subject};
use pellicle_cli::results::{StoredFields, fields_file, read_summary};
use pellicle_plot::sheet::style::Style;
use pellicle_plot::step::subject::Subject;

use crate::XtaskError;
use crate::golden::release_program;

/// Elements along a side for final figures.
pub(super) const FULL: usize = 1024;
/// Elements along a side for quick figures.
pub(super) const QUICK: usize = 256;

/// Options of every run.
const OPTIONS: &str = "--force --pictures none --formats npz";

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

/// A case and the values replaced in it, as [`Runner::run`] takes them.
pub(super) type Case<'a> = (&'static str, &'a [&'a str]);

/// A certified loading step with its fields.
pub(super) struct SolvedStep {
    /// Name of its case, such as `fig2a`.
    pub case: &'static str,
    /// Its run.
    pub run: RunSummary,
    /// Its numbers.
    pub numbers: StepSummary,
    stored: StoredFields,
}

impl Runner {
    /// A runner of the release build, which cargo makes first.
    ///
    /// # Errors
    /// If the program cannot be built.
    pub fn release(root: &Path, elements: usize, tell: fn(&str)) -> Result<Self, XtaskError> {
        Ok(Self {
            root: root.into(),
            results: root.join("target/paper/runs"),
            program: vec![release_program(root)?.into()],
            elements,
            tell,
        })
    }

    /// The steps of these cases with their fields.
    pub(super) fn steps(&self, cases: &[Case<'_>]) -> Result<Vec<SolvedStep>, XtaskError> {
        let mut steps = Vec::new();
        for (case, sets) in cases {
            let run = self.run(case, sets, "all")?;
            for (i, numbers) in run.steps.iter().enumerate() {
                steps.push(SolvedStep {
                    case: name(case),
                    run: run.clone(),
                    numbers: numbers.clone(),
                    stored: StoredFields::read(&self.folder(case).join(fields_file(i)))?,
                });
            }
        }
        Ok(steps)
    }

    /// The text, preceded by a mark if the grids are coarse.
    pub(super) fn marked(&self, text: &str) -> String {
        match self.elements {
            FULL.. => text.into(),
            _ => format!("QUICK, COARSE GRIDS.  {text}"),
        }
    }

    /// The folder of a case's results.
    pub(super) fn folder(&self, case: &str) -> PathBuf {
        self.results.join(name(case))
    }

    /// Solves a case, such as `cases/fig2a` or `cases/paper/fig4-soft-60`, with values replaced as by `--set`, and
    /// writes the fields of `all` of its steps or of `none`.
    ///
    /// # Errors
    /// [`XtaskError::NotCertified`] if a step is not, [`XtaskError::Refused`] if the program refuses the case, or any
    /// error in running it or reading its results.
    pub fn run(&self, case: &str, sets: &[&str], fields: &str) -> Result<RunSummary, XtaskError> {
        let elements = format!("grid.elements={}", self.elements);
        let sets = [&[elements.as_str()], sets].concat();
        let run = format!("{}, {}", name(case), sets.join(", "));
        (self.tell)(&format!("solve:  {run}"));
        let mut command = Command::new(&self.program[0]);
        command.current_dir(&self.root).args(&self.program[1..]);
        command.arg("run").arg(format!("{case}.toml"));
        command.arg("--out").arg(self.folder(case));
        command.args(OPTIONS.split(' ')).args(["--fields", fields]);
        command.args(sets.iter().flat_map(|set| ["--set", set]));
        let ran = command.output().map_err(|cause| XtaskError::Start {
            program: self.program[0].clone().into(),
            cause,
        })?;
        match ran.status.code() {
            Some(0) => Ok(read_summary(&self.folder(case))?),
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
    /// Its fields, N × N values each, first index along x.
    pub(super) fn fields(&self) -> Fields<'_> {
        self.stored.fields(self.run.grid.side)
    }

    /// A note on its data: grid, certificate, grid error.
    pub(super) fn note(&self, name: &str) -> String {
        let accuracy = accuracy::of_step(&self.run.grid, &self.numbers);
        format!("{name}: {accuracy}")
    }

    /// The subject of a picture in the program's style.
    pub(super) fn subject(&self) -> Subject<'_> {
        let fields = self.stored.fields(self.run.grid.side);
        subject::of_step(&self.run, &self.numbers, &fields, Style::default())
    }
}
