//! One wave of displacement and traction inside one homogeneous layer.
//!
//! The state `v = (U, V, τ, σ)` (see [`minors`](crate::response::minors): tractions in units of `2 G k`)
//! obeys `dv/dζ = A v`, `ζ = k z`, and since `(A² − 1)² = 0`
//!
//! ```text
//! exp(A t) = cosh t + (A² − 1) (t/2) sinh t + A sinh t + A (A² − 1) (t cosh t − sinh t)/2
//! (A² − 1) v = (P, −Q, Q, −P)      P = (U + σ)/(1 − ν), Q = (V + τ)/(1 − ν)
//! ```

use crate::material::Poisson;
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

/// `t cosh t − sinh t`; for small `t` the series `2 Σ n t^{2n+1} / (2n+1)!`.
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
    sum
}

/// Four independent waves of one layer, none of which grows much inside it.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Basis {
    /// The state at mid-depth: for thin layers, where decaying and growing waves look alike.
    Middle,
    /// Two waves that decay from the top and two that decay from the bottom: for thick layers.
    Faces,
}

/// A layer is thick from this `s = k H` on: the waves of its two faces differ enough, and those of the middle begin to
/// lose digits like `s²`. Both are equally accurate between 1 and 4.
const THICK: f64 = 2.0;

impl Basis {
    fn of(s: f64) -> Self {
        if s < THICK { Self::Middle } else { Self::Faces }
    }
}

/// A place inside a layer: `k` times its distances from top and bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlaceInLayer {
    pub(crate) below_top: f64,
    pub(crate) above_bottom: f64,
}

impl PlaceInLayer {
    /// On the top of a layer of `s = k H`.
    pub(crate) fn top(s: f64) -> Self {
        Self {
            below_top: 0.0,
            above_bottom: s,
        }
    }

    /// On the bottom of a layer of `s = k H`.
    pub(crate) fn bottom(s: f64) -> Self {
        Self {
            below_top: s,
            above_bottom: 0.0,
        }
    }
}

/// The functions of depth whose sums are a layer's waves, at one place.
///
/// In thin layers, with `t` from mid-depth: `cosh t`, `t sinh t`, `sinh t`, `t cosh t − sinh t`. In thick ones:
/// `e^{−ζ}`, `ζ e^{−ζ}` from the top and from the bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DepthFactors([f64; 4]);

impl DepthFactors {
    /// In a layer of `s = k H`.
    pub(crate) fn new(s: f64, place: &PlaceInLayer) -> Self {
        match Basis::of(s) {
            Basis::Middle => {
                let t = 0.5 * (place.below_top - place.above_bottom);
                let (cosh, sinh) = (t.cosh(), t.sinh());
                Self([cosh, t * sinh, sinh, difference(t, cosh, sinh)])
            }
            Basis::Faces => {
                let ([down, down_t], [up, up_t]) =
                    (decayed(place.below_top), decayed(place.above_bottom));
                Self([down, down_t, up, up_t])
            }
        }
    }
}

/// `e^{−ζ}` and `ζ e^{−ζ}`; 0 below the smallest number, and for infinite `ζ`.
pub(crate) fn decayed(zeta: f64) -> [f64; 2] {
    let decay = (-zeta).exp();
    if decay == 0.0 {
        return [0.0, 0.0];
    }
    [decay, zeta * decay]
}

/// The wave inside one layer: the state is `Σ cᵢ` times the functions of [`DepthFactors`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerWave([Vector4<f64>; 4]);

impl LayerWave {
    pub(crate) const NONE: Self = Self([Vector4::new(0.0, 0.0, 0.0, 0.0); 4]);

    /// From the amplitudes of the four waves of [`Basis`].
    fn new(poisson: &Poisson, basis: Basis, amplitudes: &Vector4<f64>) -> Self {
        match basis {
            Basis::Middle => {
                // (A² − 1) v/2 = (p, −q, q, −p) and A (A² − 1) v/2 = (q, −p, p, −q)
                let p = poisson.x * (amplitudes[U] + amplitudes[SIGMA]);
                let q = poisson.x * (amplitudes[V] + amplitudes[TAU]);
                let straight = Vector4::new(p, -q, q, -p);
                let slope = generator(poisson) * amplitudes;
                Self([*amplitudes, straight, slope, Vector4::new(q, -p, p, -q)])
            }
            Basis::Faces => {
                let [down0, down1, up0, up1] = [0, 1, 2, 3].map(|i| amplitudes[i]);
                let [down, down_slope] = decaying(poisson, [down0, down1]);
                let [up, up_slope] = decaying(poisson, [up0, up1]).map(mirrored);
                Self([down, down_slope, up, up_slope])
            }
        }
    }

    /// The state at a place.
    pub(crate) fn at(&self, &DepthFactors([f0, f1, f2, f3]): &DepthFactors) -> Vector4<f64> {
        let [c0, c1, c2, c3] = &self.0;
        c0 * f0 + c1 * f1 + c2 * f2 + c3 * f3
    }
}

/// The mirror image `z → −z`: it changes the signs of `V` and `τ`.
fn mirrored(state: Vector4<f64>) -> Vector4<f64> {
    Vector4::new(state[U], -state[V], -state[TAU], state[SIGMA])
}

/// A wave that decays downward as `v₀` and `v₁` in `e^{−ζ} (v₀ + ζ v₁)`, from its displacements on top over
/// `a = 3 − 4ν`: `v₀` is a state of a half-space, `a τ = −(w U + b V)`, `a σ = −(b U + w V)`, and `v₁ = (A + 1) v₀`.
fn decaying(poisson: &Poisson, [u, v]: [f64; 2]) -> [Vector4<f64>; 2] {
    let &Poisson { a, b, w, .. } = poisson;
    let top = Vector4::new(a * u, a * v, -(w * u + b * v), -(b * u + w * v));
    [top, slope(v - u)]
}

/// `(A + 1) v` for a state `v` of a half-space, from `τ − σ = (V − U)/a`.
pub(crate) fn slope(difference: f64) -> Vector4<f64> {
    Vector4::new(1.0, 1.0, -1.0, -1.0) * difference
}

/// The two conditions on the top of a layer: which two components of its state are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TopPair(pub(crate) [usize; 2]);

impl TopPair {
    /// Shear and normal traction.
    pub(crate) const TRACTIONS: Self = Self([TAU, SIGMA]);
}

/// The four equations of one layer: two components of the state on its top, two for the support of its bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerEquations {
    poisson: Poisson,
    basis: Basis,
    pub(crate) matrix: Matrix4<f64>,
}

impl LayerEquations {
    /// A layer of `s = k H`, given by two components on its top and two `bottom` equations `row · v`.
    pub(crate) fn new(
        poisson: &Poisson,
        s: f64,
        top: TopPair,
        bottom: [RowVector4<f64>; 2],
    ) -> Self {
        let basis = Basis::of(s);
        let top_profile = DepthFactors::new(s, &PlaceInLayer::top(s));
        let bottom_profile = DepthFactors::new(s, &PlaceInLayer::bottom(s));
        let columns = [0, 1, 2, 3].map(|i| {
            let mut unit = Vector4::zeros();
            unit[i] = 1.0;
            let wave = LayerWave::new(poisson, basis, &unit);
            let (on_top, on_bottom) = (wave.at(&top_profile), wave.at(&bottom_profile));
            let [first, second] = top.0;
            let [third, fourth] = bottom.map(|row| (row * on_bottom)[0]);
            Vector4::new(on_top[first], on_top[second], third, fourth)
        });
        Self {
            poisson: *poisson,
            basis,
            matrix: Matrix4::from_columns(&columns),
        }
    }

    /// Solves for several right-hand sides by LU with partial pivoting; `None` if a pivot vanishes.
    pub(crate) fn solve<const N: usize>(&self, loads: [Vector4<f64>; N]) -> Option<[LayerWave; N]> {
        let factors = self.matrix.lu();
        let mut waves = [LayerWave::NONE; N];
        for (wave, load) in waves.iter_mut().zip(&loads) {
            let mut amplitudes = factors.solve(load)?;
            // One step of refinement reduces the error of every component to a few roundings of the equations, however
            // different their sizes are (Skeel 1980).
            amplitudes += factors.solve(&(load - self.matrix * amplitudes))?;
            *wave = LayerWave::new(&self.poisson, self.basis, &amplitudes);
        }
        Some(waves)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;

    fn poisson(nu: f64) -> Poisson {
        Poisson::new(Material::new(1.0, nu).unwrap())
    }

    /// `exp(A t)` from the closed form of the module.
    fn propagator(poisson: &Poisson, t: f64) -> Matrix4<f64> {
        let a = generator(poisson);
        let nilpotent = a * a - Matrix4::identity();
        let (cosh, sinh) = (t.cosh(), t.sinh());
        Matrix4::identity() * cosh
            + nilpotent * (0.5 * t * sinh)
            + a * sinh
            + a * nilpotent * (0.5 * difference(t, cosh, sinh))
    }

    #[test]
    fn propagation_there_and_back_is_the_identity() {
        for t in [1e-6, 0.3, 0.999, 1.0, 2.0] {
            let product = propagator(&poisson(0.37), t) * propagator(&poisson(0.37), -t);
            // e^{2t} ≤ 55 magnifies the roundings of entries of order 1.
            assert!((product - Matrix4::identity()).norm() < 1e-13, "{t}");
        }
    }

    #[test]
    fn the_square_of_the_generator_minus_the_identity_is_nilpotent() {
        for nu in [0.0, 0.2, 0.5] {
            let a = generator(&poisson(nu));
            let nilpotent = a * a - Matrix4::identity();
            assert!((nilpotent * nilpotent).norm() < 1e-14);
        }
    }

    #[test]
    fn the_propagator_carries_the_waves_of_thin_and_thick_layers() {
        for s in [0.8, 2.5] {
            let poisson = poisson(0.37);
            let amplitudes = Vector4::new(0.3, -1.0, 0.7, 0.2);
            let wave = LayerWave::new(&poisson, Basis::of(s), &amplitudes);
            let at = |zeta: f64| {
                let place = PlaceInLayer {
                    below_top: zeta,
                    above_bottom: s - zeta,
                };
                wave.at(&DepthFactors::new(s, &place))
            };
            // e^{0.7} magnifies a few roundings.
            let carried = propagator(&poisson, 0.7) * at(0.1);
            assert!((carried - at(0.8)).norm() < 1e-14);
        }
    }
}
