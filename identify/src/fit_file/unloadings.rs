//! Unloadings in a fit file with a model: how they are evaluated, and the flat punch that stands for their imprints.

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::TomlValue;

use super::evaluation;
use super::model::FitModel;
use crate::indentation::EvaluationSettings;
use crate::measured::data_table::DataTable;
use crate::measured::sources::MeasurementSources;

/// Reads `[evaluation]` of a fit file, which has one if its measurements are unloadings.
pub(super) fn evaluation(
    table: &TableReader<'_>,
    data: &[DataTable],
    sources: &MeasurementSources,
) -> Result<Option<EvaluationSettings>, Diagnosis> {
    let unloading = data.iter().find(|table| table.is_unloading());
    match (table.optional("evaluation"), unloading) {
        (None, None) => Ok(None),
        (Some(field), Some(_)) => {
            let calibrate = field.clone().table()?.optional("calibrate");
            match calibrate {
                Some(field) => {
                    Err(field.wanted("none in a fit: a calibration is a file of its own"))
                }
                None => evaluation::read(&field, sources, data).map(Some),
            }
        }
        (Some(field), None) => Err(field.diagnosis(Fault::Wrong {
            found: "an [evaluation]".into(),
            wanted: "one only where a [[data]] has observe = \"unloading\"".into(),
        })),
        (None, Some(_)) => {
            let wanted = "a table [evaluation] of unloadings: area_function, poisson_ratio, …";
            Err(table.missing("evaluation", wanted.into()))
        }
    }
}

impl FitModel {
    /// Gives the model the flat punch of an imprint, of the tip's material: an indenter of the case does not enter, and
    /// the radius of the punch is that of each contact.
    pub(super) fn give_indenter(&mut self, settings: &EvaluationSettings) -> Result<(), Diagnosis> {
        if let Some(place) = self.place_of("surface") {
            let wanted =
                "none: unloadings are compared with a flat punch on layers without a relief";
            let fault = Fault::Wrong {
                found: "a [surface]".into(),
                wanted: wanted.into(),
            };
            return Err(Diagnosis::of_key("model.surface", place, fault));
        }
        let text = |value: &str| TomlValue::Text(value.into());
        let mut values = vec![("kind", text("flat-punch")), ("radius", text("1 um"))];
        if let Some(tip) = settings.indenter {
            let modulus = format!("{:e} Pa", tip.young_modulus.value);
            values.push(("young_modulus", text(&modulus)));
            let ratio = TomlValue::Float(tip.poisson_ratio.value);
            values.push(("poisson_ratio", ratio));
        }
        self.replace_table("indenter", values);
        Ok(())
    }
}
