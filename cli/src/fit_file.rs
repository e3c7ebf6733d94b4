//! The fit file: which measurements, what is sought from them, and what is known besides.

pub mod model;
pub mod nuisance;
pub mod prior;
pub mod report;
pub mod unknown;

use std::path::Path;
use std::sync::Arc;

use self::model::FitModel;
use self::nuisance::NuisanceTable;
use self::report::ReportTable;
use self::unknown::{UnknownCase, read_unknowns};
use crate::case::document::{self, Document};
use crate::case::source::{self, Source};
use crate::case::table_reader::TableReader;
use crate::case::value_reader::ValueReader;
use crate::failure::Failure;
use crate::measured::data_table::DataTable;

/// A fit file.
#[derive(Debug)]
pub struct FitFile {
    /// Title; the name of the file unless given.
    pub title: String,
    /// The model.
    pub model: FitModel,
    /// The measurements.
    pub data: Vec<DataTable>,
    /// What is sought.
    pub unknowns: Vec<UnknownCase>,
    /// What acts on the measurements besides.
    pub nuisances: NuisanceTable,
    /// How the result is told.
    pub report: ReportTable,
    /// The tree of the file, for diagnoses.
    pub document: Document,
}

/// Whether a fit file must name measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measurements {
    /// It must.
    Required,
    /// It need not: they are to be planned.
    Optional,
}

impl FitFile {
    /// Reads the file.
    ///
    /// # Errors
    ///
    /// [`Failure::Unreadable`] if the file or its case cannot be read, [`Failure::Case`] if one of them is not valid.
    pub fn read(path: &Path, measurements: Measurements) -> Result<Self, Failure> {
        let source = Arc::new(source::read(path)?);
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&source, &stem, folder, measurements)
    }

    /// Reads the text of a fit file that names its files relative to `folder`.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn parse(
        source: &Arc<Source>,
        name: &str,
        folder: &Path,
        measurements: Measurements,
    ) -> Result<Self, Failure> {
        const TABLES: [&str; 6] = ["title", "model", "data", "unknown", "nuisance", "report"];
        let root = document::parse(source)?;
        let table = TableReader::root(&root)?;
        table.only(&TABLES)?;
        let title = match table.optional("title") {
            Some(field) => field.text()?,
            None => name,
        };
        let model = table.required("model", "a table [model]")?;
        let model = FitModel::read(&model, folder)?;
        let parameters = model.parameters()?;
        let unknown = table.required("unknown", "a table [unknown] of the keys that are sought")?;
        let unknowns = read_unknowns(&unknown, &parameters)?;
        let optional = |key| table.optional(key).map(ValueReader::table).transpose();
        let nuisances = match table.optional("nuisance") {
            Some(field) => NuisanceTable::read(&field, &parameters)?,
            None => NuisanceTable::default(),
        };
        let report = optional("report")?.map(|table| ReportTable::read(&table, &parameters));
        let data = match (table.optional("data"), measurements) {
            (None, Measurements::Optional) => Vec::new(),
            _ => DataTable::read_all(&root, folder)?,
        };
        Ok(Self {
            title: title.replace(char::is_control, " "),
            data,
            model,
            unknowns,
            nuisances,
            report: report.transpose()?.unwrap_or_default(),
            document: Document::new(&root),
        })
    }
}
