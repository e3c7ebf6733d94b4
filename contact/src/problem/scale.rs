//! The units of the gradient method, derived from the problem so that no result depends on the user's units.

/// Units of length, compliance and pressure. All are powers of two: a number in these units differs from that in SI
/// only by its exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// In m.
    pub length: f64,
    /// In m/Pa.
    pub compliance: f64,
}

impl Scale {
    /// SI units, as in the problem's own quantities.
    pub const SI: Self = Self {
        length: 1.0,
        compliance: 1.0,
    };

    /// Derives the units from the side of an element (m) and its coefficient on itself (m/Pa).
    pub fn new(side: f64, own_coefficient: f64) -> Self {
        Self {
            length: power_of_two(side),
            compliance: power_of_two(own_coefficient),
        }
    }

    /// Unit of pressure, in Pa: that of length over that of compliance.
    pub fn pressure(self) -> f64 {
        self.length / self.compliance
    }
}

/// The bits of a number after its leading one.
const DIGITS: u64 = (1 << (f64::MANTISSA_DIGITS - 1)) - 1;

/// The largest power of two not above a value; 1 for a zero value, such as the coefficient of a rigid body.
fn power_of_two(value: f64) -> f64 {
    if value > 0.0 && value.is_normal() {
        f64::from_bits(value.to_bits() & !DIGITS)
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::{DIGITS, Scale};

    #[test]
    fn units_are_powers_of_two_near_the_problems_own_scale() {
        for (side, own) in [(1e-9, 3e-20), (1.0, 1.0), (7e3, 2.5e-4), (3e-200, 1e190)] {
            let scale = Scale::new(side, own);
            for (unit, of) in [(scale.length, side), (scale.compliance, own)] {
                assert!(unit <= of && of < 2.0 * unit, "{unit:e} of {of:e}");
                assert_eq!(unit.to_bits() & DIGITS, 0);
            }
        }
    }

    #[test]
    fn a_problem_without_a_scale_has_unit_one() {
        for own in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Scale::new(1.0, own).pressure(), 1.0);
        }
    }
}
