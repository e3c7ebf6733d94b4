//! `[load]`: a force or a penetration, or a list of either.

use serde::Serialize;

use super::diagnosis::{Diagnosis, Fault};
use super::dimension::Dimension;
use super::spacing::{self, Spacing};
use super::table_reader::TableReader;
use super::value_reader::{Sign, ValueReader};

/// The four keys of which exactly one is given.
const KEYS: [&str; 4] = ["force", "forces", "penetration", "penetrations"];

const WANTED: &str = "exactly one of force, forces, penetration, penetrations";

/// The hint if one load comes from the file and the other from the command line or a study.
const HELP: &str = "to replace one by the other, replace the whole table: --set load='{ force = \"3 mN\" }', or in a study \"load\" = [{ force = \"3 mN\" }]";

/// The most steps of a curve; more are a mistake.
const MOST_STEPS: usize = 10_000;

/// The load of a case, every value in SI units or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LoadCase {
    /// One force `Q`, in newtons.
    Force(f64),
    /// A curve over forces `Q`, in newtons.
    Forces(Vec<f64>),
    /// One penetration `D`, in metres.
    Penetration(f64),
    /// A curve over penetrations `D`, in metres.
    Penetrations(Vec<f64>),
}

impl LoadCase {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] unless exactly one load is given, a positive force or a finite penetration.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&KEYS)?;
        let key = the_one_given(table)?;
        let field = table.required(key, WANTED)?;
        match key {
            "force" => Ok(Self::Force(LoadQuantity::FORCE.read(&field)?)),
            "forces" => Ok(Self::Forces(LoadQuantity::FORCE.read_all(&field)?)),
            "penetration" => Ok(Self::Penetration(LoadQuantity::PENETRATION.read(&field)?)),
            _ => Ok(Self::Penetrations(
                LoadQuantity::PENETRATION.read_all(&field)?,
            )),
        }
    }

    /// The loads in order.
    #[must_use]
    pub fn loads(&self) -> Vec<pellicle_contact::Load> {
        use pellicle_contact::Load;
        match self {
            Self::Force(force) => vec![Load::Force(*force)],
            Self::Forces(forces) => forces.iter().copied().map(Load::Force).collect(),
            Self::Penetration(depth) => vec![Load::Penetration(*depth)],
            Self::Penetrations(depths) => depths.iter().copied().map(Load::Penetration).collect(),
        }
    }
}

fn the_one_given(table: &TableReader<'_>) -> Result<&'static str, Diagnosis> {
    match table.given(&KEYS)[..] {
        [key] => Ok(key),
        [] => Err(table.missing("force", WANTED.into())),
        [first, second, ..] => {
            let field = table.required(second, WANTED)?;
            let wrong = Fault::Wrong {
                found: format!("{first} and {second}"),
                wanted: WANTED.into(),
            };
            Err(field.diagnosis(wrong).with_help(HELP))
        }
    }
}

/// The dimension and sign of a load.
struct LoadQuantity {
    dimension: Dimension,
    sign: Sign,
}

impl LoadQuantity {
    const FORCE: Self = Self {
        dimension: Dimension::Force,
        sign: Sign::Positive,
    };

    const PENETRATION: Self = Self {
        dimension: Dimension::Length,
        sign: Sign::Any,
    };

    fn read(&self, field: &ValueReader<'_>) -> Result<f64, Diagnosis> {
        field.quantity(self.dimension, self.sign)
    }

    fn read_all(&self, field: &ValueReader<'_>) -> Result<Vec<f64>, Diagnosis> {
        if field.is_table() {
            return self.read_range(&field.clone().table()?);
        }
        let items = field.list("a list of values, or a table of from, to, count and spacing")?;
        if items.len() > MOST_STEPS {
            return Err(field.wanted(format!("at most {MOST_STEPS} values")));
        }
        items.iter().map(|item| self.read(item)).collect()
    }

    fn read_range(&self, table: &TableReader<'_>) -> Result<Vec<f64>, Diagnosis> {
        table.only(&spacing::KEYS)?;
        let spacing = Spacing::read(table)?;
        let sign = if spacing == Spacing::Log {
            Sign::Positive
        } else {
            self.sign
        };
        let end = |key| {
            let wanted = sign.wanted(self.dimension);
            table.required(key, &wanted)?.quantity(self.dimension, sign)
        };
        let count = table.required("count", "how many values, an integer")?;
        let count = count.count(2..=MOST_STEPS, " values")?;
        Ok(spacing.between(end("from")?, end("to")?, count))
    }
}

#[cfg(test)]
mod tests {
    use super::super::table_reader::tests::read_table;
    use super::*;

    fn read(text: &str) -> Result<LoadCase, String> {
        read_table(text, |table| LoadCase::read(&table))
    }

    #[test]
    fn every_form_of_a_load_is_read() {
        assert_eq!(read("force = \"2 mN\""), Ok(LoadCase::Force(2e-3)));
        assert_eq!(read("penetration = -1"), Ok(LoadCase::Penetration(-1.0)));
        assert_eq!(
            read("forces = [1, 2.5]"),
            Ok(LoadCase::Forces(vec![1.0, 2.5]))
        );
        assert_eq!(
            read("forces = { from = 1, to = 100, count = 3, spacing = \"log\" }"),
            Ok(LoadCase::Forces(vec![1.0, 10.0, 100.0]))
        );
        assert_eq!(
            read("penetrations = { from = \"0 nm\", to = \"4 nm\", count = 3 }"),
            Ok(LoadCase::Penetrations(vec![0.0, 2e-9, 4e-9]))
        );
    }

    #[test]
    fn a_load_is_given_once() {
        let message = read("force = 1\npenetration = 2").unwrap_err();
        assert_eq!(
            message,
            format!(
                "case.toml, line 2, key `penetration`: found force and penetration, wanted {WANTED}"
            )
        );
        assert!(
            read("# none")
                .unwrap_err()
                .contains("wanted exactly one of")
        );
    }

    #[test]
    fn faulty_loads_are_refused() {
        let faulty = [
            "force = -1",
            "force = 0",
            "force = nan",
            "force = \"3 GPa\"",
            "forces = []",
            "forces = 3",
            "forces = [1, -1]",
            "penetration = inf",
            "forces = { from = 0, to = 1, count = 3, spacing = \"log\" }",
            "forces = { from = 1, to = 2, count = 1 }",
            "forces = { from = 1, to = 2 }",
            "forces = { from = 1, to = 2, count = 3, spacing = \"cubic\" }",
        ];
        for text in faulty {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
