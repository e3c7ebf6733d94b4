//! The elastic contact of an imprint with the tip that made it.
//!
//! While it is unloaded, an imprint that nearly fits the tip is in elastic contact with it. Its difference from the tip
//! is close to a body of revolution of height `rⁿ/cⁿ⁻¹` that presses on the flat body: the effective indenter (G. M.
//! Pharr and A. Bolshakov, J. Mater. Res. 17, 2660, 2002). Its contact at the largest force has three numbers of the
//! unloading, `P = α (h − h_f)^m`:
//!
//! ```text
//! a from   S_punch(a) = S                            the stiffness of a contact is that of a punch of its radius
//! n from   S D/F = m                                 D/F does not depend on c
//! c from   F = P_max, hence D = m P_max/S = h_max − h_f
//! ```
//!
//! On a half-space `n = 1/(m − 1)`. On layers the exponent m is not that of a half-space, and the same three conditions
//! hold with the layered body's contact.

mod numbers;

use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{ContactError, PowerLaw};
use pellicle_influence::ElasticBodies;
use thiserror::Error;

pub use numbers::EffectiveIndenterNumbers;

/// Most steps to the contact radius or the exponent, which take five to fifteen.
const MOST_STEPS: usize = 100;
/// Relative accuracy of both: that of the contact, 1e-11.
const PRECISION: f64 = 1e-12;
/// A step to the contact radius is at most this factor.
const FARTHEST: f64 = 4.0;

/// An unloading at its largest force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnloadingPoint {
    /// `P_max`, N.
    pub force: f64,
    /// `S = dP/dh`, N/m.
    pub stiffness: f64,
    /// `m` of `P = α (h − h_f)^m`.
    pub exponent: f64,
}

/// An indenter whose elastic contact at the largest force has the force, the stiffness and the exponent of an
/// unloading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectiveIndenter {
    /// Its shape.
    pub shape: PowerLaw,
    /// Contact radius a at the largest force, m.
    pub contact_radius: f64,
    /// Penetration at the largest force, m: `h_max − h_f`.
    pub penetration: f64,
}

/// Why an unloading has no effective indenter.
#[derive(Debug, Error)]
pub enum EffectiveIndenterError {
    /// A force, a stiffness or an exponent that no unloading has.
    #[error(
        "found force {force} N, stiffness {stiffness} N/m and exponent {exponent} of an unloading, wanted positive numbers"
    )]
    NotPositive {
        /// The force, N.
        force: f64,
        /// The stiffness, N/m.
        stiffness: f64,
        /// The exponent.
        exponent: f64,
    },
    /// An exponent beyond those of all shapes.
    #[error(
        "found an exponent of the unloading of {found:.4}, wanted one between {least:.4}, that of an indenter of height \
         r^{}, and {most:.4}, that of a cone, on this body",
        PowerLaw::MOST_EXPONENT
    )]
    Exponent {
        /// The exponent.
        found: f64,
        /// That of the flattest shape, on this body at this stiffness.
        least: f64,
        /// That of a cone.
        most: f64,
    },
    /// A contact that cannot be solved.
    #[error(transparent)]
    Contact(#[from] ContactError),
}

impl EffectiveIndenter {
    /// The effective indenter of an unloading of these bodies: layers, with the material of the tip if it is elastic.
    ///
    /// Accuracy: that of the exact contact, 1e-11. What it says is as good as the idea that the imprint is flat beyond
    /// the contact and the body still linearly elastic.
    ///
    /// ```
    /// use pellicle_identify::indentation::{EffectiveIndenter, UnloadingPoint};
    /// use pellicle_kernel::{Foundation, Material};
    ///
    /// let silica = Foundation::half_space(Material::new(72e9, 0.17)?);
    /// let unloading = UnloadingPoint { force: 5e-3, stiffness: 60e3, exponent: 1.25 };
    /// let found = EffectiveIndenter::of(&unloading, &silica.into())?;
    /// assert!((found.shape.exponent() - 4.0).abs() < 1e-9); // 1/(m − 1)
    /// assert!((found.penetration - 1.25 * 5e-3 / 60e3).abs() < 1e-9 * found.penetration);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`EffectiveIndenterError`] if a number is not positive, if no exponent from 1 to 50 has the unloading's, or if
    /// the contact has no solution.
    pub fn of(
        unloading: &UnloadingPoint,
        bodies: &ElasticBodies,
    ) -> Result<Self, EffectiveIndenterError> {
        let UnloadingPoint {
            force,
            stiffness,
            exponent,
        } = *unloading;
        let is_positive = |number: f64| number > 0.0 && number.is_finite();
        if ![force, stiffness, exponent].into_iter().all(is_positive) {
            return Err(EffectiveIndenterError::NotPositive {
                force,
                stiffness,
                exponent,
            });
        }
        let body = AxisymmetricElasticity::new(bodies);
        let radius = radius_of(&body, stiffness)?;
        let shape_exponent = exponent_of(&body, radius, exponent)?;
        let unit = UnitContact::new(&body, radius, shape_exponent)?;
        // f = (a/c)ⁿ⁻¹ rⁿ/aⁿ⁻¹
        let steeper = force / unit.force;
        let coefficient = radius * steeper.powf(-1.0 / (shape_exponent - 1.0));
        let shape = PowerLaw::new(shape_exponent, coefficient).map_err(ContactError::from)?;
        Ok(Self {
            shape,
            contact_radius: radius,
            penetration: steeper * unit.penetration,
        })
    }

    /// Exponent, coefficient, contact radius and penetration.
    fn numbers(&self) -> [f64; 4] {
        let shape = &self.shape;
        [
            shape.exponent(),
            shape.coefficient(),
            self.contact_radius,
            self.penetration,
        ]
    }
}

/// The contact of `rⁿ/aⁿ⁻¹` with the contact radius a; force and penetration are in proportion to the height.
struct UnitContact {
    force: f64,
    penetration: f64,
    stiffness: f64,
}

impl UnitContact {
    fn new(
        body: &AxisymmetricElasticity,
        radius: f64,
        exponent: f64,
    ) -> Result<Self, ContactError> {
        let profile = AxisymmetricProfile::Power {
            exponent,
            length: radius,
        };
        let contact = body.contact(profile, radius)?;
        Ok(Self {
            force: contact.force,
            penetration: contact.penetration,
            stiffness: contact.punch.stiffness,
        })
    }

    /// `d ln F/d ln D = S D/F`.
    fn exponent(&self) -> f64 {
        self.stiffness * self.penetration / self.force
    }
}

/// The radius of the punch with a stiffness, by Newton's method in the logarithms.
fn radius_of(body: &AxisymmetricElasticity, stiffness: f64) -> Result<f64, ContactError> {
    let mut radius = stiffness / (2.0 * body.modulus());
    for _ in 0..MOST_STEPS {
        let punch = body.punch(radius)?;
        let slope = radius * punch.stiffness_slope / punch.stiffness;
        let step = (stiffness / punch.stiffness).ln() / slope;
        radius *= step.exp().clamp(FARTHEST.recip(), FARTHEST);
        if step.abs() < PRECISION {
            break;
        }
    }
    Ok(radius)
}

/// The exponent n of the shape whose contact of this radius has the exponent m, by secants in 1/n, in which m is nearly
/// a straight line, held between the ends.
fn exponent_of(
    body: &AxisymmetricElasticity,
    radius: f64,
    wanted: f64,
) -> Result<f64, EffectiveIndenterError> {
    let off = |inverse: f64| {
        let contact = UnitContact::new(body, radius, inverse.recip())?;
        Ok::<_, ContactError>(contact.exponent() - wanted)
    };
    let ends = [PowerLaw::MOST_EXPONENT, PowerLaw::LEAST_EXPONENT].map(f64::recip);
    let (mut low, mut high) = ((ends[0], off(ends[0])?), (ends[1], off(ends[1])?));
    // At the upper end the coefficient is of no effect: a cone.
    if low.1 > 0.0 || high.1 <= 0.0 {
        return Err(EffectiveIndenterError::Exponent {
            found: wanted,
            least: low.1 + wanted,
            most: high.1 + wanted,
        });
    }
    for _ in 0..MOST_STEPS {
        let next = low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1));
        let found = off(next)?;
        if found.abs() < PRECISION * wanted || high.0 - low.0 < PRECISION {
            return Ok(next.recip());
        }
        // The value at an end that stays is halved: the Illinois form of the method.
        if found < 0.0 {
            (low, high.1) = ((next, found), 0.5 * high.1);
        } else {
            (high, low.1) = ((next, found), 0.5 * low.1);
        }
    }
    Ok((0.5 * (low.0 + high.0)).recip())
}

#[cfg(test)]
mod tests {
    use pellicle_contact::axisymmetric::punch_stiffness;
    use pellicle_contact::reference::power_law;
    use pellicle_kernel::{Foundation, Material};

    use super::*;

    fn oxide_on_silicon() -> ElasticBodies {
        let [oxide, silicon, diamond] = [(72e9, 0.17), (170e9, 0.22), (1141e9, 0.07)]
            .map(|(young, poisson)| Material::new(young, poisson).unwrap());
        let body = Foundation::coated(500e-9, oxide, silicon).unwrap();
        ElasticBodies::new(body, Some(diamond))
    }

    #[test]
    fn on_a_half_space_the_effective_indenter_is_that_of_the_closed_form() {
        let material = Material::new(72e9, 0.17).unwrap();
        let modulus = material.plane_strain_modulus();
        for (exponent, coefficient) in [
            (1.2, 3e-6),
            (2.0, 3e-6),
            (3.3, 1.1e-6),
            (6.0, 0.6e-6),
            (30.0, 0.5e-6),
        ] {
            let wanted = power_law::from_force([exponent, coefficient], modulus, 5e-3);
            let unloading = UnloadingPoint {
                force: 5e-3,
                // S = 2 E* a,  m = 1 + 1/n
                stiffness: 2.0 * modulus * wanted.contact_radius,
                exponent: 1.0 + exponent.recip(),
            };
            let body = Foundation::half_space(material).into();
            let found = EffectiveIndenter::of(&unloading, &body).unwrap();
            // The exponent to 1e-12 of m, n² times that of n, and c to 1/(n − 1) of the force's.
            for (found, wanted) in [
                (found.shape.exponent(), exponent),
                (found.shape.coefficient(), coefficient),
                (found.contact_radius, wanted.contact_radius),
                (found.penetration, wanted.penetration),
            ] {
                assert!(
                    (found / wanted - 1.0).abs() < 1e-9,
                    "{exponent}: {found} {wanted}"
                );
            }
        }
    }

    #[test]
    fn on_layers_the_indenter_that_made_an_unloading_is_found_again() {
        let bodies = oxide_on_silicon();
        let body = AxisymmetricElasticity::new(&bodies);
        for (exponent, radius) in [(2.2, 120e-9), (3.3, 460e-9), (5.0, 1.4e-6)] {
            let length = 1.3e-6;
            let profile = AxisymmetricProfile::Power { exponent, length };
            let contact = body.contact(profile, radius).unwrap();
            let unloading = UnloadingPoint {
                force: contact.force,
                stiffness: contact.punch.stiffness,
                exponent: contact.punch.stiffness * contact.penetration / contact.force,
            };
            let found = EffectiveIndenter::of(&unloading, &bodies).unwrap();
            for (found, wanted) in [
                (found.shape.exponent(), exponent),
                (found.shape.coefficient(), length),
                (found.contact_radius, radius),
                (found.penetration, contact.penetration),
            ] {
                assert!(
                    (found / wanted - 1.0).abs() < 1e-8,
                    "{exponent}: {found} {wanted}"
                );
            }
            // The half-space's relation is off: the base stiffens the curve.
            let naive = 1.0 / (unloading.exponent - 1.0);
            assert!((naive / exponent - 1.0).abs() > 0.01, "{exponent}: {naive}");
        }
    }

    #[test]
    fn the_imprint_in_an_oxide_of_the_guide_has_its_numbers() {
        let unloading = UnloadingPoint {
            force: 6.4032e-3,
            stiffness: 90.03e3,
            exponent: 1.3,
        };
        let found = EffectiveIndenter::of(&unloading, &oxide_on_silicon()).unwrap();
        // The digits given there.
        assert!((found.shape.exponent() - 4.126).abs() < 5e-4);
        assert!((found.shape.coefficient() - 1.00829e-6).abs() < 5e-12);
    }

    #[test]
    fn exponents_of_no_shape_are_refused_with_those_that_are_possible() {
        let bodies = oxide_on_silicon();
        let [stiffness, _] = punch_stiffness(&bodies, 460e-9).unwrap();
        let of = |exponent| {
            let unloading = UnloadingPoint {
                force: 6.4e-3,
                stiffness,
                exponent,
            };
            EffectiveIndenter::of(&unloading, &bodies)
        };
        for exponent in [1.0, 2.4] {
            let refused = of(exponent).unwrap_err().to_string();
            assert!(refused.contains("wanted one between 1.0"), "{refused}");
        }
        for exponent in [0.0, -1.0, f64::NAN] {
            assert!(of(exponent).is_err());
        }
        assert!(of(1.3).is_ok());
    }
}
