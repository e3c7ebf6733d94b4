//! One wave of displacement and traction inside one homogeneous layer.
//!
//! The state `v = (U, V, τ, σ)` (see [`minors`](crate::response::minors): tractions in units of `2 G k`)
//! obeys `dv/dζ = A v`, `ζ = k z`, and since `(A² − 1)² = 0`
//!
//! ```text
//! exp(A t) = cosh t + (A² − 1) (t/2) sinh t + A sinh t + A (A² − 1) (t cosh t − sinh t)/2
//! ```

use crate::response::Poisson;
use nalgebra::{Matrix4, Matrix4x2, RowVector4, Vector4};

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

/// Four independent waves of one layer, none of which grows beyond 1 inside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Basis {
    /// The state at mid-depth: for thin layers, where decaying and growing waves look alike.
    Middle,
    /// Two waves that decay from the top and two that decay from the bottom: for thick layers.
    Faces,
}

/// From this `s = k H` on a layer is thick: the waves of its two faces differ enough, and those of
/// the middle begin to lose digits like `s²`. Both are as good between 1 and 4.
const THICK: f64 = 2.0;

/// The states that the four waves of a layer have at one depth, as columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Waves {
    poisson: Poisson,
    s: f64,
    basis: Basis,
}

impl Waves {
    /// The waves of a layer of `s = k H`.
    pub(crate) fn new(poisson: &Poisson, s: f64) -> Self {
        let basis = if s < THICK {
            Basis::Middle
        } else {
            Basis::Faces
        };
        Self {
            poisson: *poisson,
            s,
            basis,
        }
    }

    /// The four states at `ζ = k z` below the top.
    pub(crate) fn at(&self, zeta: f64) -> Matrix4<f64> {
        match self.basis {
            Basis::Middle => {
                let t = zeta - 0.5 * self.s;
                propagator(&self.poisson, t) * (t.abs() - 0.5 * self.s).exp()
            }
            Basis::Faces => self.faces(zeta),
        }
    }

    fn faces(&self, zeta: f64) -> Matrix4<f64> {
        let down = decaying(&self.poisson, zeta);
        let up = decaying(&self.poisson, self.s - zeta);
        // The mirror image z → −z changes the signs of V and τ.
        let mirror = Matrix4::from_diagonal(&Vector4::new(1.0, -1.0, -1.0, 1.0));
        let up = mirror * up;
        Matrix4::from_columns(&[down.column(0), down.column(1), up.column(0), up.column(1)])
    }
}

/// The two waves that decay downward, at `ζ`: `e^{−ζ} [1 + ζ (A + 1)]` on the states that a half-space
/// allows, `p τ = −(g U + q V)`, `p σ = −(q U + f V)`.
pub(crate) fn decaying(poisson: &Poisson, zeta: f64) -> Matrix4x2<f64> {
    let &Poisson { a, b, w, .. } = poisson;
    #[rustfmt::skip]
    let allowed = Matrix4x2::new(
        a,   0.0,
        0.0, a,
        -w, -b,
        -b, -w,
    );
    let slope = generator(poisson) + Matrix4::identity();
    // For ζ beyond 745 the exponential is 0 and ζ could be infinite.
    let decay = (-zeta).exp();
    if decay == 0.0 {
        return Matrix4x2::zeros();
    }
    (allowed + slope * allowed * zeta) * decay
}

/// The wave inside one layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerWave {
    waves: Waves,
    amplitudes: Vector4<f64>,
}

/// The four equations of one layer: loads on its top, what holds its bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerEquations {
    waves: Waves,
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
        let waves = Waves::new(poisson, s);
        let (on_top, on_bottom) = (waves.at(0.0), waves.at(s));
        let rows = [
            on_top.row(TAU).into_owned(),
            on_top.row(SIGMA).into_owned(),
            bottom[0] * on_bottom,
            bottom[1] * on_bottom,
        ];
        Self {
            waves,
            matrix: Matrix4::from_rows(&rows),
            load: Vector4::new(tractions[0], tractions[1], 0.0, 0.0),
        }
    }

    /// Solves by LU with partial pivoting; `None` if a pivot vanishes.
    pub(crate) fn solve(&self) -> Option<LayerWave> {
        Some(LayerWave {
            waves: self.waves,
            amplitudes: self.matrix.lu().solve(&self.load)?,
        })
    }
}

impl LayerWave {
    /// The state at `ζ = k z` below the top of the layer.
    pub(crate) fn at(&self, zeta: f64) -> Vector4<f64> {
        self.waves.at(zeta) * self.amplitudes
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

    #[test]
    fn the_waves_of_the_faces_are_carried_by_the_propagator() {
        let poisson = Poisson::new(Material::new(1.0, 0.37).unwrap());
        let waves = Waves::new(&poisson, 2.5);
        let step = propagator(&poisson, 0.7) * 0.7_f64.exp();
        // e^{0.7} magnifies a few roundings.
        assert!((step * waves.at(1.0) - waves.at(1.7)).norm() < 1e-14);
    }
}
