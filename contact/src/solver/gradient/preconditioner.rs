//! The preconditioner: an approximate inverse of the system on the working set.
//!
//! Two of them, for two kinds of problem. `z = R M⁻¹ Rᵀ r` with `M⁻¹ = F⁻¹ 1/(C(k) sinc sinc + η̄) F` on the unpadded periodic grid
//! and `R` the restriction to the working set, over which `η̄` is the mean of `η`: cheap, and good where the surface is as soft as what
//! lies below or softer. (The symbol is the analytic one, which is positive; the padded operator's own spectrum is not where a coat is
//! stiff, and must not be inverted.) Under a stiff coat the restriction spoils that inverse at every edge of the contact, and a
//! factorised sparse approximate inverse of the restricted system itself takes its place.

use pellicle_influence::PeriodicSymbol;

use super::{
    control::Control, iterate::State, periodic_filter::PeriodicFilter, sparse_factor::SparseFactor,
    working_set::WorkingSet,
};
use crate::{
    DiscreteProblem,
    vector::{sum, update, update_with},
};

/// Response to the longest wave over that to the shortest from which on a coat counts as stiff. Both preconditioners are
/// equally good on a homogeneous body, 1; under a coat ten times as stiff as what it lies on, 2 to 10, the factor takes half the products.
const STIFF: f64 = 1.5;
/// Neighbours of an element in the sparse factor: with 12 a fifth more products, with 30 a tenth fewer, at three times the cost.
const NEIGHBOURS: usize = 20;
/// Sides below which no spectrum tells stiff from soft.
const SMALLEST_SPECTRUM: usize = 8;

/// An approximate inverse and its answer to an even residual.
pub struct Preconditioner {
    inverse: Inverse,
    relief_compliance: Vec<f64>,
    /// `w = M⁻¹_I 1`.
    even: Vec<f64>,
    even_total: f64,
    is_current: bool,
}

enum Inverse {
    /// The identity on the working set, where nothing is known of the operator.
    Identity,
    Filter {
        filter: PeriodicFilter,
        largest_multiplier: f64,
    },
    Factor(SparseFactor),
}

impl Preconditioner {
    pub fn new(problem: &DiscreteProblem) -> Self {
        let inverse = match problem.elasticity() {
            None => Inverse::Identity,
            Some(elasticity) => {
                let symbol = elasticity.symbol(problem.size());
                if is_stiff(&symbol) {
                    factor(problem, NEIGHBOURS).unwrap_or(Inverse::Identity)
                } else {
                    Inverse::Filter {
                        filter: PeriodicFilter::new(symbol),
                        largest_multiplier: 1.0,
                    }
                }
            }
        };
        Self {
            inverse,
            relief_compliance: problem.relief_compliance().to_vec(),
            even: vec![0.0; problem.elements()],
            even_total: 0.0,
            is_current: false,
        }
    }

    /// Turns to the sparse factor, with so many times its usual neighbours; false where nothing is known of the operator.
    pub fn turn_to_factor(&mut self, problem: &DiscreteProblem, times: usize) -> bool {
        match factor(problem, times * NEIGHBOURS) {
            None => false,
            Some(inverse) => {
                if times > 1 || !matches!(self.inverse, Inverse::Factor(_)) {
                    self.inverse = inverse;
                    self.is_current = false;
                }
                true
            }
        }
    }

    /// Must be told when the working set has changed.
    pub fn outdate(&mut self) {
        self.is_current = false;
    }

    fn refresh(&mut self, set: &WorkingSet) {
        if self.is_current {
            return;
        }
        match &mut self.inverse {
            Inverse::Identity => (),
            Inverse::Filter {
                filter,
                largest_multiplier,
            } => {
                let mean = mean_over(set, &self.relief_compliance);
                *largest_multiplier = filter.multiply_by(|symbol| 1.0 / (symbol + mean));
            }
            Inverse::Factor(factor) => factor.update(set),
        }
        let mut even = std::mem::take(&mut self.even);
        even.fill(1.0);
        self.apply(set, &mut even);
        self.even_total = sum(&even);
        self.even = even;
        self.is_current = true;
    }

    /// `r ← M⁻¹_I r`, in place; the values of `r` outside the set do not matter.
    pub fn apply(&mut self, set: &WorkingSet, residual: &mut [f64]) {
        clear_outside(set, residual);
        match &mut self.inverse {
            Inverse::Identity => (),
            Inverse::Filter {
                filter,
                largest_multiplier,
            } => {
                filter.apply(residual, *largest_multiplier);
                clear_outside(set, residual);
            }
            Inverse::Factor(factor) => factor.apply(residual),
        }
    }

    /// Writes into `z` the preconditioned residual `M⁻¹_I (D − v)`, with `D` such that `z` keeps the total where one
    /// is prescribed: the projection `z ← z − (Σz/Σw) w` in the preconditioner's own inner product.
    pub fn direction_into(&mut self, state: &State, set: &WorkingSet, z: &mut [f64]) {
        self.refresh(set);
        update(z, &state.v, |z, v| *z = state.penetration - v);
        self.apply(set, z);
        if let Control::Total(_) = state.control {
            let shift = sum(z) / self.even_total;
            update(z, &self.even, |z, w| *z -= shift * w);
        }
    }
}

fn factor(problem: &DiscreteProblem, neighbours: usize) -> Option<Inverse> {
    let elasticity = problem.elasticity()?.clone();
    let (size, compliance) = (problem.size(), problem.relief_compliance());
    Some(Inverse::Factor(SparseFactor::new(
        elasticity, size, compliance, neighbours,
    )))
}

/// Whether long waves meet a much softer body than short ones do.
fn is_stiff(symbol: &PeriodicSymbol) -> bool {
    let shortest = symbol.size() / 2;
    // C(k) sinc(k_y a): Φ ∝ k C, and the sinc of the shortest wave is 2/π.
    let response = |frequency: usize| frequency as f64 * symbol.value([0, frequency]);
    let sinc = std::f64::consts::FRAC_2_PI;
    symbol.size() >= SMALLEST_SPECTRUM && response(1) * sinc > STIFF * response(shortest)
}

/// The mean of a field over the set; 0 for an empty one.
fn mean_over(set: &WorkingSet, field: &[f64]) -> f64 {
    let members = field.iter().zip(set.mask()).filter(|(_, member)| **member);
    members.map(|(value, _)| value).sum::<f64>() / set.len().max(1) as f64
}

/// Sets `z` to 0 outside the set.
fn clear_outside(set: &WorkingSet, z: &mut [f64]) {
    update(z, set.mask(), |z, member| {
        if !member {
            *z = 0.0;
        }
    });
}

/// `r = D − v` on the set, 0 outside.
pub fn residual_into(state: &State, set: &WorkingSet, residual: &mut [f64]) {
    update_with(residual, &state.v, set.mask(), |r, v, member| {
        *r = if *member { state.penetration - v } else { 0.0 };
    });
}
