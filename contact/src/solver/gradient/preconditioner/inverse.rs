//! The kinds of approximate inverses.

use crate::solver::gradient::{
    preconditioner::{
        restricted_filter::RestrictedFilter,
        sparse_factor::{SparseFactor, scattered::ScatteredFactor},
    },
    working_set::WorkingSet,
};

/// An approximate inverse of the system on a set.
pub enum Inverse {
    /// The identity on the working set in the units of the problem's scale, if the operator is unknown.
    Identity,
    Filter(Box<RestrictedFilter>),
    Factor(Box<SparseFactor>),
    /// The factor among candidates.
    Scattered(Box<ScatteredFactor>),
}

impl Inverse {
    /// `r ← M⁻¹_I r` times `unit`, for an `r` that is 0 outside the stretches of the set; its other values outside the
    /// set are ignored.
    pub fn apply(&mut self, set: &WorkingSet, unit: f64, residual: &mut [f64]) {
        set.scale_within(residual, unit);
        match self {
            Self::Identity => (),
            Self::Filter(filter) => filter.apply(set, residual),
            Self::Factor(factor) => factor.apply(residual),
            Self::Scattered(factor) => factor.apply(residual),
        }
    }
}
