//! A number of a result, found by its name among the columns of a table.
//!
//! A name is that of a column without its unit, as `max pressure` or `critical force yield layer[0]`, or the key of
//! the number in `summary.json`, as `max_pressure`. Spaces, dots and underscores mean the same.

use pellicle::input::diagnosis;
use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;
use pellicle::result::quantities::{self, QUANTITIES};
use pellicle::result::quantity::Measure;

/// The ends of the names of columns that qualify the number before them.
const QUALIFIERS: [&str; 3] = [" error", " resolved", " status"];

/// A column with a number of the result, and those that qualify it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultColumn {
    /// Its name without unit.
    pub name: String,
    /// Its unit, `case units`, or nothing.
    pub unit: Option<String>,
    /// Its place.
    pub value: usize,
    /// The place of its ±.
    pub error: Option<usize>,
    /// The place of whether it is resolved.
    pub resolved: Option<usize>,
    /// The place of its status, that of a critical force.
    pub status: Option<usize>,
}

impl ResultColumn {
    /// Finds the number with this name among the columns of a table.
    ///
    /// # Errors
    ///
    /// What was found, and what is wanted.
    pub fn named(name: &str, columns: &[String]) -> Result<Self, (String, String)> {
        let of_key = quantities::of_key(name.trim());
        let wanted = folded(of_key.map_or(name, |quantity| quantity.name));
        let split: Vec<_> = columns.iter().map(|column| parts(column)).collect();
        let place = |name: &str| split.iter().position(|(of, _)| folded(of) == name);
        let no_number = || (format!("`{name}`, which is no number"), WANTED.to_owned());
        if of_key.is_some_and(|of| matches!(of.measure, Measure::Place | Measure::Truth)) {
            return Err(no_number());
        }
        let Some(value) = place(&wanted) else {
            let found = match of_key {
                Some(of) => format!("`{name}`, which is given {}", of.part.words()),
                None => format!("no result `{name}` of this case"),
            };
            return Err((found, WANTED.into()));
        };
        let (name, unit) = split[value];
        if !is_number(name, unit) {
            return Err(no_number());
        }
        let beside = |what: &str| place(&format!("{wanted}{what}"));
        Ok(Self {
            name: name.to_owned(),
            unit: unit.map(str::to_owned),
            value,
            error: beside(" error"),
            resolved: beside(" resolved"),
            status: beside(" status"),
        })
    }

    /// The name that a misspelt one most likely means: its key, or else the name of its column.
    #[must_use]
    pub fn closest(name: &str, columns: &[String]) -> Option<String> {
        let names = columns.iter().map(|column| parts(column));
        let names: Vec<_> = names
            .filter(|(name, unit)| is_number(name, *unit))
            .collect();
        let word = |name: &str| {
            let quantity = QUANTITIES.iter().find(|quantity| quantity.name == name);
            quantity.map_or_else(
                || name.replace(' ', "_"),
                |quantity| quantity.key.to_owned(),
            )
        };
        let words: Vec<_> = names.iter().map(|(name, _)| word(name)).collect();
        let known: Vec<_> = words.iter().map(String::as_str).collect();
        diagnosis::closest(&name.trim().replace(' ', "_"), &known).map(str::to_owned)
    }

    /// The dimension of its unit; none of a number without a unit, or in the case's own.
    #[must_use]
    pub fn dimension(&self) -> Option<Dimension> {
        let unit = self.unit.as_deref()?;
        quantity::dimension_of(&format!("1 {unit}"))
    }

    /// Its heading in a table, with the unit.
    #[must_use]
    pub fn heading(&self) -> String {
        self.heading_of("")
    }

    /// The heading of its ±.
    #[must_use]
    pub fn error_heading(&self) -> String {
        self.heading_of(" error")
    }

    fn heading_of(&self, what: &str) -> String {
        match &self.unit {
            Some(unit) => format!("{}{what} [{unit}]", self.name),
            None => format!("{}{what}", self.name),
        }
    }
}

const WANTED: &str = "a number of the result of this case, by its key or its name in tables";

/// Splits the name of a column into name and unit.
#[must_use]
pub fn parts(column: &str) -> (&str, Option<&str>) {
    let inside = column
        .strip_suffix(']')
        .and_then(|text| text.rsplit_once(" ["));
    inside.map_or((column, None), |(name, unit)| (name, Some(unit)))
}

/// Whether a column contains a number that is a result: it has a unit, or is a ratio or a count, and qualifies no
/// other.
#[must_use]
pub fn is_number(name: &str, unit: Option<&str>) -> bool {
    if QUALIFIERS.iter().any(|end| name.ends_with(end)) {
        return false;
    }
    let of_name = QUANTITIES.iter().find(|quantity| quantity.name == name);
    let measure = of_name.map(|quantity| quantity.measure);
    unit.is_some() || matches!(measure, Some(Measure::Ratio | Measure::Count))
}

/// The name in lower case, with a single space for every sequence of spaces, dots and underscores.
fn folded(name: &str) -> String {
    let name = name.to_lowercase().replace(['_', '.'], " ");
    let words: Vec<_> = name.split_whitespace().collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Vec<String> {
        [
            "step",
            "max pressure [Pa]",
            "max pressure error [Pa]",
            "max pressure resolved",
            "max pressure at x [m]",
            "contact elements",
            "certificate satisfied",
            "critical force yield layer[0] [N]",
            "critical force yield layer[0] error [N]",
            "critical force yield layer[0] resolved",
            "critical force yield layer[0] status",
        ]
        .map(str::to_owned)
        .into()
    }

    #[test]
    fn a_number_is_found_by_its_key_or_its_column_with_its_error() {
        let found = |name| ResultColumn::named(name, &columns()).map(|of| (of.value, of.error));
        for name in ["max_pressure", "max pressure", " Max  Pressure"] {
            assert_eq!(found(name), Ok((1, Some(2))), "{name}");
        }
        assert_eq!(found("contact_elements"), Ok((5, None)));
        let critical = [
            "critical force yield layer[0]",
            "critical_force.yield.layer[0]",
        ];
        for name in critical {
            let column = ResultColumn::named(name, &columns()).unwrap();
            assert_eq!((column.value, column.status), (7, Some(10)), "{name}");
            assert_eq!(column.dimension(), Some(Dimension::Force));
        }
    }

    #[test]
    fn what_is_no_number_of_the_case_is_refused() {
        let refused = |name| ResultColumn::named(name, &columns()).unwrap_err().0;
        assert!(refused("max_pressure_at").ends_with("is no number"));
        assert!(refused("certificate.satisfied").ends_with("is no number"));
        assert!(refused("max pressure resolved").ends_with("is no number"));
        assert!(refused("step").ends_with("is no number"));
        assert!(refused("plastic_depth").ends_with("which is given with a hardness"));
        assert_eq!(
            refused("max_presure"),
            "no result `max_presure` of this case"
        );
        let close = |name| ResultColumn::closest(name, &columns());
        assert_eq!(close("max_presure").as_deref(), Some("max_pressure"));
    }
}
