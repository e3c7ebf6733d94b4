//! The table `segment` of a fit file: the part of a measurement to use.

use std::ops::RangeInclusive;

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::quantity;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::TomlValue;
use pellicle::input::value_reader::ValueReader;

/// The part of a measurement to use.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CurveSegment {
    /// The value in the column of segments; all by default.
    pub value: Option<String>,
    /// Its start, if given.
    pub from: Option<SegmentEnd>,
    /// Its end, if given.
    pub to: Option<SegmentEnd>,
    /// Loading, unloading or both.
    pub part: Branch,
    /// The event that ends it before `to`.
    pub until: Until,
}

/// An end of a segment, inclusive.
#[derive(Debug, Clone, PartialEq)]
pub enum SegmentEnd {
    /// At a force, N.
    Force(f64),
    /// At a time, s.
    Time(f64),
    /// At a row of the table, from 1.
    Row(usize),
    /// At the first row with this marker.
    Marker(String),
}

/// The branch of a curve, by the direction of the force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Branch {
    /// Up to the maximum force.
    #[default]
    Loading,
    /// From the last point at the maximum force on.
    Unloading,
    /// Both branches.
    Whole,
}

/// The event that ends a loading.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Until {
    /// The maximum force.
    #[default]
    LargestForce,
    /// The largest depth step between neighbouring points: the pop-in.
    LargestDepthStep,
}

impl CurveSegment {
    const PARTS: [(&'static str, Branch); 3] = [
        ("loading", Branch::Loading),
        ("unloading", Branch::Unloading),
        ("whole", Branch::Whole),
    ];
    const ENDS_OF_LOADING: [(&'static str, Until); 2] = [
        ("largest force", Until::LargestForce),
        ("largest depth step", Until::LargestDepthStep),
    ];

    /// Its keys.
    #[must_use]
    pub fn shape() -> TableShape {
        let label = Shape::Either(vec![Shape::Text, Shape::Number]);
        let end =
            |key, meaning, missing| Field::optional(key, meaning, SegmentEnd::shape(), missing);
        let parts = Shape::words(&Self::PARTS);
        let ends = Shape::words(&Self::ENDS_OF_LOADING);
        TableShape::of([
            Field::optional("value", "the label in the column `segment`", label, "all"),
            end("from", "where it begins", "the first row"),
            end("to", "where it ends", "the last row"),
            Field::optional("part", "the branch", parts, "`\"loading\"`"),
            Field::optional("until", "what ends a loading", ends, "`\"largest force\"`"),
        ])
    }

    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&Self::shape().keys())?;
        let end = |key| {
            table
                .optional(key)
                .map(|field| SegmentEnd::read(&field))
                .transpose()
        };
        let mut segment = Self {
            value: table
                .optional("value")
                .map(|field| label(&field))
                .transpose()?,
            from: end("from")?,
            to: end("to")?,
            ..Self::default()
        };
        if let Some(field) = table.optional("part") {
            segment.part = field.choice(&Self::PARTS)?;
        }
        if let Some(field) = table.optional("until") {
            segment.until = field.choice(&Self::ENDS_OF_LOADING)?;
            if segment.part != Branch::Loading {
                return Err(field.unusable(
                    &"where part is not \"loading\"",
                    "until for a loading alone",
                ));
            }
        }
        segment.refuse_reversed(table)?;
        Ok(segment)
    }

    /// Makes it that of an unloading, whose evaluation needs the loading before it; `table` has it as `segment`.
    pub(super) fn require_whole(&mut self, table: &TableReader<'_>) -> Result<(), Diagnosis> {
        let given = table
            .optional("segment")
            .map(ValueReader::table)
            .transpose()?;
        for key in ["part", "until"] {
            let field = given.as_ref().and_then(|given| given.optional(key));
            if let Some(field) = field.filter(|field| field.text() != Ok("whole")) {
                let wanted =
                    "\"whole\", or none: an evaluation finds loading, hold and unloading itself";
                return Err(field.wanted(wanted));
            }
        }
        self.part = Branch::Whole;
        Ok(())
    }

    fn refuse_reversed(&self, table: &TableReader<'_>) -> Result<(), Diagnosis> {
        let is_reversed = match (&self.from, &self.to) {
            (Some(SegmentEnd::Force(from)), Some(SegmentEnd::Force(to)))
            | (Some(SegmentEnd::Time(from)), Some(SegmentEnd::Time(to))) => from >= to,
            (Some(SegmentEnd::Row(from)), Some(SegmentEnd::Row(to))) => from >= to,
            _ => false,
        };
        match table.optional("to") {
            Some(field) if is_reversed => Err(field.wanted("an end beyond `from`")),
            _ => Ok(()),
        }
    }
}

impl SegmentEnd {
    const WANTED: &'static str = "a force or a time with its unit, such as \"0.8 mN\" or \"3 s\", the number of a row, \
        or a table of one of force, time, row and marker";

    fn shape() -> Shape {
        let quantity = |dimension| Shape::Quantity(dimension, Sign::Any);
        Shape::Either(vec![
            quantity(Dimension::Force),
            quantity(Dimension::Time),
            Shape::Count(ROWS),
            Shape::Table(Self::table()),
        ])
    }

    /// The keys of an end that is a table, of which exactly one is given.
    fn table() -> TableShape {
        let quantity = |dimension| Shape::Quantity(dimension, Sign::Any);
        let mut table = TableShape::of([
            Field::required("force", "a force", quantity(Dimension::Force)),
            Field::required("time", "a time", quantity(Dimension::Time)),
            Field::required("row", "the number of a row", Shape::Count(ROWS)),
            Field::required("marker", "a word in the column `marker`", Shape::Text),
        ]);
        table.one_of = table.keys();
        table
    }

    fn read(field: &ValueReader<'_>) -> Result<Self, Diagnosis> {
        match field.value() {
            TomlValue::Text(text) => match quantity::dimension_of(text) {
                Some(Dimension::Force) => {
                    field.quantity(Dimension::Force, Sign::Any).map(Self::Force)
                }
                Some(Dimension::Time) => field.quantity(Dimension::Time, Sign::Any).map(Self::Time),
                _ => Err(field.wanted(Self::WANTED)),
            },
            TomlValue::Integer(_) => row(field),
            TomlValue::Table(_) => Self::of_table(&field.clone().table()?),
            _ => {
                let help =
                    "a bare number is a row; a force without a unit is written { force = 0.1 }";
                Err(field.wanted(Self::WANTED).with_help(help))
            }
        }
    }

    fn of_table(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        let keys = Self::table().keys();
        table.only(&keys)?;
        let [key] = table.given(&keys)[..] else {
            return Err(table.missing("force", "one of force, time, row and marker".into()));
        };
        let field = table.required(key, Self::WANTED)?;
        match key {
            "force" => field.quantity(Dimension::Force, Sign::Any).map(Self::Force),
            "time" => field.quantity(Dimension::Time, Sign::Any).map(Self::Time),
            "row" => row(&field),
            _ => Ok(Self::Marker(field.text()?.to_owned())),
        }
    }
}

/// The numbers of the rows of a table.
pub(super) const ROWS: RangeInclusive<usize> = 1..=1_000_000_000;

fn row(field: &ValueReader<'_>) -> Result<SegmentEnd, Diagnosis> {
    let row = field.count(ROWS, ", the number of a row of the table");
    row.map(SegmentEnd::Row)
}

/// Reads a value of the column of segments, a number or a text.
fn label(field: &ValueReader<'_>) -> Result<String, Diagnosis> {
    match field.value() {
        TomlValue::Text(text) => Ok(text.clone()),
        TomlValue::Integer(number) => Ok(number.to_string()),
        TomlValue::Float(number) => Ok(number.to_string()),
        _ => {
            let (found, wanted) = (
                "neither".into(),
                "a number or a text in the column of segments".into(),
            );
            Err(field.diagnosis(Fault::Wrong { found, wanted }))
        }
    }
}
