//! The integral equation with a film of linear springs between the bodies.
//!
//! Springs of compliance η add `η k E*/2` to `Φ`, so that g vanishes at the edge as the root of the distance and obeys
//! Prandtl's equation of the lifting line. With `x = a cos θ`, `β = η E*/2a` and `g = Σ cₙ sin nθ`, n odd (H. Glauert
//! 1926):
//!
//! ```text
//! Σ cₙ sin nθ (sin θ + β n) + sin θ ∫ L(x, t) g(t) dt = sin θ r(x)      p(a) = π E*/4a Σ n cₙ
//! ```
//!
//! with L the kernel of the layers and r the right-hand side without springs. The coefficients fall as `n⁻⁴`, because
//! the slope of an elastic surface is a logarithm where the pressure ends in a step, so force and penetration converge
//! fast and `p(a)` slowly. The derivative of the stiffness is therefore taken from its values, not from `p(a)`.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::equation::{Density, no_solution};
use super::layer_kernel::LayerKernel;
use crate::ContactError;

/// Sines beyond those that layers and stiff springs need: with more, forces and penetrations under paraboloids change
/// by 1e-7, under sharp cones by 6e-5.
const SINES: f64 = 64.0;

/// Sines per `1/√β`, the width in θ over which g falls to 0 at the edge.
const EDGE: f64 = 10.0;

/// Sines per inverse half-width in θ of the strip in which the layers' kernel is analytic: the rule leaves
/// `e^{−4 · 7.5} = 1e-13`.
const LAYERS: f64 = 7.5;

/// Most sines, whose dense system takes half a second; stiffer springs are refused.
const MOST_SINES: f64 = 1200.0;

/// The equation at a contact radius, ready for any right-hand side.
#[derive(Debug)]
pub(super) struct FilmEquation {
    /// θ at the nodes.
    angles: Vec<f64>,
    /// t and weights of the rule at the nodes.
    nodes: Vec<(f64, f64)>,
    /// `sin nθ`: one row per node, one column per n.
    sines: DMatrix<f64>,
    system: LU<f64, Dyn, Dyn>,
}

impl FilmEquation {
    /// The number of sines at a contact radius (m) for `β`.
    ///
    /// # Errors
    /// [`ContactError::AxisymmetricRadius`] if the springs are too stiff for a contact so wide, or it is beyond the
    /// kernel's reach.
    pub fn sines(
        kernel: Option<&LayerKernel>,
        radius: f64,
        ratio: f64,
    ) -> Result<usize, ContactError> {
        let of_layers = |kernel: &LayerKernel| LAYERS / (2.0 * kernel.thickness / radius).asinh();
        let needed = SINES + EDGE / ratio.sqrt() + kernel.map_or(0.0, of_layers);
        // Radii near this one are asked for, too.
        let is_within = kernel.is_none_or(|kernel| 2.1 * radius <= kernel.reach());
        if needed <= MOST_SINES && is_within {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "at most the most sines"
            )]
            return Ok(needed.ceil() as usize);
        }
        let wanted =
            "a smaller one, or a thicker or softer film: over so wide a contact it is nearly rigid";
        Err(ContactError::AxisymmetricRadius { radius, wanted })
    }

    /// The equation at a contact radius (m) for `β`, with this number of sines.
    pub fn new(kernel: Option<&LayerKernel>, radius: f64, ratio: f64, count: usize) -> Self {
        let step = PI / (2 * count + 1) as f64;
        let angles: Vec<f64> = (1..=count).map(|j| j as f64 * step).collect();
        // dt = a sin θ dθ, by the trapezoidal rule
        let nodes: Vec<_> = angles
            .iter()
            .map(|angle| (radius * angle.cos(), radius * angle.sin() * step))
            .collect();
        let sines = DMatrix::from_fn(count, count, |j, m| ((2 * m + 1) as f64 * angles[j]).sin());
        let mut system = DMatrix::from_fn(count, count, |j, m| {
            sines[(j, m)] * (angles[j].sin() + ratio * (2 * m + 1) as f64)
        });
        if let Some(kernel) = kernel {
            let table = kernel.up_to(2.0 * radius);
            let of_layers = DMatrix::from_fn(count, count, |j, i| {
                angles[j].sin() * nodes[i].1 * table.pair(nodes[j].0, nodes[i].0)
            });
            system += of_layers * &sines;
        }
        Self {
            angles,
            nodes,
            sines,
            system: system.lu(),
        }
    }

    /// Solves the equation; [`Density::edge`] is `Σ n cₙ`.
    ///
    /// # Errors
    /// [`ContactError::AxisymmetricRadius`] if the system has no solution.
    pub fn solve(
        &self,
        radius: f64,
        right_side: &dyn Fn(f64) -> f64,
    ) -> Result<Density, ContactError> {
        let places = self.nodes.iter().zip(&self.angles);
        let right = places.map(|((t, _), angle)| angle.sin() * right_side(*t));
        let mut coefficients = DVector::from_iterator(self.nodes.len(), right);
        if !self.system.solve_mut(&mut coefficients) {
            return Err(no_solution(radius));
        }
        let values = &self.sines * &coefficients;
        let nodes = self.nodes.iter().zip(values.iter());
        let edge = coefficients
            .iter()
            .enumerate()
            .map(|(m, c)| (2 * m + 1) as f64 * c);
        Ok(Density {
            nodes: nodes.map(|((t, weight), g)| (*t, *weight, *g)).collect(),
            edge: edge.sum(),
        })
    }
}
