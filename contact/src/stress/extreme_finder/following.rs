//! The peak of a stress followed from one load to another.

use pellicle_influence::{Depth, RoughDepths};

use super::judgement::BESIDE_EDGE;
use super::{ExtremeFinder, depth_in};
use crate::ContactError;
use crate::stress::MOST_MOVES;
use crate::stress::edge_extreme::{Wanted, edge_extreme, is_near_edge};
use crate::stress::extreme::Extreme;
use crate::stress::peak_search::{PeakSearch, StressPeak};
use crate::stress::plane_scan::Target;
use crate::stress::quantity::StressQuantity;

/// Factor between the three depths around a peak that is followed from another load, so narrow that a parabola places
/// the peak to half a percent and finds its value to 1e-5.
const FOLLOWED_RATIO: f64 = 1.12;

impl ExtremeFinder<'_> {
    /// The largest value of the first quantity of a target near a place that is expected from another load, to 1e-5 and
    /// without its error; a tension of the topmost body is also sought at the contact's edge.
    pub fn follow(
        &self,
        rough: &mut RoughDepths,
        target: &Target,
        expected: [f64; 3],
    ) -> Result<Option<Extreme<3>>, ContactError> {
        let loaded = self.field.loaded().size;
        let Some(quantity) = target.quantities.first().filter(|_| loaded > 0) else {
            return Ok(None);
        };
        let ([x, y, z], is_tension) = (expected, *quantity == StressQuantity::MaxPrincipal);
        let may_be_at_edge = target.top == 0.0 && is_tension;
        let is_at_edge =
            z < self.field.grid().element_side() && is_near_edge(&self.field, [x, y], BESIDE_EDGE);
        let from = is_at_edge.then_some([x, y]);
        if may_be_at_edge && is_at_edge {
            let at_edge = edge_extreme(self.path, self.step, &self.field, Wanted::Value(from))?;
            // What is sampled beside a resolved edge does not count.
            if let Some(edge) = at_edge.filter(|edge| edge.resolved) {
                return Ok(Some(edge));
            }
        }
        let followed = self.followed_from(rough, (target, *quantity), expected)?;
        match followed.map(without_error) {
            Some(sampled) if may_be_at_edge => {
                self.or_at_edge(sampled, Wanted::Value(from)).map(Some)
            }
            sampled => Ok(sampled),
        }
    }

    /// The peak near an expected place; none if it is not found after some moves.
    fn followed_from(
        &self,
        rough: &mut RoughDepths,
        (target, quantity): (&Target, StressQuantity),
        [x, y, z]: [f64; 3],
    ) -> Result<Option<StressPeak>, ContactError> {
        let (element, loaded) = (self.field.grid().element_side(), self.field.loaded().size);
        rough.forget();
        let depths = target.depths(loaded as f64 * element, element);
        let [low, high] = [depths[0].z, depths[depths.len() - 1].z];
        let mut search = PeakSearch::new(&self.field);
        let (mut at, mut z) = ([x, y], z.clamp(low, high));
        for _ in 0..MOST_MOVES {
            if z < element {
                let depth = depth_in(&depths, z);
                return Ok(Some(search.climb(rough, quantity, (at, depth))?));
            }
            let around = if z <= low || z >= high {
                vec![z]
            } else {
                let [before, after] = [z / FOLLOWED_RATIO, z * FOLLOWED_RATIO];
                vec![before.max(low), z, after.min(high)]
            };
            let middle = around.len() / 2;
            let within: Vec<Depth> = around.iter().map(|z| depth_in(&depths, *z)).collect();
            let start = (at, z);
            let (peak, _) = search.between(rough, quantity, start, (&within, middle))?;
            let [x, y, found] = peak.at;
            (at, z) = ([x, y], found);
            let [first, last] = [around[0], around[around.len() - 1]];
            let leaves = around.len() > 1
                && ((found <= first && first > low) || (found >= last && last < high));
            if !leaves {
                let state = search.state(rough, at, depth_in(&depths, z))?;
                let value = quantity.of(&state);
                return Ok(Some(StressPeak { value, ..peak }));
            }
        }
        Ok(None)
    }
}

/// An extreme whose error is not known.
fn without_error(StressPeak { value, at }: StressPeak) -> Extreme<3> {
    Extreme {
        value,
        at,
        resolved: false,
        estimate: None,
    }
}
