//! Curves of many points as combinations of a few basis curves.
//!
//! A curve consists of its value and slope at each point, as logarithms if all are positive. Curves over a box of
//! parameters are nearly combinations of a few of them, found by a pivoted Gram–Schmidt process.

use crate::{
    Prediction,
    orthonormal_basis::{OrthonormalBasis, norm},
};

/// The scale in which a number is interpolated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ValueScale {
    Logarithm,
    /// The number divided by a typical value.
    Part(f64),
}

impl ValueScale {
    fn of(values: &[f64]) -> Self {
        let typical = norm(values) / (values.len() as f64).sqrt();
        if values.iter().all(|&v| v > 0.0) {
            Self::Logarithm
        } else {
            Self::Part(typical.max(f64::MIN_POSITIVE))
        }
    }

    /// The reference of a number's relative error.
    pub fn reference(self, value: f64) -> f64 {
        match self {
            Self::Logarithm => value,
            Self::Part(typical) => typical,
        }
    }

    fn apply(self, value: f64) -> f64 {
        match self {
            Self::Logarithm => value.ln(),
            Self::Part(typical) => value / typical,
        }
    }

    /// The number, and its derivative with respect to the interpolated quantity.
    pub fn undo(self, of: f64) -> (f64, f64) {
        match self {
            Self::Logarithm => (of.exp(), of.exp()),
            Self::Part(typical) => (of * typical, typical),
        }
    }
}

/// A mean curve, and an orthonormal basis of the curves about it.
#[derive(Debug, Clone)]
pub(super) struct ReducedCurves {
    pub points: usize,
    pub scales: [ValueScale; 2],
    mean: Vec<f64>,
    basis: Vec<Vec<f64>>,
}

impl ReducedCurves {
    /// A basis that represents each sample to `tolerance`, and the amplitudes: one list of samples for each basis
    /// vector.
    pub fn of(samples: &[Prediction], tolerance: f64) -> (Self, Vec<Vec<f64>>) {
        let points = samples.first().map_or(0, |one| one.value.len());
        let all = |of: &dyn Fn(&Prediction) -> &Vec<f64>| -> Vec<f64> {
            samples.iter().flat_map(of).copied().collect()
        };
        let scales = [
            ValueScale::of(&all(&|one| &one.value)),
            ValueScale::of(&all(&|one| &one.slope)),
        ];
        let mut rows: Vec<Vec<f64>> = samples.iter().map(|one| stacked(one, scales)).collect();
        let mean: Vec<f64> = (0..2 * points)
            .map(|i| rows.iter().map(|row| row[i]).sum::<f64>() / rows.len() as f64)
            .collect();
        for row in &mut rows {
            row.iter_mut().zip(&mean).for_each(|(v, m)| *v -= m);
        }
        let (basis, amplitudes) = pivoted(rows, tolerance);
        let reduced = Self {
            points,
            scales,
            mean,
            basis,
        };
        (reduced, amplitudes)
    }

    /// Values and slopes of all points from the amplitudes, in the scale of interpolation.
    pub fn expand(&self, amplitudes: &[f64]) -> Vec<f64> {
        let mut curve = self.change(amplitudes, 0..2 * self.points);
        curve.iter_mut().zip(&self.mean).for_each(|(v, m)| *v += m);
        curve
    }

    /// The change of the values alone for a change of the amplitudes.
    pub fn change_of_values(&self, amplitudes: &[f64]) -> Vec<f64> {
        self.change(amplitudes, 0..self.points)
    }

    fn change(&self, amplitudes: &[f64], range: std::ops::Range<usize>) -> Vec<f64> {
        let mut curve = vec![0.0; range.len()];
        for (vector, amplitude) in self.basis.iter().zip(amplitudes) {
            for (v, b) in curve.iter_mut().zip(&vector[range.clone()]) {
                *v += amplitude * b;
            }
        }
        curve
    }
}

fn stacked(one: &Prediction, scales: [ValueScale; 2]) -> Vec<f64> {
    let values = one.value.iter().map(|&v| scales[0].apply(v));
    let slopes = one.slope.iter().map(|&v| scales[1].apply(v));
    values.chain(slopes).collect()
}

/// Adds the row with the longest residual to the basis until every residual is within `tolerance` of the longest row.
fn pivoted(mut rows: Vec<Vec<f64>>, tolerance: f64) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let mut basis = Vec::new();
    let mut amplitudes: Vec<Vec<f64>> = Vec::new();
    let longest = |rows: &[Vec<f64>]| {
        let lengths = rows.iter().map(|row| norm(row)).enumerate();
        lengths.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let Some((_, enough)) = longest(&rows) else {
        return (basis, amplitudes);
    };
    while basis.len() < rows.len() {
        let Some((pivot, length)) = longest(&rows) else {
            break;
        };
        if length <= tolerance * enough {
            break;
        }
        let vector: Vec<f64> = rows[pivot].iter().map(|v| v / length).collect();
        let direction = OrthonormalBasis::of([vector.clone()]);
        let parts = rows.iter_mut().map(|row| direction.remove_from(row)[0]);
        amplitudes.push(parts.collect());
        basis.push(vector);
    }
    (basis, amplitudes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_of_two_shapes_need_two_vectors_and_are_reproduced() {
        let curve = |a: f64, b: f64| Prediction {
            value: (1..=50).map(|i| (a + b * f64::from(i)).exp()).collect(),
            slope: vec![-a; 50],
            derivatives: Vec::new(),
        };
        let samples = [
            curve(0.1, 0.01),
            curve(0.3, 0.02),
            curve(-0.2, 0.05),
            curve(0.7, 0.0),
        ];
        let (reduced, amplitudes) = ReducedCurves::of(&samples, 1e-9);
        assert_eq!(amplitudes.len(), 2);
        assert_eq!(reduced.scales[0], ValueScale::Logarithm);
        for (k, sample) in samples.iter().enumerate() {
            let own: Vec<f64> = amplitudes.iter().map(|of| of[k]).collect();
            for (found, value) in reduced.expand(&own).iter().zip(&sample.value) {
                // Rounding.
                assert!((found.exp() / value - 1.0).abs() < 1e-12);
            }
        }
    }
}
