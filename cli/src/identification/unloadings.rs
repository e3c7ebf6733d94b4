//! Unloadings in a fit: the stiffness of each at the radius of its contact.

use std::f64::consts::PI;

use pellicle::input::diagnosis::Diagnosis;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::evaluation_file::{Evaluated, EvaluatedFile};
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::indentation::{
    EvaluationSettings, IndentationNumber, IndentationNumbers, Uncertain,
};
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::measured::noise::MeasuredNoise;
use pellicle_identify::{Amount, Correlation, Noise, Thinned};

use super::Identification;
use super::curve_source::CurveSource;
use super::findings::WarningResult;
use crate::evaluation::result::{ExactModulus, Indentation, indentations};
use crate::evaluation::warnings;

/// With so many more points than unknowns the scatter of the stiffnesses tells their noise.
const SPARE_POINTS: usize = 3;
/// Stiffnesses without noise are known to this part, as files have so many digits.
const DIGITS: f64 = 1e-9;
/// The thickness of the top layer.
const TOP: &str = "foundation.layer[0].thickness";

/// The readings of a table: contact radii, stiffnesses over β, and what the imprints take off the top layer.
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
    Ok(CurveSource::of_readings(
        measured,
        [radii, stiffnesses],
        thinned,
    ))
}

impl Identification {
    /// What a reader must know of the evaluations.
    #[must_use]
    pub fn evaluation_warnings(&self) -> Vec<WarningResult> {
        let settings = self.file.evaluation.as_ref();
        settings.map_or(Vec::new(), |settings| {
            warnings::all(&self.evaluated, settings)
        })
    }

    /// The contacts with their numbers; where the fit has one unknown, with its value from each alone.
    #[must_use]
    pub fn indentation(&self) -> Vec<Indentation> {
        let mut found = indentations(&self.evaluated);
        let [unknown] = &self.file.all_unknowns()[..] else {
            return found;
        };
        // In the order of the tables, as the evaluations are.
        let readings = self
            .sources
            .iter()
            .zip(&self.tables)
            .flat_map(|(source, table)| {
                let stiffnesses = source.observed.iter().copied().enumerate();
                stiffnesses.map(|(point, stiffness)| (*table, point, stiffness))
            });
        let files: Vec<&EvaluatedFile> = self.evaluated.iter().collect();
        let numbers = contacts(&files);
        for ((found, numbers), (table, point, stiffness)) in
            found.iter_mut().zip(numbers).zip(readings)
        {
            let curve = &self.model.curves()[table];
            let at = curve.parameter_at(point, unknown.parameter, unknown.range, stiffness);
            let at = at.ok().flatten();
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
}

fn contacts<'a>(files: &[&'a EvaluatedFile]) -> impl Iterator<Item = &'a IndentationNumbers> {
    let evaluated = files.iter().filter_map(|file| file.evaluated.as_ref().ok());
    evaluated.flat_map(Evaluated::contacts)
}

/// What is taken off the top layer of a model, if it has one.
#[must_use]
pub fn thinned(parameters: &ModelParameters, off: Vec<f64>) -> Option<Thinned> {
    let thickness = parameters.find(TOP)?.parameter;
    (!off.is_empty()).then_some(Thinned { thickness, off })
}

/// The noise of the stiffnesses relative to their values: from their scatter where there are enough, otherwise that of
/// their evaluations.
#[must_use]
pub fn noise(given: MeasuredNoise, evaluated: &[EvaluatedFile], file: &FitFile) -> Noise {
    let files: Vec<&EvaluatedFile> = evaluated.iter().collect();
    let variances: Vec<f64> = contacts(&files)
        .map(|of| relative_variance(of, 1.0))
        .collect();
    let count = variances.len();
    let own = (variances.iter().sum::<f64>() / count as f64)
        .sqrt()
        .max(DIGITS);
    let relative = match given.relative {
        Some(relative) => Amount::Given(relative),
        None if given.stiffness.is_some() => Amount::Given(0.0),
        None if count >= file.all_unknowns().len() + SPARE_POINTS => Amount::Estimated,
        None => Amount::Given(own),
    };
    Noise {
        observed: Amount::Given(given.stiffness.unwrap_or(0.0)),
        abscissa: Amount::Given(0.0),
        relative,
        correlation: Correlation::None,
    }
}

/// The variance of `ln S − k ln a`, with `k = d ln S/d ln a` of the model: what the errors of a contact's stiffness and
/// area leave of its stiffness over the model's.
fn relative_variance(of: &IndentationNumbers, by_radius: f64) -> f64 {
    let (stiffness, area) = (IndentationNumber::ContactStiffness, IndentationNumber::Area);
    let [s, a] = [stiffness, area].map(|number| of.get(number).unwrap_or_default());
    let square = |of: Uncertain| (of.sd / of.value).powi(2);
    let both = of.covariance(stiffness, area) / (s.value * a.value);
    // ln a = ½ ln A + constant
    let half = 0.5 * by_radius;
    (square(s) + half * half * square(a) - 2.0 * half * both).max(0.0)
}
