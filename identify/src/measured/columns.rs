//! The tables `columns` and `units` of a fit file: the columns to read, and their units.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::quantity::{self, QuantityError};
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::TomlValue;
use pellicle::input::value_reader::ValueReader;

use super::channel::Channel;
use super::error::CurveError;
use super::header::{Electrical, HeaderField, HeaderUnit, electrical};
use super::text_table::TextTable;

/// A column by its number from 1 or by its name in the header.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnName {
    /// The number, from 1.
    Number(usize),
    /// The name as in the header, with or without the unit.
    Header(String),
}

impl ColumnName {
    /// The largest column number, beyond any instrument's files.
    const MOST: usize = 10_000;

    /// Reads the value of a key of `columns`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is neither a number nor a name.
    pub fn read(field: &ValueReader<'_>) -> Result<Self, Diagnosis> {
        const WANTED: &str = "the number of a column from 1, or its name in the header of the file";
        match field.value() {
            TomlValue::Integer(_) => {
                let number = field.count(1..=Self::MOST, ", or the name of the column in the file");
                number.map(Self::Number)
            }
            TomlValue::Text(name) if !name.trim().is_empty() => Ok(Self::Header(name.clone())),
            _ => Err(field.wanted(WANTED)),
        }
    }

    /// Returns the index of the column in the table, from 0; `key` is the key that names it.
    ///
    /// # Errors
    ///
    /// [`CurveError`] if the table has no such column, or more than one.
    pub fn place(&self, key: &'static str, table: &TextTable<'_>) -> Result<usize, CurveError> {
        let columns = table.columns.max(table.header.len());
        match self {
            Self::Number(number) if *number > columns => {
                let number = *number;
                Err(CurveError::ColumnRange {
                    key,
                    number,
                    columns,
                })
            }
            Self::Number(number) => Ok(number - 1),
            Self::Header(name) => by_name(name, key, &table.header),
        }
    }
}

/// Finds the column of this name: as written, without its unit, ignoring case, or without anything in brackets, in this
/// order.
fn by_name(name: &str, key: &'static str, header: &[HeaderField]) -> Result<usize, CurveError> {
    let wanted = HeaderField::new(name).text;
    let lower = wanted.to_lowercase();
    let ways: [&dyn Fn(&HeaderField) -> bool; 5] = [
        &|head| head.text == wanted,
        &|head| head.name == wanted,
        &|head| head.text.to_lowercase() == lower,
        &|head| head.name.to_lowercase() == lower,
        &|head| before_brackets(&head.text).to_lowercase() == lower,
    ];
    for way in ways {
        let found: Vec<_> = (header.iter().enumerate())
            .filter(|(_, head)| way(head))
            .map(|(place, _)| place)
            .collect();
        match found[..] {
            [] => {}
            [place] => return Ok(place),
            _ => {
                let numbers: Vec<_> = found.iter().map(|place| (place + 1).to_string()).collect();
                let (name, numbers) = (name.to_owned(), numbers.join(", "));
                return Err(CurveError::NameTwice { key, name, numbers });
            }
        }
    }
    let quoted = header.iter().map(|head| format!("\"{}\"", head.text));
    let columns = match header {
        [] => "the columns, which have no header".to_owned(),
        _ => quoted.collect::<Vec<_>>().join(", "),
    };
    let name = name.to_owned();
    Err(CurveError::NoSuchColumn { key, name, columns })
}

/// The unit of a column, as given in the fit file.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnUnit {
    /// A unit, possibly with a factor or a sign: its SI value and its text.
    Named(f64, String),
    /// A bare number, the factor to SI units; it replaces the unit in the header.
    Value(f64),
    /// A calibration: its SI value per V or A, for which of them, and its text, such as `80 nm/V`.
    Calibration(f64, Electrical, String),
}

impl ColumnUnit {
    /// Reads the value of a key of `units`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not a unit of this quantity.
    pub fn read(field: &ValueReader<'_>, channel: Channel) -> Result<Self, Diagnosis> {
        let dimension = channel.dimension();
        let TomlValue::Text(text) = field.value() else {
            let value = field.quantity(dimension, Sign::Any)?;
            return match value {
                0.0 => Err(field.wanted("a number other than zero")),
                value => Ok(Self::Value(value)),
            };
        };
        let not_zero = |value: f64| match value {
            0.0 => Err(field.wanted("a unit other than zero")),
            value => Ok(value),
        };
        if let Some((value, measures)) = calibration(text, dimension) {
            return Ok(Self::Calibration(not_zero(value)?, measures, text.clone()));
        }
        let unit = size(text, dimension);
        let unit = unit.map_or_else(|_| field.quantity(dimension, Sign::Any), Ok)?;
        Ok(Self::Named(not_zero(unit)?, text.clone()))
    }

    /// The calibration that it is, in SI units per V or per A; none for a mere unit.
    #[must_use]
    pub fn calibration(&self) -> Option<f64> {
        match self {
            Self::Named(..) => None,
            Self::Value(value) | Self::Calibration(value, ..) => Some(*value),
        }
    }

    /// Returns the factor from the column's unit to SI, and checks it against the header of the column.
    ///
    /// # Errors
    ///
    /// [`CurveError`] if neither gives a unit, or if the header indicates another unit or another quantity.
    pub fn factor(
        given: Option<&Self>,
        channel: Channel,
        head: Option<&HeaderField>,
    ) -> Result<f64, CurveError> {
        if let Some(head) = head {
            refuse_other_quantity(given, channel, head)?;
        }
        let stated = head.and_then(|head| {
            let factor = quantity::one(&head.unit_text, channel.dimension()).ok()?;
            Some((factor, head.unit_text.clone()))
        });
        let (name, example) = (channel.key(), example(channel));
        if let (None, Some((factor, header)), Some(below)) = (
            given,
            &stated,
            head.and_then(|head| head.other_unit.as_ref()),
        ) && quantity::one(below, channel.dimension()).ok() != Some(*factor)
        {
            let (header, below) = (header.clone(), below.clone());
            return Err(CurveError::TwoUnits {
                name,
                header,
                below,
            });
        }
        match (given, stated) {
            (Some(Self::Value(value)), _) => Ok(*value),
            (Some(Self::Calibration(value, measures, given)), _) => {
                // A column without a unit is in V or A.
                let unit = head.map_or("", |head| &head.unit_text);
                match (electrical(unit), unit) {
                    (Some((of_column, size)), _) if of_column == *measures => Ok(value * size),
                    (None, "") => Ok(*value),
                    _ => Err(CurveError::OtherUnit {
                        name,
                        header: unit.to_owned(),
                        given: given.clone(),
                    }),
                }
            }
            (Some(Self::Named(factor, given)), Some((stated, header))) => {
                // Different units differ by more than this, so these are the same unit.
                if (factor.abs() / stated - 1.0).abs() < 1e-9 {
                    return Ok(*factor);
                }
                let given = given.clone();
                Err(CurveError::OtherUnit {
                    name,
                    header,
                    given,
                })
            }
            (Some(Self::Named(factor, _)), None) => Ok(*factor),
            (None, Some((stated, _))) => Ok(stated),
            (None, None) => Err(CurveError::NoUnit { name, example }),
        }
    }
}

/// The size of a unit in SI units, which may have a factor or a sign: `-1 nm`, `-nm`, `nm`.
pub(crate) fn size(text: &str, dimension: Dimension) -> Result<f64, QuantityError> {
    if let Ok(value) = quantity::parse(text, dimension) {
        return Ok(value);
    }
    match text.strip_prefix('-') {
        Some(rest) => quantity::one(rest, dimension).map(|one| -one),
        None => quantity::one(text, dimension),
    }
}

/// The SI value per V or A of a text such as `80 nm/V`; none for another text.
pub(super) fn calibration(text: &str, dimension: Dimension) -> Option<(f64, Electrical)> {
    let (upper, lower) = text.rsplit_once('/')?;
    let (measures, per) = electrical(lower.trim())?;
    let upper = size(upper.trim(), dimension).ok()?;
    Some((upper / per, measures))
}

/// Whether a text is a length per V or A, or the reverse.
pub(super) fn is_calibration(text: &str) -> bool {
    let reversed = || {
        let (upper, lower) = text.split_once('/')?;
        calibration(&format!("{lower}/{upper}"), Dimension::Length)
    };
    let length = calibration(text, Dimension::Length);
    length.or_else(reversed).is_some()
}

/// The part of a header before the first bracket.
fn before_brackets(text: &str) -> &str {
    let before = text.split(['(', '[']).next().unwrap_or_default();
    before.trim()
}

fn example(channel: Channel) -> &'static str {
    match channel {
        Channel::Depth | Channel::Height | Channel::Deflection => "nm",
        Channel::ContactRadius => "um",
        Channel::Force => "mN",
        Channel::Time => "s",
        Channel::Stiffness => "N/m",
    }
}

fn refuse_other_quantity(
    given: Option<&ColumnUnit>,
    channel: Channel,
    head: &HeaderField,
) -> Result<(), CurveError> {
    let is_calibrated = given.is_some_and(|given| given.calibration().is_some());
    let refused = |found: String| CurveError::OtherQuantity {
        name: channel.key(),
        column: head.text.clone(),
        found,
        wanted: channel.dimension().noun(),
    };
    match head.unit {
        HeaderUnit::Of(dimension) if dimension != channel.dimension() => {
            Err(refused(format!("which is {}", dimension.noun())))
        }
        HeaderUnit::Electrical if !is_calibrated => Err(CurveError::NoCalibration {
            name: channel.key(),
            column: head.text.clone(),
            unit: head.unit_text.clone(),
            example: example(channel),
        }),
        _ => match channel.other_in(&head.name) {
            // A deflection in newtons is a force.
            Some(other)
                if head.unit == HeaderUnit::Of(channel.dimension())
                    && other.dimension() != channel.dimension() =>
            {
                Ok(())
            }
            Some(other) => Err(refused(format!("which is called a {}", other.key()))),
            None => Ok(()),
        },
    }
}

/// The columns to read, and their units.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveColumns {
    /// Each quantity with its column and its given unit.
    pub channels: Vec<(Channel, ColumnName, Option<ColumnUnit>)>,
    /// The column of segments.
    pub segment: Option<ColumnName>,
    /// The column of markers.
    pub marker: Option<ColumnName>,
}

impl CurveColumns {
    /// The sensitivity of the deflection, m/V; none without a deflection, or with one in a unit of length.
    #[must_use]
    pub fn sensitivity(&self) -> Option<f64> {
        let mut channels = self.channels.iter();
        let (.., unit) = channels.find(|(channel, ..)| *channel == Channel::Deflection)?;
        unit.as_ref()?.calibration().map(f64::abs)
    }

    /// The keys of `columns`.
    #[must_use]
    pub fn shape() -> TableShape {
        let column = || Shape::Either(vec![Shape::Count(1..=usize::MAX), Shape::Text]);
        let field = |key, meaning| Field::optional(key, meaning, column(), "not there");
        let channels = Channel::ALL.map(|channel| field(channel.key(), channel.meaning()));
        let others = [
            field("segment", "a label of the part of the curve"),
            field("marker", "words at single rows"),
        ];
        TableShape::of(channels.into_iter().chain(others).collect::<Vec<_>>())
    }

    /// The keys of `units`.
    #[must_use]
    pub fn units() -> TableShape {
        let field = |channel: Channel| {
            let shape = Shape::Either(vec![Shape::Text, Shape::Number]);
            let meaning =
                "a unit, a calibration such as 80 nm/V, or what one of the file's is in SI units";
            Field::optional(channel.key(), meaning, shape, "that in the header")
        };
        TableShape::of(Channel::ALL.map(field))
    }

    /// Reads `columns` and `units`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault; a unit without a column is one.
    pub fn read(
        columns: &TableReader<'_>,
        units: Option<&TableReader<'_>>,
    ) -> Result<Self, Diagnosis> {
        columns.only(&Self::shape().keys())?;
        if let Some(units) = units {
            units.only(&Self::units().keys())?;
        }
        let name = |key| {
            columns
                .optional(key)
                .map(|field| ColumnName::read(&field))
                .transpose()
        };
        let mut channels = Vec::new();
        for channel in Channel::ALL {
            let unit = units.and_then(|units| units.optional(channel.key()));
            match (name(channel.key())?, unit) {
                (Some(column), unit) => {
                    let unit = unit
                        .map(|unit| ColumnUnit::read(&unit, channel))
                        .transpose()?;
                    channels.push((channel, column, unit));
                }
                (None, Some(_)) => {
                    let wanted = "the column that has this unit".to_owned();
                    return Err(columns.missing(channel.key(), wanted));
                }
                (None, None) => {}
            }
        }
        Ok(Self {
            channels,
            segment: name("segment")?,
            marker: name("marker")?,
        })
    }

    /// Whether the column of a quantity is given.
    #[must_use]
    pub fn has(&self, channel: Channel) -> bool {
        self.channels.iter().any(|(found, ..)| *found == channel)
    }
}
