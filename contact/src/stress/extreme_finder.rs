//! The largest values of quantities in depth ranges: planes first, then points, then the same peak on coarser grids.

mod coarser_grids;
mod exact_states;
mod following;
mod judgement;

use std::sync::Arc;

use coarser_grids::coarse_value;
use exact_states::ExactStates;
use pellicle_influence::{Depth, RoughDepths};

use super::extreme::Extreme;
use super::field::StressField;
use super::model::Sliding;
use super::peak_search::{PeakSearch, StressPeak};
use super::plane_scan::{ScannedPlane, StartingPoint, Target, is_nearly, refined, scan, window};
use super::quantity::StressQuantity;
use crate::{ContactError, LoadingPath, Step};

/// Largest number of peaks followed for one quantity.
const PEAKS: usize = 4;
/// Peaks less than this many elements below the surface are compared with the values under centres at these parts of an
/// element: at the rim of a punch stresses are largest there.
const ELEMENTS_BELOW_SURFACE: f64 = 3.0;
const BELOW_SURFACE: [f64; 3] = [0.25, 0.5, 0.75];
/// Part of an element within which a place counts as on an axis.
const ON_AXIS: f64 = 1e-3;

/// The search for the extremes under one step of a path.
pub struct ExtremeFinder<'a> {
    path: &'a LoadingPath,
    step: &'a Step,
    field: StressField,
    /// Coarser grids, coarsest first.
    coarser: Vec<StressField>,
}

/// What the targets of a search share.
struct Shared<'a> {
    rough: &'a mut RoughDepths,
    fine: PeakSearch<'a>,
    coarser: Vec<PeakSearch<'a>>,
    exact: ExactStates<'a>,
}

impl<'a> ExtremeFinder<'a> {
    pub fn new(path: &'a LoadingPath, step: &'a Step, sliding: Sliding) -> Self {
        let of =
            |grid, pressure: &[f64]| StressField::of(path.tables.clone(), grid, pressure, sliding);
        let coarser = step.coarser.iter();
        let coarser = coarser.map(|coarse| of(coarse.grid, &coarse.pressure));
        Self {
            path,
            step,
            field: of(path.grid, &step.solution.pressure),
            // A grid on which no element touches has no stresses.
            coarser: coarser.filter(|coarse| coarse.loaded().size > 0).collect(),
        }
    }

    /// The depths of a search, which the searches under other loads on the same body may use.
    pub fn rough_depths(path: &LoadingPath, sliding: Sliding) -> Result<RoughDepths, ContactError> {
        let (foundation, side) = (path.tables.foundation(), path.grid.element_side());
        Ok(RoughDepths::new(foundation, side, sliding.tractions())?)
    }

    /// Finds the largest values of the quantities of each target.
    pub fn find(
        &self,
        rough: &mut RoughDepths,
        targets: &[Target],
    ) -> Result<Vec<Vec<Extreme<3>>>, ContactError> {
        if self.field.loaded().size == 0 {
            let unloaded = |target: &Target| {
                let nowhere = Extreme {
                    value: 0.0,
                    at: [0.0, 0.0, target.top],
                    resolved: true,
                    estimate: Some(0.0),
                };
                vec![nowhere; target.quantities.len()]
            };
            return Ok(targets.iter().map(unloaded).collect());
        }
        rough.forget();
        let scan = scan(&self.field, rough, targets)?;
        let mut shared = Shared {
            rough,
            fine: PeakSearch::new(&self.field),
            coarser: self.coarser.iter().map(PeakSearch::new).collect(),
            exact: ExactStates::new(&self.field)?,
        };
        let mut found = Vec::new();
        for (index, (target, planes)) in targets.iter().zip(&scan.planes).enumerate() {
            let mut of_target = Vec::new();
            for quantity in &target.quantities {
                let of =
                    |start: &&StartingPoint| start.target == index && start.quantity == *quantity;
                let own: Vec<_> = scan.starting_points.iter().filter(of).copied().collect();
                of_target.push(self.extreme(&mut shared, (target, *quantity), planes, &own)?);
            }
            found.push(of_target);
        }
        Ok(found)
    }

    /// Finds the extreme among starting points, which are sorted by falling value.
    fn extreme(
        &self,
        shared: &mut Shared,
        (target, quantity): (&Target, StressQuantity),
        planes: &[Arc<ScannedPlane>],
        starting_points: &[StartingPoint],
    ) -> Result<Extreme<3>, ContactError> {
        let element = self.field.grid().element_side();
        let depths: Vec<Depth> = planes.iter().map(|plane| plane.depth).collect();
        let zs: Vec<f64> = depths.iter().map(|depth| depth.z).collect();
        let mut best: Option<(StressPeak, StressPeak)> = None;
        for start in distinct(starting_points, &zs, element) {
            let (peak, centre) = followed(shared, quantity, planes, &start, element)?;
            if best.is_none_or(|(best, _)| peak.value > best.value) {
                best = Some((peak, centre));
            }
        }
        let Some((mut peak, mut centre)) = best else {
            return Err(ContactError::StressNotFinite);
        };
        if peak.at[2] < ELEMENTS_BELOW_SURFACE * element && quantity != StressQuantity::MinPrincipal
        {
            let Shared { fine, rough, .. } = shared;
            let [x, y, z] = peak.at;
            if z >= element {
                let state = fine.state(rough, [x, y], depth_in(&depths, z))?;
                peak.value = quantity.of(&state);
            }
            let within = |z: &f64| *z > zs[0] && *z < zs[zs.len() - 1];
            for z in BELOW_SURFACE
                .map(|part| part * element)
                .into_iter()
                .filter(within)
            {
                let below = fine.climb(rough, quantity, ([x, y], depth_in(&depths, z)))?;
                if below.value > peak.value {
                    (peak, centre) = (below, below);
                }
            }
        }
        let mut best = shared.exact.peak(quantity, &depths, peak)?;
        if best.value < centre.value && peak.at.map(f64::to_bits) != centre.at.map(f64::to_bits) {
            // The value at the centre is that under blocks of elements where they are used.
            let at_centre = shared.exact.peak(quantity, &depths, centre)?;
            if at_centre.value > best.value {
                best = at_centre;
            }
        }
        let mut values = Vec::new();
        for coarse in &mut shared.coarser {
            let value = coarse_value(coarse, shared.rough, quantity, &depths, best)?;
            values.push((coarse.field().grid().size(), value));
        }
        values.push((self.field.grid().size(), best.value));
        let is_on_top = target.top == 0.0;
        self.judged_beside_edge((quantity, is_on_top), self.judged(best, &values))
    }
}

/// Follows a starting point to the peak between places and planes, and returns it with the best centre on the plane.
fn followed(
    Shared { fine, rough, .. }: &mut Shared,
    quantity: StressQuantity,
    planes: &[Arc<ScannedPlane>],
    start: &StartingPoint,
    element: f64,
) -> Result<(StressPeak, StressPeak), ContactError> {
    let plane = &planes[start.depth];
    if plane.is_at_edge(start.at) {
        // Some stresses are largest far outside the loaded square.
        let around = window(planes.len(), start.depth);
        let middle = start.depth - around.start;
        let depths: Vec<Depth> = planes[around].iter().map(|plane| plane.depth).collect();
        let from = (start.at, plane.depth.z);
        let (peak, _) = fine.between(rough, quantity, from, (&depths, middle))?;
        let [x, y, z] = peak.at;
        let value = quantity.of(&fine.state(rough, [x, y], depth_in(&depths, z))?);
        let peak = StressPeak { value, ..peak };
        return Ok((peak, peak));
    }
    let (value, at) = refined(planes, quantity, (start.depth, start.at));
    // Within an element of the surface only the values under centres count.
    let is_between = at[2] >= element;
    let centre = if plane.is_of_elements || (is_between && plane.depth.z >= element) {
        let [x, y] = start.at;
        StressPeak {
            value: start.value,
            at: [x, y, plane.depth.z],
        }
    } else {
        fine.climb(rough, quantity, (start.at, plane.depth))?
    };
    let peak = if is_between && value > centre.value {
        StressPeak { value, at }
    } else {
        centre
    };
    Ok((peak, centre))
}

/// A depth in the body of these depths.
fn depth_in(depths: &[Depth], z: f64) -> Depth {
    match depths.last() {
        Some(last) if z >= last.z => *last,
        _ => Depth::below(z),
    }
}

/// Selects the starting points, sorted by falling value, that come near the largest and belong to no larger one's peak.
fn distinct(starting_points: &[StartingPoint], depths: &[f64], element: f64) -> Vec<StartingPoint> {
    let mut kept: Vec<StartingPoint> = Vec::new();
    for start in starting_points {
        if kept.len() == PEAKS || !is_nearly(start.value, starting_points[0].value) {
            break;
        }
        let belongs = |other: &StartingPoint| {
            let apart = (other.at[0] - start.at[0]).hypot(other.at[1] - start.at[1]);
            other.depth.abs_diff(start.depth) == 1
                && apart <= element.max(depths[start.depth] / 2.0)
        };
        if !kept.iter().any(belongs) {
            kept.push(*start);
        }
    }
    kept
}

#[cfg(test)]
mod tests;
