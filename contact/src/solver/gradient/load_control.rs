//! The two kinds of load control: a prescribed total of the pressure, or a prescribed penetration.

use std::ops::Range;

use crate::{
    DiscreteProblem, Load,
    vector::{each, stretches::Stretches, sum},
};

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

    /// Scales a pressure ≥ 0 to the prescribed total.
    pub fn rescale(self, pressure: &mut [f64]) {
        if let Self::Total(total) = self {
            let factor = total / sum(pressure);
            each(pressure, |p| *p *= factor);
        }
    }

    /// The energy `½ p·(v + g0)`, less `D Σ p` where the penetration is prescribed, of a pressure on some stretches.
    pub fn energy(self, on: &Stretches, pressure: &[f64], [v, initial_gap]: [&[f64]; 2]) -> f64 {
        let terms = |range: &Range<usize>| {
            let fields = pressure[range.clone()].iter().zip(&v[range.clone()]);
            let terms = fields.zip(&initial_gap[range.clone()]);
            terms.map(|((p, v), g0)| p * (v + g0))
        };
        let parts = on.by_parts(|ranges| ranges.iter().flat_map(terms).sum::<f64>() / 2.0);
        let stored: f64 = parts.iter().sum();
        match self {
            Self::Total(_) => stored,
            Self::Penetration(penetration) => stored - penetration * on.sum(pressure),
        }
    }

    /// The slope `s·∂E` of the energy along a step on some stretches that satisfies the load control.
    pub fn slope(self, on: &Stretches, step: &[f64], v: &[f64]) -> f64 {
        match self {
            Self::Total(_) => on.dot(step, v),
            Self::Penetration(penetration) => on.dot(step, v) - penetration * on.sum(step),
        }
    }
}
