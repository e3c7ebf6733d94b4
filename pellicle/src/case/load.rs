//! `[load]`: a force, a nominal pressure or a penetration, or a list of one of them.

use pellicle_contact::Load;
use pellicle_contact::adhesion::AdhesionLaw;

use crate::declare::macros::{one_of, record};
use crate::declare::{Codec, energy_per_area, force, length, part, pressure, series, switch, word};

/// The hint if one load comes from the file and the other from the command line or a study.
const HELP: &str = "to replace one by the other, replace the whole table: --set load='{ force = \"3 mN\" }', or in a study \"load\" = [{ force = \"3 mN\" }]";

/// The largest number of steps of a curve; more is a mistake.
const MAX_STEPS: usize = 10_000;

record! {
    /// The load of a case, and whether derivatives are requested.
    pub struct LoadCase {
        #[serde(flatten)] values: LoadValues = part(), "force, nominal pressure or penetration, or a list of one of them";
        #[serde(skip_serializing_if = "is_false")]
        sensitivities: bool = switch().or(false, "false"), "whether derivatives by the parameters of the case are found";
        #[serde(skip_serializing_if = "Option::is_none")]
        work_of_adhesion: Option<f64> = energy_per_area().positive().optional("no adhesion"),
            "energy to separate a unit area of contact; of axisymmetric indenters on bodies without relief but a film";
        #[serde(skip_serializing_if = "Option::is_none")]
        adhesion: Option<AdhesionLaw> = word(LAWS).optional("\"jkr\" with a work of adhesion"),
            "where adhesion acts: inside the contact (soft bodies), or outside (stiff bodies under small radii)";
    }
}

const LAWS: &[(&str, AdhesionLaw)] = &[("jkr", AdhesionLaw::Jkr), ("dmt", AdhesionLaw::Dmt)];

one_of! {
    /// The values of a load in SI units or the case's own.
    pub enum LoadValues, "exactly one of force, forces, pressure, pressures, penetration, penetrations", Some(HELP);
    force: Force(f64) = force().positive(), "one force";
    forces: Forces(Vec<f64>) = series(force().positive(), MAX_STEPS), "a curve over forces";
    pressure: Pressure(f64) = pressure().positive(), "one nominal pressure, the force over the area of a periodic cell";
    pressures: Pressures(Vec<f64>) = series(pressure().positive(), MAX_STEPS), "a curve over nominal pressures";
    penetration: Penetration(f64) = length(), "one penetration of the indenter";
    penetrations: Penetrations(Vec<f64>) = series(length(), MAX_STEPS), "a curve over penetrations";
}

impl LoadCase {
    /// The number of loads.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.values.list().len()
    }

    /// The loads in order; a nominal pressure `p` on this area (m²) is the force `F = p A` in N.
    #[must_use]
    pub fn loads(&self, nominal_area: f64) -> Vec<Load> {
        let load: &dyn Fn(f64) -> Load = match self.values {
            LoadValues::Force(_) | LoadValues::Forces(_) => &Load::Force,
            LoadValues::Pressure(_) | LoadValues::Pressures(_) => {
                &|p| Load::Force(p * nominal_area)
            }
            LoadValues::Penetration(_) | LoadValues::Penetrations(_) => &Load::Penetration,
        };
        self.values.list().iter().copied().map(load).collect()
    }
}

impl LoadValues {
    /// The values in order.
    fn list(&self) -> &[f64] {
        match self {
            Self::Force(one) | Self::Pressure(one) | Self::Penetration(one) => {
                std::slice::from_ref(one)
            }
            Self::Forces(several) | Self::Pressures(several) | Self::Penetrations(several) => {
                several
            }
        }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_false(value: &bool) -> bool {
    !value
}

impl From<Load> for LoadCase {
    fn from(load: Load) -> Self {
        let values = match load {
            Load::Force(force) => LoadValues::Force(force),
            Load::Penetration(depth) => LoadValues::Penetration(depth),
        };
        values.into()
    }
}

impl From<LoadValues> for LoadCase {
    fn from(values: LoadValues) -> Self {
        Self {
            values,
            sensitivities: false,
            work_of_adhesion: None,
            adhesion: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::{Record, Scope};
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<LoadValues, String> {
        read_table(text, |table| LoadCase::read(&table, &Scope::default())).map(|load| load.values)
    }

    #[test]
    fn sensitivities_are_a_key_of_the_load_table() {
        let read = |text: &str| read_table(text, |table| LoadCase::read(&table, &Scope::default()));
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
        assert_eq!(read("pressure = \"10 MPa\""), Ok(LoadValues::Pressure(1e7)));
        assert_eq!(
            read("pressures = { from = 1, to = 2, count = 2 }"),
            Ok(LoadValues::Pressures(vec![1.0, 2.0]))
        );
        assert_eq!(
            read("penetrations = { from = \"0 nm\", to = \"4 nm\", count = 3 }"),
            Ok(LoadValues::Penetrations(vec![0.0, 2e-9, 4e-9]))
        );
    }

    #[test]
    fn exactly_one_form_of_load_is_accepted() {
        const WANTED: &str =
            "exactly one of force, forces, pressure, pressures, penetration, penetrations";
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
            "pressure = -1",
            "pressure = \"3 mN\"",
            "pressures = [1, 0]",
        ];
        for text in faulty {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
