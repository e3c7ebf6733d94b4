//! Axisymmetric contact by Fredholm's integral equation of the second kind, as solved by W. C. Hayes and others (1972)
//! for a layer on a rigid base.
//!
//! The pressure is written as waves whose transform is `p̅(k) = E*/2 ∫₀ᵃ g(t) cos kt dt`, with `E*` of the surface's
//! material. On a half-space each `g(t)` deforms the surface only within the circle t; layers add a smooth kernel:
//!
//! ```text
//! g(x) + 1/π ∫₀ᵃ g(t) (M(x + t) + M(x − t)) dt = 2/π d/dx ∫₀ˣ r u(r)/√(x² − r²) dr      M(y) = ∫ (Φ(k) − 1) cos ky dk
//! ```
//!
//! where u is the displacement that the indenter prescribes: `D` for a flat punch, `D − r²/2R` for a paraboloid,
//! `D − r` for a cone. The right-hand side is then `2D/π`, `2/π (D − x²/R)`, `2D/π − x`. The force is `π E* ∫ g dt`.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use nalgebra::{DMatrix, DVector};
use pellicle_kernel::Foundation;

use super::super::run::ValidationError;
use super::hankel::RadialPressure;
use super::{composite, graded};

/// `Φ − 1` is negligible beyond this product of wavenumber and thickness.
const DECAY: f64 = 25.0;

/// Fewest pieces of the contact radius.
const PIECES: f64 = 4.0;

/// Length of a piece of the contact radius, in thicknesses of the top layer: `M` is analytic up to two thicknesses from
/// the real axis, so 16 points leave an error of 1e-13.
const PIECE: f64 = 2.0;

/// A rigid indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxisymmetricProfile {
    /// The flat end of a cylinder, pressed in by this depth (m).
    FlatPunch(f64),
    /// `r²/2R`, with this R (m).
    Paraboloid(f64),
    /// `r`.
    Cone,
}

/// Contact of an indenter at a given contact radius.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisymmetricSolution {
    /// Penetration, m.
    pub penetration: f64,
    /// Force, N.
    pub force: f64,
    radius: f64,
    /// Half of `E*`, Pa.
    half_modulus: f64,
    /// t, weight of the rule and g at each node.
    densities: Vec<(f64, f64, f64)>,
}

impl AxisymmetricSolution {
    /// Solves the contact of an indenter with layers at a contact radius (m).
    ///
    /// # Errors
    /// An error if the system has no solution.
    pub fn new(
        foundation: &Foundation,
        profile: AxisymmetricProfile,
        radius: f64,
    ) -> Result<Self, ValidationError> {
        let rule = composite(&pieces(foundation, radius));
        let size = rule.len();
        let places = rule.iter().map(|(t, _)| *t).chain([radius]);
        let layers = kernel(foundation, radius, &places.collect::<Vec<_>>());
        let matrix = DMatrix::from_fn(size, size, |i, j| {
            f64::from(u8::from(i == j)) + rule[j].1 * layers[(i, j)]
        });
        // Two right-hand sides: 2/π for a penetration of 1, and the contribution of the profile.
        let right = DMatrix::from_fn(size, 2, |i, column| match column {
            0 => FRAC_2_PI,
            _ => profile.right_side(rule[i].0),
        });
        let found = matrix.lu().solve(&right);
        let found = found.ok_or(ValidationError::NoSolution)?;
        let [unit, shape] = [0, 1].map(|column| DVector::from(found.column(column)));
        let integral = |g: &DVector<f64>, weigh: &dyn Fn(usize) -> f64| -> f64 {
            let terms = rule.iter().zip(g.iter()).enumerate();
            terms
                .map(|(j, ((_, weight), g))| weight * weigh(j) * g)
                .sum()
        };
        let penetration = match profile {
            AxisymmetricProfile::FlatPunch(depth) => depth,
            // g(a) = 0: the pressure is finite at the edge.
            AxisymmetricProfile::Paraboloid(_) | AxisymmetricProfile::Cone => {
                let edge = |right: f64, g| right - integral(g, &|j| layers[(size, j)]);
                -edge(profile.right_side(radius), &shape) / edge(FRAC_2_PI, &unit)
            }
        };
        let density = unit * penetration + shape;
        let half_modulus = foundation.surface_material().plane_strain_modulus() / 2.0;
        let force = 2.0 * PI * half_modulus * integral(&density, &|_| 1.0);
        let densities = rule.iter().zip(density.iter());
        Ok(Self {
            penetration,
            force,
            radius,
            half_modulus,
            densities: densities
                .map(|((t, weight), g)| (*t, *weight, *g))
                .collect(),
        })
    }

    /// Returns the pressure.
    #[must_use]
    pub fn pressure(&self) -> RadialPressure<impl Fn(f64) -> f64 + '_> {
        RadialPressure {
            transform: |k: f64| {
                let terms = self.densities.iter();
                let sum: f64 = terms.map(|(t, weight, g)| weight * g * (k * t).cos()).sum();
                self.half_modulus * sum
            },
            radius: self.radius,
        }
    }
}

impl AxisymmetricProfile {
    /// `2/π d/dx ∫ r u/√(x² − r²) dr` for `u = −f`.
    fn right_side(self, x: f64) -> f64 {
        match self {
            Self::FlatPunch(_) => 0.0,
            Self::Paraboloid(radius) => -FRAC_2_PI * x * x / radius,
            Self::Cone => -x,
        }
    }
}

/// The borders between the pieces of the contact radius.
fn pieces(foundation: &Foundation, radius: f64) -> Vec<f64> {
    let top = foundation.layers().first();
    let needed = top.map_or(0.0, |layer| radius / (PIECE * layer.thickness()));
    let count = needed.ceil().max(PIECES);
    let borders = (0..).map(|border| radius * f64::from(border) / count);
    borders
        .take_while(|border| *border < radius * (1.0 + 0.5 / count))
        .collect()
}

/// `1/π (M(x + t) + M(x − t)) = 2/π ∫ (Φ − 1) cos kx cos kt dk` for all pairs of points.
fn kernel(foundation: &Foundation, radius: f64, places: &[f64]) -> DMatrix<f64> {
    let Some(top) = foundation.layers().first() else {
        return DMatrix::zeros(places.len(), places.len());
    };
    // One piece per half period of cos 2ka, and fine enough for Φ.
    let width = FRAC_PI_2 / radius.max(foundation.thickness() / 4.0);
    let waves = composite(&graded(DECAY / top.thickness(), width));
    let cosines = DMatrix::from_fn(waves.len(), places.len(), |i, j| {
        (waves[i].0 * places[j]).cos()
    });
    let mut weighted = cosines.clone();
    for (mut row, (k, weight)) in weighted.row_iter_mut().zip(waves) {
        row *= FRAC_2_PI * weight * foundation.response_minus_one(k);
    }
    cosines.tr_mul(&weighted)
}

#[cfg(test)]
mod tests {
    use super::super::super::data::contact::{AxisymmetricIndenter, axisymmetric};
    use super::*;
    use pellicle_kernel::Material;

    #[test]
    fn the_integral_equation_reproduces_the_22_digit_penetrations_and_forces() {
        for case in axisymmetric().unwrap() {
            let coating = Material::new(case.e1, case.nu1).unwrap();
            let substrate = Material::new(1.0, case.nu2).unwrap();
            let body = Foundation::coated(case.thickness, coating, substrate).unwrap();
            let profile = match case.shape {
                AxisymmetricIndenter::Paraboloid => AxisymmetricProfile::Paraboloid(1.0),
                AxisymmetricIndenter::Cone => AxisymmetricProfile::Cone,
            };
            let found = AxisymmetricSolution::new(&body, profile, 1.0).unwrap();
            let errors = [
                found.penetration / case.penetration - 1.0,
                found.force / case.force - 1.0,
            ];
            // The rules are exact to rounding; the waves left out contribute e^(−25), times the cancellation of stiff
            // coatings.
            for error in errors {
                assert!(error.abs() < 1e-11, "{case:?}: {errors:?}");
            }
        }
    }

    #[test]
    fn without_layers_the_integral_equation_gives_hertz_and_the_flat_punch() {
        let body = Foundation::half_space(Material::new(0.91, 0.3).unwrap());
        let hertz =
            AxisymmetricSolution::new(&body, AxisymmetricProfile::Paraboloid(2.0), 0.5).unwrap();
        assert!((hertz.penetration / 0.125 - 1.0).abs() < 1e-14);
        assert!((hertz.force / (4.0 * 0.125 / 6.0) - 1.0).abs() < 1e-14);
        let punch =
            AxisymmetricSolution::new(&body, AxisymmetricProfile::FlatPunch(0.1), 0.5).unwrap();
        assert!((punch.force / 0.1 - 1.0).abs() < 1e-14);
    }
}
