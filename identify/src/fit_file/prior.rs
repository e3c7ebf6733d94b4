//! The prior of a parameter: the knowledge of its value before the measurement.

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::table_reader::TableReader;

use crate::Prior;

/// The keys of a prior.
pub const KEYS: [&str; 5] = ["prior", "median", "factor", "mean", "sd"];

const FACTOR: &str = "a factor above 1 that is one standard deviation, such as 1.05";

/// The kinds of priors.
#[derive(Clone, Copy)]
enum PriorKind {
    Lognormal,
    Normal,
}

/// Reads the prior of a positive parameter of this dimension (`None` for a plain number). Returns none if the table has
/// no prior.
///
/// # Errors
///
/// A [`Diagnosis`] of the first fault.
pub fn read(
    table: &TableReader<'_>,
    dimension: Option<Dimension>,
) -> Result<Option<Prior>, Diagnosis> {
    let Some(kind) = table.optional("prior") else {
        return Ok(None);
    };
    let choices = [
        ("lognormal", PriorKind::Lognormal),
        ("normal", PriorKind::Normal),
    ];
    Ok(Some(match kind.choice(&choices)? {
        PriorKind::Lognormal => {
            let factor = table.required("factor", FACTOR)?;
            let number = factor.number(FACTOR)?;
            if number <= 1.0 {
                return Err(factor.wanted(FACTOR));
            }
            Prior::Lognormal {
                median: value(table, "median", dimension, Sign::Positive)?,
                factor: number,
            }
        }
        PriorKind::Normal => Prior::Normal {
            mean: value(table, "mean", dimension, Sign::Any)?,
            sd: value(table, "sd", dimension, Sign::Positive)?,
        },
    }))
}

/// Reads the value of a key, a quantity or a plain number.
///
/// # Errors
///
/// A [`Diagnosis`] if it is missing or is not such a value.
pub fn value(
    table: &TableReader<'_>,
    key: &str,
    dimension: Option<Dimension>,
    sign: Sign,
) -> Result<f64, Diagnosis> {
    const NUMBER: &str = "a number";
    match dimension {
        Some(dimension) => {
            let field = table.required(key, &sign.wanted(dimension))?;
            field.quantity(dimension, sign)
        }
        None => table.required(key, NUMBER)?.number(NUMBER),
    }
}
