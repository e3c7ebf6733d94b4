//! The elastic bodies in axisymmetric contact.

use std::f64::consts::{FRAC_2_PI, PI};

use pellicle_influence::ElasticBodies;

use super::equation::Equation;
use super::layer_kernel::{LayerKernel, modulus};
use super::{AxisymmetricContact, AxisymmetricPressure, AxisymmetricProfile, PunchContact};
use crate::ContactError;

/// Pieces of the contact radius on which a shape's right-hand side and the pressure are integrated.
const PIECES: f64 = 4.0;

/// Layers and an indenter's material, prepared for any contact radius and shape. The layers' kernel is found once, for
/// radii as they are asked for.
///
/// ```
/// use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
/// use pellicle_kernel::{Foundation, Material};
///
/// let (film, steel) = (Material::new(300e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let body = AxisymmetricElasticity::new(&Foundation::coated(2e-6, film, steel)?.into());
/// let ball = AxisymmetricProfile::Sphere { radius: 1e-3 };
/// let contact = body.contact(ball, 10e-6)?;
/// // The stiffness of the contact is that of a flat punch of its radius, between those of film and steel.
/// let [of_steel, of_film] = [steel, film].map(|material| 2.0 * material.plane_strain_modulus() * 10e-6);
/// assert!((of_steel..of_film).contains(&contact.punch.stiffness));
/// assert_eq!(contact.punch.stiffness, body.punch(10e-6)?.stiffness);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct AxisymmetricElasticity {
    modulus: f64,
    kernel: Option<LayerKernel>,
}

impl AxisymmetricElasticity {
    /// The elasticity of a body and of the one pressed against it.
    #[must_use]
    pub fn new(bodies: &ElasticBodies) -> Self {
        Self {
            modulus: modulus(bodies),
            kernel: LayerKernel::new(bodies),
        }
    }

    /// `E*` of the surfaces in contact, Pa: `1/E* = 1/E₁* + 1/E_i*` of the topmost material and the indenter.
    #[must_use]
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// A flat punch of a radius (m), accurate to 1e-12.
    ///
    /// # Errors
    /// [`ContactError::AxisymmetricRadius`] if the radius is not positive and finite, or above 2048 thicknesses of the
    /// top layer.
    pub fn punch(&self, radius: f64) -> Result<PunchContact, ContactError> {
        check(radius, f64::INFINITY)?;
        let equation = Equation::new(self.kernel.as_ref(), radius, radius, None)?;
        self.punch_of(&equation, radius)
    }

    /// The contact of an indenter with a contact radius (m), without adhesion: accurate to 1e-11.
    ///
    /// # Errors
    /// Those of [`Self::punch`]; also if the indenter ends within the radius.
    pub fn contact(
        &self,
        profile: AxisymmetricProfile,
        radius: f64,
    ) -> Result<AxisymmetricContact, ContactError> {
        check(radius, profile.rim())?;
        let (widest, kink) = (radius / PIECES, profile.kink());
        let equation = Equation::new(self.kernel.as_ref(), radius, widest, kink)?;
        let punch = self.punch_of(&equation, radius)?;
        let sunk = |x| FRAC_2_PI * profile.half_space_penetration(x);
        let shape = equation.solve(radius, &|x| -sunk(x))?;
        // g(a) = 0: the pressure is finite at the edge.
        let unit = punch.pressure.density();
        let penetration = -shape.edge / unit.edge;
        let density = shape.plus(unit, penetration);
        // F = π E* ∫ g dt,  U = π²/4 E* ∫ g 2/π (D − d) dt
        let force = PI * self.modulus * density.integral(|_| 1.0);
        let work = density.integral(|x| FRAC_2_PI * penetration - sunk(x));
        Ok(AxisymmetricContact {
            radius,
            force,
            penetration,
            energy: 0.25 * PI * PI * self.modulus * work,
            pressure: AxisymmetricPressure::new(radius, self.modulus, density),
            punch,
        })
    }

    fn punch_of(&self, equation: &Equation, radius: f64) -> Result<PunchContact, ContactError> {
        let unit = equation.solve(radius, &|_| FRAC_2_PI)?;
        Ok(PunchContact {
            radius,
            stiffness: PI * self.modulus * unit.integral(|_| 1.0),
            // dS/da = π²/2 E* g₁(a)²
            stiffness_slope: 0.5 * self.modulus * (PI * unit.edge).powi(2),
            pressure: AxisymmetricPressure::new(radius, self.modulus, unit),
        })
    }
}

fn check(radius: f64, rim: f64) -> Result<(), ContactError> {
    if !(radius > 0.0 && radius.is_finite()) {
        let wanted = "a positive finite number";
        return Err(ContactError::AxisymmetricRadius { radius, wanted });
    }
    if radius >= rim {
        let wanted = "less than the radius at which the indenter ends";
        return Err(ContactError::AxisymmetricRadius { radius, wanted });
    }
    Ok(())
}
