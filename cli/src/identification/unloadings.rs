//! Unloadings in a fit: the stiffness of each at the radius of its contact.

use std::f64::consts::PI;

use pellicle::display::{Unit, quantity, significant};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::units::Units;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::evaluation_file::{Evaluated, EvaluatedFile};
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::fit_file::unknown::UnknownCase;
use pellicle_identify::indentation::{
    EvaluationSettings, IndentationNumber, IndentationNumbers, Uncertain,
};
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::{ContactCurve, ParameterAtPoint, Thinned};

use super::Identification;
use super::contact_noise::{is_stated, own_errors, relative_variance};
use super::curve_source::CurveSource;
use super::findings::WarningResult;
use super::{names, units};
use crate::evaluation::result::{ExactModulus, Indentation, indentations};
use crate::evaluation::warnings;

/// A trend with the depth of the contacts matters from this change of the logarithm on, and is told beyond so many
/// standard deviations of the order of its pairs, a chance of 1.6 %. Five contacts all in order have 2.45.
const LEAST_TREND: f64 = 0.05;
const TREND_DEVIATIONS: f64 = 2.4;
/// The thickness of the top layer.
const TOP: &str = "foundation.layer[0].thickness";
/// Poisson's ratio of the top layer, and of a body without layers.
const TOP_RATIO: &str = "foundation.layer[0].poisson_ratio";
const HALF_SPACE_RATIO: &str = "foundation.substrate.poisson_ratio";

/// The readings of a table: contact radii, stiffnesses over β, what the imprints take off the top layer, and, where no
/// noise is stated, the errors of each contact from its own curve.
///
/// # Errors
///
/// A [`Diagnosis`] if no file of the table could be evaluated.
pub fn source(
    (index, table): (usize, &DataTable),
    evaluated: &[EvaluatedFile],
    settings: &EvaluationSettings,
) -> Result<CurveSource, Diagnosis> {
    let files: Vec<&EvaluatedFile> = evaluated.iter().filter(|of| of.table == index).collect();
    let contacts: Vec<&IndentationNumbers> = contacts(&files).collect();
    if let (true, Some(error)) = (
        contacts.is_empty(),
        files.iter().find_map(|file| file.evaluated.as_ref().err()),
    ) {
        return Err(table.refused("file", error));
    }
    let value = |of: &IndentationNumbers, number| of.get(number).unwrap_or_default().value;
    let each =
        |read: &dyn Fn(&IndentationNumbers) -> f64| contacts.iter().map(|of| read(of)).collect();
    let radii = each(&|of| (value(of, IndentationNumber::Area) / PI).sqrt());
    let stiffnesses =
        each(&|of| value(of, IndentationNumber::ContactStiffness) / settings.beta.value);
    let thinned = if settings.thinning > 0.0 {
        each(&|of| settings.thinning * value(of, IndentationNumber::ContactDepth))
    } else {
        Vec::new()
    };
    // One measurement stands for all files of the table, with a row for each contact.
    let mut measured = files[0].measured.clone();
    measured.rows = (1..=contacts.len()).collect();
    // They are told with those of the evaluations.
    measured.warnings.clear();
    let errors = if is_stated(&table.noise) {
        Vec::new()
    } else {
        let own = contacts.iter().zip(radii.iter().zip(&stiffnesses));
        own.map(|(of, (radius, stiffness))| own_errors(of, *radius, *stiffness))
            .collect()
    };
    let mut source = CurveSource::of_readings(measured, [radii, stiffnesses]);
    source.thinned = thinned;
    source.errors = errors;
    Ok(source)
}

impl Identification {
    /// What a reader must know of the evaluations.
    #[must_use]
    pub fn evaluation_warnings(&self) -> Vec<WarningResult> {
        let Some(settings) = &self.file.evaluation else {
            return Vec::new();
        };
        let mut found = warnings::all(&self.evaluated, settings);
        found.extend(self.other_poisson_ratio(settings));
        found.extend(self.thinning_effect(settings));
        found.extend(self.trend());
        found
    }

    /// The contacts with their numbers; where the fit has one unknown, with its value from each alone.
    #[must_use]
    pub fn indentation(&self) -> Vec<Indentation> {
        let mut found = indentations(&self.evaluated);
        let [unknown] = &self.file.all_unknowns()[..] else {
            return found;
        };
        let alone = self.alone_at_each(unknown, None);
        let files: Vec<&EvaluatedFile> = self.evaluated.iter().collect();
        for ((found, numbers), at) in found.iter_mut().zip(contacts(&files)).zip(alone) {
            found.exact = Some(ExactModulus {
                key: unknown.key.clone(),
                unit: unknown.unit(),
                value: at.map(|at| at.value),
                sd: at.map(|at| {
                    let variance = relative_variance(numbers, at.by_radius);
                    at.value * variance.sqrt() / at.by_parameter.abs()
                }),
            });
        }
        found
    }

    /// The value of an unknown from each contact alone, in the order of the evaluations; none where no value in its
    /// bounds gives the stiffness. `thinning` replaces that of the settings.
    fn alone_at_each(
        &self,
        unknown: &UnknownCase,
        thinning: Option<f64>,
    ) -> Vec<Option<ParameterAtPoint>> {
        let files: Vec<&EvaluatedFile> = self.evaluated.iter().collect();
        let depth = |of: &IndentationNumbers| of.get(IndentationNumber::ContactDepth);
        let depths = contacts(&files).map(|of| depth(of).unwrap_or_default().value);
        // In the order of the tables, as the evaluations are.
        let readings = self
            .sources
            .iter()
            .zip(&self.tables)
            .flat_map(|(source, table)| {
                let stiffnesses = source.observed.iter().copied().enumerate();
                stiffnesses.map(|(point, stiffness)| (*table, point, stiffness))
            });
        let at = |((table, point, stiffness), depth): ((usize, usize, f64), f64)| {
            let given = &self.model.curves()[table];
            let mut one = given.at(point);
            if let Some(part) = thinning {
                let parameters = self.file.model.with(&self.file.data[table].set).ok()?;
                one.thinned = thinned(&parameters, vec![part * depth]);
            }
            let found = one.parameter_at(unknown.parameter, unknown.range, stiffness);
            found.ok().flatten()
        };
        readings.zip(depths).map(at).collect()
    }

    /// That the only unknown changes with the depth of the contacts, which one body does not explain.
    fn trend(&self) -> Option<WarningResult> {
        let all = self.file.all_unknowns();
        let [unknown] = &all[..] else {
            return None;
        };
        let files: Vec<&EvaluatedFile> = self.evaluated.iter().collect();
        let depths = contacts(&files).map(|of| of.get(IndentationNumber::ContactDepth));
        let values = self.alone_at_each(unknown, None).into_iter();
        let pairs = depths
            .zip(values)
            .filter_map(|(depth, at)| Some((depth?.value, at?.value)));
        let mut pairs: Vec<(f64, f64)> = pairs.collect();
        pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
        let values: Vec<f64> = pairs.iter().map(|pair| pair.1).collect();
        let (first, last) = (*values.first()?, *values.last()?);
        if !is_trend(&values) || (last / first).ln().abs() < LEAST_TREND {
            return None;
        }
        let scale = units::scale(first, unknown.unit());
        let [first, last] = [first, last].map(|value| significant(value / scale.divisor, 4));
        let (name, unit) = (names::of_key(&unknown.key), scale.label);
        Some(WarningResult {
            code: "trend".into(),
            message: format!(
                "the {name} from single contacts goes from {first} to {last} {unit} with their depth, more steadily than by \
                 chance, and one body has one: are thickness and base right, the area function, and is there pile-up?"
            ),
        })
    }

    /// That the evaluation has another Poisson's ratio than the body at its surface, which a fit does not seek.
    fn other_poisson_ratio(&self, settings: &EvaluationSettings) -> Option<WarningResult> {
        let is_sought = |key: &str| self.file.all_unknowns().iter().any(|of| of.key == key);
        let curves = self.model.curves().iter().zip(&self.file.data);
        let found = curves.filter_map(|(curve, data)| {
            let foundation = curve.model.tables.foundation();
            let (key, place) = match foundation.layers() {
                [] => (HALF_SPACE_RATIO, "the substrate"),
                [..] => (TOP_RATIO, "the top layer"),
            };
            let found = foundation.surface_material().poisson_ratio();
            let Uncertain { value, sd } = settings.poisson_ratio;
            let differs = (found - value).abs() > sd.max(f64::EPSILON);
            (data.is_unloading() && differs && !is_sought(key)).then_some((place, found))
        });
        let (place, found) = found.into_iter().next()?;
        let given = settings.poisson_ratio.value;
        Some(WarningResult {
            code: "poisson-ratio".into(),
            message: format!(
                "evaluation.poisson_ratio is {given}, and Poisson's ratio of {place} in the model {found}: the indentation \
                 modulus has the first, the fit the second"
            ),
        })
    }

    /// What the choice of the thinning means for the only unknown of a film; none without layers.
    fn thinning_effect(&self, settings: &EvaluationSettings) -> Option<WarningResult> {
        let all = self.file.all_unknowns();
        let [unknown] = &all[..] else {
            return None;
        };
        let has_layer = |curve: &ContactCurve| !curve.model.tables.foundation().layers().is_empty();
        if !self.model.curves().iter().any(has_layer) {
            return None;
        }
        let mean = |thinning: f64| {
            let values = self.alone_at_each(unknown, Some(thinning)).into_iter();
            let values: Vec<f64> = values.flatten().map(|at| at.value).collect();
            (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        let values = [mean(0.0)?, mean(settings.thinning)?, mean(1.0)?];
        let scale = units::scale(values[1], unknown.unit());
        let [none, given, all] = values.map(|value| significant(value / scale.divisor, 4));
        let (name, unit) = (names::of_key(&unknown.key), scale.label);
        Some(WarningResult {
            code: "thinning".into(),
            message: format!(
                "how far an imprint thins the film under it is a choice, {} of its depth here, and no part of the interval: \
                 the mean of the {name} over the contacts is {none} {unit} for none, {given} {unit} for this and {all} \
                 {unit} for all of it",
                settings.thinning
            ),
        })
    }
}

/// The contacts of files, in their order.
pub(super) fn contacts<'a>(
    files: &[&'a EvaluatedFile],
) -> impl Iterator<Item = &'a IndentationNumbers> {
    let evaluated = files.iter().filter_map(|file| file.evaluated.as_ref().ok());
    evaluated.flat_map(Evaluated::contacts)
}

/// Contacts deeper than the layer that they are in.
#[derive(Debug, thiserror::Error)]
#[error(
    "found a top layer of {thickness} and {count} deeper contacts, down to {deepest}, wanted contacts within the layer: is its \
     unit right, or is the tip through it (`segment = {{ to = .. }}` or `omit` leaves such contacts out)?"
)]
struct PressedThrough {
    thickness: String,
    count: usize,
    deepest: String,
}

/// Rejects contacts of a table that are deeper than the top layer of its model is thick.
///
/// # Errors
///
/// A [`Diagnosis`] of the thickness.
pub fn refuse_pressed_through(
    file: &FitFile,
    table: usize,
    parameters: &ModelParameters,
    evaluated: &[EvaluatedFile],
) -> Result<(), Diagnosis> {
    let Some(of) = parameters.find(TOP) else {
        return Ok(());
    };
    let unknowns = file.all_unknowns();
    let sought = unknowns
        .iter()
        .find(|unknown| unknown.parameter == of.parameter);
    let thickness = sought.map_or(parameters.value(of), |unknown| Some(unknown.range[1]));
    let thickness = thickness.unwrap_or(f64::INFINITY);
    let files: Vec<&EvaluatedFile> = evaluated.iter().filter(|of| of.table == table).collect();
    let depths = contacts(&files).filter_map(|of| of.get(IndentationNumber::ContactDepth));
    let deeper: Vec<f64> = depths
        .map(|of| of.value)
        .filter(|depth| *depth >= thickness)
        .collect();
    if deeper.is_empty() {
        return Ok(());
    }
    let length = |value: f64| quantity(value, Unit::Metre, Units::Si);
    let reason = PressedThrough {
        thickness: length(thickness),
        count: deeper.len(),
        deepest: length(deeper.into_iter().fold(0.0, f64::max)),
    };
    let keys = [format!("model.{TOP}"), "model.case".into(), "model".into()];
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    Err(file.document.refused(&keys, &reason))
}

/// What is taken off the top layer of a model, if it has one.
#[must_use]
pub fn thinned(parameters: &ModelParameters, off: Vec<f64>) -> Option<Thinned> {
    let thickness = parameters.find(TOP)?.parameter;
    (!off.is_empty()).then_some(Thinned { thickness, off })
}

/// Whether values in the order of their depths rise or fall more steadily than by chance: of `n(n − 1)/2` pairs, the
/// number in order less those out of order has the variance `n(n − 1)(2n + 5)/18` (M. G. Kendall, Biometrika 30, 81
/// (1938)).
fn is_trend(values: &[f64]) -> bool {
    let count = values.len() as f64;
    let score: f64 = (0..values.len())
        .flat_map(|i| (0..i).map(move |j| (j, i)))
        .map(|(j, i)| (values[i] - values[j]).signum())
        .sum();
    let variance = count * (count - 1.0) * (2.0 * count + 5.0) / 18.0;
    score.abs() > TREND_DEVIATIONS * variance.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_rise_of_six_values_is_a_trend_and_one_with_two_exchanges_is_none() {
        assert!(is_trend(&[75.0, 80.0, 87.0, 94.0, 103.0, 119.0]));
        assert!(!is_trend(&[69.9, 70.1, 69.2, 68.9, 69.2, 71.4]));
        assert!(!is_trend(&[1.0, 2.0, 3.0]));
    }
}
