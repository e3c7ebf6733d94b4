//! Problems on part of a grid: a region of it, or the candidates in one.

use std::sync::Arc;

use super::{DiscreteProblem, Identity};
use crate::{
    grid::{candidates::Candidates, region::Region},
    problem::support::divisible::Divisible,
};

impl DiscreteProblem {
    /// The same problem on a region of the grid; none if there is no operator for it. The pressure outside is zero.
    pub(crate) fn part(&self, region: &Region) -> Option<Self> {
        Some(self.on_part(self.support.part(region)?))
    }

    /// Whether it can be restricted to candidates.
    pub(crate) fn takes_candidates(&self) -> bool {
        self.support.takes_candidates()
    }

    /// The same problem restricted to the candidates of a region, with products accurate to about 1e-9; none if there
    /// is no operator for them or the region too small.
    pub(crate) fn among(&self, region: &Region, candidates: &Arc<Candidates>) -> Option<Self> {
        Some(self.on_part(self.support.among(region, candidates)?))
    }

    /// Moves a problem among candidates of `whole` to others of the same region; returns false if it has none.
    pub(crate) fn move_to(&mut self, candidates: &Arc<Candidates>, whole: &Self) -> bool {
        if !self.support.list(candidates) {
            return false;
        }
        self.springs = whole.springs.on_part(|field| self.support.gather(field));
        self.initial_gap = self.support.gather(&whole.initial_gap);
        (self.held, self.identity) = (None, Identity::default());
        true
    }

    /// The same problem on some of its elements.
    fn on_part(&self, support: Box<dyn Divisible>) -> Self {
        Self {
            springs: self.springs.on_part(|field| support.gather(field)),
            initial_gap: support.gather(&self.initial_gap),
            element_area: self.element_area,
            hardness: self.hardness,
            held: None,
            scale: self.scale,
            support,
            identity: Identity::default(),
        }
    }
}
