//! A soft film that covers the whole surface.

use crate::error::{Quantity, TextureError, positive};
use crate::spring_law::SpringLaw;

/// A film of uniform thickness, a one-dimensional spring of compliance `η = h / E_w` at every point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    thickness: f64,
    young_modulus: f64,
    law: SpringLaw,
}

impl Film {
    /// Builds a film of thickness h (m) and Young's modulus `E_w` (Pa).
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if either is not positive and finite.
    pub fn new(thickness: f64, young_modulus: f64) -> Result<Self, TextureError> {
        let thickness = positive(Quantity::Thickness, thickness)?;
        let young_modulus = positive(Quantity::YoungModulus, young_modulus)?;
        Ok(Self {
            thickness,
            young_modulus,
            law: SpringLaw::LINEAR,
        })
    }

    /// Returns the same film with springs of the [logarithmic law](SpringLaw), never squeezed beyond the thickness.
    #[must_use]
    pub fn stiffening(self) -> Self {
        let law = SpringLaw::of_checked(self.young_modulus);
        Self { law, ..self }
    }

    /// The law of the springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        self.law
    }

    /// Thickness h, m. Linear springs may shorten by more; such a result is outside the model's validity.
    #[must_use]
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Young's modulus `E_w`, Pa.
    #[must_use]
    pub fn young_modulus(&self) -> f64 {
        self.young_modulus
    }

    /// Compliance at rest `η = h / E_w`, m/Pa.
    #[must_use]
    pub fn compliance(&self) -> f64 {
        self.thickness / self.young_modulus
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_needs_a_thickness_and_a_modulus() {
        let error = |quantity, found| Err(TextureError::NotPositive { quantity, found });
        assert_eq!(Film::new(0.0, 1.0), error(Quantity::Thickness, 0.0));
        assert_eq!(Film::new(5e-9, -1.0), error(Quantity::YoungModulus, -1.0));
        assert_eq!(Film::new(4.0, 8.0).unwrap().compliance(), 0.5);
    }

    #[test]
    fn a_film_is_linear_unless_stiffening_is_requested() {
        let film = Film::new(4.0, 8.0).unwrap();
        assert!(film.spring_law().is_linear());
        let stiffening = film.stiffening();
        assert_eq!(
            Ok(stiffening.spring_law()),
            SpringLaw::logarithmic(film.young_modulus())
        );
        assert_eq!(stiffening.compliance(), film.compliance());
    }
}
