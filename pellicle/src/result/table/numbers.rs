//! The columns of the numbers of a step.

use crate::case::Case;
use crate::input::units::Units;
use crate::result::quantities::QUANTITIES;
use crate::result::quantity::Quantity;
use crate::summary::{RunSummary, StepSummary};

/// The columns: the step, then each number that the steps have.
#[derive(Debug, Clone)]
pub struct NumberColumns {
    /// Whether each of [`QUANTITIES`] has columns.
    given: Vec<bool>,
}

impl NumberColumns {
    /// The columns of a run.
    #[must_use]
    pub fn of_run(run: &RunSummary) -> Self {
        let given = QUANTITIES.iter().map(|quantity| quantity.is_in(run));
        Self {
            given: given.collect(),
        }
    }

    /// The columns that every case has.
    #[must_use]
    pub fn of_every_case() -> Self {
        let given = QUANTITIES.iter().map(|of| of.part.is_everywhere());
        Self {
            given: given.collect(),
        }
    }

    /// Adds the columns of a case that are not there yet.
    pub fn add(&mut self, case: &Case) {
        for (given, quantity) in self.given.iter_mut().zip(QUANTITIES) {
            *given = *given || quantity.part.is_of(case);
        }
    }

    fn quantities(&self) -> impl Iterator<Item = &'static Quantity> {
        let given = QUANTITIES.iter().zip(&self.given);
        given.filter_map(|(quantity, given)| given.then_some(quantity))
    }

    /// Their names, with units.
    #[must_use]
    pub fn header(&self, units: Units) -> Vec<String> {
        let names = self.quantities().flat_map(|of| of.columns(units));
        std::iter::once("step".to_owned()).chain(names).collect()
    }

    /// Their cells in the row of a step, without commas.
    #[must_use]
    pub fn row(&self, i: usize, step: &StepSummary) -> Vec<String> {
        let cells = self.quantities().flat_map(|of| of.cells(step));
        std::iter::once(i.to_string()).chain(cells).collect()
    }
}
