//! The imperfect bond between two bodies at one wavenumber.
//!
//! If `U` and `V` jump by `ĉ_s τ` and `ĉ_n σ`, `ĉ = 2 G k c` in the units of the upper body, the minors of a perfect
//! bond become, with positive terms only,
//!
//! ```text
//! p' = p + ĉ_n f + ĉ_s g + ĉ_s ĉ_n d     f' = f + ĉ_s d     g' = g + ĉ_n d     q' = q     d' = d
//! ```
//!
//! All are divided by `(1 + ĉ_s)(1 + ĉ_n)`, so that the frictionless bond, `ĉ_s = ∞`, is included.

use super::contrast::Contrast;
use super::minors::Minors;
use crate::Interface;
use crate::material::Poisson;

/// One compliance as the parts `1/(1 + ĉ)` and `ĉ/(1 + ĉ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ComplianceShare {
    pub(crate) held: f64,
    pub(crate) free: f64,
}

impl ComplianceShare {
    /// The shares of a dimensionless compliance `ĉ` from 0 to ∞.
    pub(crate) fn new(compliance: f64) -> Self {
        if compliance > 1.0 {
            let inverse = 1.0 / compliance;
            let free = 1.0 / (1.0 + inverse);
            Self {
                held: inverse * free,
                free,
            }
        } else {
            let held = 1.0 / (1.0 + compliance);
            Self {
                held,
                free: compliance * held,
            }
        }
    }
}

/// Both compliances of an interface at one wavenumber.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpringWave {
    pub(crate) shear: ComplianceShare,
    pub(crate) normal: ComplianceShare,
}

impl SpringWave {
    /// The compliances of an interface below a body of `unit = 2 G k`.
    pub(crate) fn new(interface: Interface, unit: f64) -> Self {
        let share = |compliance: f64| ComplianceShare::new(scaled(compliance, unit));
        Self {
            shear: share(interface.shear_compliance()),
            normal: share(interface.normal_compliance()),
        }
    }

    /// The minors above the spring, given those below it, both in the units of the upper body.
    pub(crate) fn minors(&self, below: &Minors) -> Minors {
        let &Minors { p, q, f, g, d } = below;
        let Self {
            shear: s,
            normal: n,
        } = self;
        Minors {
            p: s.held * (n.held * p + n.free * f) + s.free * (n.held * g + n.free * d),
            q: s.held * n.held * q,
            f: n.held * (s.held * f + s.free * d),
            g: s.held * (n.held * g + n.free * d),
            d: s.held * n.held * d,
        }
    }

    /// The contrast above the spring, given minors and contrast below it: the definitions, with
    /// `x g − d = x c₄` and `x f − d = x (c₄ + x c₁ − c₂)`.
    pub(crate) fn contrast(
        &self,
        below: &Minors,
        contrast: &Contrast,
        upper: &Poisson,
    ) -> Contrast {
        let &Minors { f, g, d, .. } = below;
        let &Contrast { c1, c2, c3, c4 } = contrast;
        let Self {
            shear: s,
            normal: n,
        } = self;
        let x = upper.x;
        let (held, opened) = (s.held * n.held, s.held * n.free);
        let (slid, both) = (s.free * n.held * x * c4, s.free * n.free * d);
        Contrast {
            c1: held * c1 + opened * f + s.free * n.held * g + both,
            c2: held * c2 + opened * (d + x * f) + slid + x * both,
            c3: held * c3 + opened * x * (c4 + x * c1 - c2) + slid + x * both,
            c4: held * c4 + opened * d,
        }
    }
}

/// `c · 2 G k`; 0 for a bond even if `2 G k` overflows.
fn scaled(compliance: f64, unit: f64) -> f64 {
    if compliance == 0.0 {
        0.0
    } else {
        compliance * unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;

    const MINORS: Minors = Minors {
        p: 3.0,
        q: 0.5,
        f: 1.2,
        g: 2.5,
        d: 11.0 / 12.0,
    };

    #[test]
    fn the_contrast_above_a_spring_is_that_of_its_minors() {
        let poisson = Poisson::new(Material::new(1.0, 0.3).unwrap());
        let contrast = Contrast::of(&MINORS, &poisson);
        for (normal, shear) in [(0.0, 0.0), (0.3, 0.0), (0.0, 2.0), (5.0, f64::INFINITY)] {
            let spring = SpringWave::new(Interface::spring(normal, shear).unwrap(), 1.7);
            let found = spring.contrast(&MINORS, &contrast, &poisson);
            let wanted = Contrast::of(&spring.minors(&MINORS), &poisson);
            // a few roundings of terms of order 10
            assert!((found.c1 - wanted.c1).abs() < 1e-14 && (found.c2 - wanted.c2).abs() < 1e-14);
            assert!((found.c3 - wanted.c3).abs() < 1e-14 && (found.c4 - wanted.c4).abs() < 1e-14);
        }
    }

    #[test]
    fn the_minors_above_a_spring_satisfy_their_identity() {
        let spring = SpringWave::new(Interface::spring(0.4, 7.0).unwrap(), 1.0);
        let Minors { p, q, f, g, d } = spring.minors(&MINORS);
        // p d = f g − q², a few roundings
        assert!((p * d - (f * g - q * q)).abs() < 1e-16);
    }
}
