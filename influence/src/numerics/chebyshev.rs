//! Chebyshev expansions: coefficients from values, sums, integrals, and the error estimated from the tail; and
//! Lagrange interpolation at the points of an expansion, on [0, 1].

use std::f64::consts::PI;

/// The points `cos(π (i + ½)/n)`, i = 0 … n−1, at which a function is sampled for an expansion of n terms.
pub(crate) fn nodes(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| (PI * (i as f64 + 0.5) / count as f64).cos())
}

/// The transform from values at the [`nodes`] to coefficients, for one number of terms.
#[derive(Clone, Debug)]
pub(crate) struct ChebyshevTransform {
    samples: usize,
    /// Row j: `2/n cos(π j (i + ½)/n)`, halved for j = 0.
    matrix: Vec<f64>,
}

impl ChebyshevTransform {
    /// The transform from `samples` values to the first `terms` coefficients; with more samples than
    /// terms, a least-squares fit.
    pub(crate) fn new(samples: usize, terms: usize) -> Self {
        let entry = |j: usize, i: usize| {
            let turn = (j * (2 * i + 1)) % (4 * samples);
            let scale = if j == 0 { 1.0 } else { 2.0 };
            scale / samples as f64 * (PI * turn as f64 / (2 * samples) as f64).cos()
        };
        let rows = 0..terms;
        let matrix = rows.flat_map(|j| (0..samples).map(move |i| entry(j, i)));
        Self {
            samples,
            matrix: matrix.collect(),
        }
    }

    /// Coefficients `c_j` of `Σ c_j T_j(x)` from the values at the nodes.
    pub(crate) fn coefficients(&self, values: &[f64]) -> Vec<f64> {
        let dot = |row: &[f64]| row.iter().zip(values).map(|(m, v)| m * v).sum();
        self.matrix.chunks_exact(self.samples).map(dot).collect()
    }
}

/// `Σ c_j T_j(x)` for x in [−1, 1], by Clenshaw's recurrence.
#[inline]
pub(crate) fn sum(coefficients: &[f64], x: f64) -> f64 {
    let Some((first, rest)) = coefficients.split_first() else {
        return 0.0;
    };
    let (mut near, mut far) = (0.0, 0.0);
    for c in rest.iter().rev() {
        // b_j = c_j + 2x b_(j+1) − b_(j+2)
        (near, far) = (2.0 * x * near + (c - far), near);
    }
    first + (x * near - far)
}

/// Coefficients of the integral from −1 of `Σ c_j T_j`; one more than given.
pub(crate) fn integral(coefficients: &[f64]) -> Vec<f64> {
    let c = |j: usize| coefficients.get(j).copied().unwrap_or(0.0);
    let entry = |j: usize| match j {
        0 => 0.0,
        // ∫ T_0 = T_1, ∫ T_1 = T_2/4, ∫ T_j = T_(j+1)/2(j+1) − T_(j−1)/2(j−1)
        1 => c(0) - c(2) / 2.0,
        _ => (c(j - 1) - c(j + 1)) / (2 * j) as f64,
    };
    let mut result: Vec<f64> = (0..=coefficients.len()).map(entry).collect();
    result[0] = -sum(&result, -1.0);
    result
}

/// Coefficient of `u^power` in `Σ c_j T_j(2u − 1)`.
pub(crate) fn taylor(coefficients: &[f64], power: i32) -> f64 {
    let terms = coefficients.iter().enumerate();
    terms.map(|(j, c)| c * taylor_weight(j, power)).sum()
}

/// Coefficient of `u^power` in `T_j(2u − 1)`: `(−1)^(j+power) Π_(i<power) 2 (j² − i²) / ((2i+1)(i+1))`.
pub(crate) fn taylor_weight(j: usize, power: i32) -> f64 {
    let j_squared = (j * j) as f64;
    let factor = |i: i32| {
        let i = f64::from(i);
        2.0 * (j_squared - i * i) / ((2.0 * i + 1.0) * (i + 1.0))
    };
    let sign = if j.is_multiple_of(2) == (power % 2 == 0) {
        1.0
    } else {
        -1.0
    };
    sign * (0..power).map(factor).product::<f64>()
}

/// Estimate of the error of a truncated expansion: the largest of its last three coefficients.
pub(crate) fn tail(coefficients: &[f64]) -> f64 {
    let last = coefficients.iter().rev().take(3);
    last.fold(0.0, |largest, c| c.abs().max(largest))
}

/// The [`nodes`] mapped to [0, 1], in descending order.
pub(crate) fn unit_nodes<const COUNT: usize>() -> [f64; COUNT] {
    let mut nodes = nodes(COUNT);
    std::array::from_fn(|_| 0.5 + 0.5 * nodes.next().unwrap_or_default())
}

/// Lagrange weights of the [`unit_nodes`] at `place` in [0, 1].
pub(crate) fn lagrange_weights<const COUNT: usize>(place: f64) -> [f64; COUNT] {
    let nodes = unit_nodes::<COUNT>();
    std::array::from_fn(|i| {
        let others = nodes.iter().enumerate().filter(|(other, _)| *other != i);
        others
            .map(|(_, node)| (place - node) / (nodes[i] - node))
            .product()
    })
}

#[cfg(test)]
mod tests {
    use super::{
        ChebyshevTransform, integral, lagrange_weights, nodes, sum, tail, taylor, unit_nodes,
    };

    fn exponential() -> Vec<f64> {
        let values: Vec<f64> = nodes(18).map(f64::exp).collect();
        ChebyshevTransform::new(18, 18).coefficients(&values)
    }

    #[test]
    fn an_entire_function_is_approximated_to_rounding() {
        let coefficients = exponential();
        for x in [-1.0, -0.3, 0.0, 0.77, 1.0_f64] {
            assert!((sum(&coefficients, x) - x.exp()).abs() < 2e-15);
        }
        assert!(tail(&coefficients) < 1e-14);
    }

    #[test]
    fn the_integral_starts_at_the_left_end() {
        let coefficients = integral(&exponential());
        for x in [-1.0, 0.1, 1.0_f64] {
            let expected = x.exp() - (-1_f64).exp();
            assert!((sum(&coefficients, x) - expected).abs() < 2e-15);
        }
    }

    #[test]
    fn more_samples_than_terms_give_the_same_polynomial() {
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (3.0 - 4.0 * x));
        let values: Vec<f64> = nodes(64).map(cubic).collect();
        let coefficients = ChebyshevTransform::new(64, 4).coefficients(&values);
        assert!((sum(&coefficients, 0.4) - cubic(0.4)).abs() < 1e-14);
    }

    #[test]
    fn a_chebyshev_sum_is_converted_to_powers() {
        // T_3(2u−1) = 32u³ − 48u² + 18u − 1
        let cubic = [0.0, 0.0, 0.0, 1.0];
        for (power, expected) in [(0, -1.0), (1, 18.0), (2, -48.0), (3, 32.0), (4, 0.0)] {
            assert!((taylor(&cubic, power) - expected).abs() < 1e-13);
        }
    }

    #[test]
    fn polynomials_with_fewer_terms_than_nodes_are_reproduced() {
        let cubic = |x: f64| 2.0 - x + 3.0 * x.powi(3);
        for place in [0.0, 0.17, 0.5, 1.0] {
            let terms = unit_nodes::<4>()
                .map(cubic)
                .into_iter()
                .zip(lagrange_weights::<4>(place));
            let found: f64 = terms.map(|(value, weight)| value * weight).sum();
            assert!((found - cubic(place)).abs() < 1e-14, "{place}: {found}");
        }
    }
}
