//! The fit of a fit file: its measurements and model are posed as a problem, solved, and reported.

mod adhesion;
pub mod causes;
pub mod contact_noise;
pub mod curve_source;
pub mod deviations;
mod effective_indenter;
pub mod exact_evaluation;
pub mod files;
pub mod findings;
pub mod fitted_file;
pub mod fitting;
pub mod grid_error;
pub mod likelihood;
pub mod names;
pub mod null_directions;
pub mod outside;
pub mod pictures;
pub mod remembered;
mod repeats;
pub mod report;
pub mod result;
pub mod simulation;
pub mod spring_constants;
pub mod tables;
pub mod taken_as_exact;
pub mod text;
pub mod units;
pub mod unloadings;
pub mod validity;
pub mod zeros;

use std::sync::Arc;

use pellicle_contact::ContactError;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::evaluation_file::EvaluatedFile;
use pellicle_identify::fit_file::unknown::UnknownCase;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::{
    ContactCurve, ContactCurves, CurveOptions, IdentifyError, NullDirections, Observable, Problem,
    Scatter, StopFlag, Unknown,
};

use self::curve_source::CurveSource;
use self::outside::Outside;
use crate::failure::Failure;

/// The fewest repeats that determine the scatter between curves.
const FEWEST_REPEATS: usize = 3;

/// A fit ready to be run.
#[derive(Debug)]
pub struct Identification {
    /// The fit file.
    pub file: Arc<FitFile>,
    /// The curves, in the order of the tables and their files.
    pub sources: Vec<CurveSource>,
    /// The table of each curve, by its index.
    pub tables: Vec<usize>,
    /// The evaluations of unloadings, if they are fitted.
    pub evaluated: Arc<[EvaluatedFile]>,
    /// The models of the curves.
    pub model: ContactCurves,
    /// The problem: unknowns, nuisances, data and noise.
    pub problem: Problem,
    /// Directions in parameter space along which no curve changes.
    pub directions: NullDirections,
    /// Points at which the model does not hold.
    pub outside: Outside,
    /// The work of earlier fits, repeated because points had to be left out.
    pub spent: Spent,
    /// The user's request to stop.
    pub stop: StopFlag,
}

/// The work of fits.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Spent {
    /// Curves solved.
    pub curves: usize,
    /// Loads solved.
    pub loads: usize,
    /// Products with `K`.
    pub products: usize,
}

impl Identification {
    /// Reads the measurements and poses the problem; `stop` ends the fit.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a measurement gives no curve, a model cannot be built, or there are too few points.
    pub fn new(file: FitFile, stop: StopFlag) -> Result<Self, Failure> {
        adhesion::refuse_readings(&file)?;
        let evaluated = match &file.evaluation {
            Some(settings) => EvaluatedFile::all(&file.data, settings)?,
            None => Vec::new(),
        };
        let of_table = |(index, table)| {
            let sources = if let Some(settings) = &file.evaluation {
                vec![unloadings::source((index, table), &evaluated, settings)?]
            } else {
                let adhesion = file.model.with(&table.set)?.adhesion;
                CurveSource::of_table(table, &file.nuisances, adhesion)?
            };
            for source in &sources {
                file.refuse_other_radius(index, &source.measured)?;
            }
            Ok(sources.into_iter().map(move |source| (index, source)))
        };
        let sources = file.data.iter().enumerate().map(of_table);
        let sources: Vec<_> = sources.collect::<Result<_, Failure>>()?;
        let sources: Vec<_> = sources.into_iter().flatten().collect();
        adhesion::require_pull_off(&file, &sources)?;
        Self::posed(file.into(), sources, evaluated.into(), None, stop)
    }

    /// The problem of these curves, each with the index of its table. The starts are those of the fit file unless
    /// others are given.
    fn posed(
        file: Arc<FitFile>,
        sources: Vec<(usize, CurveSource)>,
        evaluated: Arc<[EvaluatedFile]>,
        starts: Option<&[f64]>,
        stop: StopFlag,
    ) -> Result<Self, Failure> {
        let mut curves = Vec::new();
        let mut directions = Vec::new();
        for (index, table) in file.data.iter().enumerate() {
            let parameters = file.model.with(&table.set)?;
            unloadings::refuse_pressed_through(&file, index, &parameters, &evaluated)?;
            let own = parameters.given_in(&table.set);
            directions.push(null_directions::of(&parameters, &own, index));
            let of_table = sources.iter().filter(|(table, _)| *table == index);
            let has_zero = zeros::of_abscissa(&file, &sources).is_some();
            let points = of_table.flat_map(|(_, source)| {
                let origin = has_zero.then(|| source.origin(table.observe).unwrap_or(0.0));
                source
                    .abscissa
                    .iter()
                    .map(move |abscissa| (*abscissa, origin))
            });
            let (abscissae, origins): (Vec<f64>, Vec<Option<f64>>) = points.unzip();
            let thinned = sources
                .iter()
                .filter(|(table, _)| *table == index)
                .flat_map(|(_, source)| source.thinned.iter().copied());
            curves.push(ContactCurve {
                model: parameters.model.clone(),
                observable: table.observe,
                abscissae,
                own,
                series: curve_source::series(table),
                origins: origins.into_iter().flatten().collect(),
                thinned: unloadings::thinned(&parameters, thinned.collect()),
                adhesion: parameters.adhesion,
            });
        }
        let unknowns = file.all_unknowns();
        let sought = unknowns.iter().map(|unknown| unknown.parameter).collect();
        let options = CurveOptions {
            stop: stop.clone(),
            ..CurveOptions::default()
        };
        let model = ContactCurves::new(curves, sought, options)
            .map_err(|error| refused_curves(&file, error))?
            .with_force_scales(spring_constants::scales(&file));
        let (tables, sources): (Vec<usize>, Vec<CurveSource>) = sources.into_iter().unzip();
        let directions = null_directions::common(directions)?;
        let problem = problem(&file, &sources, &evaluated, starts)?
            .with_null_directions(directions.clone())
            .with_scatter(scatter(&file));
        Ok(Self {
            file,
            sources,
            tables,
            evaluated,
            model,
            problem,
            directions,
            outside: Outside::default(),
            spent: Spent::default(),
            stop,
        })
    }
}

/// The failure that the curves of a fit file cannot be computed, at the observable if that is the reason.
fn refused_curves(file: &FitFile, error: ContactError) -> Failure {
    let is_of_radius = |table: &&DataTable| table.observe == Observable::StiffnessAtContactRadius;
    match (&error, file.data.iter().find(is_of_radius)) {
        (ContactError::ContactRadius { .. }, Some(table)) => {
            table.refused("observe", &error).into()
        }
        _ => error.into(),
    }
}

impl Identification {
    /// Whether forces are observed at approaches of a cantilever in place of depths.
    #[must_use]
    pub fn is_at_approach(&self) -> bool {
        self.model
            .curves()
            .first()
            .is_some_and(|curve| curve.series > 0.0)
    }
}

/// The problem without its null directions and the scatter between curves.
fn problem(
    file: &FitFile,
    sources: &[CurveSource],
    evaluated: &[EvaluatedFile],
    starts: Option<&[f64]>,
) -> Result<Problem, Failure> {
    let curves = sources.iter().map(|source| {
        let curve = source.curve()?;
        Ok(match source.origin(observe(file)) {
            Some(origin) => curve.with_origin(origin),
            None => curve,
        })
    });
    let curves = curves.collect::<Result<Vec<_>, IdentifyError>>()?;
    let nuisances = file.nuisances.parameters.iter();
    let nuisances = nuisances.map(|case| case.unknown().map(Unknown::as_nuisance));
    let unknowns = file.unknowns.iter().map(UnknownCase::unknown);
    let springs = spring_constants::unknowns(file);
    let unknowns = unknowns.chain(nuisances).chain(springs);
    let mut unknowns = unknowns.collect::<Result<Vec<_>, _>>()?;
    if let Some(starts) = starts {
        let pairs = unknowns.into_iter().zip(starts);
        let moved = pairs.map(|(unknown, start)| unknown.starting_at(*start));
        unknowns = moved.collect::<Result<_, _>>()?;
    }
    let noise = curve_source::noise(file, sources, evaluated)?;
    let told: Vec<_> = sources.iter().map(CurveSource::force_zero).collect();
    let mut linear = file.nuisances.linear(observe(file), &told)?;
    linear.extend(zeros::baseline_slopes(observe(file), sources)?);
    linear.extend(contact_noise::nuisances(evaluated, sources)?);
    Ok(Problem::new(curves, unknowns, &linear, noise)?)
}

/// The observable of a file, which all tables share.
fn observe(file: &FitFile) -> Observable {
    file.data
        .first()
        .map_or(Observable::default(), |table| table.observe)
}

/// Repeats of one table may scatter; the curves of several tables share their parameters.
fn scatter(file: &FitFile) -> Scatter {
    match &file.data[..] {
        [table] if table.files.len() >= FEWEST_REPEATS && !table.is_unloading() => {
            Scatter::BetweenCurves
        }
        _ => Scatter::None,
    }
}
