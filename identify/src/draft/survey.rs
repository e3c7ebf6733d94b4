//! What a measured file is found to be: its text, the columns that it has, its cantilever, and what happens in it.

use std::path::{Path, PathBuf};

use pellicle::input::decode::TextEncoding;

use super::history::History;
use super::table_columns::{SurveyedColumn, SurveyedUnit, chosen, guesses, named};
use super::{DraftError, DraftKind, spring_guess};
use crate::measured::channel::Channel;
use crate::measured::columns::{self, ColumnName, ColumnUnit, CurveColumns};
use crate::measured::decimal_mark::DecimalMark;
use crate::measured::error::CurveError;
use crate::measured::raw_curve::RawCurve;
use crate::measured::reading;
use crate::measured::sources::MeasurementSources;
use crate::measured::spring::{self, HeightDirection, SpringConstant, SpringSource};
use crate::measured::stated::{StatedNumber, StatedQuantity};
use crate::measured::text_options::TextOptions;
use crate::measured::text_table::TextTable;

/// A depth without unit that goes no farther is in micrometres, otherwise in nanometres.
const SHALLOW: f64 = 5.0;

/// A load of negative sign falls from its start by more than so many times what it rises,
const DOWNWARD: f64 = 3.0;
/// and is lowest beyond this part of the way.
const DEEPEST: f64 = 0.8;
/// Of a cantilever most loads are farther from the lowest than this part of the fall, or it is the noise of a baseline
/// after a retraction, with which the file begins.
const FEW_BELOW: f64 = 0.3;

/// What a measured file is found to be.
#[derive(Debug, Clone)]
pub(super) struct Survey {
    /// The file.
    pub(super) file: PathBuf,
    /// Number of columns of its table.
    pub(super) width: usize,
    /// Number of tables in it.
    pub(super) tables: usize,
    /// Its decimal mark.
    pub(super) decimal: DecimalMark,
    /// Its encoding, where it is only guessed.
    pub(super) encoding: Option<&'static str>,
    /// What its lines above the table state.
    pub(super) stated: Vec<StatedNumber>,
    /// The columns that are read.
    pub(super) columns: Vec<SurveyedColumn>,
    /// Its cantilever, if it has one.
    pub(super) spring: Option<SpringGuess>,
    /// The quantities whose sign is reversed.
    pub(super) reversed: Vec<Channel>,
    /// Whether its unloading is evaluated, and nothing fitted to a model.
    pub(super) is_unloading: bool,
    /// What happens in it.
    pub(super) history: Option<History>,
}

/// The spring constant of a cantilever, N/m.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SpringGuess {
    /// Its value.
    pub(super) value: f64,
    /// The line that states it.
    pub(super) stated: Option<StatedNumber>,
}

impl Survey {
    /// Surveys a file.
    pub(super) fn of(file: &Path, kind: DraftKind) -> Result<Self, DraftError> {
        let curve_error = |error| DraftError::Curve {
            file: file.to_owned(),
            error,
        };
        let sources = MeasurementSources::default();
        let bytes = sources.read(file).map_err(|error| {
            curve_error(CurveError::Unreadable {
                cause: error.to_string(),
            })
        })?;
        let decoded = reading::decoded(file, &bytes, TextEncoding::Guessed).map_err(curve_error)?;
        let (options, table) = table(&decoded.text).map_err(curve_error)?;
        let guesses = guesses(&table, &options).ok_or_else(|| not_understood(file, &table))?;
        let stated_spring = StatedNumber::of(StatedQuantity::SpringConstant, &table.stated);
        let (chosen, is_cantilever) = chosen(&guesses, kind, stated_spring.is_some())
            .ok_or_else(|| not_understood(file, &table))?;
        let mut columns = named(&chosen, &guesses, &table);
        let mut raw = raw(&table, &columns, &options).map_err(curve_error)?;
        let sensitivity = StatedNumber::of(StatedQuantity::Sensitivity, &table.stated);
        assume_units(&mut columns, &mut raw, sensitivity);
        let reversed = Vec::from_iter(reversed_load(&mut raw));
        let spring = is_cantilever.then(|| SpringGuess::of(stated_spring, &raw));
        if let Some(spring) = &spring {
            spring.add_penetration(&mut raw).map_err(curve_error)?;
        }
        let history = History::of(&raw);
        let mut survey = Self {
            file: file.to_owned(),
            width: table.columns,
            tables: table.tables,
            decimal: options.decimal,
            encoding: decoded.guessed,
            columns,
            spring,
            reversed,
            is_unloading: false,
            history,
            stated: table.stated,
        };
        survey.choose_observable(kind);
        Ok(survey)
    }

    /// Decides between the unloading, the contact stiffness and the loading. After a pop-in all are those of an
    /// imprint; an unloading that gives back too little work, or a contact that is stiffer than its loading, is that of
    /// one, too.
    fn choose_observable(&mut self, kind: DraftKind) {
        let history = self.history.as_ref();
        let has_pop_in = history.is_some_and(|of| of.pop_in.is_some());
        let is_imprint = history.is_some_and(|of| of.is_plastic() || of.is_stiffer_than_loading());
        self.is_unloading = match kind {
            DraftKind::Guessed => is_imprint && !has_pop_in && self.spring.is_none(),
            DraftKind::Afm => false,
            DraftKind::Unloading => true,
        };
        // A file with a stiffness is evaluated at each of its rows.
        let has_unloading = history.is_some_and(|of| of.returned.is_some());
        let is_ignored = if self.is_unloading {
            has_unloading
        } else {
            has_pop_in
        };
        if is_ignored {
            self.columns
                .retain(|column| column.channel != Channel::Stiffness);
        }
    }

    /// Whether a column of this quantity is read.
    pub(super) fn has(&self, channel: Channel) -> bool {
        self.columns.iter().any(|column| column.channel == channel)
    }

    /// The line that states a quantity.
    pub(super) fn stated(&self, quantity: StatedQuantity) -> Option<&StatedNumber> {
        StatedNumber::of(quantity, &self.stated)
    }

    /// The line that states the radius of the tip.
    pub(super) fn stated_radius(&self) -> Option<&StatedNumber> {
        StatedNumber::of(StatedQuantity::TipRadius, &self.stated)
    }
}

/// The table of a text, with the decimal mark that gives one.
fn table(text: &str) -> Result<(TextOptions, TextTable<'_>), CurveError> {
    let options = TextOptions::default();
    match TextTable::find(text, &options) {
        Err(CurveError::NoTable { hint: Some(_) }) => {
            let decimal = DecimalMark::Comma;
            let options = TextOptions { decimal, ..options };
            TextTable::find(text, &options).map(|table| (options, table))
        }
        found => found.map(|table| (options, table)),
    }
}

fn not_understood(file: &Path, table: &TextTable<'_>) -> DraftError {
    let headings: Vec<_> = table
        .header
        .iter()
        .map(|head| format!("\"{}\"", head.text))
        .collect();
    let columns = match headings[..] {
        [] => format!("{} columns without names", table.columns),
        _ => format!("the columns {}", headings.join(", ")),
    };
    DraftError::Columns {
        file: file.to_owned(),
        columns,
        wanted: "a force, and a depth or the height of a piezo",
    }
}

fn raw(
    table: &TextTable<'_>,
    columns: &[SurveyedColumn],
    options: &TextOptions,
) -> Result<RawCurve<'static>, CurveError> {
    let channel = |column: &SurveyedColumn| {
        let unit = match &column.unit {
            SurveyedUnit::Stated(_) => None,
            SurveyedUnit::Assumed(unit) => {
                let size = columns::size(unit, column.channel.dimension());
                Some(ColumnUnit::Value(size.unwrap_or(1.0)))
            }
            SurveyedUnit::Sensitivity(value) => Some(ColumnUnit::Value(*value)),
        };
        (column.channel, ColumnName::Number(column.number), unit)
    };
    let columns = CurveColumns {
        channels: columns.iter().map(channel).collect(),
        segment: None,
        marker: None,
    };
    let read = RawCurve::read(table, &columns, options)?;
    Ok(RawCurve {
        channels: read.channels,
        segments: Vec::new(),
        markers: Vec::new(),
        rows: read.rows,
        missing: read.missing,
    })
}

/// Fits the units that no header states to the numbers: shallow depths are in micrometres, the forces of a cantilever
/// in nanonewtons, and a voltage has a sensitivity.
fn assume_units(
    columns: &mut [SurveyedColumn],
    raw: &mut RawCurve<'_>,
    stated: Option<&StatedNumber>,
) {
    let has_height = columns
        .iter()
        .any(|column| column.channel == Channel::Height);
    for column in columns {
        let Some(values) = raw.values(column.channel) else {
            continue;
        };
        let valid = values.iter().copied().filter(|value| value.is_finite());
        let (low, high) = valid.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        let change = match (&column.unit, column.channel) {
            (SurveyedUnit::Assumed(_), Channel::Depth | Channel::Height | Channel::Deflection)
                if high - low < SHALLOW * 1e-9 =>
            {
                column.unit = SurveyedUnit::Assumed("um");
                1e3
            }
            (SurveyedUnit::Assumed(_), Channel::Force) if has_height => {
                column.unit = SurveyedUnit::Assumed("nN");
                1e-6
            }
            (SurveyedUnit::Sensitivity(_), _) => {
                let heights = raw.values(Channel::Height).unwrap_or_default();
                let guess = || spring_guess::sensitivity(heights, values);
                let sensitivity = stated.map_or_else(guess, |stated| stated.value);
                column.unit = SurveyedUnit::Sensitivity(sensitivity);
                sensitivity
            }
            _ => continue,
        };
        let changed = values.iter().map(|value| change * value).collect();
        raw.replace(column.channel, changed);
    }
}

/// The force or the deflection, if it presses with a negative sign: far from its start it is negative, and deepest in.
/// A pull-off is not: there the indenter is on its way out. Reverses it.
fn reversed_load(raw: &mut RawCurve<'_>) -> Option<Channel> {
    let channel = [Channel::Force, Channel::Deflection]
        .into_iter()
        .find(|channel| raw.values(*channel).is_some())?;
    let lengths = raw.values(Channel::Height).or(raw.values(Channel::Depth))?;
    let loads = raw.values(channel)?;
    let valid = lengths
        .iter()
        .zip(loads)
        .filter(|(length, load)| length.is_finite() && load.is_finite());
    let points: Vec<(f64, f64)> = valid.map(|(length, load)| (*length, *load)).collect();
    let (start, first) = *points.first()?;
    let (end, last) = *points
        .iter()
        .min_by(|one, other| one.1.total_cmp(&other.1))?;
    let most = points
        .iter()
        .map(|point| point.1)
        .fold(f64::NEG_INFINITY, f64::max);
    let travel = points
        .iter()
        .map(|point| (point.0 - start).abs())
        .fold(0.0, f64::max);
    let presses_down = last < 0.0 && first - last > DOWNWARD * (most - first);
    if !presses_down || (end - start).abs() < DEEPEST * travel {
        return None;
    }
    let near = |load: &&(f64, f64)| load.1 - last < FEW_BELOW * (first - last);
    let has_height = raw.values(Channel::Height).is_some();
    if has_height && 2 * points.iter().filter(near).count() > points.len() {
        return None;
    }
    let reversed = loads.iter().map(|load| -load).collect();
    raw.replace(channel, reversed);
    Some(channel)
}

impl SpringGuess {
    fn of(stated: Option<&StatedNumber>, raw: &RawCurve<'_>) -> Self {
        let heights = raw.values(Channel::Height).unwrap_or_default();
        // Without a force, that of a deflection is not steeper than the approach.
        let forces = raw.values(Channel::Force).unwrap_or_default();
        let assumed = || spring_guess::spring_constant(heights, forces);
        Self {
            value: stated.map_or_else(assumed, |stated| stated.value),
            stated: stated.cloned(),
        }
    }

    /// Adds force and penetration to the columns of a file.
    fn add_penetration(&self, raw: &mut RawCurve<'_>) -> Result<(), CurveError> {
        let constant = SpringConstant {
            mean: self.value,
            sd: None,
            source: SpringSource::BareNumber,
        };
        spring::add_penetration(raw, HeightDirection::FromForce, constant)
    }
}
