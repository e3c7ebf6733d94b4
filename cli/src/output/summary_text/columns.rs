//! Lines of a summary in words, in columns.

use pellicle::display::{error_of, position};
use pellicle::input::units::Units;
use pellicle::result::quantity::{Measure, Quantity, Value};
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_contact::ErrorEstimate;

/// Width of the names: that of the longest, and a space.
const NAMES: usize = 26;

/// Lines of name, value and note, in columns.
pub struct TextColumns {
    pub units: Units,
    /// Side of an element, m.
    pub element_side: f64,
    pub text: String,
}

impl TextColumns {
    pub fn push(&mut self, name: &str, value: &str, note: &str) {
        let line = format!("  {name:<NAMES$}{value:<28}{note}");
        self.text.push_str(line.trim_end());
        self.text.push('\n');
    }

    /// Adds a number of a step, if the step has it and it is known, with its grid error.
    pub fn number(&mut self, of: &Quantity, step: &StepSummary, run: &RunSummary) {
        let is_unknown = match (of.value)(step) {
            Some(Value::Number(number)) => number.is_nan(),
            Some(Value::Place(at)) => at.iter().any(|place| place.is_nan()),
            _ => false,
        };
        if is_unknown {
            return;
        }
        if let Some(words) = of.words(step, run) {
            self.push(&of.title(), &words, &self.error(of, step));
        }
    }

    fn error(&self, of: &Quantity, step: &StepSummary) -> String {
        let error = of.error_in(step);
        match (error, (of.value)(step), of.measure) {
            (Some(error), Some(Value::Number(value)), Measure::Of(unit)) => match error {
                // A prescribed quantity.
                ErrorEstimate { estimate: 0.0, .. } => String::new(),
                error if error.resolved => {
                    let error = error_of(value, error.estimate, unit, self.units);
                    format!("{error} (grid)")
                }
                _ => "not resolved by the grid".into(),
            },
            _ => String::new(),
        }
    }

    pub fn position<const AXES: usize>(&mut self, name: &str, at: [f64; AXES]) {
        self.push(name, &position(at, self.element_side, self.units), "");
    }
}
