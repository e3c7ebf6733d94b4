//! A fit file without unknowns: unloadings that are evaluated by Oliver and Pharr, and nothing is fitted to a model.

use std::path::Path;
use std::sync::Arc;

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::document::Document;
use pellicle::input::source_file;
use pellicle::input::span::Source;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree;

use rayon::prelude::*;

use super::{FitFile, FitSources, Measurements, evaluation};
use crate::indentation::{
    AreaFunction, Calibration, DepthZero, Drift, EvaluatedCurve, EvaluationSettings,
    IndentationCurve, IndentationError, IndentationNumbers, calibrate, evaluate,
    evaluate_stiffnesses,
};
use crate::measured::curve::MeasuredCurve;
use crate::measured::cycles::peaks;
use crate::measured::data_table::DataTable;
use crate::measured::sources::MeasurementSources;

/// A file of unloadings and how they are evaluated.
#[derive(Debug)]
pub struct EvaluationFile {
    /// Title; by default the name of the file.
    pub title: String,
    /// The measurements.
    pub data: Vec<DataTable>,
    /// How they are evaluated.
    pub settings: EvaluationSettings,
    /// The tree of the file, for diagnoses.
    pub document: Document,
}

/// What an evaluation finds in a measured curve.
#[derive(Debug, Clone)]
pub enum Evaluated {
    /// A load and its unloading.
    Unloading(Box<EvaluatedCurve>),
    /// Readings of a continuous stiffness, one contact each.
    Stiffnesses(Vec<IndentationNumbers>),
}

/// A cycle goes beyond those before if its force is larger by this part.
const BEYOND: f64 = 0.02;

/// A measured curve, or a cycle of it, and its evaluation.
#[derive(Debug, Clone)]
pub struct EvaluatedFile {
    /// The index of its table.
    pub table: usize,
    /// The measurement.
    pub measured: MeasuredCurve,
    /// Its numbers, or why there are none.
    pub evaluated: Result<Evaluated, IndentationError>,
}

impl Evaluated {
    /// The numbers of its contacts.
    #[must_use]
    pub fn contacts(&self) -> &[IndentationNumbers] {
        match self {
            Self::Unloading(curve) => std::slice::from_ref(&curve.numbers),
            Self::Stiffnesses(contacts) => contacts,
        }
    }

    /// The unloading, if it is one.
    #[must_use]
    pub fn unloading(&self) -> Option<&EvaluatedCurve> {
        match self {
            Self::Unloading(curve) => Some(curve),
            Self::Stiffnesses(_) => None,
        }
    }
}

/// What a fit file asks for.
#[derive(Debug)]
pub enum Task {
    /// Unloadings are evaluated.
    Evaluation(Box<EvaluationFile>),
    /// A model is fitted.
    Fit(Box<FitFile>),
}

impl Task {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// An [`Error`](pellicle::Error) if the file cannot be read or is not valid.
    pub fn read(path: &Path, measurements: Measurements) -> Result<Self, pellicle::Error> {
        let source = Arc::new(source_file::read(path)?);
        let stem = source_file::stem(path);
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&source, &stem, &FitSources::in_folder(folder), measurements)
    }

    /// Reads the text of a file; `sources` supplies its files and arrays. Without `[unknown]` and `[model]` an
    /// `[evaluation]` stands alone.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn parse(
        source: &Arc<Source>,
        name: &str,
        sources: &FitSources,
        measurements: Measurements,
    ) -> Result<Self, pellicle::Error> {
        let root = toml_tree::parse(source)?;
        let table = TableReader::root(&root)?;
        let has = |key| table.optional(key).is_some();
        if has("evaluation") && !has("unknown") && !has("model") {
            let file = EvaluationFile::of(&root, name, &sources.measurements)?;
            return Ok(Self::Evaluation(file.into()));
        }
        let file = FitFile::parse(source, name, sources, measurements)?;
        Ok(Self::Fit(file.into()))
    }
}

impl EvaluationFile {
    fn of(
        root: &toml_tree::TomlNode,
        name: &str,
        sources: &MeasurementSources,
    ) -> Result<Self, Diagnosis> {
        let table = TableReader::root(root)?;
        table.only(&FitFile::EVALUATION_KEYS)?;
        let title = match table.optional("title") {
            Some(field) => field.text()?,
            None => name,
        };
        let field = table.required("evaluation", "a table [evaluation]")?;
        if let Some(thinning) = field.clone().table()?.optional("thinning") {
            return Err(thinning.wanted("none without a [model], whose top layer it thins"));
        }
        let data = DataTable::read_all(root, sources)?;
        let file = Self {
            title: title.replace(char::is_control, " "),
            settings: evaluation::read(&field, sources, &data)?,
            data,
            document: Document::new(root),
        };
        let other = file.data.iter().find(|table| !table.is_unloading());
        match other {
            Some(table) => Err(table.wanted(
                "observe",
                "\"unloading\", since there is an [evaluation] and neither [model] nor [unknown]",
            )),
            None => Ok(file),
        }
    }
}

impl EvaluationFile {
    /// Calibrates the indenter and the frame, if the file asks for it.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first file that gives no curve, or of the key `calibrate`.
    pub fn calibration(&self) -> Result<Option<Calibration>, Diagnosis> {
        let Some(task) = self.settings.calibration_task() else {
            return Ok(None);
        };
        // Neither area nor modulus enter what a calibration reads of a contact.
        let provisional = EvaluationSettings {
            area: Some(AreaFunction::Polynomial(vec![1.0])),
            indenter: None,
            ..self.settings.clone()
        };
        let evaluated = EvaluatedFile::all(&self.data, &provisional)?;
        let contacts = evaluated
            .iter()
            .filter_map(|file| file.evaluated.as_ref().ok());
        let contacts = contacts.flat_map(Evaluated::contacts);
        let contacts: Vec<_> = contacts
            .filter_map(|found| provisional.measured_contact(found))
            .collect();
        let found = calibrate(&contacts, task);
        let refused =
            |error: IndentationError| self.document.refused(&["evaluation.calibrate"], &error);
        found.map(Some).map_err(refused)
    }
}

impl EvaluatedFile {
    /// The unloading, if it is one and has numbers.
    #[must_use]
    pub fn unloading(&self) -> Option<&EvaluatedCurve> {
        self.evaluated.as_ref().ok()?.unloading()
    }

    /// Evaluates the curves of the tables of unloadings among these.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first file that gives no curve.
    pub fn all(data: &[DataTable], settings: &EvaluationSettings) -> Result<Vec<Self>, Diagnosis> {
        let tables = data.iter().enumerate();
        let mut measured = Vec::new();
        for (table, data) in tables.filter(|(_, data)| data.is_unloading()) {
            let curves = MeasuredCurve::read_all(data)?.into_iter();
            measured.extend(curves.map(|curve| (table, curve)));
        }
        let evaluated = measured
            .into_par_iter()
            .flat_map_iter(|(table, measured)| Self::cycles(table, measured, settings));
        Ok(evaluated.collect())
    }

    /// The cycles of a curve that go beyond the ones before, each as a curve of its own, the largest last. All have the
    /// drift and the zero of the depth that are found with that.
    fn cycles(table: usize, measured: MeasuredCurve, settings: &EvaluationSettings) -> Vec<Self> {
        let evaluated = Self::of(&measured, settings);
        let mut files = Vec::new();
        if let Ok(Evaluated::Unloading(curve)) = &evaluated {
            let settings = EvaluationSettings {
                drift: match (settings.drift, &curve.drift) {
                    (_, Some(hold)) => Drift::Rate(hold.rate),
                    (Drift::Rate(rate), None) => Drift::Rate(rate),
                    _ => Drift::Off,
                },
                depth_zero: DepthZero::At(curve.zero),
                ..settings.clone()
            };
            let peaks = peaks(&curve.force);
            let mut largest = 0.0;
            for (cycle, peak) in peaks.iter().enumerate() {
                let force = curve.force[*peak];
                let next = peaks.get(cycle + 1).copied().unwrap_or(curve.force.len());
                let lowest =
                    (*peak..next).min_by(|a, b| curve.force[*a].total_cmp(&curve.force[*b]));
                let lowest = lowest.unwrap_or(*peak);
                // The largest cycle is the curve itself, wherever noise puts its peak.
                if force < largest || lowest >= curve.phases.top.start {
                    continue;
                }
                largest = (1.0 + BEYOND) * force;
                let measured = measured.up_to(lowest + 1);
                files.push(Self {
                    table,
                    evaluated: Self::of(&measured, &settings),
                    measured,
                });
            }
        }
        files.push(Self {
            table,
            measured,
            evaluated,
        });
        files
    }

    fn of(
        measured: &MeasuredCurve,
        settings: &EvaluationSettings,
    ) -> Result<Evaluated, IndentationError> {
        let depth = measured.depth().unwrap_or_default();
        let force = measured.force().unwrap_or_default();
        if let Some(stiffness) = measured.stiffness() {
            let readings = [depth, force, stiffness];
            let contacts = evaluate_stiffnesses(readings, measured.contact_radius(), settings)?;
            return Ok(Evaluated::Stiffnesses(contacts));
        }
        let before = measured.before_contact;
        // The force without contact is no force.
        let offset = before.map_or(0.0, |before| before.zero()[0]);
        let force: Vec<f64> = force.iter().map(|force| force - offset).collect();
        let first = before.map(|before| {
            let rows = measured.rows.iter();
            rows.take_while(|row| **row < before.contact_row).count()
        });
        let curve = IndentationCurve {
            time: measured.time(),
            depth,
            force: &force,
            first_contact: first,
        };
        evaluate(curve, settings).map(|curve| Evaluated::Unloading(curve.into()))
    }
}
