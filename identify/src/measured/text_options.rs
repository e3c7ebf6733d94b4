//! The table `text` of a fit file: the format of the text of a measurement.

use std::ops::RangeInclusive;

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::decode::TextEncoding;
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::table_reader::TableReader;

use super::decimal_mark::DecimalMark;
use super::separator::Separator;

/// The format of the text of a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct TextOptions {
    /// The decimal mark; a point by default.
    pub decimal: DecimalMark,
    /// The separator of columns; detected if not given.
    pub separator: Option<Separator>,
    /// If given, the table begins at a line with this text.
    pub skip_until: Option<String>,
    /// The number of the table among several, from 1; the first by default.
    pub table: Option<usize>,
    /// The encoding.
    pub encoding: TextEncoding,
    /// Numbers of a larger magnitude mark missing values; 1e100 by default.
    pub invalid_above: f64,
}

impl Default for TextOptions {
    fn default() -> Self {
        Self {
            decimal: DecimalMark::Point,
            separator: None,
            skip_until: None,
            table: None,
            encoding: TextEncoding::Guessed,
            invalid_above: 1e100,
        }
    }
}

impl TextOptions {
    const DECIMALS: [(&'static str, DecimalMark); 2] =
        [(".", DecimalMark::Point), (",", DecimalMark::Comma)];
    const SEPARATORS: [(&'static str, Option<Separator>); 5] = [
        ("auto", None),
        (",", Some(Separator::Comma)),
        (";", Some(Separator::Semicolon)),
        ("tab", Some(Separator::Tab)),
        ("space", Some(Separator::Space)),
    ];
    const TABLES: RangeInclusive<usize> = 1..=1_000_000;

    /// Its keys.
    #[must_use]
    pub fn shape() -> TableShape {
        let optional = Field::optional;
        let words = [
            Shape::words(&Self::DECIMALS),
            Shape::words(&Self::SEPARATORS),
        ];
        let [decimals, separators] = words;
        TableShape::of([
            optional("decimal", "the decimal mark", decimals, "a point"),
            optional(
                "separator",
                "what separates columns",
                separators,
                "detected",
            ),
            optional(
                "skip_until",
                "the table begins at a line with this text",
                Shape::Text,
                "detected",
            ),
            optional(
                "table",
                "which of the tables in the file",
                Shape::Count(Self::TABLES),
                "1",
            ),
            optional(
                "encoding",
                "such as `\"utf-16\"`",
                Shape::Text,
                "`\"auto\"`",
            ),
            optional(
                "invalid_above",
                "larger numbers mark missing values",
                Shape::Number,
                "1e100",
            ),
        ])
    }

    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&Self::shape().keys())?;
        let mut options = Self::default();
        if let Some(field) = table.optional("decimal") {
            options.decimal = field.choice(&Self::DECIMALS)?;
        }
        if let Some(field) = table.optional("skip_until") {
            options.skip_until = Some(field.text()?.to_owned());
        }
        if let Some(field) = table.optional("table") {
            options.table = Some(field.count(Self::TABLES, ", which of the tables in the file")?);
        }
        if let Some(field) = table.optional("encoding") {
            let named = TextEncoding::named(field.text()?);
            options.encoding = named.ok_or_else(|| {
                field.wanted("\"auto\", \"utf-8\", \"latin-1\", \"windows-1252\", \"utf-16\" or a label like these")
            })?;
        }
        if let Some(field) = table.optional("invalid_above") {
            let wanted = "a positive number";
            let number = field.number(wanted)?;
            options.invalid_above = Some(number)
                .filter(|n| *n > 0.0)
                .ok_or_else(|| field.wanted(wanted))?;
        }
        options.separator = Self::separator(table, options.decimal)?;
        Ok(options)
    }

    fn separator(
        table: &TableReader<'_>,
        decimal: DecimalMark,
    ) -> Result<Option<Separator>, Diagnosis> {
        let Some(field) = table.optional("separator") else {
            return Ok(None);
        };
        let separator = field.choice(&Self::SEPARATORS)?;
        if separator == Some(Separator::Comma) && decimal == DecimalMark::Comma {
            let (found, wanted) = (
                "a comma for both".into(),
                "another separator than the decimal mark".into(),
            );
            return Err(field.diagnosis(Fault::Wrong { found, wanted }));
        }
        Ok(separator)
    }
}
