//! One start of the program in a folder of its own.

use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;

use super::files::{self, Files};
use super::outcome::{self, Outcome};
use crate::XtaskError;

/// A file that a run finds in its folder, by its path from there.
pub type InputFile = (String, Arc<[u8]>);

/// One start of the program.
#[derive(Debug, Clone)]
pub struct Run {
    /// Its name, such as `cases/hertz`.
    pub name: String,
    /// The command line without the program.
    pub line: Vec<String>,
    /// The files in its folder.
    pub files: Vec<InputFile>,
    /// What it finds on standard input.
    pub stdin: String,
    /// The file or folder that it writes, from its own folder, and what is kept of it.
    pub out: Option<(String, Files)>,
}

impl Run {
    /// A run without input on standard input, of which only what it prints is kept.
    pub fn new(name: &str, line: &[&str], files: Vec<InputFile>) -> Self {
        Self {
            name: name.into(),
            line: line.iter().map(|&word| word.into()).collect(),
            files,
            stdin: String::new(),
            out: None,
        }
    }

    /// A hash of all that the run is given: if it differs, so may everything else.
    pub fn input(&self) -> String {
        let parts = self
            .files
            .iter()
            .flat_map(|(name, bytes)| [name.as_bytes(), bytes]);
        let words = self.line.iter().map(String::as_bytes);
        let all: Vec<&[u8]> = parts.chain(words).chain([self.stdin.as_bytes()]).collect();
        files::hash(&all.join(&0))
    }
}

/// What all runs have in common.
#[derive(Debug, Clone, Copy)]
pub struct Starter<'a> {
    /// The program with its leading arguments.
    pub program: &'a [OsString],
    /// Number of threads of each run.
    pub threads: usize,
    /// The folder in which each run gets its own.
    pub scratch: &'a Path,
}

impl Starter<'_> {
    /// Runs the program and collects its values.
    pub fn outcome(&self, run: &Run) -> Result<Outcome, XtaskError> {
        let folder = self.scratch.join(run.name.replace('/', "-"));
        for (name, bytes) in &run.files {
            let path = folder.join(name);
            let made = fs::create_dir_all(path.parent().unwrap_or(&folder));
            let written = made.and_then(|()| fs::write(&path, bytes));
            written.map_err(|cause| XtaskError::write(&path, cause))?;
        }
        fs::create_dir_all(&folder).map_err(|cause| XtaskError::write(&folder, cause))?;
        let ran = self
            .start(run, &folder)
            .map_err(|cause| XtaskError::start(Path::new(&self.program[0]), cause))?;
        let mut outcome = outcome::of(&ran);
        outcome.insert("input".into(), run.input().into());
        if let Some((out, kept)) = &run.out {
            outcome.extend(files::values(&folder.join(out), *kept)?);
        }
        fs::remove_dir_all(&folder).map_err(|cause| XtaskError::write(&folder, cause))?;
        Ok(outcome)
    }

    /// Its environment has no cache of coefficients, so that every build computes its own.
    fn start(&self, run: &Run, folder: &Path) -> std::io::Result<Output> {
        let mut command = Command::new(&self.program[0]);
        command.args(&self.program[1..]).args(&run.line);
        command.current_dir(folder);
        command.env("PELLICLE_CACHE", "").env("NO_COLOR", "1");
        command.env("RAYON_NUM_THREADS", self.threads.to_string());
        command.stdin(Stdio::piped());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn()?;
        if let Some(mut stdin) = child.stdin.take() {
            // A run that reads nothing may have ended before.
            let _ = stdin.write_all(run.stdin.as_bytes());
        }
        child.wait_with_output()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_the_input_changes_its_hash() {
        let file = |text: &str| vec![("a".to_owned(), text.as_bytes().into())];
        let run = Run::new("x", &["run", "a"], file("1"));
        let same = Run::new("another name", &["run", "a"], file("1"));
        assert_eq!(run.input(), same.input());
        let with_stdin = Run {
            stdin: "1".into(),
            ..run.clone()
        };
        for other in [
            Run::new("x", &["run", "a"], file("2")),
            Run::new("x", &["runa"], file("1")),
            with_stdin,
        ] {
            assert_ne!(run.input(), other.input());
        }
    }
}
