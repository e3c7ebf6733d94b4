//! The table `text` of a fit file: the format of the text of a measurement.

use pellicle::input::decode::TextEncoding;
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::table_reader::TableReader;

use super::separator::{DecimalMark, Separator};

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
    const KEYS: [&'static str; 6] = [
        "decimal",
        "separator",
        "skip_until",
        "table",
        "encoding",
        "invalid_above",
    ];

    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&Self::KEYS)?;
        let mut options = Self::default();
        if let Some(field) = table.optional("decimal") {
            options.decimal =
                field.choice(&[(".", DecimalMark::Point), (",", DecimalMark::Comma)])?;
        }
        if let Some(field) = table.optional("skip_until") {
            options.skip_until = Some(field.text()?.to_owned());
        }
        if let Some(field) = table.optional("table") {
            options.table = Some(field.count(1..=1_000_000, ", which of the tables in the file")?);
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
        let separator = field.choice(&[
            ("auto", None),
            (",", Some(Separator::Comma)),
            (";", Some(Separator::Semicolon)),
            ("tab", Some(Separator::Tab)),
            ("space", Some(Separator::Space)),
        ])?;
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
