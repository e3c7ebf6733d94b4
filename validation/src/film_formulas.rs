//! Formulas for indenters on a thin layer on a rigid base, compared with the exact force and the program's contacts.
//!
//! All give the force over that on a half-space, for a frictionless indenter, as a function of one length in
//! thicknesses H:
//!
//! ```text
//! paraboloid   F = ψ(χ) 4/3 E* √R D^{3/2}      χ = √(RD)/H
//! cone         F = ψ(X) 2/π E* D² tan α        X = D tan α/H, α from the axis
//! flat punch   F = ψ(x) 2 E* a D               x = a/H
//! ```

mod published;

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use pellicle_contact::Load;
use pellicle_contact::axisymmetric::quadrature::{composite, graded};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use crate::run::{ContactSetup, ValidationError, ValidationRun, paraboloid};

pub use published::{PUBLISHED, PublishedFormula};

/// Secant steps that find a contact radius to rounding, and two more.
const SECANTS: usize = 8;

/// An indenter pressed on the layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmIndenter {
    /// Of radius 1.
    Paraboloid,
    /// With a side at 45° to its axis.
    Cone,
    /// Pressed in by 1.
    FlatPunch,
}

/// A layer of thickness 1 on a rigid base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinLayer {
    /// Interface with the base.
    pub interface: Interface,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
}

impl ThinLayer {
    /// Returns the foundation, with the plane-strain modulus 1.
    ///
    /// # Errors
    /// Errors if Poisson's ratio is outside 0 … ½.
    pub fn foundation(&self) -> Result<Foundation, ValidationError> {
        let nu = self.poisson_ratio;
        let material = Material::new(1.0 - nu * nu, nu)?;
        let layer = Layer::new(1.0, material, self.interface)?;
        Ok(Foundation::new(vec![layer], Base::Rigid)?)
    }

    /// Returns the length in thicknesses and `ψ` at a contact radius, in thicknesses, from the integral equation.
    ///
    /// # Errors
    /// Errors of [`AxisymmetricElasticity::contact`].
    pub fn at_contact_radius(
        &self,
        indenter: FilmIndenter,
        radius: f64,
    ) -> Result<[f64; 2], ValidationError> {
        let body = AxisymmetricElasticity::new(&self.foundation()?.into());
        let pressed = |profile| {
            let contact = body.contact(profile, radius)?;
            Ok::<_, ValidationError>((contact.penetration, contact.force))
        };
        Ok(match indenter {
            FilmIndenter::Paraboloid => {
                let (depth, force) = pressed(AxisymmetricProfile::Paraboloid { radius: 1.0 })?;
                [depth.sqrt(), 0.75 * force / depth.powf(1.5)]
            }
            FilmIndenter::Cone => {
                let (depth, force) = pressed(AxisymmetricProfile::Cone {
                    slope: 1.0,
                    tip_radius: 0.0,
                })?;
                [depth, FRAC_PI_2 * force / depth.powi(2)]
            }
            FilmIndenter::FlatPunch => [radius, 0.5 * body.punch(radius)?.stiffness / radius],
        })
    }

    /// Returns `ψ` at a length in thicknesses from the integral equation.
    ///
    /// # Errors
    /// Errors of [`AxisymmetricElasticity::contact`].
    pub fn exact(&self, indenter: FilmIndenter, length: f64) -> Result<f64, ValidationError> {
        // The length grows roughly as a power of the contact radius: secants in the logarithms, starting from a thick
        // layer.
        let at = |radius: f64| {
            let found = self.at_contact_radius(indenter, radius)?;
            Ok::<_, ValidationError>((radius.ln(), found))
        };
        let (mut before, mut last) = (at(length)?, at(1.2 * length)?);
        if indenter == FilmIndenter::FlatPunch {
            return Ok(before.1[1]);
        }
        for _ in 0..SECANTS {
            let [found, psi] = last.1;
            let off = (found / length).ln();
            if off.abs() < 1e-13 {
                return Ok(psi);
            }
            let slope = (found / before.1[0]).ln() / (last.0 - before.0);
            let next = at((last.0 - off / slope).exp())?;
            (before, last) = (last, next);
        }
        Ok(last.1[1])
    }

    /// Returns `ψ(χ)` of a paraboloid from the program's certified solution on 256 × 256 elements, on a domain of this
    /// side in thicknesses.
    ///
    /// # Errors
    /// Errors of [`ValidationRun::solve`].
    pub fn solved(&self, chi: f64, side: f64) -> Result<f64, ValidationError> {
        let (body, load) = (self.foundation()?, Load::Penetration(chi * chi));
        let contact = ContactSetup::bare(body, paraboloid(1.0)?, (side, 256), load);
        let path = ValidationRun::default().solve(&contact)?;
        // F/(4/3 E* √R D^{3/2}) with E* = R = H = 1 and D = χ².
        Ok(0.75 * path.steps[0].solution.force / chi.powi(3))
    }

    /// Returns the first coefficients of the exact `ψ` in powers of its length, including the constant. With
    ///
    /// ```text
    /// A = 2/π ∫ (Φ − 1) ds      B = −1/π ∫ (Φ − 1) s² ds
    /// ```
    ///
    /// the integral equation's kernel is `A + B (x² + t²)` up to the fifth power of the lengths, hence
    ///
    /// ```text
    /// paraboloid   1 − A χ + 7/6 A² χ² − (40/27 A³ + 8/15 B) χ³ + (143/72 A⁴ + 8/5 A B) χ⁴
    /// cone         1 − A d + 5/4 A² d² − (7/4 A³ + ½ B) d³ + (21/8 A⁴ + 7/4 A B) d⁴          d = 2X/π
    /// flat punch   1/(1 + A x + ⅔ B x³)
    /// ```
    ///
    /// # Errors
    /// Errors of [`Self::foundation`].
    pub fn series(&self, indenter: FilmIndenter) -> Result<[f64; 5], ValidationError> {
        let [a, b] = self.moments()?;
        Ok(match indenter {
            FilmIndenter::Paraboloid => [
                1.0,
                -a,
                7.0 / 6.0 * a * a,
                -(40.0 / 27.0 * a.powi(3) + 8.0 / 15.0 * b),
                143.0 / 72.0 * a.powi(4) + 8.0 / 5.0 * a * b,
            ],
            FilmIndenter::Cone => {
                let [a, b] = [a * FRAC_2_PI, b * FRAC_2_PI.powi(3)];
                [
                    1.0,
                    -a,
                    1.25 * a * a,
                    -(1.75 * a.powi(3) + 0.5 * b),
                    2.625 * a.powi(4) + 1.75 * a * b,
                ]
            }
            FilmIndenter::FlatPunch => [
                1.0,
                -a,
                a * a,
                -(a.powi(3) + 2.0 / 3.0 * b),
                a.powi(4) + 4.0 / 3.0 * a * b,
            ],
        })
    }

    /// A and B, see [`Self::series`].
    fn moments(&self) -> Result<[f64; 2], ValidationError> {
        let body = self.foundation()?;
        let moment = |power| {
            let nodes = composite(&graded(25.0, 0.5));
            let terms = nodes.into_iter();
            terms
                .map(|(s, weight)| weight * s.powi(power) * body.response_minus_one(s))
                .sum::<f64>()
        };
        Ok([FRAC_2_PI * moment(0), -moment(2) / PI])
    }

    /// Returns the coefficients of `ψ(χ)` by E. K. Dimitriadis and others (2002): for a bonded incompressible layer as
    /// printed, for a layer that is not bonded from the general formula; `None` otherwise.
    #[must_use]
    pub fn dimitriadis(&self) -> Option<[f64; 5]> {
        let nu = self.poisson_ratio;
        match self.interface {
            Interface::Bonded => (nu >= 0.5).then_some([1.0, 1.133, 1.283, 0.769, 0.0975]),
            Interface::Frictionless => {
                let alpha = -0.347 * (3.0 - 2.0 * nu) / (1.0 - nu);
                let beta = 0.056 * (5.0 - 2.0 * nu) / (1.0 - nu);
                let cube = alpha.powi(3);
                Some([
                    1.0,
                    -FRAC_2_PI * alpha,
                    (FRAC_2_PI * alpha).powi(2),
                    -8.0 / PI.powi(3) * (cube + 4.0 * PI * PI / 15.0 * beta),
                    16.0 * alpha / PI.powi(4) * (cube + 3.0 * PI * PI / 5.0 * beta),
                ])
            }
            Interface::Spring(_) => None,
        }
    }

    /// Returns `ψ(χ)` of a layer much thinner than the contact is wide. A bonded incompressible layer flows outward
    /// like a liquid film and has `3π/8 χ³`. Otherwise the layer is a bed of springs and has `3π/4 χ` times its modulus
    /// of compression over `E*`.
    #[must_use]
    pub fn thin_limit(&self, chi: f64) -> f64 {
        let nu = self.poisson_ratio;
        let springs = 0.75 * PI * chi;
        match self.interface {
            Interface::Bonded if nu >= 0.5 => 0.375 * PI * chi.powi(3),
            // (1 − ν)²/(1 − 2ν): no strain along the surface
            Interface::Bonded => springs * (1.0 - nu).powi(2) / (1.0 - 2.0 * nu),
            _ => springs,
        }
    }
}

/// `Σ cᵢ χⁱ`.
#[must_use]
pub fn polynomial(coefficients: &[f64], chi: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * chi + c)
}
