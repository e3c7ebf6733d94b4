//! What is read from a curve at given corrections: the law of its unloading, the depths of its hold, its works.

use std::ops::Range;

use super::contact::Contact;
use super::correction::Line;
use super::evaluation::IndentationCurve;
use super::inputs::Inputs;
use super::numbers::Values;
use super::phases::Phases;
use super::settings::EvaluationSettings;
use super::unloading::UnloadingFit;
use super::{IndentationError, IndentationNumber, Uncertain};
use crate::measured::cycles::median;

/// The depth at the end of a hold is that of the line through the last of so many parts of it.
const END_OF_HOLD: usize = 3;

/// What is read from a curve at given corrections.
#[derive(Debug, Clone)]
pub(super) struct Reading {
    pub(super) unloading: UnloadingFit,
    /// Depths at the end and at the beginning of the hold, m.
    top: [Uncertain; 2],
    is_held: bool,
    /// Work of loading and hold, and of the unloading as far as it was measured, J.
    work: [Uncertain; 2],
    /// Change of both by one standard deviation of the depth between them, J.
    work_at_top: f64,
    /// The force at which the unloading ends, N.
    last_force: f64,
}

impl Reading {
    pub(super) fn of(
        curve: IndentationCurve<'_>,
        phases: &Phases,
        inputs: &Inputs,
    ) -> Result<Self, IndentationError> {
        let depth = inputs.corrected(curve);
        let force = curve.force;
        let top = phases.top.clone();
        let largest = median(&force[top.clone()]);
        let fitted = phases.fitted.clone();
        let unloading = UnloadingFit::of(&depth[fitted.clone()], &force[fitted], largest)?;
        let noise = unloading.noise;
        let (end, beginning) = if phases.is_held {
            let first = top.end - top.len().div_ceil(END_OF_HOLD);
            let places: Vec<f64> = (first..top.end).map(|at| at as f64).collect();
            let line = Line::through(&places, &depth[first..top.end], Some(unloading.dependence));
            let end = line.map_or(depth[top.end - 1], |line| line.last.value);
            let sd = line.map_or(noise, |line| line.last.sd.min(noise));
            // The hold begins within a step of its first point, and creep is fastest there.
            let step = depth[(top.start + 1).min(top.end - 1)] - depth[top.start];
            let beginning = Uncertain {
                value: depth[top.start],
                sd: noise.hypot(0.5 * step),
            };
            (Uncertain { value: end, sd }, beginning)
        } else {
            let value = depth[top.start];
            let at = Uncertain { value, sd: noise };
            (at, at)
        };
        let work = |range: Range<usize>| {
            let (depth, force) = (&depth[range.clone()], &force[range]);
            let strips = depth.windows(2).zip(force.windows(2));
            let value = strips
                .map(|(h, p)| 0.5 * (p[0] + p[1]) * (h[1] - h[0]))
                .sum::<f64>();
            // Each depth but the first and the last enters with half the difference of its neighbours' forces.
            let weights = force
                .windows(3)
                .map(|p| (0.5 * (p[2] - p[0])).powi(2))
                .sum::<f64>();
            Uncertain {
                value,
                sd: noise * (weights * unloading.dependence).sqrt(),
            }
        };
        let first = curve.first_contact.unwrap_or(0);
        let loading = work(first..top.end);
        let back = work(top.end - 1..phases.end + 1);
        Ok(Self {
            unloading,
            top: [end, beginning],
            is_held: phases.is_held,
            work: [
                loading,
                Uncertain {
                    value: -back.value,
                    ..back
                },
            ],
            work_at_top: noise * force[top.end - 1],
            last_force: force[phases.end].max(0.0),
        })
    }

    /// The independent directions of the noise, each one standard deviation long: of `S`, `m`, `h₁`, both depths of the
    /// hold, both works, and of the depth between these.
    pub(super) fn noise(&self) -> Vec<[f64; 7]> {
        let triangle = cholesky(self.unloading.covariance);
        let mut directions: Vec<[f64; 7]> = (0..3)
            .map(|k| {
                let of = |row: usize| triangle[row][k];
                [of(0), of(1), of(2), 0.0, 0.0, 0.0, 0.0]
            })
            .collect();
        let others = [self.top[0], self.top[1], self.work[0], self.work[1]];
        for (k, uncertain) in others.into_iter().enumerate() {
            let mut direction = [0.0; 7];
            direction[3 + k] = uncertain.sd;
            directions.push(direction);
        }
        let both = self.work_at_top;
        directions.push([0.0, 0.0, 0.0, 0.0, 0.0, both, both]);
        directions
    }

    pub(super) fn moved(&self, direction: &[f64; 7], side: f64) -> Self {
        let mut moved = self.clone();
        let [s, m, h, end, beginning, loading, back] = direction.map(|part| side * part);
        moved.unloading.stiffness += s;
        moved.unloading.exponent += m;
        moved.unloading.depth += h;
        moved.top[0].value += end;
        moved.top[1].value += beginning;
        moved.work[0].value += loading;
        moved.work[1].value += back;
        moved
    }

    /// The numbers, in the order of [`IndentationNumber::ALL`].
    pub(super) fn numbers(
        &self,
        settings: &EvaluationSettings,
        inputs: &Inputs,
    ) -> Result<Values, IndentationError> {
        let fit = &self.unloading;
        let [end, beginning] = self.top.map(|of| of.value);
        let contact = Contact {
            depth: end,
            force: fit.force,
            stiffness: fit.stiffness,
            exponent: Some(fit.exponent),
            area: None,
        };
        let mut numbers = contact.numbers(settings, inputs)?;
        let [loading, back] = self.work.map(|of| of.value);
        // What the law gives back below the last force, ∫ P dh = P (h − h_f)/(m + 1).
        let span = fit.exponent * fit.force / fit.stiffness;
        let left = span * (self.last_force / fit.force).powf(1.0 / fit.exponent);
        let tail = self.last_force * left / (fit.exponent + 1.0);
        let creep = (end - beginning) / beginning;
        let mut set = |of: IndentationNumber, value| numbers[of.place()] = value;
        set(IndentationNumber::FinalDepth, Some(fit.final_depth()));
        set(IndentationNumber::Creep, self.is_held.then_some(creep));
        let ratio = (loading > 0.0).then_some((back + tail) / loading);
        set(IndentationNumber::ElasticWorkRatio, ratio);
        set(IndentationNumber::DriftRate, Some(inputs.rate));
        Ok(numbers)
    }
}

/// The lower triangle `L` of `L Lᵀ`; zero columns where the matrix is not positive.
fn cholesky(matrix: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut triangle = [[0.0; 3]; 3];
    for k in 0..3 {
        let dot = |a: usize, b: usize, l: &[[f64; 3]; 3]| -> f64 {
            (0..k).map(|j| l[a][j] * l[b][j]).sum()
        };
        let pivot = matrix[k][k] - dot(k, k, &triangle);
        if pivot <= 0.0 {
            continue;
        }
        triangle[k][k] = pivot.sqrt();
        for row in k + 1..3 {
            triangle[row][k] = (matrix[row][k] - dot(row, k, &triangle)) / triangle[k][k];
        }
    }
    triangle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_triangle_gives_the_matrix_back() {
        let matrix = [[4.0, 2.0, 1.0], [2.0, 5.0, 3.0], [1.0, 3.0, 6.0]];
        let l = cholesky(matrix);
        for (i, row) in matrix.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let product: f64 = (0..3).map(|k| l[i][k] * l[j][k]).sum();
                assert!((product - entry).abs() < 1e-14);
            }
        }
    }
}
