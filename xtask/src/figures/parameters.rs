//! The parameters of a case in words, read from the summary of its run.

use pellicle_cli::Units;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::{Unit, quantity};
use serde_json::Value;

use super::run::PaperRun;

/// The case as the run resolved it.
pub(super) struct Parameters<'a> {
    case: &'a Value,
    units: Units,
}

impl<'a> Parameters<'a> {
    /// Those of a run.
    pub(super) fn of(run: &'a PaperRun) -> Self {
        Self {
            case: &run.summary.case,
            units: run.summary.units,
        }
    }

    /// `E₁/E₂ = 0.1, ν₁ = 0.4, ν₂ = 0.3`.
    pub(super) fn materials(&self) -> String {
        let [layer, substrate] = ["/foundation/layer/0", "/foundation/substrate"];
        let of = |part: &str, key: &str| self.number(&format!("{part}/{key}"));
        let ratio = of(layer, "young_modulus") / of(substrate, "young_modulus");
        let [first, second] = [layer, substrate].map(|part| power(of(part, "poisson_ratio"), 3));
        format!("E₁/E₂ = {}, ν₁ = {first}, ν₂ = {second}", power(ratio, 3))
    }

    /// `E₁ = 70 GPa`.
    pub(super) fn modulus(&self) -> String {
        let modulus = self.number("/foundation/layer/0/young_modulus");
        format!("E₁ = {}", self.in_words(modulus, Unit::Pascal))
    }

    /// What figures 2 and 3 have in common.
    pub(super) fn textured_coating(&self) -> String {
        format!(
            "paraboloid of radius R; coating {}; cylinders {}, {}",
            self.thickness(),
            self.cylinders(),
            self.period()
        )
    }

    /// `H = 10⁻⁴ R`.
    pub(super) fn thickness(&self) -> String {
        format!("H = {}", self.length("/foundation/layer/0/thickness"))
    }

    /// `r = 5·10⁻³ R, h = 10⁻⁴ R`.
    pub(super) fn cylinders(&self) -> String {
        let [radius, height] =
            ["radius", "height"].map(|key| self.length(&format!("/surface/{key}")));
        format!("r = {radius}, h = {height}")
    }

    /// The period of the cylinders as a part of the radius: `T = R/80`.
    pub(super) fn period(&self) -> String {
        format!("T = R/{}", power(1.0 / self.number("/surface/period"), 4))
    }

    /// `5 nm thick, modulus 140 MPa`, of a film.
    pub(super) fn film(&self) -> String {
        let modulus = self.in_words(self.number("/surface/young_modulus"), Unit::Pascal);
        format!(
            "{} thick, modulus {modulus}",
            self.length("/surface/thickness")
        )
    }

    /// The radius of a pyramid's tip.
    pub(super) fn tip_radius(&self) -> String {
        self.length("/indenter/tip_radius")
    }

    fn length(&self, place: &str) -> String {
        self.in_words(self.number(place), Unit::Metre)
    }

    /// With its unit in SI; of lengths in the paper's system, in R.
    fn in_words(&self, value: f64, unit: Unit) -> String {
        match self.units {
            Units::Si => short(&quantity(value, unit, self.units)),
            Units::Consistent => format!("{} R", power(value, 4)),
        }
    }

    /// A number of the case; not a number where the case has none, which a picture then shows.
    fn number(&self, place: &str) -> f64 {
        self.case
            .pointer(place)
            .and_then(Value::as_f64)
            .unwrap_or(f64::NAN)
    }
}

/// `10.000 nm` as `10 nm`.
pub(super) fn short(quantity: &str) -> String {
    match quantity.split_once(' ') {
        Some((number, unit)) if number.contains('.') => {
            let number = number.trim_end_matches('0').trim_end_matches('.');
            format!("{number} {unit}")
        }
        _ => quantity.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_those_of_the_case() {
        let case = serde_json::json!({
            "foundation": { "substrate": { "young_modulus": 7e9, "poisson_ratio": 0.4 },
                            "layer": [{ "thickness": 1e-8, "young_modulus": 7e10, "poisson_ratio": 0.3 }] },
            "surface": { "thickness": 5e-9, "young_modulus": 1.4e8, "period": 0.0125 },
        });
        let parameters = Parameters {
            case: &case,
            units: Units::Si,
        };
        assert_eq!(parameters.materials(), "E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4");
        assert_eq!(parameters.thickness(), "H = 10 nm");
        assert_eq!(parameters.film(), "5 nm thick, modulus 140 MPa");
        assert_eq!(parameters.period(), "T = R/80");
        assert_eq!(parameters.tip_radius(), "NaN m");
    }
}
