//! The scan for extremes of stresses, on planes at depths that are denser near the surface and the interfaces.
//!
//! Pressures that vary over less than z hardly affect a plane at depth z. On planes many elements deep, elements are
//! therefore merged into blocks of up to an eighth of the depth.

use pellicle_influence::{Depth, InfluenceError, PlaneFields, Squares, SubsurfaceState};
use rayon::prelude::*;

use super::field::{LoadedSquare, StressField};
use super::quantity::StressQuantity;

/// The stresses among the fields of a plane.
const STRESSES: [usize; 6] = [3, 4, 5, 6, 7, 8];
/// Blocks of elements are no larger than this part of the depth.
const BLOCK_PART: f64 = 1.0 / 8.0;
/// Smallest number of blocks across the loaded square.
const FEWEST_BLOCKS: usize = 16;
/// Ratio of the distances of successive planes from an end of a body.
const RATIO: f64 = 1.4;
/// The planes nearest to the middle of a body are at least this factor away from it.
const ROOM: f64 = 1.15;
/// Planes reach down to this many sides of the loaded square below the top of a body.
const REACH: f64 = 2.0;
/// The planes extend beyond the loaded square by this part of it plus this many depths, on either side.
const MARGIN_PART: f64 = 0.3;
const MARGIN_DEPTHS: f64 = 1.5;
/// Peaks above this part of the largest are examined more closely.
const NEARLY: f64 = 0.98;
/// Largest number of peaks examined on one plane.
const PEAKS_OF_A_PLANE: usize = 4;

/// A depth range and the quantities whose extremes are wanted there; an interface is a range without extent.
#[derive(Debug, Clone)]
pub struct Target {
    /// Depth of the top, m.
    pub top: f64,
    /// Depth of the bottom, m.
    pub bottom: f64,
    pub quantities: Vec<StressQuantity>,
}

/// A peak of a quantity on a plane.
#[derive(Debug, Clone, Copy)]
pub struct StartingPoint {
    /// Index among the targets.
    pub target: usize,
    pub quantity: StressQuantity,
    /// Value, in Pa.
    pub value: f64,
    /// Place (x, y), in m.
    pub at: [f64; 2],
    /// Index among the depths of the target.
    pub depth: usize,
}

impl Target {
    /// The depths to examine, from the top down, under a loaded square of side `loaded` (m) with elements of side
    /// `element` (m).
    pub fn depths(&self, loaded: f64, element: f64) -> Vec<Depth> {
        let (top, bottom) = (self.top, self.bottom.min(self.top + REACH * loaded));
        if top >= bottom {
            return vec![Depth::above(top)];
        }
        let is_cut = bottom < self.bottom;
        let half = if is_cut {
            bottom - top
        } else {
            (bottom - top) / 2.0
        };
        let first = (element / 2.0).max(half / 32.0);
        let first = first.max((top / 8.0).min(half / 2.0)).min(half);
        let steps = std::iter::successors(Some(first), |step| Some(step * RATIO));
        // The last step stays clear of the middle.
        let steps: Vec<f64> = steps.take_while(|step| *step < half / ROOM).collect();
        let mut depths = vec![Depth::below(top)];
        depths.extend(steps.iter().map(|step| Depth::below(top + step)));
        if !is_cut {
            depths.push(Depth::below(top + half));
            depths.extend(steps.iter().rev().map(|step| Depth::above(bottom - step)));
        }
        depths.push(Depth::above(bottom));
        depths
    }
}

/// Scans all targets and returns the peaks of each quantity, largest first.
pub fn starting_points(
    field: &StressField,
    targets: &[Target],
) -> Result<Vec<StartingPoint>, InfluenceError> {
    let element = field.grid().element_side();
    let loaded = field.loaded().size as f64 * element;
    let mut planes = Vec::new();
    for (target, of) in targets.iter().enumerate() {
        for (index, depth) in of.depths(loaded, element).into_iter().enumerate() {
            planes.push((target, index, depth));
        }
    }
    let doubling = |z: f64| {
        let fits = |m: &u32| {
            2_f64.powi(m.cast_signed()) * element <= BLOCK_PART * z
                && field.loaded().size >> m >= FEWEST_BLOCKS
        };
        (1..u32::BITS).take_while(fits).last().unwrap_or(0)
    };
    let largest = planes.iter().map(|(_, _, depth)| doubling(depth.z)).max();
    let mut found = Vec::new();
    for m in 0..=largest.unwrap_or(0) {
        let of_size = planes.iter().filter(|(_, _, depth)| doubling(depth.z) == m);
        let deepest = of_size.clone().map(|(_, _, depth)| depth.z);
        let Some(deepest) = deepest.reduce(f64::max) else {
            continue;
        };
        let mut blocks = BlockPlanes::new(field, 1 << m, deepest);
        for (target, index, depth) in of_size {
            let states = blocks.states_on(*depth)?;
            for quantity in &targets[*target].quantities {
                let peaks = blocks.peaks(&states, *quantity);
                found.extend(peaks.into_iter().map(|(value, at)| StartingPoint {
                    target: *target,
                    quantity: *quantity,
                    value,
                    at,
                    depth: *index,
                }));
            }
        }
    }
    found.sort_by(|one, other| other.value.total_cmp(&one.value));
    Ok(found)
}

/// Whether a value comes near the largest, so that it may be the largest after refinement.
pub fn is_nearly(value: f64, largest: f64) -> bool {
    value >= largest - (1.0 - NEARLY) * largest.abs()
}

/// Planes under blocks of elements.
struct BlockPlanes {
    fields: PlaneFields,
    /// Blocks along a side of the planes.
    shown: usize,
    /// x and y (m) of the first block.
    first: [f64; 2],
    side: f64,
}

impl BlockPlanes {
    fn new(field: &StressField, elements: usize, deepest: f64) -> Self {
        let LoadedSquare {
            origin,
            size,
            pressure,
        } = field.loaded();
        let grid = field.grid();
        let loaded = size.div_ceil(elements).max(1);
        let mut means = vec![0.0; loaded * loaded];
        for (row, pressures) in pressure.chunks_exact((*size).max(1)).enumerate() {
            for (column, p) in pressures.iter().enumerate() {
                means[row / elements * loaded + column / elements] += p;
            }
        }
        let side = grid.element_side() * elements as f64;
        let area = (elements * elements) as f64;
        means.iter_mut().for_each(|mean| *mean /= area);
        let margin = MARGIN_PART * loaded as f64 + MARGIN_DEPTHS * deepest / side;
        let margin = super::nearest(margin.ceil()).unsigned_abs();
        let shown = loaded + 2 * margin;
        let squares = Squares {
            loaded,
            shown,
            before: [margin; 2],
        };
        let first = origin.map(|origin| {
            let edge = grid.centre(origin) - grid.element_side() / 2.0;
            edge + (0.5 - margin as f64) * side
        });
        let foundation = field.tables().foundation();
        Self {
            fields: PlaneFields::new(foundation, side, squares, &means, field.tractions()),
            shown,
            first,
            side,
        }
    }

    /// The states on a plane, without displacements, row by row.
    fn states_on(&mut self, depth: Depth) -> Result<Vec<SubsurfaceState>, InfluenceError> {
        let mut states = vec![SubsurfaceState::default(); self.shown * self.shown];
        self.fields
            .chosen_fields_on(depth, &STRESSES, |field, values| {
                let entries = states.par_iter_mut().zip(values);
                entries.for_each(|(state, value)| state.stress[field - STRESSES[0]] = *value);
            })?;
        Ok(states)
    }

    /// The largest peaks of a quantity on a plane, with their places (m).
    fn peaks(&self, states: &[SubsurfaceState], quantity: StressQuantity) -> Vec<(f64, [f64; 2])> {
        let rows = states.par_chunks_exact(self.shown);
        let largest_of = |row: &[SubsurfaceState]| {
            let mut largest = f64::NEG_INFINITY;
            for state in row {
                if quantity.bound(state) > largest {
                    largest = largest.max(quantity.roughly(state));
                }
            }
            largest
        };
        let of_rows: Vec<f64> = rows.map(largest_of).collect();
        let largest = of_rows.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let place = |i: usize| [i / self.shown, i % self.shown];
        let near = states.par_iter().enumerate().filter_map(|(i, state)| {
            let is_bound = is_nearly(quantity.bound(state), largest);
            let value = is_bound.then(|| quantity.roughly(state))?;
            (is_nearly(value, largest) && self.is_peak(states, quantity, place(i), value))
                .then_some((value, place(i)))
        });
        let mut peaks: Vec<(f64, [usize; 2])> = near.collect();
        peaks.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        peaks.truncate(PEAKS_OF_A_PLANE);
        let point = |place: [usize; 2]| {
            std::array::from_fn(|axis| self.first[axis] + place[axis] as f64 * self.side)
        };
        peaks
            .into_iter()
            .map(|(value, place)| (value, point(place)))
            .collect()
    }

    /// Whether no neighbour is larger.
    fn is_peak(
        &self,
        states: &[SubsurfaceState],
        quantity: StressQuantity,
        [i, j]: [usize; 2],
        value: f64,
    ) -> bool {
        let last = self.shown - 1;
        let rows = i.saturating_sub(1)..=(i + 1).min(last);
        let columns = j.saturating_sub(1)..=(j + 1).min(last);
        let mut around = rows.flat_map(|i| columns.clone().map(move |j| [i, j]));
        around.all(|[i, j]| quantity.roughly(&states[i * self.shown + j]) <= value)
    }
}

#[cfg(test)]
mod tests;
