//! The preconditioner: the reciprocal of the analytic symbol on the periodic grid, restricted to the working set.
//!
//! `z = R M⁻¹ Rᵀ r` with `M⁻¹ = F⁻¹ 1/(C(k) sinc sinc + η̄) F` on the unpadded N × N grid and `R` the restriction to
//! the working set, over which `η̄` is the mean of `η`. The symbol is the analytic one, which is positive; the
//! padded operator's own spectrum is not where a coat is stiff, and must not be inverted.

use super::{
    super::super::DiscreteProblem, control::Control, iterate::State,
    periodic_filter::PeriodicFilter, vector::sum, working_set::WorkingSet,
};

/// The restricted inverse; without a symbol, the identity on the working set.
pub struct Preconditioner {
    filter: Option<PeriodicFilter>,
    relief_compliance: Vec<f64>,
    /// `w = M⁻¹_I 1`, the answer to an even residual.
    even: Vec<f64>,
    even_is_current: bool,
    mean_compliance: f64,
}

impl Preconditioner {
    pub fn new(problem: &DiscreteProblem) -> Self {
        Self {
            filter: problem.symbol().map(PeriodicFilter::new),
            relief_compliance: problem.relief_compliance().to_vec(),
            even: vec![0.0; problem.elements()],
            even_is_current: false,
            mean_compliance: 0.0,
        }
    }

    /// Must be told when the working set has changed.
    pub fn refresh(&mut self, set: &WorkingSet) {
        if set.stands_still() && self.even_is_current {
            return;
        }
        let members = self
            .relief_compliance
            .iter()
            .zip(set.mask())
            .filter(|(_, member)| **member);
        self.mean_compliance = members.map(|(eta, _)| eta).sum::<f64>() / set.len() as f64;
        let mut even = std::mem::take(&mut self.even);
        even.fill(1.0);
        self.apply(set, &mut even);
        self.even = even;
        self.even_is_current = true;
    }

    /// `r ← M⁻¹_I r`, in place; the values of `r` outside the set do not matter.
    pub fn apply(&mut self, set: &WorkingSet, residual: &mut [f64]) {
        clear_outside(set, residual);
        if let Some(filter) = &mut self.filter {
            let mean = self.mean_compliance;
            filter.apply(residual, |symbol| 1.0 / (symbol + mean));
            clear_outside(set, residual);
        }
    }

    /// Writes into `z` the preconditioned residual `M⁻¹_I (D − v)`, with `D` such that `z` keeps the total where one
    /// is prescribed: the projection `z ← z − (Σz/Σw) w` in the preconditioner's own inner product.
    pub fn direction_into(&mut self, state: &State, set: &WorkingSet, z: &mut [f64]) {
        self.refresh(set);
        for (z, v) in z.iter_mut().zip(&state.v) {
            *z = state.penetration - v;
        }
        self.apply(set, z);
        if let Control::Total(_) = state.control {
            let shift = sum(z) / sum(&self.even);
            z.iter_mut()
                .zip(&self.even)
                .for_each(|(z, w)| *z -= shift * w);
        }
    }
}

/// Sets `z` to 0 outside the set.
fn clear_outside(set: &WorkingSet, z: &mut [f64]) {
    z.iter_mut()
        .zip(set.mask())
        .filter(|(_, member)| !**member)
        .for_each(|(z, _)| *z = 0.0);
}
