//! Correlated noise: a first-order autoregression plus white noise, whitened exactly in one pass.
//!
//! For unit variance, `R_ij = w δ_ij + (1 − w) φ^|i − j|`, where `φ` is the correlation of the persistent part from one
//! point to the next and `w` the white fraction of the variance. Where only a part `h_i²` of a point's variance is such
//! noise and the rest is white, `R_ij = (1 − h_i²) δ_ij + h_i h_j R_ij`. The Kalman filter of this state-space model
//! gives the innovations, the product of the inverse Cholesky factor of `R` and the series, in O(n): J. Durbin and S.
//! J. Koopman, Time Series Analysis by State Space Methods (Oxford, 2nd ed. 2012), sections 4.3 and 7.2.

use crate::orthonormal_basis::dot;

/// A larger correlation of neighbours cannot be told from a bend.
pub(crate) const MOST_PERSISTENT: f64 = 0.95;

/// The correlation of neighbouring residuals, at least 0.
pub(crate) fn persistence(residual: &[f64]) -> f64 {
    let products = dot(&residual[1..], &residual[..residual.len() - 1]);
    let persistence = (products / dot(residual, residual)).clamp(0.0, MOST_PERSISTENT);
    if persistence.is_nan() {
        0.0
    } else {
        persistence
    }
}

/// How many neighbouring points of such noise count as one in a long mean: `1 + 2 (1 − w) φ/(1 − φ)`.
pub(crate) fn dependence(persistence: f64, white_fraction: f64) -> f64 {
    (1.0 + persistence * (1.0 - 2.0 * white_fraction)) / (1.0 - persistence)
}

/// The whitening of a series, stored as the gains of the filter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Innovations {
    persistence: f64,
    /// `h_i`.
    loading: Vec<f64>,
    /// `K_i = φ h_i P_i/F_i`.
    gain: Vec<f64>,
    /// `F_i`, the variance of point `i` given those before.
    variance: Vec<f64>,
}

impl Innovations {
    /// The filter for series of up to `points` points, all of such noise.
    pub fn new(points: usize, persistence: f64, white_fraction: f64) -> Self {
        Self::of(vec![1.0; points], persistence, white_fraction)
    }

    /// The filter for series of which these parts `h_i` of the standard deviations are such noise.
    pub fn of(loading: Vec<f64>, persistence: f64, white_fraction: f64) -> Self {
        let (phi, white) = (persistence, white_fraction);
        let mut state = 1.0 - white;
        let points = loading.len();
        let (mut gain, mut variance) = (Vec::with_capacity(points), Vec::with_capacity(points));
        for h in &loading {
            // w' = w + (1 − w)(1 − h²),  F = h² P + w',  K = φ h P/F,  P' = φ² P w'/F + (1 − φ²)(1 − w)
            let own = white + (1.0 - white) * (1.0 - h * h);
            let f = h * h * state + own;
            gain.push(phi * h * state / f);
            variance.push(f);
            state = phi * phi * state * own / f + (1.0 - phi * phi) * (1.0 - white);
        }
        Self {
            persistence,
            loading,
            gain,
            variance,
        }
    }

    /// Replaces a series by its innovations, each divided by its standard deviation.
    pub fn whiten(&self, series: &mut [f64]) {
        let mut expected = 0.0;
        let filter = self.loading.iter().zip(&self.gain).zip(&self.variance);
        for (value, ((loading, gain), variance)) in series.iter_mut().zip(filter) {
            let innovation = *value - loading * expected;
            expected = self.persistence * expected + gain * innovation;
            *value = innovation / variance.sqrt();
        }
    }

    /// `ln det R` for a series of `points` points.
    pub fn log_determinant(&self, points: usize) -> f64 {
        self.variance[..points].iter().map(|f| f.ln()).sum()
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use faer::{Mat, Side, linalg::solvers::Solve as _};

    use super::*;

    #[test]
    fn whitening_agrees_with_the_dense_covariance() {
        whitening_agrees(&[1.0; 12]);
        whitening_agrees(&[1.0, 0.8, 0.0, 0.3, 1.0, 0.9, 0.2, 0.6, 0.7, 0.1, 0.5, 1.0]);
    }

    fn whitening_agrees(loading: &[f64]) {
        let (points, phi, white) = (loading.len(), 0.85, 0.3);
        let dense = Mat::from_fn(points, points, |i, j| {
            let part = (1.0 - white) * f64::powi(phi, i32::try_from(i.abs_diff(j)).unwrap());
            let diagonal = 1.0 - (1.0 - white) * loading[i] * loading[i];
            if i == j {
                part * loading[i] * loading[i] + diagonal
            } else {
                part * loading[i] * loading[j]
            }
        });
        let series: Vec<f64> = (0..points).map(|i| (1.7 * i as f64).sin() + 0.2).collect();
        let column = Mat::from_fn(points, 1, |i, _| series[i]);
        let solution = dense.llt(Side::Lower).unwrap().solve(&column);
        let quadratic: f64 = (0..points).map(|i| series[i] * solution[(i, 0)]).sum();

        let filter = Innovations::of(loading.to_vec(), phi, white);
        let mut whitened = series.clone();
        filter.whiten(&mut whitened);
        let sum: f64 = whitened.iter().map(|v| v * v).sum();
        // Rounding of twelve numbers, with a matrix of condition number about 30.
        assert_relative_eq!(sum, quadratic, max_relative = 1e-12);
        assert_relative_eq!(
            filter.log_determinant(points),
            dense.determinant().ln(),
            max_relative = 1e-12
        );
    }

    #[test]
    fn white_noise_is_left_alone() {
        let filter = Innovations::new(3, 0.5, 1.0);
        let mut series = [1.0, -2.0, 3.0];
        filter.whiten(&mut series);
        assert_eq!(series, [1.0, -2.0, 3.0]);
        assert_eq!(filter.log_determinant(3), 0.0);
    }
}
