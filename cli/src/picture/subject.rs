//! What a picture of one loading step shows.

use super::trust;
use crate::case::units::Units;
use crate::display::{self, Scale, Unit};
use crate::output::fields::Fields;
use crate::output::summary::StepSummary;

/// One loading step: its numbers and its fields.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// Of the case.
    pub title: &'a str,
    /// Of the case.
    pub units: Units,
    /// Height of the relief above the surface of the body, m, where it is the same everywhere.
    pub relief_height: Option<f64>,
    /// Its numbers.
    pub step: &'a StepSummary,
    /// Its fields.
    pub fields: Fields<'a>,
}

impl Subject<'_> {
    /// The second line of a heading: force, penetration, largest pressure; and if they are not to be used.
    #[must_use]
    pub fn numbers(&self) -> String {
        let quantity = |value, unit| display::quantity(value, unit, self.units);
        let mark = if self.step.certificate.satisfied {
            ""
        } else {
            "NOT CONVERGED:  "
        };
        format!(
            "{mark}Q = {},  D = {},  largest p = {}",
            quantity(self.step.force, Unit::Newton),
            quantity(self.step.penetration, Unit::Metre),
            quantity(self.largest_pressure(), Unit::Pascal),
        )
    }

    /// The third line of a heading: grid, certificate, grid error.
    #[must_use]
    pub fn trust(&self) -> String {
        trust::of_step(self.fields.size, self.step)
    }

    /// The largest pressure, Pa; 0 without contact.
    #[must_use]
    pub fn largest_pressure(&self) -> f64 {
        self.fields.pressure.iter().copied().fold(0.0, f64::max)
    }

    /// The scale of lengths up to this one.
    #[must_use]
    pub fn metres(&self, largest: f64) -> Scale {
        Scale::of(largest, Unit::Metre, self.units)
    }

    /// The scale of the pressures, and the largest of them on it, or 1 without contact.
    #[must_use]
    pub fn pressures(&self) -> (Scale, f64) {
        let largest = self.largest_pressure();
        let scale = Scale::of(largest, Unit::Pascal, self.units);
        let top = largest / scale.divisor;
        let top = if top > 0.0 && top.is_finite() {
            top
        } else {
            1.0
        };
        (scale, top)
    }
}
