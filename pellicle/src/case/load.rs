//! `[load]`: a force or a penetration, or a list of either.

use serde::Serialize;

use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::dimension::{Dimension, Sign};
use crate::input::quantity_list::QuantityList;
use crate::input::table_reader::TableReader;

/// The four keys of which exactly one is given.
const KEYS: [&str; 4] = ["force", "forces", "penetration", "penetrations"];

/// The key that requests derivatives.
const SENSITIVITIES: &str = "sensitivities";

const WANTED: &str = "exactly one of force, forces, penetration, penetrations";

/// The hint if one load comes from the file and the other from the command line or a study.
const HELP: &str = "to replace one by the other, replace the whole table: --set load='{ force = \"3 mN\" }', or in a study \"load\" = [{ force = \"3 mN\" }]";

/// The largest number of steps of a curve; more is a mistake.
const MAX_STEPS: usize = 10_000;

/// The load of a case, and whether derivatives are requested.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LoadCase {
    /// Force or penetration, or a list of either.
    #[serde(flatten)]
    pub values: LoadValues,
    /// Whether derivatives with respect to the parameters of the case are requested.
    #[serde(skip_serializing_if = "is_false")]
    pub sensitivities: bool,
}

impl LoadCase {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] unless exactly one load is given, a positive force or a finite penetration.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&[&KEYS[..], &[SENSITIVITIES]].concat())?;
        let sensitivities = table.optional(SENSITIVITIES);
        Ok(Self {
            values: LoadValues::read(table)?,
            sensitivities: sensitivities.map_or(Ok(false), |field| field.switch())?,
        })
    }

    /// The loads in order.
    #[must_use]
    pub fn loads(&self) -> Vec<pellicle_contact::Load> {
        self.values.loads()
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_false(value: &bool) -> bool {
    !value
}

/// The values of a load in SI units or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LoadValues {
    /// One force `Q`, in newtons.
    Force(f64),
    /// A curve over forces `Q`, in newtons.
    Forces(Vec<f64>),
    /// One penetration `D`, in metres.
    Penetration(f64),
    /// A curve over penetrations `D`, in metres.
    Penetrations(Vec<f64>),
}

impl LoadValues {
    fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        let key = the_one_given(table)?;
        let field = table.required(key, WANTED)?;
        match key {
            "force" => Ok(Self::Force(FORCE.item(&field)?)),
            "forces" => Ok(Self::Forces(FORCE.read(&field)?)),
            "penetration" => Ok(Self::Penetration(PENETRATION.item(&field)?)),
            _ => Ok(Self::Penetrations(PENETRATION.read(&field)?)),
        }
    }

    fn loads(&self) -> Vec<pellicle_contact::Load> {
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

const FORCE: QuantityList = QuantityList {
    dimension: Dimension::Force,
    sign: Sign::Positive,
    most: MAX_STEPS,
};

const PENETRATION: QuantityList = QuantityList {
    dimension: Dimension::Length,
    sign: Sign::Any,
    most: MAX_STEPS,
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<LoadValues, String> {
        read_table(text, |table| LoadCase::read(&table)).map(|load| load.values)
    }

    #[test]
    fn sensitivities_are_a_key_of_the_load_table() {
        let read = |text: &str| read_table(text, |table| LoadCase::read(&table));
        let requested = |text: &str| read(text).map(|load| load.sensitivities);
        assert_eq!(requested("force = 1\nsensitivities = true"), Ok(true));
        assert_eq!(requested("force = 1"), Ok(false));
        assert!(requested("force = 1\nsensitivities = 1").is_err());
    }

    #[test]
    fn every_form_of_a_load_is_read() {
        assert_eq!(read("force = \"2 mN\""), Ok(LoadValues::Force(2e-3)));
        assert_eq!(read("penetration = -1"), Ok(LoadValues::Penetration(-1.0)));
        assert_eq!(
            read("forces = [1, 2.5]"),
            Ok(LoadValues::Forces(vec![1.0, 2.5]))
        );
        assert_eq!(
            read("forces = { from = 1, to = 100, count = 3, spacing = \"log\" }"),
            Ok(LoadValues::Forces(vec![1.0, 10.0, 100.0]))
        );
        assert_eq!(
            read("penetrations = { from = \"0 nm\", to = \"4 nm\", count = 3 }"),
            Ok(LoadValues::Penetrations(vec![0.0, 2e-9, 4e-9]))
        );
    }

    #[test]
    fn exactly_one_form_of_load_is_accepted() {
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
    fn invalid_loads_are_rejected() {
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
