//! A model that is free to evaluate: curves of another model, interpolated over a box of its unknowns.
//!
//! The logarithms of values and slopes are polynomials in each `ln θ`, through the Chebyshev nodes of the box.

use std::f64::consts::PI;

use pellicle_identify::{ForwardError, ForwardModel, Prediction};
use rayon::prelude::*;

/// A box of unknowns, with the curves at its nodes.
pub struct Interpolant {
    /// `ln θ` at the ends of each side.
    sides: Vec<[f64; 2]>,
    nodes: usize,
    /// At each node, the last unknown running fastest: logarithms of all values, then of all slopes.
    curves: Vec<Vec<f64>>,
}

impl Interpolant {
    /// Solves the model at `nodes` values of each unknown between the ends of its side.
    pub fn over(model: &dyn ForwardModel, sides: &[[f64; 2]], nodes: usize) -> Self {
        let sides: Vec<[f64; 2]> = sides.iter().map(|side| side.map(f64::ln)).collect();
        let value = |[low, high]: [f64; 2], k: usize| {
            (f64::midpoint(low, high) + 0.5 * (high - low) * node(k, nodes)).exp()
        };
        let parameters = |place: usize| -> Vec<f64> {
            let along = sides.iter().zip(digits(place, nodes, sides.len()));
            along.map(|(side, k)| value(*side, k)).collect()
        };
        let curve = |place: usize| {
            let found = model.predict(&parameters(place)).unwrap();
            let both = found.value.iter().chain(&found.slope);
            both.map(|v| v.ln()).collect()
        };
        let places = nodes.pow(u32::try_from(sides.len()).unwrap());
        let curves = (0..places).into_par_iter().map(curve).collect();
        Self {
            sides,
            nodes,
            curves,
        }
    }

    /// The curve summed with one weight for each node and side.
    fn combined(&self, weights: &[Vec<f64>]) -> Vec<f64> {
        let mut sum = vec![0.0; self.curves[0].len()];
        for (place, curve) in self.curves.iter().enumerate() {
            let along = digits(place, self.nodes, self.sides.len());
            let weight: f64 = weights.iter().zip(along).map(|(of, k)| of[k]).product();
            sum.iter_mut()
                .zip(curve)
                .for_each(|(sum, v)| *sum += weight * v);
        }
        sum
    }
}

impl ForwardModel for Interpolant {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let half = |side: &[f64; 2]| 0.5 * (side[1] - side[0]);
        let pairs = self.sides.iter().zip(parameters);
        let at: Vec<f64> = pairs
            .map(|(side, value)| (value.ln() - f64::midpoint(side[0], side[1])) / half(side))
            .collect();
        // Bounds of a fit may lie outside by rounding.
        if at.iter().any(|t| t.is_nan() || t.abs() > 1.0 + 1e-9) {
            let source = format!("found {parameters:?}, wanted values in the box").into();
            return Err(ForwardError::OutOfRange { source });
        }
        let weights: Vec<Vec<f64>> = at.iter().map(|t| weights(*t, self.nodes)).collect();
        let curve = self.combined(&weights);
        let (values, slopes) = curve.split_at(curve.len() / 2);
        let value: Vec<f64> = values.iter().map(|v| v.exp()).collect();
        let derivative = |axis: usize| {
            let mut weights = weights.clone();
            weights[axis] = changes(at[axis], self.nodes);
            let by_value = 1.0 / (half(&self.sides[axis]) * parameters[axis]);
            let changes = self.combined(&weights).into_iter().zip(&value);
            changes.map(|(change, v)| v * change * by_value).collect()
        };
        Ok(Prediction {
            derivatives: (0..at.len()).map(derivative).collect(),
            slope: slopes.iter().map(|v| v.exp()).collect(),
            value,
            ..Prediction::default()
        })
    }
}

/// The index of a node along each side.
fn digits(place: usize, nodes: usize, sides: usize) -> impl Iterator<Item = usize> {
    let place_of = move |axis: usize| nodes.pow(u32::try_from(sides - 1 - axis).unwrap());
    (0..sides).map(move |axis| place / place_of(axis) % nodes)
}

/// Chebyshev's node `t_k = −cos (π (k + ½)/n)`.
fn node(k: usize, nodes: usize) -> f64 {
    -(PI * (k as f64 + 0.5) / nodes as f64).cos()
}

/// Lagrange's polynomials of the nodes at a point.
fn weights(t: f64, nodes: usize) -> Vec<f64> {
    let factor = |k: usize, j: usize| (t - node(j, nodes)) / (node(k, nodes) - node(j, nodes));
    let one = |k: usize| {
        (0..nodes)
            .filter(|j| *j != k)
            .map(|j| factor(k, j))
            .product()
    };
    (0..nodes).map(one).collect()
}

/// Their derivatives: the sum of the products with one factor differentiated.
fn changes(t: f64, nodes: usize) -> Vec<f64> {
    let apart = |k: usize, j: usize| node(k, nodes) - node(j, nodes);
    let without = |k: usize, m: usize| -> f64 {
        let others = (0..nodes).filter(|j| *j != k && *j != m);
        let product: f64 = others.map(|j| (t - node(j, nodes)) / apart(k, j)).product();
        product / apart(k, m)
    };
    let one = |k: usize| (0..nodes).filter(|m| *m != k).map(|m| without(k, m)).sum();
    (0..nodes).map(one).collect()
}

#[test]
fn a_power_law_is_interpolated_exactly_with_its_derivatives() {
    /// `y = a q^b`, whose logarithm is linear in `ln a` and `b`; its parameters are `a` and `eᵇ`.
    struct Power;
    impl ForwardModel for Power {
        fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
            let (a, b) = (parameters[0], parameters[1].ln());
            let value: Vec<f64> = (1..9).map(|q| a * f64::from(q).powf(b)).collect();
            Ok(Prediction {
                slope: value.clone(),
                origins: Vec::new(),
                derivatives: vec![
                    value.iter().map(|v| v / a).collect(),
                    (value.iter().zip(1..))
                        .map(|(v, q)| v * f64::from(q).ln() / parameters[1])
                        .collect(),
                ],
                value,
            })
        }
    }
    let found = Interpolant::over(&Power, &[[1.0, 9.0], [2.0, 5.0]], 4);
    let [found, wanted] =
        [&found as &dyn ForwardModel, &Power].map(|model| model.predict(&[2.5, 4.1]).unwrap());
    let numbers = |of: &Prediction| {
        [&of.value, &of.slope, &of.derivatives[0], &of.derivatives[1]]
            .map(Clone::clone)
            .concat()
    };
    for (found, wanted) in numbers(&found).iter().zip(numbers(&wanted)) {
        // Rounding; the second derivative of the first point is zero.
        assert!(
            (found - wanted).abs() < 1e-12 * wanted.abs().max(1.0),
            "{found} {wanted}"
        );
    }
}
