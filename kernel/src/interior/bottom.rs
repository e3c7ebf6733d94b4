//! Two equations for the support of the bottom of a layer.
//!
//! The states that the minors allow satisfy
//!
//! ```text
//! q U + f V + p σ = 0     d U + f τ − q σ = 0     g U + q V + p τ = 0     d V + g σ − q τ = 0
//! ```
//!
//! of which two are independent. Those with the largest minor are used, as they magnify no error.

use super::crossing::best_pair;
use crate::material::Poisson;
use crate::response::contrast::Contrast;
use crate::response::{BottomSupport, Minors};
use crate::wave::{U, V};
use nalgebra::RowVector4;

/// One of the four equations.
#[derive(Debug, Clone, Copy)]
enum Equation {
    /// `q U + f V + p σ = 0`
    Normal,
    /// `d U + f τ − q σ = 0`
    Along,
    /// `g U + q V + p τ = 0`
    Shear,
    /// `d V + g σ − q τ = 0`
    Down,
}

/// The two equations that give the other components from the pair with the largest minor, or from `U` and `σ` if theirs
/// is not much smaller: these keep more digits of a thin layer's membrane stress.
fn equations(minors: &Minors) -> [Equation; 2] {
    let &Minors { p, f, g, d, .. } = minors;
    if f >= NEARLY_LARGEST * p.max(g).max(d) {
        return [Equation::Normal, Equation::Along];
    }
    match best_pair(minors).0 {
        [U, _] => [Equation::Shear, Equation::Normal],
        [V, _] => [Equation::Shear, Equation::Down],
        _ => [Equation::Along, Equation::Down],
    }
}

/// Fraction of the largest minor. Before solutions were refined, errors at 4000 random places were the same from 1e-4
/// to 0.1 and seven times as large at 1.
const NEARLY_LARGEST: f64 = 0.1;

/// The two equations as rows, `row · v = 0`.
pub(super) fn rows(minors: &Minors) -> [RowVector4<f64>; 2] {
    equations(minors).map(|equation| equation.row(minors) / equation.size(minors))
}

/// [`rows`] for states of a half-space of the layer's material, without the part that vanishes for them.
///
/// The equations are linear in the minors and hold for such a state with the minors of the half-space, so only the
/// deviation from those minors is left.
pub(super) fn rows_of_half_space(
    support: &BottomSupport,
    poisson: &Poisson,
    layers: usize,
) -> [RowVector4<f64>; 2] {
    let deviation = deviation(&support.minors, &support.contrast, poisson, layers);
    equations(&support.minors)
        .map(|equation| equation.row(&deviation) / equation.size(&support.minors))
}

impl Equation {
    fn row(self, &Minors { p, q, f, g, d }: &Minors) -> RowVector4<f64> {
        match self {
            Self::Normal => RowVector4::new(q, f, 0.0, p),
            Self::Along => RowVector4::new(d, 0.0, f, -q),
            Self::Shear => RowVector4::new(g, q, p, 0.0),
            Self::Down => RowVector4::new(0.0, d, -q, g),
        }
    }

    /// The largest coefficient of the row.
    fn size(self, minors: &Minors) -> f64 {
        self.row(minors).amax()
    }
}

/// The minors minus `d` times those of a half-space, from the contrast, or by subtraction where that is more accurate.
fn deviation(minors: &Minors, contrast: &Contrast, poisson: &Poisson, layers: usize) -> Minors {
    let &Minors { p, q, f, g, d } = minors;
    let &Poisson { a, b, w, x, .. } = poisson;
    let &Contrast { c1, c2, c3, c4 } = contrast;
    let judged = |contrast, plain, size| Contrast::judged(contrast, plain, size, layers);
    Minors {
        p: judged(c1 + 2.0 * c4 + c3 - c2, p - a * d, p + a * d),
        q: judged(c4 + 0.5 * (c3 - c2), q - b * d, q.abs() + b * d),
        f: judged(c4 + x * c1 - c2, f - w * d, f + w * d),
        g: judged(c4, g - w * d, g + w * d),
        d: 0.0,
    }
}
