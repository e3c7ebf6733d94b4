//! `[solver]`: tolerance, method, and the hardness that cuts the pressure.

use pellicle_contact::{Method, SolverOptions};
use serde::Serialize;

use crate::declare::codec::Number;
use crate::declare::macros::record;
use crate::declare::{Codec, Scope, fraction, pressure, word};
use crate::input::diagnosis::Diagnosis;
use crate::input::value_reader::ValueReader;

/// Below the lower limit rounding errors dominate; above the upper limit the solution is useless.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-13..=1e-2;

record! {
    /// Tolerance and method of a case.
    #[derive(Copy)]
    pub struct SolverCase {
        tolerance: f64 = tolerance().or(SolverOptions::default().tolerance, "1e-8"),
            "bound on every line of the certificate";
        method: MethodCase = word(METHODS).checked(fits_the_grid).or(MethodCase::Gradient, "\"gradient\""),
            "the solver: fast, or the paper's own for small grids";
        #[serde(skip_serializing_if = "Option::is_none")]
        hardness: Option<f64> = pressure().positive().optional("none"), "pressure at which the surface yields";
    }
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

const METHODS: &[(&str, MethodCase)] = &[
    ("gradient", MethodCase::Gradient),
    ("active-set", MethodCase::ActiveSet),
];

fn tolerance() -> Number {
    let (least, most) = (TOLERANCES.start(), TOLERANCES.end());
    fraction(TOLERANCES, format!("a number from {least:e} to {most:e}"))
}

/// Refuses a method that is too expensive for the grid.
fn fits_the_grid(
    value: &ValueReader<'_>,
    method: MethodCase,
    scope: &Scope<'_>,
) -> Result<MethodCase, Diagnosis> {
    let solver = SolverCase {
        method,
        ..SolverCase::default()
    };
    let checked = solver.options().checked_for(scope.elements);
    checked.map_err(|error| value.refused(&error))?;
    Ok(method)
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
    use crate::declare::Record;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<SolverCase, String> {
        read_table(text, |table| {
            let elements = 256;
            let scope = Scope {
                elements,
                ..Scope::default()
            };
            SolverCase::read(&table, &scope)
        })
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
