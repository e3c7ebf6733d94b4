//! Lines of a summary in words, in columns.

use pellicle_contact::ErrorEstimate;

use crate::display::{Unit, error_of, position, quantity};
use crate::input::units::Units;

/// Lines of name, value and note, in columns.
pub struct TextColumns {
    pub units: Units,
    /// Side of an element, m.
    pub element_side: f64,
    pub text: String,
}

impl TextColumns {
    pub fn push(&mut self, name: &str, value: &str, note: &str) {
        let line = format!("  {name:<18}{value:<28}{note}");
        self.text.push_str(line.trim_end());
        self.text.push('\n');
    }

    pub fn quantity(&mut self, name: &str, value: f64, unit: Unit) {
        self.push(name, &quantity(value, unit, self.units), "");
    }

    pub fn position<const AXES: usize>(&mut self, name: &str, at: [f64; AXES]) {
        self.push(name, &position(at, self.element_side, self.units), "");
    }

    pub fn estimated(&mut self, name: &str, value: f64, unit: Unit, error: Option<ErrorEstimate>) {
        let note = match error {
            // A prescribed quantity.
            Some(error) if error.estimate == 0.0 => String::new(),
            Some(error) if error.resolved => {
                format!(
                    "{} (grid)",
                    error_of(value, error.estimate, unit, self.units)
                )
            }
            Some(_) => "not resolved by the grid".into(),
            None => String::new(),
        };
        self.push(name, &quantity(value, unit, self.units), &note);
    }
}
