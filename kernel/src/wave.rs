//! One wave of displacement and traction inside one homogeneous layer.
//!
//! The state `v = (U, V, τ, σ)` (see [`minors`](crate::response::minors): tractions in units of `2 G k`)
//! obeys `dv/dζ = A v`, `ζ = k z`, and since `(A² − 1)² = 0`
//!
//! ```text
//! exp(A t) = cosh t + (A² − 1) (t/2) sinh t + A sinh t + A (A² − 1) (t cosh t − sinh t)/2
//! ```

use crate::response::Poisson;
use nalgebra::{Matrix4, RowVector4, Vector4};

/// Horizontal displacement `U`.
pub(crate) const U: usize = 0;
/// Vertical displacement `V`.
pub(crate) const V: usize = 1;
/// Shear traction `τ`, in `2 G k`.
pub(crate) const TAU: usize = 2;
/// Normal traction `σ`, in `2 G k`.
pub(crate) const SIGMA: usize = 3;

/// The matrix `A` of `dv/dζ = A v`: Hooke's law and equilibrium, transformed.
pub(crate) fn generator(poisson: &Poisson) -> Matrix4<f64> {
    let &Poisson { nu, b, x, .. } = poisson;
    // n = ν / (1 − ν), 2m = (1 − 2ν) / (1 − ν), x = 1 / (2 (1 − ν))
    let (n, m2, e) = (2.0 * x * nu, 2.0 * x * b, 2.0 * x);
    #[rustfmt::skip]
    let rows = Matrix4::new(
        0.0, 1.0,  2.0, 0.0,
        -n,  0.0,  0.0, m2,
        e,   0.0,  0.0, n,
        0.0, 0.0, -1.0, 0.0,
    );
    rows
}

/// `e^{−|t|} exp(A t)`: the state a distance `t/k` deeper, with the growth taken off.
pub(crate) fn propagator(poisson: &Poisson, t: f64) -> Matrix4<f64> {
    let a = generator(poisson);
    let one = Matrix4::identity();
    let nilpotent = a * a - one;
    let decayed = (-2.0 * t.abs()).exp_m1();
    // e^{−|t|} cosh t, e^{−|t|} sinh t
    let cosh = 1.0 + 0.5 * decayed;
    let sinh = -0.5 * decayed * t.signum();
    one * cosh
        + nilpotent * (0.5 * t * sinh)
        + a * sinh
        + a * nilpotent * (0.5 * difference(t, cosh, sinh))
}

/// `e^{−|t|} (t cosh t − sinh t)`; for small `t` the series `2 Σ n t^{2n+1} / (2n+1)!`.
fn difference(t: f64, cosh: f64, sinh: f64) -> f64 {
    if t.abs() >= 1.0 {
        return t * cosh - sinh;
    }
    let square = t * t;
    let mut term = t * square / 3.0;
    let mut sum = term;
    // Ratio of terms: t² / (2n (2n + 3)), below 1e-17 of the sum after nine of them.
    for n in 1..10 {
        let n = f64::from(n);
        term *= square / (2.0 * n * (2.0 * n + 3.0));
        sum += term;
    }
    sum * (-t.abs()).exp()
}

/// The wave inside one layer, held by the state at mid-depth so that nothing grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerWave {
    poisson: Poisson,
    half: f64,
    middle: Vector4<f64>,
}

/// The four equations of one layer: loads on its top, what holds its bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerEquations {
    poisson: Poisson,
    half: f64,
    pub(crate) matrix: Matrix4<f64>,
    pub(crate) load: Vector4<f64>,
}

impl LayerEquations {
    /// A layer of `s = k H` with `tractions` `(τ, σ)` on its top, whose state on the bottom fulfils
    /// the two `bottom` equations `row · v = 0`.
    pub(crate) fn new(
        poisson: &Poisson,
        s: f64,
        tractions: [f64; 2],
        bottom: [RowVector4<f64>; 2],
    ) -> Self {
        let half = 0.5 * s;
        let to_top = propagator(poisson, -half);
        let to_bottom = propagator(poisson, half);
        let rows = [
            to_top.row(TAU).into_owned(),
            to_top.row(SIGMA).into_owned(),
            bottom[0] * to_bottom,
            bottom[1] * to_bottom,
        ];
        Self {
            poisson: *poisson,
            half,
            matrix: Matrix4::from_rows(&rows),
            load: Vector4::new(tractions[0], tractions[1], 0.0, 0.0),
        }
    }

    /// Solves by LU with partial pivoting; `None` if a pivot vanishes.
    pub(crate) fn solve(&self) -> Option<LayerWave> {
        let middle = self.matrix.lu().solve(&self.load)?;
        Some(LayerWave {
            poisson: self.poisson,
            half: self.half,
            middle,
        })
    }
}

impl LayerWave {
    /// The state at `ζ = k z` below the top of the layer.
    pub(crate) fn at(&self, zeta: f64) -> Vector4<f64> {
        let t = zeta - self.half;
        // The middle carries the factor e^{−s/2} of the equations, the propagator e^{−|t|}.
        propagator(&self.poisson, t) * self.middle * (t.abs() - self.half).exp()
    }

    /// The state on the top.
    pub(crate) fn top(&self) -> Vector4<f64> {
        propagator(&self.poisson, -self.half) * self.middle
    }

    /// The state on the bottom.
    pub(crate) fn bottom(&self) -> Vector4<f64> {
        propagator(&self.poisson, self.half) * self.middle
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;

    #[test]
    fn propagation_there_and_back_is_no_propagation() {
        let poisson = Poisson::new(Material::new(1.0, 0.37).unwrap());
        for t in [1e-6, 0.3, 0.999, 1.0, 2.0] {
            let product = propagator(&poisson, t) * propagator(&poisson, -t);
            let scale = (-2.0 * t).exp();
            // e^{2t} ≤ 55 magnifies the roundings of entries of order 1.
            assert!(
                (product / scale - Matrix4::identity()).norm() < 1e-13,
                "{t}"
            );
        }
    }

    #[test]
    fn the_square_of_the_generator_minus_one_squares_to_nothing() {
        for nu in [0.0, 0.2, 0.5] {
            let a = generator(&Poisson::new(Material::new(1.0, nu).unwrap()));
            let nilpotent = a * a - Matrix4::identity();
            assert!((nilpotent * nilpotent).norm() < 1e-14);
        }
    }
}
