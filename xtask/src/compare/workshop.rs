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
        create_folder(&results)?;
        let unwritable = |source| XtaskError::Write {
            path: results.clone(),
            source,
        };
        let scratch = TempDir::new_in(&results).map_err(unwritable)?;
        let mut prepared = |name: &str, requirements| {
            let folder = root.join(&arguments.environments).join(name);
            tell(&format!("environment of {name}"));
            let environment = Environment::prepare(&folder, &arguments.python, requirements);
            if let Ok(Environment::Missing(reason)) = &environment {
                tell(&format!("{name} is missing: {reason}"));
            }
            environment
        };
        let certificate = prepared("the-certificate", CERTIFICATE_REQUIREMENTS)?;
        let rivals = arguments
            .peers
            .iter()
            .map(|&rival| Ok((rival, prepared(&rival.to_string(), rival.requirements())?)));
        let rivals = rivals.collect::<Result<_, XtaskError>>()?;
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
        return Err(XtaskError::Build { status });
    }
    let name = format!("xtask{}", env::consts::EXE_SUFFIX);
    Ok(target.join("release").join(name))
}
