//! The solution of one load with its numbers, and its status.

use pellicle_texture::Grid;
use serde::{Deserialize, Serialize};

use crate::{
    ContactSlope, GridError, LimitRatio, RoughContact, Solution, Summary, Work,
    result::{cut_off::CutOff, step_wear::StepWear},
};

/// The solution of one load. It is converged if its certificate is satisfied.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The pressure and its certificate.
    pub solution: Solution,
    /// The numbers that describe it.
    pub summary: Summary,
    /// The work.
    pub work: Work,
    /// The discretisation error.
    pub grid_error: GridError,
    /// Largest line of the certificate at each iteration on the finest grid, by the iteration's own residual.
    pub residuals: Vec<f64>,
    /// Contact stiffness `dQ/dD`, in N/m; none without contact, or if it was not requested or not found.
    pub contact_stiffness: Option<f64>,
    /// Islands, gaps and pressures if a measured map takes part; none otherwise or without contact.
    pub rough: Option<RoughContact>,
    /// The limit that cuts off the contact, if any; the step then solves a different problem from the one posed.
    pub cut_off: Option<CutOff>,
    /// The slope of the surfaces in contact; none without contact.
    pub slope: Option<ContactSlope>,
    /// Numbers over the limits from which linear elasticity cannot hold, at most one of each kind.
    pub limits: Vec<LimitRatio>,
    /// The pressures of the next coarser grids, coarsest first; empty unless
    /// [requested](crate::SolverOptions::coarse_pressures).
    pub coarser: Vec<CoarsePressure>,
    /// The wear up to here; none without wear.
    pub wear: Option<StepWear>,
}

/// The pressure under a load on a grid coarser than the finest.
#[derive(Debug, Clone, PartialEq)]
pub struct CoarsePressure {
    /// The grid.
    pub grid: Grid,
    /// N² values, in Pa.
    pub pressure: Vec<f64>,
}

impl Step {
    /// The number farthest beyond its limit; none if the model may hold.
    #[must_use]
    pub fn beyond(&self) -> Option<LimitRatio> {
        let beyond = self.limits.iter().copied().filter(LimitRatio::is_beyond);
        beyond.max_by(|one, other| one.ratio.total_cmp(&other.ratio))
    }

    /// The status of the step.
    #[must_use]
    pub fn status(&self) -> Status {
        let on_the_way = self.wear.as_ref().is_none_or(|wear| wear.is_certified);
        if !self.solution.certificate.is_satisfied() || !on_the_way {
            Status::NotConverged
        } else if self.beyond().is_some() {
            Status::BeyondModel
        } else if self.cut_off.is_some() {
            Status::CutOff
        } else {
            Status::Certified
        }
    }
}

/// How a result may be used, from good to bad.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Its certificate is satisfied, and it solves the problem posed.
    #[default]
    Certified,
    /// Its certificate is satisfied, but the contact would continue beyond the domain or a map: it solves a different
    /// problem.
    CutOff,
    /// Its certificate is satisfied, but a [number](LimitRatio) is impossible: the equations of linear elasticity are
    /// solved, but they do not describe such a contact.
    BeyondModel,
    /// Its certificate is not satisfied.
    NotConverged,
}

impl Status {
    /// Returns a stable word for programs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Certified => "certified",
            Self::CutOff => "cut-off",
            Self::BeyondModel => "beyond-model",
            Self::NotConverged => "not-converged",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statuses_are_stored_by_their_words_and_ordered_from_good_to_bad() {
        let all = [
            Status::Certified,
            Status::CutOff,
            Status::BeyondModel,
            Status::NotConverged,
        ];
        let words = all.map(|status| serde_json::to_string(&status).unwrap());
        assert_eq!(words, all.map(|status| format!("\"{}\"", status.word())));
        assert!(all.is_sorted() && all[0] == Status::default());
    }
}
