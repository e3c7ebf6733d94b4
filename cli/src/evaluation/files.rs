//! The files of an evaluation: the picture, the table, the report, and `fit.json` last.

use std::path::Path;

use pellicle_files::json;
use pellicle_files::whole;
use pellicle_identify::fit_file::evaluation::calibration_file;
use pellicle_plot::sheet::style::Style;

use super::{Evaluation, pictures, report, table};
use crate::failure::Failure;
use crate::identification::findings::WarningResult;
use crate::identification::result;
use crate::output;
use crate::output::write_progress::WriteProgress;

/// Name of the file of a calibration, which another evaluation reads as its `area_function`.
pub const CALIBRATION: &str = "calibration.toml";

/// Whether an evaluation writes a file of this name, other than those that a fit writes too.
#[must_use]
pub fn is_name(name: &str) -> bool {
    [table::FILE, CALIBRATION].contains(&name) || pictures::is_name(name)
}

/// Writes the files into a folder; a picture that cannot be drawn becomes a warning of the result.
///
/// # Errors
///
/// [`Failure::File`] if a file cannot be written.
pub fn write(folder: &Path, of: &mut Evaluation) -> Result<(), Failure> {
    let writer = WriteProgress::new(pictures::sheets(&of.curves), &|_, _| ());
    let drawings = pictures::write(
        folder,
        (&of.found.title, &of.curves),
        &Style::default(),
        &writer,
    )?;
    let failed = writer.warnings().into_iter();
    of.found
        .warnings
        .extend(failed.map(|warning| WarningResult {
            code: warning.code,
            message: warning.message,
        }));
    let table = table::table(&of.found.indentation);
    whole::write_bytes(&folder.join(table::FILE), table.as_bytes())?;
    if let Some(calibration) = &of.calibration {
        let text = calibration_file::text(calibration);
        whole::write_bytes(&folder.join(CALIBRATION), text.as_bytes())?;
    }
    let page = report::html(&of.found, &drawings);
    whole::write_bytes(&folder.join(output::report::FILE), page.as_bytes())?;
    let text = json(&of.found)?;
    Ok(whole::write_bytes(
        &folder.join(result::FILE),
        text.as_bytes(),
    )?)
}
