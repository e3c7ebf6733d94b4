//! The fit file: the measurements, the unknowns with their priors, and the nuisances.

pub mod evaluation;
pub mod evaluation_file;
pub mod model;
pub mod nuisance;
pub mod prior;
pub mod report;
pub mod shape;
mod stated_radius;
mod stiffness;
pub mod unknown;
mod unloadings;

use std::path::Path;
use std::sync::Arc;

use pellicle::case::map_sources::MapSources;
use pellicle::case::parameter::WORK_OF_ADHESION;
use pellicle::input::document::Document;
use pellicle::input::span::Source;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree;
use pellicle::input::value_reader::ValueReader;

use self::model::FitModel;
use self::nuisance::NuisanceTable;
use self::report::ReportTable;
use self::unknown::{UnknownCase, read_unknowns};
use crate::indentation::EvaluationSettings;
use crate::measured::data_table::DataTable;
use crate::measured::sources::MeasurementSources;
use crate::measured::spring;
use crate::measured::stated::StatedNumber;

/// A fit file.
#[derive(Debug, Clone)]
pub struct FitFile {
    /// Title; by default the name of the file.
    pub title: String,
    /// The model.
    pub model: FitModel,
    /// The measurements.
    pub data: Vec<DataTable>,
    /// The unknowns.
    pub unknowns: Vec<UnknownCase>,
    /// Frame compliance, drift and zero of the curves, and parameters of the model that are not known exactly.
    pub nuisances: NuisanceTable,
    /// The table `[report]`.
    pub report: ReportTable,
    /// How unloadings are evaluated, if they are fitted.
    pub evaluation: Option<EvaluationSettings>,
    /// The radius of the indenter, if the files of the measurements state it and the model has none.
    pub stated_radius: Option<StatedNumber>,
    /// The tree of the file, for diagnoses.
    pub document: Document,
}

/// The sources of the maps and measurements of a fit file.
#[derive(Debug, Clone, Default)]
pub struct FitSources {
    /// The maps of the model.
    pub maps: MapSources,
    /// The measurements.
    pub measurements: MeasurementSources,
}

impl FitSources {
    /// The files of a folder.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self {
            maps: MapSources::in_folder(folder),
            measurements: MeasurementSources::in_folder(folder),
        }
    }
}

/// Whether a fit file must name measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measurements {
    /// Measurements are required.
    Required,
    /// Measurements are optional: they are to be planned.
    Optional,
}

impl FitFile {
    /// The keys of a file with an `[evaluation]` alone.
    const EVALUATION_KEYS: [&str; 3] = ["title", "data", "evaluation"];

    /// Reads the text of a fit file; `sources` supplies its files and arrays.
    ///
    /// # Errors
    ///
    /// An [`Error`](pellicle::Error) if the text or its case cannot be read, or one of them is not valid.
    pub fn parse(
        source: &Arc<Source>,
        name: &str,
        sources: &FitSources,
        measurements: Measurements,
    ) -> Result<Self, pellicle::Error> {
        let root = toml_tree::parse(source)?;
        let table = TableReader::root(&root)?;
        table.only(&shape::fit_file().keys())?;
        let title = match table.optional("title") {
            Some(field) => field.text()?,
            None => name,
        };
        let model = table.required("model", "a table [model]")?;
        let mut model = FitModel::read(&model, &sources.maps)?;
        let data = match (table.optional("data"), measurements) {
            (None, Measurements::Optional) => Vec::new(),
            _ => DataTable::read_all(&root, &sources.measurements)?,
        };
        let evaluation = unloadings::evaluation(&table, &data, &sources.measurements)?;
        if let Some(settings) = &evaluation {
            model.give_indenter(settings)?;
        }
        let stated_radius = if model.lacks_radius() && table.optional("data").is_some() {
            stated_radius::of_files(&root, &sources.measurements)?
        } else {
            None
        };
        if let Some(stated) = &stated_radius {
            model.give_radius(&stated_radius::text(stated));
        }
        let parameters = model.parameters()?;
        let unknown = table.required("unknown", "a table [unknown] of the keys that are sought")?;
        let unknowns = read_unknowns(&unknown, &parameters)?;
        let optional = |key| table.optional(key).map(ValueReader::table).transpose();
        let nuisance = table.optional("nuisance");
        let nuisances = match &nuisance {
            Some(field) => NuisanceTable::read(field, &parameters)?,
            None => NuisanceTable::default(),
        };
        let report = optional("report")?.map(|table| ReportTable::read(&table, &parameters));
        let file = Self {
            title: title.replace(char::is_control, " "),
            data,
            model,
            unknowns,
            nuisances,
            report: report.transpose()?.unwrap_or_default(),
            evaluation,
            stated_radius,
            document: Document::new(&root),
        };
        file.refuse_nuisances_of_stiffness(nuisance.as_ref())?;
        Ok(file)
    }

    /// The same fit of one file of one of its tables alone, by their indices; none if there are no such ones.
    #[must_use]
    pub fn alone(&self, table: usize, file: usize) -> Option<Self> {
        let mut data = self.data.get(table)?.clone();
        data.files = vec![data.files.get(file)?.clone()];
        let data = vec![data];
        Some(Self {
            data,
            ..self.clone()
        })
    }

    /// The unknowns, then the parameters of the model that are not known exactly.
    #[must_use]
    pub fn all_unknowns(&self) -> Vec<UnknownCase> {
        let nuisances = self.nuisances.parameters.iter();
        self.unknowns.iter().chain(nuisances).cloned().collect()
    }

    /// Refuses a model with adhesion for a purpose in words.
    ///
    /// # Errors
    ///
    /// A diagnosis at its work of adhesion.
    pub fn refuse_adhesion(&self, purpose: &str) -> Result<(), pellicle::Error> {
        if self.model.parameters()?.adhesion.is_none() {
            return Ok(());
        }
        let key = format!("model.{WORK_OF_ADHESION}");
        let wanted = format!("none {purpose}: only contact without adhesion can be");
        Err(self.document.wanted(&key, &wanted).into())
    }

    /// The SI unit of an estimate of a fit; `index` counts all unknowns, then the spring constants.
    #[must_use]
    pub fn unit(&self, index: usize) -> &'static str {
        let all = self.all_unknowns();
        all.get(index).map_or(spring::UNIT, UnknownCase::unit)
    }
}
