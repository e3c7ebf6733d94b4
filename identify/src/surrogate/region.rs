//! The box of a surrogate, in the coordinates of the unknowns, and mapped to a cube.

use crate::{Estimate, Fit, IdentifyError, Unknown};

/// Half side of the box, in half widths of the intervals.
const REACH: f64 = 2.5;

/// Maximum number of unknowns.
const MOST: usize = 4;

/// A value this far outside a box, in half sides, is attributed to rounding.
const ROUNDING: f64 = 1e-9;

/// A box about a centre.
#[derive(Debug, Clone)]
pub(crate) struct Region {
    unknowns: Vec<Unknown>,
    /// Smallest and largest coordinate of each unknown.
    sides: Vec<[f64; 2]>,
    /// Point about which it shrinks.
    centre: Vec<f64>,
}

impl Region {
    /// A box given by the smallest and largest values of the unknowns.
    pub fn new(unknowns: &[Unknown], sides: &[[f64; 2]]) -> Result<Self, IdentifyError> {
        let position = |(unknown, side): (&Unknown, &[f64; 2])| side.map(|v| unknown.position(v));
        let sides: Vec<[f64; 2]> = unknowns.iter().zip(sides).map(position).collect();
        let centre = sides.iter().map(|[low, high]| f64::midpoint(*low, *high));
        let centre = centre.collect();
        Self::about(unknowns, sides, centre)
    }

    /// The box determined by the intervals of a fit.
    pub fn around(unknowns: &[Unknown], fit: &Fit) -> Result<Self, IdentifyError> {
        let pairs = || unknowns.iter().zip(&fit.estimates);
        let sides = pairs().map(|(unknown, estimate)| reach(unknown, estimate));
        let centre = pairs().map(|(unknown, estimate)| unknown.position(estimate.value));
        Self::about(unknowns, sides.collect(), centre.collect())
    }

    fn about(
        unknowns: &[Unknown],
        sides: Vec<[f64; 2]>,
        centre: Vec<f64>,
    ) -> Result<Self, IdentifyError> {
        let wanted = unknowns.len().min(MOST);
        for found in [sides.len(), unknowns.len()] {
            if found != wanted || found == 0 {
                let list = "sides of the surrogate's box";
                return Err(IdentifyError::Length {
                    list,
                    found,
                    wanted,
                });
            }
        }
        for (unknown, [low, high]) in unknowns.iter().zip(&sides) {
            if !(high > low && (high - low).is_finite()) {
                return Err(IdentifyError::NumberOf {
                    name: unknown.name().to_owned(),
                    quantity: "side of the surrogate's box",
                    found: high - low,
                    wanted: "a positive finite number",
                });
            }
        }
        Ok(Self {
            unknowns: unknowns.to_vec(),
            sides,
            centre,
        })
    }

    pub fn dimensions(&self) -> usize {
        self.sides.len()
    }

    /// The box with its sides multiplied by `part`, about the centre.
    pub fn shrunk(&self, part: f64) -> Self {
        let pairs = self.sides.iter().zip(&self.centre);
        let side = |(side, centre): (&[f64; 2], &f64)| side.map(|x| centre + part * (x - centre));
        Self {
            sides: pairs.map(side).collect(),
            ..self.clone()
        }
    }

    /// Smallest and largest value of each unknown.
    pub fn sides(&self) -> Vec<[f64; 2]> {
        let pairs = self.unknowns.iter().zip(&self.sides);
        pairs
            .map(|(unknown, side)| side.map(|x| unknown.value(x)))
            .collect()
    }

    /// Smallest and largest coordinate of each unknown.
    pub fn coordinates(&self) -> &[[f64; 2]] {
        &self.sides
    }

    /// The values of the unknowns at a point of the cube `[−1, 1]^d`.
    pub fn parameters(&self, at: &[f64]) -> Vec<f64> {
        let pairs = self.unknowns.iter().zip(&self.sides).zip(at);
        pairs
            .map(|((unknown, [low, high]), t)| {
                unknown.value(f64::midpoint(*low, *high) + 0.5 * t * (high - low))
            })
            .collect()
    }

    /// The point of the cube for these coordinates.
    pub fn cube(&self, position: &[f64]) -> Vec<f64> {
        let pairs = self.sides.iter().zip(position);
        pairs
            .map(|([low, high], x)| (2.0 * x - low - high) / (high - low))
            .collect()
    }

    /// The point of the cube for these parameters, or an error naming one that lies outside.
    pub fn inside(&self, parameters: &[f64]) -> Result<Vec<f64>, IdentifyError> {
        let pairs = self.unknowns.iter().zip(parameters);
        let position: Vec<f64> = pairs.map(|(unknown, &v)| unknown.position(v)).collect();
        let at = self.cube(&position);
        let outside = at
            .iter()
            .position(|t| t.is_nan() || t.abs() > 1.0 + ROUNDING);
        match outside {
            Some(axis) => Err(IdentifyError::NumberOf {
                name: self.unknowns[axis].name().to_owned(),
                quantity: "value",
                found: parameters[axis],
                wanted: "a number in the box of the surrogate",
            }),
            None => Ok(at),
        }
    }

    /// `dt/dθ`, the derivative of a coordinate of the cube with respect to the value of an unknown.
    pub fn slope(&self, axis: usize, value: f64) -> f64 {
        let [low, high] = self.sides[axis];
        2.0 / ((high - low) * self.unknowns[axis].value_slope(value))
    }
}

/// The side of the box for one unknown: a multiple of its interval about the best value, at most to the bounds.
fn reach(unknown: &Unknown, estimate: &Estimate) -> [f64; 2] {
    let centre = unknown.position(estimate.value);
    let bounds = unknown.bounds();
    [0, 1].map(|side| {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let Some(end) = estimate.interval[side] else {
            return bounds[side];
        };
        let [low, high] = unknown.range();
        let ends = [Some(end), estimate.wald.map(|wald| wald[side])];
        let inside = ends.into_iter().flatten().map(|end| end.clamp(low, high));
        let half = inside.map(|end| sign * (unknown.position(end) - centre));
        let half = half.fold(0.0, f64::max);
        (centre + sign * REACH * half).clamp(bounds[0], bounds[1])
    })
}
