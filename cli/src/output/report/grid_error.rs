//! The note on the grid error of a number in the report.

use pellicle::display::{Unit, error_of};
use pellicle::input::units::Units;
use pellicle_contact::ErrorEstimate;

/// The note on the grid error of a number.
#[derive(Debug, PartialEq, Eq)]
pub enum GridErrorNote {
    /// The error is not estimated.
    NotEstimated,
    /// There is no coarser grid to compare with.
    OneGrid,
    /// The number still changes from grid to grid.
    NotResolved,
    /// The error and its order.
    Estimated(String),
}

impl GridErrorNote {
    /// Makes the note of a number with this error; the error is none if there is no coarser grid.
    pub fn new(value: f64, unit: Unit, error: Option<ErrorEstimate>, units: Units) -> Self {
        let Some(error) = error else {
            return Self::OneGrid;
        };
        // A prescribed number.
        if error.estimate == 0.0 {
            return Self::NotEstimated;
        }
        if !error.resolved {
            return Self::NotResolved;
        }
        let order = error.order.map(|order| format!(", order {order:.1}"));
        let error = error_of(value, error.estimate, unit, units);
        Self::Estimated(error + &order.unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unresolved_grid_error_is_not_given_as_a_number() {
        let note = |resolved| {
            let estimate = ErrorEstimate {
                estimate: 0.02,
                order: Some(2.0),
                resolved,
            };
            GridErrorNote::new(1.0, Unit::Metre, Some(estimate), Units::Consistent)
        };
        assert_eq!(note(false), GridErrorNote::NotResolved);
        let GridErrorNote::Estimated(text) = note(true) else {
            unreachable!("it is resolved")
        };
        assert!(text.ends_with(", order 2.0"), "{text}");
    }
}
