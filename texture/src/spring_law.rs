//! Shortening of a relief's spring under pressure: proportional or stiffening.

use crate::error::{Quantity, TextureError, positive};

/// The law by which the springs of a relief shorten under a pressure p.
///
/// With the compliance at rest `η = h/E`, height h and Young's modulus E:
///
/// ```text
/// linear (3.3):  w* = η p
/// logarithmic:   w* = h (1 − exp(−p/E)),    p = −E ln(1 − w*/h)
/// ```
///
/// The second uses the logarithmic strain `−ln(1 − w*/h)` in Hooke's law, so a spring never reaches zero height. For
/// `p ≪ E` it tends to the first, `w* = η p (1 − p/2E + …)`. Both grow with the pressure everywhere, so a contact has
/// one solution under either. All functions describe one spring, with η in m/Pa and p in Pa; `w* = η m(p)` with `m = p`
/// or `m = E (1 − exp(−p/E))`, so springs under one law differ only in η.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpringLaw {
    /// Young's modulus E of the logarithmic law, Pa.
    young_modulus: Option<f64>,
}

/// Changes of pressure, in units of E, below which differences of exponentials are computed by `expm1`.
const SMALL_CHANGE: f64 = 1.0;

impl SpringLaw {
    /// `w* = η p`.
    pub const LINEAR: Self = Self {
        young_modulus: None,
    };

    /// The law `w* = h (1 − exp(−p/E))` for springs of Young's modulus E (Pa).
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if the modulus is not positive and finite.
    pub fn logarithmic(young_modulus: f64) -> Result<Self, TextureError> {
        positive(Quantity::YoungModulus, young_modulus).map(Self::of_checked)
    }

    /// The logarithmic law for a modulus known to be positive and finite.
    pub(crate) fn of_checked(young_modulus: f64) -> Self {
        Self {
            young_modulus: Some(young_modulus),
        }
    }

    /// Whether the shortening is proportional to the pressure.
    #[must_use]
    pub fn is_linear(self) -> bool {
        self.young_modulus.is_none()
    }

    /// Shortening `w*(p)`, m.
    #[must_use]
    pub fn shortening(self, compliance: f64, pressure: f64) -> f64 {
        match self.young_modulus {
            None => compliance * pressure,
            Some(modulus) => -compliance * modulus * (-pressure / modulus).exp_m1(),
        }
    }

    /// Compliance under pressure `dw*/dp`, m/Pa: η or `η exp(−p/E)`.
    #[must_use]
    pub fn tangent(self, compliance: f64, pressure: f64) -> f64 {
        match self.young_modulus {
            None => compliance,
            Some(modulus) => compliance * (-pressure / modulus).exp(),
        }
    }

    /// Shortening over pressure `w*/p`, m/Pa; η at rest.
    #[must_use]
    pub fn secant(self, compliance: f64, pressure: f64) -> f64 {
        if self.is_linear() || pressure == 0.0 {
            compliance
        } else {
            self.shortening(compliance, pressure) / pressure
        }
    }

    /// Pressure `p` that shortens a spring by `w*` (m), Pa; infinite for a spring squeezed to zero height.
    #[must_use]
    pub fn pressure(self, compliance: f64, shortening: f64) -> f64 {
        match self.young_modulus {
            None => shortening / compliance,
            Some(modulus) => -modulus * (-shortening / (compliance * modulus)).ln_1p(),
        }
    }

    /// Complementary energy per area `W*(p) = ∫₀ᵖ w* dp`, J/m²: `½ η p²` or `η E (p − E (1 − exp(−p/E)))`.
    #[must_use]
    pub fn energy(self, compliance: f64, pressure: f64) -> f64 {
        match self.young_modulus {
            None => 0.5 * compliance * pressure * pressure,
            Some(modulus) => {
                let ratio = pressure / modulus;
                compliance * modulus * modulus * (ratio + (-ratio).exp_m1())
            }
        }
    }

    /// Shortening at a pressure beyond the tangent at another, `w*(p) − w*(p₀) − (p − p₀) dw*/dp(p₀)`, m: 0 or
    /// negative, accurate to the last digits for close pressures.
    #[must_use]
    pub fn beyond_tangent(self, compliance: f64, from: f64, pressure: f64) -> f64 {
        let Some(modulus) = self.young_modulus else {
            return 0.0;
        };
        let (change, at) = ((pressure - from) / modulus, (-from / modulus).exp());
        let beyond = if change.abs() < SMALL_CHANGE {
            -at * (change + (-change).exp_m1())
        } else {
            at * (1.0 - change) - (-pressure / modulus).exp()
        };
        compliance * modulus * beyond
    }

    /// Energy at a pressure beyond the tangent at another, `∫ (beyond tangent) dp` from p₀ to p, J/m². It has the sign
    /// of `p₀ − p`.
    #[must_use]
    pub fn energy_beyond_tangent(self, compliance: f64, from: f64, pressure: f64) -> f64 {
        let Some(modulus) = self.young_modulus else {
            return 0.0;
        };
        let (change, at) = ((pressure - from) / modulus, (-from / modulus).exp());
        let half_square = 0.5 * change * change;
        let beyond = if change.abs() < SMALL_CHANGE {
            at * (change + (-change).exp_m1() - half_square)
        } else {
            (-pressure / modulus).exp() - at * (1.0 - change + half_square)
        };
        compliance * modulus * modulus * beyond
    }

    /// Returns the law for pressures in another unit, given in Pa.
    #[must_use]
    pub fn in_unit(self, pressure: f64) -> Self {
        Self {
            young_modulus: self.young_modulus.map(|modulus| modulus / pressure),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COMPLIANCE: f64 = 0.25;
    const MODULUS: f64 = 8.0;

    fn laws() -> [SpringLaw; 2] {
        [SpringLaw::LINEAR, SpringLaw::logarithmic(MODULUS).unwrap()]
    }

    #[test]
    fn a_logarithmic_spring_never_shortens_to_zero_height() {
        let [_, law] = laws();
        let height = COMPLIANCE * MODULUS;
        for pressure in [1e-9, 0.1, 8.0, 80.0] {
            let shortening = law.shortening(COMPLIANCE, pressure);
            assert!(0.0 < shortening && shortening < height, "{pressure}");
        }
        // e^{−37} is the smallest part of the height above rounding.
        assert!(law.shortening(COMPLIANCE, 1e6) <= height);
        assert_eq!(law.pressure(COMPLIANCE, height), f64::INFINITY);
        assert_eq!(law.shortening(0.0, 1.0), 0.0);
        assert_eq!(law.secant(COMPLIANCE, 0.0), COMPLIANCE);
        assert_eq!(
            law.secant(COMPLIANCE, 80.0),
            law.shortening(COMPLIANCE, 80.0) / 80.0
        );
    }

    #[test]
    fn the_logarithmic_law_differs_from_the_linear_one_by_half_the_strain() {
        let [linear, law] = laws();
        for ratio in [1e-3, 1e-5] {
            let pressure = ratio * MODULUS;
            let part = 1.0
                - law.shortening(COMPLIANCE, pressure) / linear.shortening(COMPLIANCE, pressure);
            // 1 − p/2E + p²/6E²; rounding of a quotient next to 1
            assert!((part - 0.5 * ratio).abs() < 0.2 * ratio * ratio + 1e-15);
        }
    }

    #[test]
    fn pressure_tangent_and_energy_belong_to_the_shortening() {
        for law in laws() {
            for pressure in [0.3, 5.0, 40.0] {
                let shortening = |p| law.shortening(COMPLIANCE, p);
                let back = law.pressure(COMPLIANCE, shortening(pressure));
                // e^{40/8} = 148 times the rounding of the shortening
                assert!((back / pressure - 1.0).abs() < 1e-13);
                let step = 1e-3;
                let [tangent, slope] = [
                    |law: SpringLaw, p| law.shortening(COMPLIANCE, p),
                    |law: SpringLaw, p| law.energy(COMPLIANCE, p),
                ]
                .map(|of| (of(law, pressure + step) - of(law, pressure - step)) / (2.0 * step));
                // third derivatives, at most η/E = 0.03, times step²/6; rounding of 300 over the step
                assert!((tangent - law.tangent(COMPLIANCE, pressure)).abs() < 1e-8);
                assert!((slope - shortening(pressure)).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn deviations_from_a_tangent_agree_with_their_definition() {
        for law in laws() {
            for (from, to) in [(0.0, 3.0), (5.0, 0.0), (2.0, 2.5), (40.0, 0.0), (1.0, 90.0)] {
                let change = to - from;
                let [before, after] = [from, to].map(|p| law.shortening(COMPLIANCE, p));
                let tangent = law.tangent(COMPLIANCE, from);
                let beyond = law.beyond_tangent(COMPLIANCE, from, to);
                // numbers of order 10
                assert!((beyond - (after - before - tangent * change)).abs() < 1e-13);
                assert!(beyond <= 0.0);
                let [e, f] = [from, to].map(|p| law.energy(COMPLIANCE, p));
                let straight = e + before * change + 0.5 * tangent * change * change;
                let beyond = law.energy_beyond_tangent(COMPLIANCE, from, to);
                // numbers of order 1000
                assert!((beyond - (f - straight)).abs() < 1e-12);
            }
        }
        // y²/2 for a change too small for a difference of shortenings
        let [_, law] = laws();
        let wanted = -COMPLIANCE * MODULUS * (-0.125_f64).exp() * 0.5e-20;
        let found = law.beyond_tangent(COMPLIANCE, 1.0, 1.0 + 1e-10 * MODULUS);
        // e^x − 1 − x at x = 1e-10 keeps six digits.
        assert!((found / wanted - 1.0).abs() < 1e-5, "{found:e} {wanted:e}");
    }

    #[test]
    fn extreme_pressures_give_finite_numbers_and_units_do_not_matter() {
        let [_, law] = laws();
        let far = 1e4 * MODULUS;
        assert!(law.beyond_tangent(COMPLIANCE, far, 0.0).is_finite());
        assert!(law.energy_beyond_tangent(COMPLIANCE, far, 0.0).is_finite());
        let [shortening, same] = [
            law.shortening(COMPLIANCE, 3.0),
            law.in_unit(0.5).shortening(0.5 * COMPLIANCE, 6.0),
        ];
        assert_eq!(shortening, same);
        assert!(SpringLaw::logarithmic(0.0).is_err() && SpringLaw::logarithmic(f64::NAN).is_err());
    }
}
