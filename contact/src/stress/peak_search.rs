//! Stresses under one field at and between the centres of elements, or of [blocks](super::pressure_blocks) of them many
//! elements deep, for searches: to 2e-6.
//!
//! The stresses of an element are tabulated once for each depth, and all quantities share the tables.

use std::collections::BTreeMap;
use std::sync::Arc;

use pellicle_influence::{CentreStresses, Depth, InfluenceError, RoughDepths, SubsurfaceState};
use rayon::prelude::*;

use super::field::StressField;
use super::neighbourhood::Neighbourhood;
use super::pressure_blocks::{PressureBlocks, doublings};
use super::quantity::StressQuantity;
use super::residual::ResidualStress;

/// Offsets tabulated beyond those needed initially, in elements.
const SLACK: usize = 8;
/// A climb ends at a distance of one side of the loaded square plus this many depths beside it.
const FARTHEST_DEPTHS: f64 = 4.0;
/// Number of moves after which the stride of a climb doubles, and the longest stride, in elements.
const PATIENCE: usize = 4;
const LONGEST_STRIDE: isize = 16;
/// Tables of up to this many offsets in all are kept, and of larger ones the last: 100 to 250 bytes each.
const KEPT_OFFSETS: usize = 60_000;
/// A field on a coarser grid rises from a plane to its peak between planes by at most this factor.
const MOST_RISE: f64 = 1.2;

/// A largest value and its place.
#[derive(Debug, Clone, Copy)]
pub struct StressPeak {
    /// Value, in Pa.
    pub value: f64,
    /// Place (x, y, z), in m.
    pub at: [f64; 3],
}

/// A search for largest values under one field.
pub struct PeakSearch<'a> {
    field: &'a StressField,
    /// Centres (m) and pressures (Pa) of the loaded elements.
    loaded: Vec<([f64; 2], f64)>,
    blocks: BTreeMap<u32, Arc<PressureBlocks>>,
    /// The plane used last is the last.
    planes: Vec<Plane>,
}

/// The stresses under the centres of blocks at one depth.
struct Plane {
    depth: Depth,
    doublings: u32,
    stresses: CentreStresses,
    /// States by the place of the block, counted from the first.
    known: BTreeMap<[isize; 2], SubsurfaceState>,
}

impl<'a> PeakSearch<'a> {
    pub fn new(field: &'a StressField) -> Self {
        Self {
            field,
            loaded: field.loaded().elements(field.grid()),
            blocks: BTreeMap::new(),
            planes: Vec::new(),
        }
    }

    pub fn field(&self) -> &'a StressField {
        self.field
    }

    /// The state at a point and a depth, by a sum over the loaded elements.
    pub fn state(
        &self,
        rough: &mut RoughDepths,
        point: [f64; 2],
        depth: Depth,
    ) -> Result<SubsurfaceState, InfluenceError> {
        let (side, friction) = (self.field.grid().element_side(), self.field.tractions());
        let loaded = rough.sum_over(&self.loaded, side, friction, (point, depth))?;
        Ok(self.field.residual().added(loaded, depth))
    }

    /// The same by a sum over blocks of elements.
    pub fn state_under_blocks(
        &mut self,
        rough: &mut RoughDepths,
        (point, depth): ([f64; 2], Depth),
        doublings: u32,
    ) -> Result<SubsurfaceState, InfluenceError> {
        let blocks = self.blocks(doublings);
        let friction = self.field.tractions();
        let loaded = rough.sum_over(&blocks.loaded(), blocks.side, friction, (point, depth))?;
        Ok(self.field.residual().added(loaded, depth))
    }

    /// The value under the centre nearest to (x, y).
    pub fn under_nearest(
        &mut self,
        rough: &mut RoughDepths,
        quantity: StressQuantity,
        (point, depth): ([f64; 2], Depth),
    ) -> Result<StressPeak, InfluenceError> {
        let doublings = self.doublings(depth);
        let blocks = self.blocks(doublings);
        let place = blocks.nearest(point);
        let plane = self.plane_with(rough, &[place], depth, doublings)?;
        let [x, y] = blocks.point(place);
        Ok(StressPeak {
            value: quantity.of(&plane.known[&place]),
            at: [x, y, depth.z],
        })
    }

    /// Climbs from (x, y) and returns the value under the best centre reached.
    pub fn climb(
        &mut self,
        rough: &mut RoughDepths,
        quantity: StressQuantity,
        (start, depth): ([f64; 2], Depth),
    ) -> Result<StressPeak, InfluenceError> {
        let doublings = self.doublings(depth);
        let blocks = self.blocks(doublings);
        // A compressive stress that decays away from the contact has no peak in tension.
        let size = blocks.size.cast_signed();
        let margin = size + super::nearest((FARTHEST_DEPTHS * depth.z / blocks.side).ceil());
        let within = |along: isize| along.clamp(-margin, size + margin);
        let mut place = blocks.nearest(start).map(within);
        let (mut stride, mut moves) = (1, 0);
        loop {
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [i, j]));
            let around: Vec<_> = around
                .map(|[i, j]| [place[0] + stride * i, place[1] + stride * j].map(within))
                .collect();
            let plane = self.plane_with(rough, &around, depth, doublings)?;
            let (value, best) = best_of(&around, |place| quantity.of(&plane.known[&place]));
            if best != place {
                place = best;
                moves += 1;
                // Far from its start the climb takes longer steps.
                if moves % PATIENCE == 0 {
                    stride = (2 * stride).min(LONGEST_STRIDE);
                }
            } else if stride > 1 {
                stride /= 2;
            } else {
                let [x, y] = blocks.point(place);
                let at = [x, y, depth.z];
                return Ok(StressPeak { value, at });
            }
        }
    }

    /// Finds the place of the largest value around a centre, which the first climb from `start` reaches at the depth of
    /// this index among some depths, and within them: the place, and the factor by which the interpolated value there
    /// exceeds that at the same (x, y) and the depth `z` (m).
    pub fn between(
        &mut self,
        rough: &mut RoughDepths,
        quantity: StressQuantity,
        (start, z): ([f64; 2], f64),
        (depths, middle): (&[Depth], usize),
    ) -> Result<(StressPeak, f64), InfluenceError> {
        let climbed = self.climb(rough, quantity, (start, depths[middle]))?;
        let doublings = self.doublings(depths[middle]);
        let blocks = self.blocks(doublings);
        let place = blocks.nearest([climbed.at[0], climbed.at[1]]);
        let mut around = Neighbourhood::new(depths.iter().map(|depth| depth.z).collect());
        let places = Neighbourhood::places(place);
        for depth in depths {
            let plane = self.plane_with(rough, &places, *depth, doublings)?;
            around.take(&places.map(|place| plane.known[&place]));
        }
        let ends = [depths[0].z, depths[depths.len() - 1].z];
        let [u, v, w] = around.largest([0.0, 0.0, z.clamp(ends[0], ends[1])], |state| {
            quantity.roughly(state)
        });
        let interpolated = |z: f64| quantity.of(&around.state([u, v, z]));
        let (value, there) = (interpolated(w), interpolated(z.clamp(ends[0], ends[1])));
        let rise = Some(value / there).filter(|rise| (1.0..MOST_RISE).contains(rise));
        let [x, y] = blocks.point(place);
        let at = [x + u * blocks.side, y + v * blocks.side, w];
        Ok((StressPeak { value, at }, rise.unwrap_or(1.0)))
    }

    /// How often elements are doubled to blocks at a depth.
    fn doublings(&self, depth: Depth) -> u32 {
        doublings(depth.z, self.field.grid().element_side())
    }

    /// The pressure in blocks of a size.
    fn blocks(&mut self, doublings: u32) -> Arc<PressureBlocks> {
        let blocks = self.blocks.entry(doublings);
        blocks
            .or_insert_with(|| Arc::new(PressureBlocks::new(self.field, doublings)))
            .clone()
    }

    /// Returns the plane at a depth, with the stresses under the centres of these blocks computed.
    fn plane_with(
        &mut self,
        rough: &mut RoughDepths,
        places: &[[isize; 2]],
        depth: Depth,
        doublings: u32,
    ) -> Result<&Plane, InfluenceError> {
        let blocks = self.blocks(doublings);
        let last = blocks.size.cast_signed() - 1;
        let farthest = places.iter().flatten();
        let farthest =
            farthest.map(|along| along.unsigned_abs().max((last - along).unsigned_abs()));
        let farthest = farthest.max().unwrap_or(0);
        let is_it = |plane: &Plane| plane.depth == depth && plane.doublings == doublings;
        let known = self.planes.iter().position(is_it);
        let known = known.map(|index| self.planes.remove(index));
        let known = known.filter(|plane| farthest < plane.stresses.offsets());
        let plane = if let Some(plane) = known {
            plane
        } else {
            let offsets = farthest + SLACK;
            self.drop_oldest(offsets * offsets);
            let (foundation, friction) = (self.field.tables().foundation(), self.field.tractions());
            let mut stresses = CentreStresses::new(foundation, blocks.side, offsets, friction);
            stresses.move_roughly_to(rough, depth)?;
            Plane {
                depth,
                doublings,
                stresses,
                known: BTreeMap::new(),
            }
        };
        self.planes.push(plane);
        let last = self.planes.len() - 1;
        let plane = &mut self.planes[last];
        plane.compute(&blocks, self.field.residual(), places);
        Ok(plane)
    }

    /// Drops planes until there is room for one with this many offsets.
    fn drop_oldest(&mut self, offsets: usize) {
        let of = |plane: &Plane| plane.stresses.offsets().pow(2);
        let mut sum = offsets + self.planes.iter().map(of).sum::<usize>();
        let mut dropped = 0;
        while sum > KEPT_OFFSETS && dropped < self.planes.len() {
            sum -= of(&self.planes[dropped]);
            dropped += 1;
        }
        self.planes.drain(..dropped);
    }
}

impl Plane {
    /// Computes the stresses under the centres of these blocks that are not known yet.
    fn compute(
        &mut self,
        blocks: &PressureBlocks,
        residual: &ResidualStress,
        places: &[[isize; 2]],
    ) {
        let missing: Vec<_> = places
            .iter()
            .filter(|place| !self.known.contains_key(*place))
            .collect();
        let found: Vec<_> = missing
            .into_par_iter()
            .map(|place| {
                let state = self.stresses.at(&blocks.pressure, blocks.size, *place);
                (*place, residual.added(state, self.depth))
            })
            .collect();
        self.known.extend(found);
    }
}

/// The largest value at some places and its place; among equal ones, the middle place takes precedence, then the first.
fn best_of(places: &[[isize; 2]], value: impl Fn([isize; 2]) -> f64) -> (f64, [isize; 2]) {
    let middle = places[places.len() / 2];
    let mut best = (value(middle), middle);
    for place in places {
        let value = value(*place);
        if value > best.0 {
            best = (value, *place);
        }
    }
    best
}

#[cfg(test)]
mod tests;
