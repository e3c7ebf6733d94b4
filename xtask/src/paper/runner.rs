//! Requests answered by the program, or from what it left before.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Instant;

use pellicle_cli::case::Case;
use pellicle_cli::output::{npz, record::Record, summary};
use tempfile::TempDir;

use super::request::digest;
use super::{Keep, PaperRun, Program, Request};
use crate::XtaskError;

/// The file that says which program solved which case with which values.
const IDENTITY: &str = "identity";

/// Runs cases of the workspace at `root` and keeps their results in a folder.
#[derive(Debug, Clone)]
pub struct Runner {
    root: PathBuf,
    results: PathBuf,
    program: Program,
}

impl Runner {
    /// A runner with the release build of the program, which keeps its results in `target/paper/runs`; `tell` hears that it
    /// is being built.
    ///
    /// # Errors
    /// Those of [`Program::build`].
    pub fn prepare(root: &Path, tell: &mut dyn FnMut(&str)) -> Result<Self, XtaskError> {
        tell("building pellicle");
        let results = root.join("target").join("paper").join("runs");
        Ok(Self::new(root, results, Program::build(root)?))
    }

    /// A runner with any program that takes the command line of `pellicle`.
    #[must_use]
    pub fn new(root: &Path, results: PathBuf, program: Program) -> Self {
        Self {
            root: root.into(),
            results,
            program,
        }
    }

    /// The result of a request: kept from an identical run of the same program, or solved now. `tell` hears which.
    ///
    /// # Errors
    /// [`XtaskError::NotCertified`] if a step is not, [`XtaskError::Refused`] if the program refuses the case, or whatever
    /// stands against starting it, reading or writing.
    pub fn run(
        &self,
        request: &Request,
        tell: &mut dyn FnMut(&str),
    ) -> Result<PaperRun, XtaskError> {
        let folder = self.results.join(request.folder());
        let identity = self.identity(request)?;
        let kept = fs::read_to_string(folder.join(IDENTITY));
        if kept.is_ok_and(|kept| kept == identity) {
            tell(&format!("kept:   {}", request.describe()));
        } else {
            tell(&format!("solve:  {} …", request.describe()));
            let clock = Instant::now();
            self.solve(request, &folder, &identity)?;
            let seconds = clock.elapsed().as_secs_f64();
            tell(&format!("solved: {} in {seconds:.1} s", request.describe()));
        }
        self.read(request, folder)
    }

    /// What a run is told from another by: program, case and values.
    fn identity(&self, request: &Request) -> Result<String, XtaskError> {
        let case = self.case_file(request);
        let text = fs::read_to_string(&case).map_err(|source| XtaskError::Read {
            path: case.clone(),
            source,
        })?;
        let overrides = request.overrides().join("\n");
        Ok(digest(&[self.program.digest(), &text, &overrides]))
    }

    fn case_file(&self, request: &Request) -> PathBuf {
        self.root.join(request.case.file())
    }

    /// Runs the program in a folder of its own; what is kept of it appears at once, and only if all of it is certified.
    fn solve(&self, request: &Request, folder: &Path, identity: &str) -> Result<(), XtaskError> {
        let written = |source| XtaskError::Write {
            path: folder.into(),
            source,
        };
        fs::create_dir_all(&self.results).map_err(written)?;
        let scratch = TempDir::with_prefix_in(".partial-", &self.results).map_err(written)?;
        let (out, kept) = (scratch.path().join("run"), scratch.path().join("kept"));
        let ran = self.execute(request, &out)?;
        check(request, &ran)?;
        fs::create_dir(&kept).map_err(written)?;
        fs::write(kept.join(summary::FILE), &ran.stdout).map_err(written)?;
        if request.keep == Keep::Fields {
            move_fields(&out, &kept).map_err(written)?;
        }
        fs::write(kept.join(IDENTITY), identity).map_err(written)?;
        replace(&kept, folder).map_err(written)
    }

    fn execute(&self, request: &Request, out: &Path) -> Result<Output, XtaskError> {
        let mut command = self.program.command();
        command
            .arg("run")
            .arg(self.case_file(request))
            .arg("--json");
        for set in request.overrides() {
            command.arg("--set").arg(set);
        }
        if request.keep == Keep::Fields {
            let fields = ["--fields", "all", "--formats", "npz", "--pictures", "none"];
            command.args(fields).arg("--out").arg(out);
        }
        start(&mut command, self.program.path())
    }

    fn read(&self, request: &Request, folder: PathBuf) -> Result<PaperRun, XtaskError> {
        let path = folder.join(summary::FILE);
        let text = fs::read_to_string(&path).map_err(|source| XtaskError::Read { path, source })?;
        // The summary does not name its units; the case does.
        let units = Case::read(&self.case_file(request), &request.overrides())?.units;
        let record = Record::parse(&text, units)?;
        check_certificates(request, &record)?;
        Ok(PaperRun::new(request.clone(), record, folder))
    }
}

fn start(command: &mut Command, program: &Path) -> Result<Output, XtaskError> {
    command.output().map_err(|source| XtaskError::Start {
        program: program.into(),
        source,
    })
}

/// Exit code 0, or why not; 1 means that the result is not certified.
fn check(request: &Request, ran: &Output) -> Result<(), XtaskError> {
    let run = request.describe();
    match ran.status.code() {
        Some(0) => Ok(()),
        Some(1) => Err(XtaskError::NotCertified { run }),
        _ => Err(XtaskError::Refused {
            run,
            message: String::from_utf8_lossy(&ran.stderr).trim().to_owned(),
        }),
    }
}

/// A second look, at the certificates themselves: none missing, none that is not satisfied.
fn check_certificates(request: &Request, record: &Record) -> Result<(), XtaskError> {
    let mut steps = record.steps.iter();
    if !record.steps.is_empty() && steps.all(|step| step.certificate.satisfied) {
        return Ok(());
    }
    Err(XtaskError::NotCertified {
        run: request.describe(),
    })
}

/// Moves the fields of every step from a results folder.
fn move_fields(from: &Path, to: &Path) -> std::io::Result<()> {
    for step in 0.. {
        let name = npz::file(step);
        if !from.join(&name).exists() {
            break;
        }
        fs::rename(from.join(&name), to.join(&name))?;
    }
    Ok(())
}

/// Puts a folder in the place of another.
fn replace(new: &Path, old: &Path) -> std::io::Result<()> {
    if old.exists() {
        fs::remove_dir_all(old)?;
    }
    fs::rename(new, old)
}
