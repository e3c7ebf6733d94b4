//! The two kinds of load control: a prescribed total of the pressure, or a prescribed penetration.

use crate::vector::{by_parts, dot, each, sum};
use crate::{DiscreteProblem, Load};

/// The prescribed quantity in the solver's terms and the units of the problem's scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadControl {
    /// `Σ p = Q/(4a²)`.
    Total(f64),
    /// The penetration `D`.
    Penetration(f64),
}

impl LoadControl {
    /// The load control for a load on a problem.
    pub fn of(problem: &DiscreteProblem, load: Load) -> Self {
        let scale = problem.scale();
        match load {
            Load::Force(force) => Self::Total(force / problem.loaded_area() / scale.pressure()),
            Load::Penetration(penetration) => Self::Penetration(penetration / scale.length),
        }
    }

    /// `D = Σ p v / Σ p`, the multiplier of the total; or the penetration itself.
    pub fn penetration(self, pressure: &[f64], v: &[f64]) -> f64 {
        match self {
            Self::Total(_) => dot(pressure, v) / sum(pressure),
            Self::Penetration(penetration) => penetration,
        }
    }

    /// Scales a pressure ≥ 0 to the prescribed total.
    pub fn rescale(self, pressure: &mut [f64]) {
        if let Self::Total(total) = self {
            let factor = total / sum(pressure);
            each(pressure, |p| *p *= factor);
        }
    }

    /// The energy `½ p·(v + g0)`, less `D Σ p` where the penetration is prescribed.
    pub fn energy(self, pressure: &[f64], v: &[f64], initial_gap: &[f64]) -> f64 {
        let stored: f64 = by_parts(pressure.len(), |part| {
            let fields = pressure[part.clone()].iter().zip(&v[part.clone()]);
            let terms = fields.zip(&initial_gap[part]);
            terms.map(|((p, v), g0)| p * (v + g0)).sum::<f64>() / 2.0
        })
        .iter()
        .sum();
        match self {
            Self::Total(_) => stored,
            Self::Penetration(penetration) => stored - penetration * sum(pressure),
        }
    }

    /// The slope `s·∂E` of the energy along a step that satisfies the load control.
    pub fn slope(self, step: &[f64], v: &[f64]) -> f64 {
        match self {
            Self::Total(_) => dot(step, v),
            Self::Penetration(penetration) => dot(step, v) - penetration * sum(step),
        }
    }
}
