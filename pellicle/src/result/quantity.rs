//! What is known about a number of a result: its names, unit and meaning, and how to take it from a loading step.

use pellicle_contact::{ErrorEstimate, GridError};

use crate::case::Case;
use crate::case::grid::BoundaryCase;
use crate::display::{Unit, position, quantity, significant};
use crate::input::units::Units;
use crate::summary::{RunSummary, StepSummary};

/// What a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// A number in a unit.
    Of(Unit),
    /// A number without dimension.
    Ratio,
    /// A whole number.
    Count,
    /// Whether something holds.
    Truth,
    /// A point x, y of the surface, m.
    Place,
}

/// The value of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// Of [`Measure::Of`] and [`Measure::Ratio`].
    Number(f64),
    /// Of [`Measure::Count`].
    Count(usize),
    /// Of [`Measure::Truth`].
    Truth(bool),
    /// Of [`Measure::Place`].
    Place([f64; 2]),
}

impl From<f64> for Value {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<usize> for Value {
    fn from(value: usize) -> Self {
        Self::Count(value)
    }
}

impl From<bool> for Value {
    fn from(value: bool) -> Self {
        Self::Truth(value)
    }
}

impl From<[f64; 2]> for Value {
    fn from(value: [f64; 2]) -> Self {
        Self::Place(value)
    }
}

/// The results to which a quantity belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Every result.
    Contact,
    /// Every result, but none without contact.
    Touching,
    /// Every result, of use where the body shows between the tops of its relief.
    Relief,
    /// Those with a nominal area: of a periodic cell or a measured map.
    Nominal,
    /// Those with a length over which the pressure is averaged.
    Averaged,
    /// Those with a hardness.
    Hardness,
    /// Those with wear.
    Wear,
    /// Those with a measured map.
    Rough,
    /// Every result: how well its equations are solved, and at what cost.
    Solution,
}

impl Part {
    /// When its quantities are given, in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Contact | Self::Relief | Self::Solution => "always",
            Self::Touching => "with contact",
            Self::Nominal => "in a periodic cell or with a measured map",
            Self::Averaged => "with output.mean_pressure_over",
            Self::Hardness => "with a hardness",
            Self::Wear => "with wear",
            Self::Rough => "with a measured map",
        }
    }

    /// Whether every result has it.
    #[must_use]
    pub fn is_everywhere(self) -> bool {
        matches!(
            self,
            Self::Contact | Self::Touching | Self::Relief | Self::Solution
        )
    }

    /// Whether the results of a case have it.
    #[must_use]
    pub fn is_of(self, case: &Case) -> bool {
        let has_map = case.surface.map().is_some() || case.indenter.map().is_some();
        match self {
            Self::Contact | Self::Touching | Self::Relief | Self::Solution => true,
            Self::Nominal => has_map || case.grid.boundary == BoundaryCase::Periodic,
            Self::Averaged => case.output.mean_pressure_over.is_some(),
            Self::Hardness => case.hardness().is_some(),
            Self::Wear => case.wear.is_some(),
            Self::Rough => has_map,
        }
    }
}

/// A number of a loading step.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Its place in a step of `summary.json`, with a dot between levels.
    pub key: &'static str,
    /// Its name in words, as in tables.
    pub name: &'static str,
    /// Its symbol in the documents, or nothing.
    pub symbol: &'static str,
    /// What it measures.
    pub measure: Measure,
    /// The results that have it.
    pub part: Part,
    /// Its meaning, in words.
    pub meaning: &'static str,
    /// Its value; none where a step has none.
    pub value: fn(&StepSummary) -> Option<Value>,
    /// Its grid error, if it is estimated.
    pub error: Option<fn(&GridError) -> Option<ErrorEstimate>>,
}

impl Quantity {
    /// Its name with its symbol: `force Q`.
    #[must_use]
    pub fn title(&self) -> String {
        format!("{} {}", self.name, self.symbol)
            .trim_end()
            .to_owned()
    }

    /// Its grid error in a step; none if it is not estimated, or there is no coarser grid.
    #[must_use]
    pub fn error_in(&self, step: &StepSummary) -> Option<ErrorEstimate> {
        (self.error?)(&step.grid_error)
    }

    /// Whether some step of a run has it.
    #[must_use]
    pub fn is_in(&self, run: &RunSummary) -> bool {
        self.part.is_everywhere() || run.steps.iter().any(|step| (self.value)(step).is_some())
    }

    /// Its value for human readers, with its unit; none where the step has none, or where it says nothing.
    #[must_use]
    pub fn words(&self, step: &StepSummary, run: &RunSummary) -> Option<String> {
        if self.part == Part::Relief && !run.has_gaps_in_relief() {
            return None;
        }
        Some(match ((self.value)(step)?, self.measure) {
            (Value::Number(value), Measure::Of(unit)) => quantity(value, unit, run.units),
            (Value::Number(value), _) => significant(value, 4),
            (Value::Count(count), _) => count.to_string(),
            (Value::Truth(truth), _) => truth.to_string(),
            (Value::Place(at), _) => position(at, run.grid.element_side, run.units),
        })
    }

    /// The names of its columns in a table, with units: its own, and those of its error.
    #[must_use]
    pub fn columns(&self, units: Units) -> Vec<String> {
        let with_unit = |name: &str| match self.measure.si_unit() {
            Some(unit) => format!("{name} [{}]", units.name(unit)),
            None => name.to_owned(),
        };
        let name = self.name;
        if self.measure == Measure::Place {
            return ["x", "y"]
                .map(|axis| with_unit(&format!("{name} {axis}")))
                .into();
        }
        let mut columns = vec![with_unit(name)];
        if self.error.is_some() {
            columns.push(with_unit(&format!("{name} error")));
            columns.push(format!("{name} resolved"));
        }
        columns
    }

    /// The cells of these columns in the row of a step; empty without a value, and without an error that is resolved.
    #[must_use]
    pub fn cells(&self, step: &StepSummary) -> Vec<String> {
        let mut cells = match (self.value)(step) {
            Some(Value::Number(value)) => vec![cell(Some(value))],
            Some(Value::Count(count)) => vec![count.to_string()],
            Some(Value::Truth(truth)) => vec![truth.to_string()],
            Some(Value::Place(at)) => at.map(|along| cell(Some(along))).into(),
            None if self.measure == Measure::Place => vec![String::new(); 2],
            None => vec![String::new()],
        };
        if self.error.is_some() {
            let error = self.error_in(step);
            let resolved = error.filter(|error| error.resolved);
            cells.push(cell(resolved.map(|error| error.estimate)));
            cells.push(error.map_or_else(String::new, |error| error.resolved.to_string()));
        }
        cells
    }
}

impl Measure {
    /// The unit in SI, in ASCII.
    #[must_use]
    pub fn si_unit(self) -> Option<&'static str> {
        match self {
            Self::Of(unit) => Some(unit.ascii()),
            Self::Place => Some(Unit::Metre.ascii()),
            Self::Ratio | Self::Count | Self::Truth => None,
        }
    }
}

/// The cell of a number in a table: the shortest text that reads back as the same number, or nothing.
#[must_use]
pub fn cell(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}
