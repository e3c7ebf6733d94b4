//! The runs of the program whose numbers are kept.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::outcome::Outcome;
use super::random_case::random_case;
use crate::XtaskError;

/// One start of the program.
#[derive(Debug)]
pub struct Run {
    /// Its name in the file, such as `cases/hertz`.
    pub name: String,
    /// The command line without the program.
    arguments: Vec<OsString>,
    /// A table that the run writes, read in place of standard output.
    table: Option<PathBuf>,
}

/// All runs, in the order of their names; files that they need are written to `scratch`.
pub fn all(root: &Path, scratch: &Path, random: u64) -> Result<Vec<Run>, XtaskError> {
    let mut runs = Vec::new();
    for folder in ["cases", "cases/paper"] {
        for file in toml_files(&root.join(folder))? {
            runs.push(json(&format!("{folder}/{}", stem(&file)), "run", &file));
        }
    }
    for seed in 0..random {
        let name = format!("random-{seed:03}");
        let file = scratch.join(&name).with_extension("toml");
        std::fs::write(&file, random_case(seed))
            .map_err(|cause| XtaskError::write(&file, cause))?;
        runs.push(json(&format!("random/{seed:03}"), "run", &file));
    }
    runs.push(Run {
        name: "validate".into(),
        arguments: ["validate", "--json"].map(OsString::from).to_vec(),
        table: None,
    });
    let inputs = root.join("xtask/golden");
    for file in toml_files(&inputs)? {
        let name = stem(&file);
        if name.ends_with("-fit") {
            runs.push(json(&format!("fits/{name}"), "identify", &file));
        } else {
            let out = scratch.join(&name);
            let mut run = json(&format!("studies/{name}"), "study", &file);
            run.arguments.extend(["--out".into(), out.clone().into()]);
            run.table = Some(out.join("results.csv"));
            runs.push(run);
        }
    }
    Ok(runs)
}

/// A run of a command on a file that prints JSON.
fn json(name: &str, command: &str, file: &Path) -> Run {
    Run {
        name: name.into(),
        arguments: vec![
            command.into(),
            file.into(),
            "--json".into(),
            "--threads".into(),
            "1".into(),
        ],
        table: None,
    }
}

impl Run {
    /// Runs the program and collects its numbers.
    pub fn outcome(&self, root: &Path, program: &[OsString]) -> Result<Outcome, XtaskError> {
        let mut command = Command::new(&program[0]);
        command.args(&program[1..]).args(&self.arguments);
        let ran = command
            .current_dir(root)
            .output()
            .map_err(|cause| XtaskError::Start {
                program: program[0].clone().into(),
                cause,
            })?;
        let table = self.table.as_ref();
        let table = table.map(|file| {
            std::fs::read_to_string(file).map_err(|cause| XtaskError::read(file, cause))
        });
        Ok(Outcome::of(&ran, table.transpose()?.as_deref()))
    }
}

fn stem(file: &Path) -> String {
    file.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into()
}

/// The TOML files of a folder, by name.
fn toml_files(folder: &Path) -> Result<Vec<PathBuf>, XtaskError> {
    let entries = std::fs::read_dir(folder).map_err(|cause| XtaskError::read(folder, cause))?;
    let paths: Result<Vec<PathBuf>, _> = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect();
    let mut paths = paths.map_err(|cause| XtaskError::read(folder, cause))?;
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    paths.sort();
    Ok(paths)
}
