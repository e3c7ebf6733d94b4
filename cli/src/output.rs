//! The results of a run: its summary, curve, fields, pictures and report, and the folder that holds them.

pub mod curve;
pub mod disk_space;
pub mod file;
pub mod folder;
pub mod gsf;
pub mod lock;
pub mod netcdf;
pub mod npz;
mod npz_archive;
pub mod own_files;
pub mod partial_file;
pub mod pictures;
pub mod redraw;
pub mod report;
pub mod results;
mod stoppable;
pub mod stress;
pub mod summary_text;
pub mod text_cell;
pub mod vti;
pub mod write_progress;

use serde::Serialize;

use crate::failure::Failure;

/// Returns the value as JSON with a final newline; numbers have their shortest exact form, and non-finite ones are
/// `null`.
///
/// # Errors
///
/// [`Failure::Case`] if the value has no JSON form.
pub fn json(value: &impl Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string_pretty(value)?;
    text.push('\n');
    Ok(text)
}
