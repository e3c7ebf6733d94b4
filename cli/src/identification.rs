//! The fit of a fit file: its measurements and its model, made into a problem, solved, and told.

pub mod curve_source;
pub mod files;
pub mod names;
pub mod null_directions;
pub mod pictures;
pub mod report;
pub mod result;
pub mod sampling;
pub mod simulation;
pub mod tables;
pub mod text;
pub mod units;
pub mod validity;

use std::sync::atomic::{AtomicUsize, Ordering};

use pellicle_contact::ModelParameter;
use pellicle_identify::{
    ContactCurve, ContactCurves, CurveOptions, Fit, ForwardError, ForwardModel, IdentifyError,
    NullDirections, Prediction, Problem, Scatter, Unknown, identify,
};

use self::curve_source::CurveSource;
use crate::failure::Failure;
use crate::fit_file::FitFile;
use crate::fit_file::model::ModelParameters;
use crate::fit_file::unknown::UnknownCase;
use crate::interrupt;
use crate::measured::data_table::DataTable;

/// As many repeats as tell a scatter between them.
const FEWEST_REPEATS: usize = 3;

/// A fit to be made.
#[derive(Debug)]
pub struct Identification {
    /// The fit file.
    pub file: FitFile,
    /// The curves, in the order of the tables and their files.
    pub sources: Vec<CurveSource>,
    /// Their models.
    pub model: ContactCurves,
    /// What is to be found.
    pub problem: Problem,
    /// Directions in which no curve changes.
    pub directions: NullDirections,
}

impl Identification {
    /// Reads the measurements and poses the problem.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a measurement gives no curve, a model cannot be built, or there are too few points.
    pub fn new(file: FitFile) -> Result<Self, Failure> {
        let mut sources = Vec::new();
        let mut curves = Vec::new();
        let mut directions = Vec::new();
        for (index, table) in file.data.iter().enumerate() {
            let parameters = file.model.with(&table.set)?;
            let own = own(table, &parameters);
            directions.push(null_directions::of(&parameters, &own, index));
            let of_table = CurveSource::of_table(table)?;
            curves.push(ContactCurve {
                model: parameters.model.clone(),
                observable: curve_source::observable(table.observe),
                abscissae: (of_table.iter())
                    .flat_map(|source| source.abscissa.iter().copied())
                    .collect(),
                own,
            });
            sources.extend(of_table);
        }
        let unknowns = file.all_unknowns();
        let sought = unknowns.iter().map(|unknown| unknown.parameter).collect();
        let model = ContactCurves::new(curves, sought, CurveOptions::default())?;
        let directions = null_directions::common(directions)?;
        let problem = problem(&file, &sources)?
            .with_null_directions(directions.clone())
            .with_scatter(scatter(&file));
        Ok(Self {
            file,
            sources,
            model,
            problem,
            directions,
        })
    }

    /// Makes the fit; `tell` is told of each prediction how many there were.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the model has no prediction at any start, or the user stops.
    pub fn run(&self, tell: &(dyn Fn(usize) + Sync)) -> Result<Fit, Failure> {
        let watched = Watched {
            model: &self.model,
            predictions: AtomicUsize::new(0),
            tell,
        };
        Ok(identify(
            &watched,
            &self.problem,
            &self.file.report.options(),
        )?)
    }
}

impl FitFile {
    /// The unknowns, then the numbers of the model that are not known exactly.
    #[must_use]
    pub fn all_unknowns(&self) -> Vec<UnknownCase> {
        let nuisances = self.nuisances.parameters.iter();
        self.unknowns.iter().chain(nuisances).cloned().collect()
    }
}

/// The problem without what no data can tell.
fn problem(file: &FitFile, sources: &[CurveSource]) -> Result<Problem, Failure> {
    let curves = sources.iter().map(CurveSource::curve);
    let curves = curves.collect::<Result<Vec<_>, IdentifyError>>()?;
    let nuisances = file.nuisances.parameters.iter();
    let nuisances = nuisances.map(|case| case.unknown().map(Unknown::as_nuisance));
    let unknowns = file.unknowns.iter().map(UnknownCase::unknown);
    let unknowns = unknowns.chain(nuisances).collect::<Result<Vec<_>, _>>()?;
    let noise = curve_source::noise(file)?;
    Ok(Problem::new(
        curves,
        unknowns,
        &file.nuisances.linear()?,
        noise,
    )?)
}

/// Repeats of one table scatter; curves of several tables are of the same parameters.
fn scatter(file: &FitFile) -> Scatter {
    match &file.data[..] {
        [table] if table.files.len() >= FEWEST_REPEATS => Scatter::BetweenCurves,
        _ => Scatter::None,
    }
}

/// The numbers that a table gives a value of its own.
pub fn own(table: &DataTable, parameters: &ModelParameters) -> Vec<ModelParameter> {
    let keys = table.set.entries.iter();
    let found = keys.filter_map(|entry| parameters.find(&entry.key));
    found.map(|of| of.parameter).collect()
}

/// A model that tells of its predictions and stops when the user wants.
struct Watched<'a> {
    model: &'a ContactCurves,
    predictions: AtomicUsize,
    tell: &'a (dyn Fn(usize) + Sync),
}

impl ForwardModel for Watched<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        if interrupt::is_requested() {
            return Err(ForwardError::Stopped);
        }
        let prediction = self.model.predict(parameters);
        (self.tell)(1 + self.predictions.fetch_add(1, Ordering::Relaxed));
        prediction
    }
}
