//! `pellicle init`: a commented case that runs as it is.

use std::io::Write;
use std::path::Path;

use crate::arguments::InitArguments;
use crate::failure::Failure;
use crate::program::Outcome;
use crate::templates::Template;
use crate::{output, terminal};

/// Prints the template, or writes it to a new file.
///
/// # Errors
///
/// [`Failure`] if the file exists or cannot be written.
pub fn init(arguments: &InitArguments) -> Result<Outcome, Failure> {
    match &arguments.out {
        Some(path) => write(path, arguments.kind, arguments.force)?,
        None => terminal::print(arguments.kind.text())?,
    }
    Ok(Outcome::Done)
}

fn write(path: &Path, kind: Template, force: bool) -> Result<(), Failure> {
    if path.exists() && !force {
        let path = path.to_owned();
        return Err(Failure::Exists { path });
    }
    output::file::write_whole(path, |file| file.write_all(kind.text().as_bytes()))?;
    let path = path.display().to_string();
    let next = kind.next(&path);
    terminal::tell(&format!("wrote {path}; now: {next}"));
    Ok(())
}
