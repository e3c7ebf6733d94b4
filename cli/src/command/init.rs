//! `pellicle init`: a commented case that runs as it is.

use std::path::Path;

use pellicle_files::whole;

use crate::arguments::InitArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::templates::Template;
use crate::terminal;

/// Prints the template, or writes it to a new file.
///
/// # Errors
///
/// [`Failure`] if the file exists or cannot be written.
pub fn init(arguments: &InitArguments) -> Result<Outcome, Failure> {
    match &arguments.out {
        Some(path) => write(path, arguments.kind, arguments.force)?,
        None => terminal::print(&arguments.kind.text())?,
    }
    Ok(Outcome::Done)
}

fn write(path: &Path, kind: Template, force: bool) -> Result<(), Failure> {
    let text = kind.text();
    if force {
        whole::write_bytes(path, text.as_bytes())?;
    } else {
        whole::write_new(path, text.as_bytes())?;
    }
    let path = path.display().to_string();
    let next = kind.next(&path);
    terminal::report(&format!("wrote {path}; now: {next}"));
    Ok(())
}
