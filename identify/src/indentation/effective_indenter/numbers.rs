//! The effective indenter of an evaluated unloading, with the uncertainties of its numbers.

use pellicle_influence::ElasticBodies;
use serde::Serialize;

use super::super::{IndentationNumber, IndentationNumbers, Uncertain};
use super::{EffectiveIndenter, EffectiveIndenterError, UnloadingPoint};

/// Relative step of stiffness and exponent in differences: an error of its square, 1e-8.
const STEP: f64 = 1e-4;

/// The numbers of an effective indenter, with the standard uncertainties that those of stiffness and exponent leave.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EffectiveIndenterNumbers {
    /// Exponent n of the shape.
    pub exponent: Uncertain,
    /// Coefficient c of the shape, m.
    pub coefficient: Uncertain,
    /// Contact radius at the largest force, m.
    pub contact_radius: Uncertain,
    /// Penetration at the largest force, m.
    pub penetration: Uncertain,
}

impl EffectiveIndenterNumbers {
    /// The effective indenter of an evaluated unloading of these bodies, whose stiffness is `beta` times that of a flat
    /// punch; none if it has no exponent, as readings of a continuous stiffness.
    ///
    /// # Errors
    ///
    /// Those of [`EffectiveIndenter::of`].
    pub fn of(
        numbers: &IndentationNumbers,
        beta: f64,
        bodies: &ElasticBodies,
    ) -> Result<Option<Self>, EffectiveIndenterError> {
        use IndentationNumber::{ContactStiffness, Exponent, MaxForce};
        let found = [MaxForce, ContactStiffness, Exponent].map(|of| numbers.get(of));
        let [Some(force), Some(stiffness), Some(exponent)] = found else {
            return Ok(None);
        };
        let at = |by_stiffness: f64, by_exponent: f64| {
            let unloading = UnloadingPoint {
                force: force.value,
                stiffness: stiffness.value / beta * (1.0 + by_stiffness),
                exponent: exponent.value * (1.0 + by_exponent),
            };
            EffectiveIndenter::of(&unloading, bodies).map(|found| found.numbers())
        };
        let value = at(0.0, 0.0)?;
        let slopes = [
            [at(STEP, 0.0)?, at(-STEP, 0.0)?],
            [at(0.0, STEP)?, at(0.0, -STEP)?],
        ];
        let relative = |one, other, scale: f64| numbers.covariance(one, other) / scale;
        let (s, m) = (stiffness.value, exponent.value);
        let variance = [
            relative(ContactStiffness, ContactStiffness, s * s),
            relative(ContactStiffness, Exponent, s * m),
            relative(Exponent, Exponent, m * m),
        ];
        let number = |k: usize| {
            let [s, m] = slopes.map(|[more, less]| (more[k] - less[k]) / (2.0 * STEP));
            let square = s * s * variance[0] + 2.0 * s * m * variance[1] + m * m * variance[2];
            Uncertain {
                value: value[k],
                sd: square.max(0.0).sqrt(),
            }
        };
        Ok(Some(Self {
            exponent: number(0),
            coefficient: number(1),
            contact_radius: number(2),
            penetration: number(3),
        }))
    }
}
