//! The largest values of quantities in depth ranges: planes first, then points, then the same peak on coarser grids.

mod coarser_grids;
mod following;
mod judgement;
mod near_surface;

use std::sync::Arc;

use coarser_grids::coarse_value;
use pellicle_influence::{Depth, RoughDepths};

use super::extreme::Extreme;
use super::field::StressField;
use super::model::Sliding;
use super::peak_search::{PeakSearch, StressPeak};
use super::plane_scan::{
    PEAKS, ScannedPlane, StartingPoint, Target, is_nearly, refined, scan, smooth_doublings, window,
};
use super::pressure_blocks::doublings;
use super::quantity::StressQuantity;
use super::residual::ResidualStress;
use crate::{ContactError, LoadingPath, Step};

/// Stresses under blocks of elements differ by up to this part from those under elements.
const BLOCK_ERROR: f64 = 0.01;
/// Part of the depth by which a peak found under blocks is tried above and below, and by which it may be moved: it is
/// found up to 0.06 too deep, a loss of up to 1 %.
const DEPTH_STEP: f64 = 0.06;
const FARTHEST_STEP: f64 = 0.12;
/// Halvings of the blocks for these trials. Errors under blocks are quadratic in their side, and the loss is quadratic
/// in the error of the depth: two leave 1/256 of it.
const FINER: u32 = 2;
/// Mirror images of a peak differ by less than this part, as their stresses are known in single precision.
const ALIKE: f64 = 1e-4;
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
    /// Whether the pressure is smooth on the scale of some elements.
    is_smooth: bool,
    rough: &'a mut RoughDepths,
    fine: PeakSearch<'a>,
    coarser: Vec<PeakSearch<'a>>,
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

    /// The same with what the bodies carry without a load.
    pub fn with_residual(self, residual: &ResidualStress) -> Self {
        let with = |field: StressField| field.with_residual(residual.clone());
        Self {
            field: with(self.field),
            coarser: self.coarser.into_iter().map(with).collect(),
            ..self
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
                let quantities = target.quantities.iter();
                let nowhere = quantities.map(|quantity| Extreme {
                    value: target.at_rest(*quantity, self.field.residual()),
                    at: [0.0, 0.0, target.top],
                    resolved: true,
                    estimate: Some(0.0),
                });
                nowhere.collect()
            };
            return Ok(targets.iter().map(unloaded).collect());
        }
        rough.forget();
        let scan = scan(&self.field, rough, targets)?;
        let mut shared = Shared {
            is_smooth: smooth_doublings(&self.field) > 0,
            rough,
            fine: PeakSearch::new(&self.field),
            coarser: self.coarser.iter().map(PeakSearch::new).collect(),
        };
        let mut found = Vec::new();
        for (index, (target, planes)) in targets.iter().zip(&scan.planes).enumerate() {
            let mut peaks = Vec::new();
            for quantity in &target.quantities {
                let of =
                    |start: &&StartingPoint| start.target == index && start.quantity == *quantity;
                let own: Vec<_> = scan.starting_points.iter().filter(of).copied().collect();
                peaks.push(self.peak(&mut shared, *quantity, planes, &own)?);
            }
            let depths: Vec<Depth> = planes.iter().map(|plane| plane.depth).collect();
            self.look_near_surface(&mut shared, target, &depths, &mut peaks)?;
            let is_on_top = target.top == 0.0;
            let mut of_target = Vec::new();
            for (quantity, peak) in target.quantities.iter().zip(peaks) {
                let values = self.values(&mut shared, *quantity, &depths, peak)?;
                let (of, judged) = ((target, *quantity), self.judged(peak, &values));
                let judged = self.with_grading(&mut shared, of, judged)?;
                let judged = self.judged_beside_edge((*quantity, is_on_top), judged)?;
                of_target.push(self.or_far_away(judged, target, *quantity));
            }
            found.push(of_target);
        }
        Ok(found)
    }

    /// Finds the largest peak that starting points, which are sorted by falling value, lead to.
    fn peak(
        &self,
        shared: &mut Shared,
        quantity: StressQuantity,
        planes: &[Arc<ScannedPlane>],
        starting_points: &[StartingPoint],
    ) -> Result<StressPeak, ContactError> {
        let element = self.field.grid().element_side();
        let depths: Vec<Depth> = planes.iter().map(|plane| plane.depth).collect();
        let zs: Vec<f64> = depths.iter().map(|depth| depth.z).collect();
        let mut followed = Vec::new();
        for start in distinct(starting_points, &zs, element) {
            followed.push(self.followed(shared, quantity, planes, &start)?);
        }
        let values = followed.iter().map(|(peak, _)| peak.value);
        let largest = values.fold(f64::NEG_INFINITY, f64::max);
        // Values between planes and under blocks do not tell which of several is the largest.
        let may_be_largest = |value: f64| value >= largest - 2.0 * BLOCK_ERROR * largest.abs();
        let mut best: Option<StressPeak> = None;
        for (index, (peak, centre)) in followed.iter().copied().enumerate() {
            let mut before = followed[..index].iter();
            if !may_be_largest(peak.value) || before.any(|(other, _)| is_image(&peak, other)) {
                continue;
            }
            let found = self.settled(shared, quantity, &depths, (peak, centre))?;
            if best.is_none_or(|best| found.value > best.value) {
                best = Some(found);
            }
        }
        best.ok_or(ContactError::StressNotFinite)
    }

    /// The peak with the value at its place, or the best centre on its plane where the interpolation between centres
    /// has gone astray.
    fn settled(
        &self,
        shared: &mut Shared,
        quantity: StressQuantity,
        depths: &[Depth],
        (peak, centre): (StressPeak, StressPeak),
    ) -> Result<StressPeak, ContactError> {
        let element = self.field.grid().element_side();
        let best = self.valued(shared, quantity, depths, peak)?;
        let is_of_elements = !shared.is_smooth && doublings(centre.at[2], element) == 0;
        let error = if is_of_elements { 0.0 } else { BLOCK_ERROR };
        if best.value >= centre.value - error * centre.value.abs() {
            return Ok(best);
        }
        let at_centre = if is_of_elements {
            centre
        } else {
            self.valued(shared, quantity, depths, centre)?
        };
        Ok(if at_centre.value > best.value {
            at_centre
        } else {
            best
        })
    }

    /// Follows a starting point to the peak between places and planes, and returns it with the best centre on the
    /// plane.
    fn followed(
        &self,
        Shared {
            is_smooth,
            fine,
            rough,
            ..
        }: &mut Shared,
        quantity: StressQuantity,
        planes: &[Arc<ScannedPlane>],
        start: &StartingPoint,
    ) -> Result<(StressPeak, StressPeak), ContactError> {
        let element = self.field.grid().element_side();
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
            // Under blocks the peak lies between their centres.
            let [x, y, _] = at;
            let from = ([x, y], plane.depth);
            if *is_smooth && self.is_away_from_edges(at) {
                fine.under_nearest(rough, quantity, from)?
            } else {
                fine.climb(rough, quantity, from)?
            }
        };
        let peak = if is_between && value > centre.value {
            StressPeak { value, at }
        } else {
            centre
        };
        Ok((peak, centre))
    }

    /// The peak with the value at its place, on an axis if it is as near as places are accurate; within an element of
    /// the surface its value is that under the centre already.
    fn valued(
        &self,
        shared: &mut Shared,
        quantity: StressQuantity,
        depths: &[Depth],
        peak: StressPeak,
    ) -> Result<StressPeak, ContactError> {
        let ([x, y, z], element) = (peak.at, self.field.grid().element_side());
        if z < element {
            return Ok(peak);
        }
        let block = element * 2_f64.powi(doublings(z, element).cast_signed());
        let point = [x, y].map(|along| {
            if along.abs() < ON_AXIS * block {
                0.0
            } else {
                along
            }
        });
        let z = moved_in_depth(shared, quantity, depths, (point, z))?;
        let depth = depth_in(depths, z);
        let state = shared.fine.state(shared.rough, point, depth)?;
        let [x, y, _] = peak.at;
        Ok(StressPeak {
            value: quantity.of(&state),
            at: [x, y, z],
        })
    }

    /// The values of a peak on all grids: pairs of elements per side and value.
    fn values(
        &self,
        shared: &mut Shared,
        quantity: StressQuantity,
        depths: &[Depth],
        peak: StressPeak,
    ) -> Result<Vec<(usize, f64)>, ContactError> {
        let mut values = Vec::new();
        for coarse in &mut shared.coarser {
            let value = coarse_value(coarse, shared.rough, quantity, depths, peak)?;
            values.push((coarse.field().grid().size(), value));
        }
        values.push((self.field.grid().size(), peak.value));
        Ok(values)
    }
}

/// The depth of a peak at a point (x, y): one found between planes under blocks is moved to the vertex of a parabola
/// through values under finer blocks, or to the best of these.
fn moved_in_depth(
    Shared { fine, rough, .. }: &mut Shared,
    quantity: StressQuantity,
    depths: &[Depth],
    (point, z): ([f64; 2], f64),
) -> Result<f64, ContactError> {
    let doublings = doublings(z, fine.field().grid().element_side());
    if doublings == 0 {
        return Ok(z);
    }
    let finer = doublings.saturating_sub(FINER);
    let mut at = |z: f64| {
        let place = (point, depth_in(depths, z));
        let state = fine.state_under_blocks(rough, place, finer)?;
        Ok::<_, ContactError>((quantity.of(&state), z))
    };
    let [top, bottom] = [depths.first(), depths.last()].map(|end| end.map_or(z, |depth| depth.z));
    let within = |part: f64| (z * (1.0 + part)).clamp(top.min(z), bottom.max(z));
    // At an end of the depths only one is beside it, on an interface none.
    let beside = [-DEPTH_STEP, DEPTH_STEP].map(within);
    let beside: Vec<f64> = beside
        .into_iter()
        .filter(|other| (other - z).abs() > 0.0)
        .collect();
    if beside.is_empty() {
        return Ok(z);
    }
    let found = at(z)?;
    let others = beside.into_iter().map(at).collect::<Result<Vec<_>, _>>()?;
    let best = others.iter().fold(
        found,
        |best, other| {
            if other.0 > best.0 { *other } else { best }
        },
    );
    let vertex = <[_; 2]>::try_from(others)
        .ok()
        .and_then(|others| vertex(found, others));
    Ok(vertex.map_or(best.1, |vertex| {
        vertex.clamp(within(-FARTHEST_STEP), within(FARTHEST_STEP))
    }))
}

/// The place of the maximum of the parabola through a value at a place and two others; none if it has a minimum.
fn vertex((value, z): (f64, f64), others: [(f64, f64); 2]) -> Option<f64> {
    // With d = z − zᵢ and f = value − vᵢ: z − ½ (d₁² f₂ − d₂² f₁) / (d₁ f₂ − d₂ f₁)
    let [(d, f), (d_2, f_2)] = others.map(|(other, at)| (z - at, value - other));
    let is_maximum = (f / d - f_2 / d_2) / (d - d_2) > 0.0;
    let shift = 0.5 * (d * d * f_2 - d_2 * d_2 * f) / (d * f_2 - d_2 * f);
    (is_maximum && shift.is_finite()).then_some(z - shift)
}

/// A depth in the body of these depths.
fn depth_in(depths: &[Depth], z: f64) -> Depth {
    match depths.last() {
        Some(last) if z >= last.z => *last,
        _ => Depth::below(z),
    }
}

/// Whether two peaks are mirror images of each other.
fn is_image(peak: &StressPeak, other: &StressPeak) -> bool {
    let from_axis = |of: &StressPeak| of.at[0].hypot(of.at[1]);
    let pairs = [
        (peak.value, other.value),
        (peak.at[2], other.at[2]),
        (from_axis(peak), from_axis(other)),
    ];
    let is_alike = |(one, other): (f64, f64)| (one - other).abs() <= ALIKE * one.abs();
    pairs.into_iter().all(is_alike)
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
