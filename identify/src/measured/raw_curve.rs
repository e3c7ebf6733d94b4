//! The columns of a measurement as numbers in SI units, with every row of the table.

use pellicle::case::map::hole_code::HoleCode;

use super::channel::Channel;
use super::columns::{ColumnUnit, CurveColumns};
use super::error::CurveError;
use super::header::{Electrical, HeaderUnit};
use super::stated::{StatedNumber, StatedQuantity};
use super::text_options::TextOptions;
use super::text_table::TextTable;

/// The columns of a measurement, row by row; invalid numbers are NaN.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RawCurve<'t> {
    /// Values of each quantity, SI.
    pub(crate) channels: Vec<(Channel, Vec<f64>)>,
    /// Fields of the column of segments; empty if there is none.
    pub(crate) segments: Vec<&'t str>,
    /// Fields of the column of markers; empty if there is none.
    pub(crate) markers: Vec<&'t str>,
    /// Number of rows of the table.
    pub(crate) rows: usize,
    /// Numbers that stand for missing ones, such as -9999, and are invalid.
    pub(crate) missing: Vec<(Channel, HoleCode)>,
}

impl<'t> RawCurve<'t> {
    /// Reads the columns of a table.
    pub(crate) fn read(
        table: &TextTable<'t>,
        columns: &CurveColumns,
        options: &TextOptions,
    ) -> Result<Self, CurveError> {
        let mut places = Vec::new();
        for (channel, column, unit) in &columns.channels {
            let place = column.place(channel.key(), table)?;
            let head = table.header.get(place);
            let stated = || {
                let is_in_volts = head.is_some_and(|head| head.unit == HeaderUnit::Electrical);
                let is_deflection = *channel == Channel::Deflection;
                let stated = StatedNumber::of(StatedQuantity::Sensitivity, &table.stated)?;
                let (value, text) = (stated.value, stated.text.clone());
                let is_sure = stated.assumed_unit.is_none();
                (is_sure && is_in_volts && is_deflection).then_some(ColumnUnit::Calibration(
                    value,
                    Electrical::Voltage,
                    text,
                ))
            };
            let unit = unit.clone().or_else(stated);
            let factor = ColumnUnit::factor(unit.as_ref(), *channel, head)?;
            places.push((place, factor));
        }
        let label = |key, name: &Option<super::columns::ColumnName>| {
            name.as_ref().map(|name| name.place(key, table)).transpose()
        };
        let (segment, marker) = (
            label("segment", &columns.segment)?,
            label("marker", &columns.marker)?,
        );
        let mut values = vec![Vec::with_capacity(table.rows.len()); places.len()];
        let (mut segments, mut markers) = (Vec::new(), Vec::new());
        let numbers = RowNumbers { table, options };
        for row in &table.rows {
            let fields = table.separator.fields(row);
            let field = |place: usize| fields.get(place).copied().unwrap_or_default();
            numbers.refuse_split(row, &fields)?;
            for ((place, _), values) in places.iter().zip(&mut values) {
                values.push(numbers.read(row, field(*place))?);
            }
            segments.extend(segment.map(field));
            markers.extend(marker.map(field));
        }
        let channels = columns.channels.iter().map(|(channel, ..)| *channel);
        let mut channels: Vec<(Channel, Vec<f64>)> = channels.zip(values).collect();
        let mut missing = Vec::new();
        for ((channel, values), (_, factor)) in channels.iter_mut().zip(&places) {
            let codes = invalidated(values);
            missing.extend(codes.into_iter().map(|code| (*channel, code)));
            values.iter_mut().for_each(|value| *value *= factor);
        }
        Ok(Self {
            channels,
            missing,
            segments,
            markers,
            rows: table.rows.len(),
        })
    }

    /// Whether its rows are points of one curve in the order of time, and not contacts with a stiffness each.
    pub(crate) fn is_in_order(&self) -> bool {
        self.values(Channel::Stiffness).is_none()
    }

    /// The values of a quantity, if it has a column.
    pub(crate) fn values(&self, channel: Channel) -> Option<&[f64]> {
        let found = self.channels.iter().find(|(found, _)| *found == channel);
        found.map(|(_, values)| values.as_slice())
    }

    /// Replaces or adds the values of a quantity.
    pub(crate) fn replace(&mut self, channel: Channel, values: Vec<f64>) {
        self.channels.retain(|(found, _)| *found != channel);
        self.channels.push((channel, values));
    }

    /// The rows in which every quantity has a valid number.
    pub(crate) fn valid_rows(&self) -> Vec<usize> {
        let is_valid = |row: &usize| {
            let value =
                |(_, values): &(Channel, Vec<f64>)| values.get(*row).is_some_and(|v| v.is_finite());
            self.channels.iter().all(value)
        };
        (0..self.rows).filter(is_valid).collect()
    }
}

/// The numbers that stand for missing ones, which are made invalid.
fn invalidated(values: &mut [f64]) -> Vec<HoleCode> {
    let codes = HoleCode::usual_among(values);
    let is_code = |value: f64| codes.iter().any(|code| code.is_at(value));
    let missing = values.iter_mut().filter(|value| is_code(**value));
    missing.for_each(|value| *value = f64::NAN);
    codes
}

/// The numbers of the rows of a table.
struct RowNumbers<'a, 't> {
    table: &'a TextTable<'t>,
    options: &'a TextOptions,
}

impl RowNumbers<'_, '_> {
    /// The number of a field of a row; NaN if it has none or marks an invalid value.
    fn read(&self, row: &str, field: &str) -> Result<f64, CurveError> {
        let decimal = self.options.decimal;
        let grouped = || match decimal.grouped(field) {
            Some(number) if self.has_decimals() => Ok(Some(number.value)),
            None => Ok(None),
            Some(_) => Err(CurveError::GroupedOrDecimal {
                field: field.to_owned(),
                row: self.number_of(row),
            }),
        };
        let number = match decimal.number(field) {
            None => grouped()?,
            number => number,
        };
        let valid = number.filter(|number| number.abs() <= self.options.invalid_above);
        Ok(valid.unwrap_or(f64::NAN))
    }

    /// Whether a number of the table has the decimal mark, so that the other one can only group digits.
    fn has_decimals(&self) -> bool {
        let is_in = |field: &str| self.options.decimal.is_in(field);
        let mut rows = self.table.rows.iter();
        rows.any(|row| self.table.separator.fields(row).into_iter().any(is_in))
    }

    /// Rejects a row in which the separator stands within a number, so that its fields are displaced.
    fn refuse_split(&self, row: &str, fields: &[&str]) -> Result<(), CurveError> {
        let named = self.table.header.len();
        let columns = self.table.columns;
        if fields.len() <= named.max(1) || (named == 0 && fields.len() <= columns) {
            return Ok(());
        }
        let joined = |pair: &[&str]| {
            let number = self
                .table
                .separator
                .joined([pair[0], pair[1]], self.options.decimal);
            number.filter(|number| number.is_certain || fields.len() > columns)
        };
        match fields.windows(2).find(|pair| joined(pair).is_some()) {
            None => Ok(()),
            Some(pair) => Err(CurveError::GroupedBySeparator {
                fields: pair.join(" and "),
                row: self.number_of(row),
            }),
        }
    }

    /// The number of a row, from 1.
    fn number_of(&self, row: &str) -> usize {
        let place = self.table.rows.iter().position(|found| *found == row);
        place.map_or(0, |place| place + 1)
    }
}
