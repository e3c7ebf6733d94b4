//! Parts of a support: a contact is solved on a part that holds it, and judged on all elements.

use std::sync::Arc;

use super::Support;
use crate::grid::{candidates::Candidates, region::Region};

/// A support with parts of the same body. By default it has none.
pub trait Divisible: Support {
    /// The same body under a region of the grid; none if there is no operator for it.
    fn part(&self, _: &Region) -> Option<Box<dyn Divisible>> {
        None
    }

    /// Whether it can be restricted to candidates.
    fn takes_candidates(&self) -> bool {
        false
    }

    /// The same body under the candidates of a region, with products accurate to about 1e-9; none if there is no
    /// operator for them or the region too small.
    fn among(&self, _: &Region, _: &Arc<Candidates>) -> Option<Box<dyn Divisible>> {
        None
    }

    /// Writes `K p` on a `reach` around a part of the region, for a pressure on that part that is 0 outside.
    fn apply_around(
        &mut self,
        _part_and_reach: [&Region; 2],
        pressure: &[f64],
        displacement: &mut [f64],
    ) {
        self.apply_into(pressure, displacement);
    }

    /// Writes `K p` among other elements of the region, given by ascending indices; returns false if only its own
    /// elements can press.
    fn apply_among(&mut self, _: &[u32], _pressure: &[f64], _displacement: &mut [f64]) -> bool {
        false
    }

    /// Exchanges its candidates for others of the same region; returns false if it has none.
    fn list(&mut self, _: &Arc<Candidates>) -> bool {
        false
    }

    /// Frees the memory of operators that can be rebuilt.
    fn release(&mut self) {}
}
