//! What must stand before the first run: Pellicle built, an environment for each rival and one for the certificate.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

use super::environment::{Environment, create_folder};
use super::{CompareArguments, Rival};
use crate::XtaskError;

/// The hidden subcommand of xtask by which Pellicle runs in a process of its own.
const PELLICLE_COMMAND: &str = "pellicle";
/// What the certificate needs.
const CERTIFICATE_REQUIREMENTS: &[&[&str]] = &[&["numpy", "scipy"]];

/// Programs ready to run, and folders for what they write.
pub(super) struct Workshop {
    results: PathBuf,
    scratch: TempDir,
    pellicle: PathBuf,
    scripts: PathBuf,
    certificate: Environment,
    rivals: Vec<(Rival, Environment)>,
}

impl Workshop {
    /// Builds Pellicle in release and makes every environment that is not there yet.
    ///
    /// # Errors
    /// Pellicle not built; folders that cannot be written.
    pub(super) fn prepare(
        arguments: &CompareArguments,
        root: &Path,
        tell: &mut dyn FnMut(&str),
    ) -> Result<Self, XtaskError> {
        let results = root.join(&arguments.out);
        let scratch = scratch_in(&results)?;
        let mut prepare =
            |name: &str, list| prepare_environment(name, list, arguments, root, &mut *tell);
        let certificate = prepare("the-certificate", CERTIFICATE_REQUIREMENTS)?;
        let rivals = (arguments.peers.iter())
            .map(|rival| Ok((*rival, prepare(&rival.to_string(), rival.requirements())?)))
            .collect::<Result<_, XtaskError>>()?;
        tell("building Pellicle");
        Ok(Self {
            pellicle: build(root)?,
            scripts: root.join("xtask").join("compare"),
            results,
            scratch,
            certificate,
            rivals,
        })
    }

    /// Folder of the results.
    pub(super) fn results(&self) -> &Path {
        &self.results
    }

    /// A file for what a process writes; emptied with the workshop.
    pub(super) fn scratch(&self, name: &str) -> PathBuf {
        self.scratch.path().join(name)
    }

    /// Pellicle, without its arguments.
    pub(super) fn pellicle(&self) -> Command {
        let mut command = Command::new(&self.pellicle);
        command.arg(PELLICLE_COMMAND);
        command
    }

    /// A rival's driver, without its arguments; the reason if the rival is not installed.
    pub(super) fn driver(&self, rival: Rival) -> Result<Command, String> {
        let found = self
            .rivals
            .iter()
            .find(|(candidate, _)| *candidate == rival);
        match found {
            Some((_, environment)) => self.script(environment, rival.driver()),
            None => Err("not asked for".to_owned()),
        }
    }

    /// The certificate's script, without its arguments; the reason if Python or a package is missing.
    pub(super) fn certificate(&self) -> Result<Command, String> {
        self.script(&self.certificate, "certificate.py")
    }

    fn script(&self, environment: &Environment, file: &str) -> Result<Command, String> {
        match environment {
            Environment::Ready(python) => {
                let mut command = Command::new(python);
                // No compiled copies beside the sources.
                command.arg("-B").arg(self.scripts.join(file));
                Ok(command)
            }
            Environment::Missing(reason) => Err(reason.clone()),
        }
    }
}

/// A folder in that of the results which disappears with the workshop.
fn scratch_in(results: &Path) -> Result<TempDir, XtaskError> {
    create_folder(results)?;
    TempDir::new_in(results).map_err(|source| XtaskError::Write {
        path: results.into(),
        source,
    })
}

/// The environment `name`, with word of what is missing.
fn prepare_environment(
    name: &str,
    requirements: &[&[&str]],
    arguments: &CompareArguments,
    root: &Path,
    tell: &mut dyn FnMut(&str),
) -> Result<Environment, XtaskError> {
    tell(&format!("environment of {name}"));
    let folder = root.join(&arguments.environments).join(name);
    let environment = Environment::prepare(&folder, &arguments.python, requirements)?;
    if let Environment::Missing(reason) = &environment {
        tell(&format!("{name} is missing: {reason}"));
    }
    Ok(environment)
}

/// Builds xtask itself in release, which holds Pellicle's runner; its executable.
fn build(root: &Path) -> Result<PathBuf, XtaskError> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let target = root.join("target");
    let status = Command::new(&cargo)
        .current_dir(root)
        .args(["build", "--release", "--package", "xtask", "--target-dir"])
        .arg(&target)
        .status()
        .map_err(|source| XtaskError::Start {
            program: cargo.into(),
            source,
        })?;
    if !status.success() {
        return Err(XtaskError::Build {
            package: "xtask",
            status,
        });
    }
    let name = format!("xtask{}", env::consts::EXE_SUFFIX);
    Ok(target.join("release").join(name))
}
