//! The elastic bodies in axisymmetric contact.

use std::f64::consts::{FRAC_2_PI, PI};

use pellicle_influence::ElasticBodies;
use pellicle_texture::Relief;

use super::equation::{Density, Equation};
use super::film_equation::FilmEquation;
use super::layer_kernel::LayerKernel;
use super::{AxisymmetricContact, AxisymmetricPressure, AxisymmetricProfile, PunchContact};
use crate::ContactError;

/// Pieces of the contact radius on which a shape's right-hand side and the pressure are integrated.
const PIECES: f64 = 4.0;

/// Relative step of the radius in the derivative of a stiffness: rounding and the fourth order leave 1e-11.
const STEP: f64 = 1e-3;

/// Two bodies with their layers, prepared for any contact radius and shape. The layers' kernel is found once, for
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
    moduli: [f64; 2],
    kernel: Option<LayerKernel>,
    /// Compliance η of springs between the bodies, m/Pa.
    springs: Option<f64>,
}

/// The integral equation at a contact radius.
enum AnyEquation {
    Bare(Equation),
    Film(FilmEquation),
}

impl AxisymmetricElasticity {
    /// The elasticity of a body and of the one pressed against it.
    #[must_use]
    pub fn new(bodies: &ElasticBodies) -> Self {
        Self {
            modulus: bodies.surface_modulus(),
            moduli: bodies.modulus_range(),
            kernel: LayerKernel::new(bodies),
            springs: None,
        }
    }

    /// The same with a film of linear springs of a compliance η (m/Pa) between the bodies, such as a soft film of
    /// thickness h and modulus E with `η = h/E`; none if η is 0.
    #[must_use]
    pub fn with_springs(self, compliance: f64) -> Self {
        let springs = Some(compliance).filter(|compliance| *compliance > 0.0);
        Self { springs, ..self }
    }

    /// `E*` of the surfaces in contact, Pa: `1/E* = 1/E₁* + 1/E_i*` of the topmost materials.
    #[must_use]
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// `E*` of the softest and of the stiffest materials of both bodies, Pa.
    #[must_use]
    pub fn moduli(&self) -> [f64; 2] {
        self.moduli
    }

    /// Whether springs lie between the bodies.
    #[must_use]
    pub fn has_springs(&self) -> bool {
        self.springs.is_some()
    }

    /// The same with the springs of a relief that is the same everywhere; none if its springs are not.
    #[must_use]
    pub fn on_relief(self, relief: &Relief) -> Option<Self> {
        match relief {
            Relief::Bare => Some(self),
            Relief::Film(film) if film.spring_law().is_linear() => {
                Some(self.with_springs(film.thickness() / film.young_modulus()))
            }
            _ => None,
        }
    }

    /// Relative accuracy of forces and penetrations: 1e-11; with springs 1e-6, or 1e-4 under cones and power laws,
    /// whose tips are not smooth.
    #[must_use]
    pub fn accuracy(&self, profile: AxisymmetricProfile) -> f64 {
        let is_smooth = matches!(
            profile,
            AxisymmetricProfile::Paraboloid { .. } | AxisymmetricProfile::Sphere { .. }
        );
        match (self.springs, is_smooth) {
            (None, _) => 1e-11,
            (Some(_), true) => 1e-6,
            (Some(_), false) => 1e-4,
        }
    }

    /// A flat punch of a radius (m), accurate to 1e-12, with springs to 1e-6.
    ///
    /// # Errors
    /// [`ContactError::AxisymmetricRadius`] if the radius is not positive and finite, or above 2048 thicknesses of the
    /// top layer.
    pub fn punch(&self, radius: f64) -> Result<PunchContact, ContactError> {
        check(radius, f64::INFINITY)?;
        let equation = self.equation(radius, radius, None)?;
        self.punch_of(&equation, radius)
    }

    /// The contact of an indenter with a contact radius (m), without adhesion; see [`Self::accuracy`].
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
        let equation = self.equation(radius, widest, kink)?;
        let punch = self.punch_of(&equation, radius)?;
        let sunk = |x| FRAC_2_PI * profile.half_space_penetration(x);
        let shape = equation.solve(radius, &|x| -sunk(x))?;
        // g(a) = 0, with springs p(a) = 0: the surfaces part smoothly.
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

    fn equation(
        &self,
        radius: f64,
        widest: f64,
        kink: Option<f64>,
    ) -> Result<AnyEquation, ContactError> {
        let kernel = self.kernel.as_ref();
        match self.springs {
            None => Equation::new(kernel, radius, widest, kink).map(AnyEquation::Bare),
            Some(compliance) => {
                let ratio = self.spring_ratio(compliance, radius);
                let sines = FilmEquation::sines(kernel, radius, ratio)?;
                Ok(AnyEquation::Film(FilmEquation::new(
                    kernel, radius, ratio, sines,
                )))
            }
        }
    }

    /// `β = η E*/2a`.
    fn spring_ratio(&self, compliance: f64, radius: f64) -> f64 {
        compliance * self.modulus / (2.0 * radius)
    }

    /// `dS/da` of a flat punch with this density, N/m².
    fn stiffness_slope(&self, radius: f64, unit: &Density) -> Result<f64, ContactError> {
        let Some(compliance) = self.springs else {
            // π²/2 E* g₁(a)²
            return Ok(0.5 * self.modulus * (PI * unit.edge).powi(2));
        };
        // A difference of fourth order, all with as many sines.
        let sines = unit.nodes.len();
        let stiffness = |factor: f64| {
            let radius = factor * radius;
            let ratio = self.spring_ratio(compliance, radius);
            let equation = FilmEquation::new(self.kernel.as_ref(), radius, ratio, sines);
            let unit = equation.solve(radius, &|_| FRAC_2_PI)?;
            Ok::<_, ContactError>(PI * self.modulus * unit.integral(|_| 1.0))
        };
        let near = stiffness(1.0 + STEP)? - stiffness(1.0 - STEP)?;
        let far = stiffness(1.0 + 2.0 * STEP)? - stiffness(1.0 - 2.0 * STEP)?;
        Ok((8.0 * near - far) / (12.0 * STEP * radius))
    }

    fn punch_of(&self, equation: &AnyEquation, radius: f64) -> Result<PunchContact, ContactError> {
        let unit = equation.solve(radius, &|_| FRAC_2_PI)?;
        Ok(PunchContact {
            radius,
            stiffness: PI * self.modulus * unit.integral(|_| 1.0),
            stiffness_slope: self.stiffness_slope(radius, &unit)?,
            pressure: AxisymmetricPressure::new(radius, self.modulus, unit),
        })
    }
}

impl AnyEquation {
    fn solve(&self, radius: f64, right_side: &dyn Fn(f64) -> f64) -> Result<Density, ContactError> {
        match self {
            Self::Bare(equation) => equation.solve(radius, right_side),
            Self::Film(equation) => equation.solve(radius, right_side),
        }
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
