//! The files of a fit: pictures, tables, the page, and `fit.json` last.

use std::path::Path;

use pellicle_identify::Fit;

use super::pictures::{self, FitPicture};
use super::result::{self, FitResult, WarningResult};
use super::{Identification, report, tables};
use crate::failure::Failure;
use crate::output::file;
use crate::output::json;
use crate::output::npz;
use crate::output::write_progress::WriteProgress;
use crate::picture::style::Style;

/// Samples of the posterior, an array for each unknown.
const SAMPLES: &str = "posterior.npz";
/// The points at which the model does not hold, if there are any.
const EXCLUDED: &str = "excluded.csv";
/// The tables of a fit.
const TABLES: [&str; 3] = ["fit.csv", "covariance.csv", "profiles.csv"];

/// Whether a fit writes a file of this name, besides the page.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let is_picture = |picture: &FitPicture| {
        let ending = name.strip_prefix(picture.name());
        ending.is_some_and(|ending| [".svg", ".png"].contains(&ending))
    };
    [result::FILE, SAMPLES, EXCLUDED].contains(&name)
        || TABLES.contains(&name)
        || FitPicture::ALL.iter().any(is_picture)
}

/// Writes the files into a folder; a picture that cannot be drawn becomes a warning of the result.
///
/// # Errors
///
/// [`Failure::Write`] if a file cannot be written.
pub fn write(
    folder: &Path,
    of: &Identification,
    fit: &Fit,
    found: &mut FitResult,
) -> Result<(), Failure> {
    let writer = WriteProgress::new(FitPicture::ALL.len(), &|_, _| ());
    let drawings = pictures::write(folder, of, fit, found, &Style::default(), &writer)?;
    let failed = writer.warnings().into_iter();
    found.warnings.extend(failed.map(|warning| WarningResult {
        code: warning.code,
        message: warning.message,
    }));
    if !found.samples.is_empty() {
        let columns = fit.estimates.iter().enumerate().map(|(index, estimate)| {
            let values = found.samples.iter().map(|sample| sample[index]);
            (estimate.name.clone(), values.collect())
        });
        npz::write_columns(&folder.join(SAMPLES), &columns.collect::<Vec<_>>())?;
    }
    for (name, table) in tables::all(of, fit) {
        file::write_bytes(&folder.join(name), table.as_bytes())?;
    }
    if let Some(table) = tables::excluded(of) {
        file::write_bytes(&folder.join(EXCLUDED), table.as_bytes())?;
    }
    let page = report::html(of, fit, found, &drawings);
    file::write_bytes(&folder.join(crate::output::report::FILE), page.as_bytes())?;
    file::write_bytes(&folder.join(result::FILE), json(found)?.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_fit_are_known_and_no_others() {
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
