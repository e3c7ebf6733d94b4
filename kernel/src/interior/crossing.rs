//! The state from the bottom of a layer to the top of the body below, without loss of digits.
//!
//! The body below a plane allows a two-dimensional set of states, so two components determine the others through the
//! [minors](crate::response::Minors): `(XY) Z = (ZY) X + (XZ) Y`. Of the four pairs that do not vanish in general, the
//! one with the largest minor magnifies no error. The components below an interface follow in this way directly from
//! those above it, in the units of the body above, without the subtraction of a spring's jump.

use crate::response::{BottomSupport, ComplianceShare, Minors};
use crate::wave::{SIGMA, TAU, TopPair, U, V};
use nalgebra::Vector4;

/// The two components with the largest minor.
pub(super) fn best_pair(minors: &Minors) -> TopPair {
    let &Minors { p, f, g, d, .. } = minors;
    let pairs = [
        (p, [U, V]),
        (f, [U, SIGMA]),
        (g, [V, TAU]),
        (d, [TAU, SIGMA]),
    ];
    let (_, pair) = pairs.into_iter().fold((0.0, [TAU, SIGMA]), |best, next| {
        if next.0 > best.0 { next } else { best }
    });
    TopPair(pair)
}

/// The state below the interface, in the units of the body above it.
pub(super) fn cross(support: &BottomSupport, state: &Vector4<f64>) -> Vector4<f64> {
    let Minors { p, q, f, g, d } = support.minors;
    let mixed = Mixed::new(support);
    let [u, v, tau, sigma] = [U, V, TAU, SIGMA].map(|i| state[i]);
    match best_pair(&support.minors).0 {
        [U, V] => {
            Vector4::new(
                mixed.uv * u - mixed.uu * v,
                mixed.vu * v - mixed.vv * u,
                -(g * u + q * v),
                -(q * u + f * v),
            ) / p
        }
        [U, SIGMA] => {
            Vector4::new(
                mixed.f * u + mixed.uu * sigma,
                -(q * u + mixed.vu * sigma),
                q * sigma - d * u,
                f * sigma,
            ) / f
        }
        [V, TAU] => {
            Vector4::new(
                -(q * v + mixed.uv * tau),
                mixed.g * v + mixed.vv * tau,
                g * tau,
                q * tau - d * v,
            ) / g
        }
        _ => {
            Vector4::new(
                q * sigma - mixed.f * tau,
                q * tau - mixed.g * sigma,
                d * tau,
                d * sigma,
            ) / d
        }
    }
}

/// Minors of a displacement above a spring with another component below it.
struct Mixed {
    /// `(U V')`, prime above
    uv: f64,
    /// `(U' V)`
    vu: f64,
    /// `−(U' U)`
    uu: f64,
    /// `(V' V)`
    vv: f64,
    /// `−(U σ)`
    f: f64,
    /// `(V τ)`
    g: f64,
}

impl Mixed {
    fn new(support: &BottomSupport) -> Self {
        let Minors { p, q, f, g, .. } = support.below;
        let ComplianceShare { held: s1, free: s2 } = support.spring.shear;
        let ComplianceShare { held: n1, free: n2 } = support.spring.normal;
        Self {
            uv: s1 * (n1 * p + n2 * f),
            vu: n1 * (s1 * p + s2 * g),
            uu: s2 * n1 * q,
            vv: s1 * n2 * q,
            f: s1 * n1 * f,
            g: s1 * n1 * g,
        }
    }
}
