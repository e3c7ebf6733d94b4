//! The files of a fit: pictures, tables, the report, and `fit.json` last.

use std::path::Path;

use pellicle_files::json;
use pellicle_files::whole;
use pellicle_plot::sheet::style::Style;

use super::findings::WarningResult;
use super::fitted_file::FittedFile;
use super::pictures::{self, FitPicture};
use super::{report, result, tables};
use crate::evaluation;
use crate::failure::Failure;
use crate::output::write_progress::WriteProgress;
use crate::withdrawn;

/// The tables of a fit.
const TABLES: [&str; 3] = ["fit.csv", "covariance.csv", "profiles.csv"];

/// Whether a fit writes a file of this name, other than the report.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let is_picture = |picture: &FitPicture| {
        let ending = name.strip_prefix(picture.name());
        ending.is_some_and(|ending| [".svg", ".png"].contains(&ending))
    };
    [result::FILE, tables::EXCLUDED].contains(&name)
        || evaluation::files::is_name(name)
        || withdrawn::is_file_of_a_fit(name)
        || TABLES.contains(&name)
        || FitPicture::ALL.iter().any(is_picture)
}

/// Writes the files into a folder; a picture that cannot be drawn becomes a warning of the result.
///
/// # Errors
///
/// [`Failure::File`] if a file cannot be written.
pub fn write(folder: &Path, fitted: &mut FittedFile) -> Result<(), Failure> {
    let (of, fit, found) = (&fitted.identification, &fitted.fit, &fitted.found);
    let sheets = evaluation::pictures::sheets(&of.evaluated);
    let writer = WriteProgress::new(FitPicture::ALL.len() + sheets, &|_, _| ());
    let style = Style::default();
    let drawings = pictures::write(folder, of, fit, found, &style, &writer)?;
    evaluation::pictures::write(folder, (&found.title, &of.evaluated), &style, &writer)?;
    let failed = writer.warnings().into_iter();
    fitted
        .found
        .warnings
        .extend(failed.map(|warning| WarningResult {
            code: warning.code,
            message: warning.message,
        }));
    for (name, table) in fitted.tables() {
        whole::write_bytes(&folder.join(name), table.as_bytes())?;
    }
    let FittedFile {
        identification,
        fit,
        found,
    } = fitted;
    let page = report::html(identification, fit, found, &drawings);
    whole::write_bytes(&folder.join(crate::output::report::FILE), page.as_bytes())?;
    let text = json(found)?;
    Ok(whole::write_bytes(
        &folder.join(result::FILE),
        text.as_bytes(),
    )?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_file_names_of_a_fit_are_recognised() {
        for name in [
            "fit.json",
            "fit.csv",
            "posterior.npz",
            "excluded.csv",
            "covariance.csv",
            "fit-curve.svg",
            "fit-corner.png",
        ] {
            assert!(is_name(name), "{name}");
        }
        for name in [
            "fit-curve.csv",
            "fit-curve",
            "fit-mine.png",
            "fitness.json",
            "",
        ] {
            assert!(!is_name(name), "{name}");
        }
    }
}
