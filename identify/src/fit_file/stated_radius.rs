//! The radius of the tip that the files of a measurement state: given to a model that has none, else compared with it.

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::Dimension;
use pellicle::input::toml_tree::{TomlNode, TomlValue};

use super::FitFile;
use crate::measured::curve::MeasuredCurve;
use crate::measured::data_table::DataTable;
use crate::measured::sources::MeasurementSources;
use crate::measured::stated::{StatedNumber, StatedQuantity};

/// A radius that a file contradicts.
#[derive(Debug, thiserror::Error)]
#[error(
    "found a radius of {given:.4e} m, and {:.4e} m in line {} of {file}, \"{}\", wanted one of them; a bare number \
     replaces that of the file",
    .stated.value, .stated.line, .stated.text
)]
struct OtherRadius {
    given: f64,
    file: String,
    stated: StatedNumber,
}

/// Two files that state different radii, where the model has none.
#[derive(Debug, thiserror::Error)]
#[error(
    "found radii of {:.4e} and {:.4e} m in the measurements, the second one in {file}, wanted the radius of the \
     indenter in the model",
    .radii[0], .radii[1]
)]
struct TwoRadii {
    file: String,
    radii: [f64; 2],
}

impl FitFile {
    /// Compares the radius of a table's indenter with the one that a file of it states, unless it is sought.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] at the radius if they differ by more than a hundredth and
    /// the radius has a unit: a bare number replaces that of the file.
    pub fn refuse_other_radius(
        &self,
        table: usize,
        curve: &MeasuredCurve,
    ) -> Result<(), pellicle::Error> {
        let Some(stated) = StatedNumber::of(StatedQuantity::TipRadius, &curve.stated) else {
            return Ok(());
        };
        let parameters = self.model.with(&self.data[table].set)?;
        let Some(radius) = parameters.radius() else {
            return Ok(());
        };
        let given = parameters.value(radius).unwrap_or(f64::NAN);
        let is_sought = self
            .all_unknowns()
            .iter()
            .any(|of| of.parameter == radius.parameter);
        if is_sought || given <= 0.0 || !stated.contradicts(given) {
            return Ok(());
        }
        let (key, set) = (
            format!("model.{}", radius.key),
            format!("data[{table}].set"),
        );
        let own = self.data[table].set.entry(&radius.key);
        let is_bare = match own {
            Some(entry) => !matches!(entry.node.value, TomlValue::Text(_)),
            None => self.document.has(&key) && self.document.texts(&key).is_empty(),
        };
        if is_bare {
            return Ok(());
        }
        let place = if own.is_some() { &set } else { &key };
        let keys = [place, "model.case", "model"];
        let (file, stated) = (curve.file.display().to_string(), stated.clone());
        let reason = OtherRadius {
            given,
            file,
            stated,
        };
        Err(self.document.refused(&keys, &reason).into())
    }
}

/// The radius that all files of all tables state; none if one states none.
///
/// # Errors
///
/// A [`Diagnosis`] of the tables, or that two files state different radii.
pub(super) fn of_files(
    root: &TomlNode,
    sources: &MeasurementSources,
) -> Result<Option<StatedNumber>, Diagnosis> {
    let tables = DataTable::read_all(root, sources)?;
    let mut first: Option<StatedNumber> = None;
    for table in &tables {
        for file in &table.files {
            let stated = table.stated(file);
            let Some(other) = StatedNumber::of(StatedQuantity::TipRadius, &stated) else {
                return Ok(None);
            };
            match &first {
                Some(first) if first.contradicts(other.value) => {
                    let (file, radii) = (file.display().to_string(), [first.value, other.value]);
                    return Err(table.refused("file", &TwoRadii { file, radii }));
                }
                Some(_) => {}
                None => first = Some(other.clone()),
            }
        }
    }
    Ok(first)
}

/// Its value as the text of a key, which has a unit.
pub(super) fn text(stated: &StatedNumber) -> String {
    format!("{:e} {}", stated.value, Dimension::Length.si_unit())
}
