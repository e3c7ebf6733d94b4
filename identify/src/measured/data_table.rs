//! One `[[data]]` table of a fit file: the files of measurements, how they are read, and the part to use.

mod required_columns;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::document::Document;
use pellicle::input::key_path;
use pellicle::input::span::Source;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::{self, TomlNode, TomlTable, TomlValue};
use pellicle::input::value_reader::ValueReader;

use super::baseline::Baseline;
use super::channel::Channel;
use super::columns::CurveColumns;
use super::curve::MeasuredCurve;
use super::curve_segment::CurveSegment;
use super::error::CurveError;
use super::noise::MeasuredNoise;
use super::omitted::OmittedRows;
use super::sources::MeasurementSources;
use super::spring::{HeightDirection, SpringConstant};
use super::stated::StatedNumber;
use super::text_options::TextOptions;
use crate::Observable;

/// One `[[data]]` table.
#[derive(Debug, Clone, PartialEq)]
pub struct DataTable {
    /// The files, in the order of their names.
    pub files: Vec<PathBuf>,
    /// The columns and their units.
    pub columns: CurveColumns,
    /// The form of the text.
    pub text: TextOptions,
    /// The part to use.
    pub segment: CurveSegment,
    /// The line of forces without contact that is subtracted.
    pub baseline: Baseline,
    /// Rows that are left out by hand.
    pub omit: OmittedRows,
    /// The observable that is compared with the model.
    pub observe: Observable,
    /// The noise.
    pub noise: MeasuredNoise,
    /// The spring constant of a cantilever, if the penetration comes from the height of its piezo.
    pub spring_constant: Option<SpringConstant>,
    /// The direction in which that height is counted.
    pub height_direction: HeightDirection,
    /// Values of keys of the model that differ for these files, by their dotted paths.
    pub set: TomlTable,
    /// The source of their content.
    pub sources: MeasurementSources,
    /// The tree of the table, for diagnoses.
    document: Document,
    path: String,
}

impl DataTable {
    /// Its keys.
    #[must_use]
    pub fn shape() -> TableShape {
        let table = Shape::Table;
        let optional = Field::optional;
        let files = "a path from the folder of the fit file, with `*` and `?` for several";
        let observed = "what is compared with the model, at which values of another quantity";
        let set = TableShape::default().open_to("a key of the model and its value");
        TableShape::of([
            Field::required("file", files, Shape::Text),
            Field::required(
                "columns",
                "the number or the name of each column",
                table(CurveColumns::shape()),
            ),
            optional(
                "units",
                "the unit of each column",
                table(CurveColumns::units()),
                "those in the header",
            ),
            optional(
                "text",
                "the form of the text",
                table(TextOptions::shape()),
                "detected",
            ),
            optional(
                "segment",
                "the part to use",
                table(CurveSegment::shape()),
                "the loading",
            ),
            optional(
                "baseline",
                "a line of forces before the contact that is subtracted",
                Baseline::shape(),
                "of a cantilever `\"before contact\"` where its curve shows such a stretch, otherwise `\"off\"`",
            ),
            optional(
                "omit",
                "rows that are left out",
                OmittedRows::shape(),
                "none",
            ),
            optional(
                "observe",
                observed,
                Shape::words(&Observable::ALL),
                "`\"depth at force\"`; of a cantilever `\"force at depth\"`",
            ),
            optional(
                "noise",
                "standard deviations of the readings",
                table(MeasuredNoise::shape()),
                "estimated",
            ),
            optional(
                "spring_constant",
                "that of a cantilever",
                SpringConstant::shape(),
                "that of the files",
            ),
            optional(
                "height_direction",
                "whether a larger height is nearer to the body",
                Shape::words(&HeightDirection::CHOICES),
                "`\"auto\"`",
            ),
            optional(
                "set",
                "keys of the model that are other for these files",
                table(set),
                "none",
            ),
        ])
    }

    /// Reads every `[[data]]` table of the text of a fit file in this folder, ignoring its other tables.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn parse_all(source: &Arc<Source>, folder: &Path) -> Result<Vec<Self>, Diagnosis> {
        Self::read_all(
            &toml_tree::parse(source)?,
            &MeasurementSources::in_folder(folder),
        )
    }

    /// Reads every `[[data]]` table of a fit file with these measurements.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read_all(root: &TomlNode, sources: &MeasurementSources) -> Result<Vec<Self>, Diagnosis> {
        const WANTED: &str = "one table [[data]] or more";
        let tables = TableReader::root(root)?.required("data", WANTED)?;
        let read = |field: &ValueReader<'_>| Self::read(root, field, sources);
        tables.list(WANTED)?.iter().map(read).collect()
    }

    /// The diagnosis that no file was found; none if there are files.
    #[must_use]
    pub fn without_files(&self) -> Option<Diagnosis> {
        let key = format!("{}.file", self.path);
        let wanted = format!("{FILES}; no file matches");
        (self.files.is_empty()).then(|| self.document.wanted(&key, &wanted))
    }

    /// The diagnosis that another value of one of its keys is required.
    #[must_use]
    pub fn wanted(&self, key: &str, wanted: &str) -> Diagnosis {
        self.document
            .wanted(&format!("{}.{key}", self.path), wanted)
    }

    /// The diagnosis that the value of one of its keys is rejected for this reason.
    #[must_use]
    pub fn refused(&self, key: &str, reason: &dyn std::error::Error) -> Diagnosis {
        let key = format!("{}.{key}", self.path);
        self.document.refused(&[&key], reason)
    }

    fn read(
        root: &TomlNode,
        field: &ValueReader<'_>,
        sources: &MeasurementSources,
    ) -> Result<Self, Diagnosis> {
        let table = field.clone().table()?;
        table.only(&Self::shape().keys())?;
        let optional = |key| table.optional(key).map(ValueReader::table).transpose();
        let columns =
            "the columns, such as { depth = 2, force = 3 }, by their numbers from 1 or their names";
        let columns = table.required("columns", columns)?.table()?;
        let spring = table.optional("spring_constant");
        let direction = table.optional("height_direction");
        let files = matching(&table, sources)?;
        let text =
            optional("text")?.map_or(Ok(TextOptions::default()), |t| TextOptions::read(&t))?;
        let columns_read = CurveColumns::read(&columns, optional("units")?.as_ref())?;
        let observe = observe(&table, &columns)?;
        let mut segment =
            optional("segment")?.map_or(Ok(CurveSegment::default()), |t| CurveSegment::read(&t))?;
        if observe == Observable::UnloadingStiffness {
            segment.require_whole(&table)?;
        }
        let mut data = Self {
            omit: table
                .optional("omit")
                .map_or(Ok(OmittedRows::default()), |f| {
                    OmittedRows::read(&f, &files)
                })?,
            files,
            sources: sources.clone(),
            columns: columns_read,
            text,
            segment,
            baseline: (table.optional("baseline"))
                .map_or(Ok(Baseline::default()), |field| Baseline::read(&field))?,
            observe,
            noise: optional("noise")?
                .map_or(Ok(MeasuredNoise::default()), |t| MeasuredNoise::read(&t))?,
            spring_constant: spring.map(|f| SpringConstant::read(&f)).transpose()?,
            height_direction: direction.map_or(Ok(HeightDirection::default()), |f| {
                HeightDirection::read(&f)
            })?,
            set: set(&table)?,
            document: Document::new(root),
            path: field.path().to_owned(),
        };
        data.take_over_spring_constant()?;
        data.require_columns(&table, &columns)?;
        Ok(data)
    }

    /// Takes the spring constant over from the files if the columns need one and the table gives none.
    fn take_over_spring_constant(&mut self) -> Result<(), Diagnosis> {
        let is_needed = self.columns.has(Channel::Height) || self.columns.has(Channel::Deflection);
        if self.spring_constant.is_some() || !is_needed {
            return Ok(());
        }
        let stated: Vec<_> = self.files.iter().map(|file| self.stated(file)).collect();
        self.spring_constant = SpringConstant::of_files(&stated).map_err(|(file, both)| {
            let [first, other] = *both;
            let error = CurveError::OtherSpringConstant {
                given: first.value,
                stated: other.value,
                line: other.line,
                text: other.text,
            };
            self.diagnosis(&self.files[file], &error)
        })?;
        Ok(())
    }

    /// Whether its files are loads and their unloadings, or rows with the stiffness of such, which an evaluation reads.
    #[must_use]
    pub fn is_unloading(&self) -> bool {
        self.observe == Observable::UnloadingStiffness
    }

    /// The numbers that a file states above its table; none if it cannot be read.
    #[must_use]
    pub fn stated(&self, file: &Path) -> Vec<StatedNumber> {
        MeasuredCurve::stated(file, (&self.sources, &self.text))
    }

    /// The diagnosis that its noise or observable differs from that of the first table.
    #[must_use]
    pub fn other_noise(&self) -> Diagnosis {
        let keys = ["noise", "observe", "file"].map(|key| format!("{}.{key}", self.path));
        let given = keys.iter().find(|key| self.document.has(key));
        let key = given.unwrap_or(&keys[2]);
        self.document.wanted(
            key,
            "the noise and the observable of the first [[data]]: a fit has one of each",
        )
    }

    /// The diagnosis of a file that does not give a curve.
    #[must_use]
    pub fn diagnosis(&self, path: &Path, error: &CurveError) -> Diagnosis {
        #[derive(Debug, thiserror::Error)]
        #[error("{file}: {error}")]
        struct InFile<'a> {
            file: String,
            error: &'a CurveError,
        }
        let file = path.display().to_string();
        let keys = error.keys();
        let named = keys.iter().map(String::as_str).chain(["file"]);
        let keys: Vec<_> = named.map(|key| format!("{}.{key}", self.path)).collect();
        let keys: Vec<_> = keys.iter().map(String::as_str).collect();
        self.document.refused(&keys, &InFile { file, error })
    }
}

/// Description of the expected files.
const FILES: &str = "the path of a text file from the folder of the fit file, or a pattern with * and ? for several";

/// Returns the files that match; an empty list is not an error until they are read.
fn matching(
    table: &TableReader<'_>,
    sources: &MeasurementSources,
) -> Result<Vec<PathBuf>, Diagnosis> {
    let field = table.required("file", FILES)?;
    Ok(sources.of(field.text()?))
}

/// The observable; of a cantilever the force, which carries the noise, otherwise the depth.
fn observe(table: &TableReader<'_>, columns: &TableReader<'_>) -> Result<Observable, Diagnosis> {
    let field = table.optional("observe");
    let observe = field.map(|field| field.choice(&Observable::ALL));
    let default = match columns.optional(Channel::Height.key()) {
        Some(_) => Observable::ForceAtDepth,
        None => Observable::DepthAtForce,
    };
    Ok(observe.transpose()?.unwrap_or(default))
}

/// Reads the entries of `set`: their keys must be paths; their values are checked by the model.
fn set(table: &TableReader<'_>) -> Result<TomlTable, Diagnosis> {
    let Some(field) = table.optional("set") else {
        return Ok(TomlTable::default());
    };
    let TomlValue::Table(entries) = field.value() else {
        return Err(field
            .wanted("a table of keys of the model, such as { \"indenter.radius\" = \"1 um\" }"));
    };
    for entry in &entries.entries {
        if key_path::parts(&entry.key).is_none() {
            let wanted = "the dotted path of a key of the model".into();
            let fault = Fault::Unknown { wanted };
            return Err(Diagnosis::of_key(
                entry.key.clone(),
                entry.key_span.clone(),
                fault,
            ));
        }
    }
    Ok(entries.clone())
}
