//! The unit in which an estimate of a fit is easy to read.

use std::f64::consts::PI;

use pellicle::display::{DisplayUnit, Unit};
use pellicle::input::units::Units;

/// The scale for values up to `largest`, in the SI unit that `fit.json` names.
#[must_use]
pub fn scale(largest: f64, unit: &str) -> DisplayUnit {
    let prefixed = |value, unit| DisplayUnit::of(value, unit, Units::Si);
    let own = |divisor, label: &str| DisplayUnit {
        divisor,
        label: label.into(),
    };
    match unit {
        "Pa" => prefixed(largest, Unit::Pascal),
        "m" => prefixed(largest, Unit::Metre),
        "N" => prefixed(largest, Unit::Newton),
        "N/m" => prefixed(largest, Unit::NewtonPerMetre),
        "rad" => own(PI / 180.0, "°"),
        // A length over a gigapascal.
        "m/Pa" => {
            let DisplayUnit { divisor, label } = prefixed(1e9 * largest, Unit::Metre);
            own(1e-9 * divisor, &format!("{label}/GPa"))
        }
        "m/N" => own(1e-6, "nm/mN"),
        "m/s" => own(1e-9, "nm/s"),
        "m^2" => prefixed(largest, Unit::SquareMetre),
        "1" => own(1.0, ""),
        other => own(1.0, other),
    }
}

/// The scale of a fraction in percent.
#[must_use]
pub fn percent() -> DisplayUnit {
    DisplayUnit {
        divisor: 0.01,
        label: "%".into(),
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn every_unit_of_a_fit_has_a_readable_scale() {
        for (value, unit, wanted, label) in [
            (1.642e-7, "m", 164.2, "nm"),
            (4.1e11, "Pa", 410.0, "GPa"),
            (2e-4, "N", 200.0, "µN"),
            (PI / 3.0, "rad", 60.0, "°"),
            (5e-18, "m/Pa", 5.0, "nm/GPa"),
            (2e-7, "m/N", 0.2, "nm/mN"),
            (0.3, "1", 0.3, ""),
        ] {
            let scale = scale(value, unit);
            assert_eq!(scale.label, label);
            // Each of the two factors has one rounding error.
            assert_relative_eq!(value / scale.divisor, wanted, max_relative = 1e-14);
        }
    }
}
