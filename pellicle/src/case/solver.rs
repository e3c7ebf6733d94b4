//! `[solver]`: tolerance, method, and the hardness that cuts the pressure.

use pellicle_contact::{Method, SolverOptions};
use serde::Serialize;

use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::{Dimension, Sign};
use crate::input::table_reader::TableReader;

/// Below the lower limit rounding errors dominate; above the upper limit the solution is useless.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-13..=1e-2;

/// Tolerance and method of a case.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SolverCase {
    /// Bound on every line of the certificate.
    pub tolerance: f64,
    /// The solver.
    pub method: MethodCase,
    /// Hardness of the surface, Pa, at which the pressure is cut.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness: Option<f64>,
}

/// A solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MethodCase {
    /// Preconditioned projected gradients on the FFT operator.
    Gradient,
    /// The paper's active set on the dense system.
    ActiveSet,
}

impl Default for SolverCase {
    fn default() -> Self {
        Self {
            tolerance: SolverOptions::default().tolerance,
            method: MethodCase::Gradient,
            hardness: None,
        }
    }
}

impl SolverCase {
    /// Reads the table for a grid of this many elements per side.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key, or of a method that is too expensive for this grid.
    pub fn read(table: &TableReader<'_>, elements: usize) -> Result<Self, Diagnosis> {
        table.only(&["tolerance", "method", "hardness"])?;
        let mut solver = Self::default();
        if let Some(field) = table.optional("tolerance") {
            let wanted = format!(
                "a number from {:e} to {:e}",
                TOLERANCES.start(),
                TOLERANCES.end()
            );
            solver.tolerance = field.number(&wanted)?;
            if !TOLERANCES.contains(&solver.tolerance) {
                return Err(field.wanted(wanted));
            }
        }
        if let Some(field) = table.optional("method") {
            solver.method = field.choice(&[
                ("gradient", MethodCase::Gradient),
                ("active-set", MethodCase::ActiveSet),
            ])?;
            let checked = solver.options().checked_for(elements);
            checked.map_err(|error| field.refused(&error))?;
        }
        if let Some(field) = table.optional("hardness") {
            solver.hardness = Some(field.quantity(Dimension::Pressure, Sign::Positive)?);
        }
        Ok(solver)
    }

    /// The options of the solver.
    #[must_use]
    pub fn options(&self) -> SolverOptions {
        let method = match self.method {
            MethodCase::Gradient => Method::Gradient,
            MethodCase::ActiveSet => Method::ActiveSet,
        };
        SolverOptions {
            tolerance: self.tolerance,
            method,
            ..SolverOptions::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<SolverCase, String> {
        read_table(text, |table| SolverCase::read(&table, 256))
    }

    #[test]
    fn everything_has_a_default() {
        assert_eq!(read(""), Ok(SolverCase::default()));
    }

    #[test]
    fn a_grid_too_large_for_the_dense_system_is_reported_at_the_method() {
        let message = read("method = \"active-set\"").unwrap_err();
        let start = "case.toml, line 1, key `method`: found 256 elements";
        assert!(message.starts_with(start), "{message}");
    }

    #[test]
    fn invalid_solver_settings_are_rejected() {
        for text in [
            "tolerance = 0",
            "tolerance = -1",
            "tolerance = nan",
            "tolerance = 1",
            "method = \"gradeint\"",
            "hardness = 0",
            "hardness = -1",
            "hardness = \"6 um\"",
            "hardness = nan",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
