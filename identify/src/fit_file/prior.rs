//! The prior of a parameter: the knowledge of its value before the measurement.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::table_reader::TableReader;

use crate::Prior;

/// The keys of a prior, of numbers of this dimension.
#[must_use]
pub fn shape(dimension: Option<Dimension>) -> TableShape {
    let value = || dimension.map_or(Shape::Number, |of| Shape::Quantity(of, Sign::Any));
    let words = Shape::words(&KINDS);
    let factor = "one standard deviation of a lognormal one, above 1";
    let field = |key, meaning, shape| Field::optional(key, meaning, shape, "none");
    TableShape::of([
        field("prior", "the kind of the prior", words),
        field("median", "median of a lognormal one", value()),
        field("factor", factor, Shape::Number),
        field("mean", "mean of a normal one", value()),
        field("sd", "standard deviation of a normal one", value()),
    ])
}

const FACTOR: &str = "a factor above 1 that is one standard deviation, such as 1.05";

/// The kinds of priors.
#[derive(Clone, Copy)]
enum PriorKind {
    Lognormal,
    Normal,
}

const KINDS: [(&str, PriorKind); 2] = [
    ("lognormal", PriorKind::Lognormal),
    ("normal", PriorKind::Normal),
];

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
    Ok(Some(match kind.choice(&KINDS)? {
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
