//! The largest values of quantities in depth ranges: planes first, then points, then the same peak on coarser grids.

use std::sync::Arc;

use pellicle_influence::{
    CentreStresses, Depth, ElementDepths, ElementFields, RoughDepths, SubsurfaceState,
};

use super::edge_extreme::{edge_extreme, is_near_edge};
use super::extreme::Extreme;
use super::field::StressField;
use super::model::Sliding;
use super::peak_search::{PeakSearch, StressPeak};
use super::plane_scan::{ScannedPlane, StartingPoint, Target, is_nearly, refined, scan, window};
use super::pressure_blocks::{PressureBlocks, doublings};
use super::quantity::StressQuantity;
use crate::result::peak::place_near;
use crate::{ContactError, ErrorEstimate, LoadingPath, PeakPlace, Step};

/// Largest number of peaks followed for one quantity.
const PEAKS: usize = 4;
/// An extreme within this many elements of the surface and near something sharp grows with the grid.
const ELEMENTS_FROM_SURFACE: f64 = 2.0;
/// Peaks less than this many elements below the surface are compared with the values under centres at these parts of an
/// element: at the rim of a punch stresses are largest there.
const ELEMENTS_BELOW_SURFACE: f64 = 3.0;
const BELOW_SURFACE: [f64; 3] = [0.25, 0.5, 0.75];
/// A tension sampled on the surface within this many elements of the contact's edge is not that of the continuum, which
/// has a cusp there.
const BESIDE_EDGE: isize = 3;
/// The pressures of the two outermost elements are up to 15 % off, and so are stresses under sliding on the surface
/// there.
const OUTERMOST: isize = 2;
/// Part of an element within which a place counts as on an axis.
const ON_AXIS: f64 = 1e-3;
/// Factor between the three depths around a peak that is followed from another load, so narrow that a parabola places
/// the peak to half a percent and finds its value to 1e-5, and how often it may leave them.
const FOLLOWED_RATIO: f64 = 1.12;
const FOLLOWED_MOVES: usize = 8;

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
    exact: ExactStates,
}

/// Exact states; those at one depth share their functions.
struct ExactStates {
    depths: ElementDepths,
    known: Vec<(Depth, f64, ElementFields)>,
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
        let side = self.field.grid().element_side();
        let mut shared = Shared {
            rough,
            fine: PeakSearch::new(&self.field),
            coarser: self.coarser.iter().map(PeakSearch::new).collect(),
            exact: ExactStates {
                depths: ElementDepths::new(self.field.tables().foundation(), side)?,
                known: Vec::new(),
            },
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
        let mut best = self.exact(shared, quantity, &depths, peak)?;
        if best.value < centre.value && peak.at.map(f64::to_bits) != centre.at.map(f64::to_bits) {
            // The value at the centre is that under blocks of elements where they are used.
            let at_centre = self.exact(shared, quantity, &depths, centre)?;
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
        let judged = self.judged(best, &values);
        if target.top == 0.0 && quantity == StressQuantity::MaxPrincipal {
            return self.or_at_edge(judged);
        }
        let [x, y, z] = judged.at;
        let slides = self.field.slides();
        let is_outermost = slides && z < element && is_near_edge(&self.field, [x, y], OUTERMOST);
        Ok(Extreme {
            resolved: judged.resolved && !is_outermost,
            ..judged
        })
    }

    /// Replaces the largest tension of the topmost body by that at the contact's edge if this is larger, or if the
    /// value
    /// was sampled beside the edge.
    fn or_at_edge(&self, sampled: Extreme<3>) -> Result<Extreme<3>, ContactError> {
        let Self {
            path,
            step,
            field,
            coarser,
        } = self;
        let at_edge = edge_extreme(path, step, field, coarser.last())?;
        let [x, y, z] = sampled.at;
        let is_beside = z < field.grid().element_side() && is_near_edge(field, [x, y], BESIDE_EDGE);
        Ok(match at_edge {
            Some(edge) if edge.value >= sampled.value || (is_beside && edge.resolved) => edge,
            _ => Extreme {
                resolved: sampled.resolved && !is_beside,
                ..sampled
            },
        })
    }

    /// The peak with its exact value, on an axis if it is as near as places are accurate.
    fn exact(
        &self,
        shared: &mut Shared,
        quantity: StressQuantity,
        depths: &[Depth],
        peak: StressPeak,
    ) -> Result<StressPeak, ContactError> {
        let [x, y, z] = peak.at;
        let element = self.field.grid().element_side();
        let block = element * 2_f64.powi(doublings(z, element).cast_signed());
        let [x, y] = [x, y].map(|along| {
            if along.abs() < ON_AXIS * block {
                0.0
            } else {
                along
            }
        });
        let depth = depth_in(depths, z);
        let under_centre = if z < element {
            under_centre(&self.field, [x, y], depth)?
        } else {
            None
        };
        let state = match under_centre {
            Some(state) => state,
            None => shared.exact.at(&self.field, [x, y], depth)?,
        };
        Ok(StressPeak {
            value: quantity.of(&state),
            at: [x, y, z],
        })
    }

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
        let followed = self.followed_from(rough, (target, *quantity), expected)?;
        match followed.map(without_error) {
            Some(sampled) if target.top == 0.0 && *quantity == StressQuantity::MaxPrincipal => {
                self.or_at_edge(sampled).map(Some)
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
        for _ in 0..FOLLOWED_MOVES {
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

    /// Returns the extreme with its error, from pairs of elements per side and value.
    fn judged(&self, peak: StressPeak, values: &[(usize, f64)]) -> Extreme<3> {
        let Self { path, step, .. } = self;
        let [x, y, z] = peak.at;
        let side = path.grid.element_side();
        let is_near = place_near(&path.relief, &path.indenter, side, [x, y]) != PeakPlace::Inside;
        let is_at_edge = z < ELEMENTS_FROM_SURFACE * side && is_near;
        let meets_outline = step
            .grid_error
            .levels
            .iter()
            .any(|level| level.meets_outline);
        let accuracy = step.solution.certificate.worst() + path.tables.error_estimate();
        let error = ErrorEstimate::of_values(values, meets_outline, is_at_edge, accuracy);
        // A peak nearer to the axis than rounding resolves lies on it.
        let snapped = |along: f64| {
            if along.abs() < ON_AXIS * side {
                0.0
            } else {
                along
            }
        };
        Extreme {
            value: peak.value,
            at: [snapped(x), snapped(y), z],
            resolved: error.is_some_and(|error| error.resolved) && step.grid_error.resolves_waves(),
            estimate: error.map(|error| error.estimate),
        }
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

impl ExactStates {
    fn at(
        &mut self,
        field: &StressField,
        point: [f64; 2],
        depth: Depth,
    ) -> Result<SubsurfaceState, ContactError> {
        let farthest = point[0].hypot(point[1]) + field.grid().side();
        let is_known =
            |(other, reach, _): &(Depth, f64, ElementFields)| *other == depth && *reach >= farthest;
        let known = self.known.iter().position(is_known);
        let index = if let Some(index) = known {
            index
        } else {
            let fields = self.depths.fields(depth, farthest)?;
            self.known.push((depth, farthest, fields));
            self.known.len() - 1
        };
        let loaded = field.loaded().elements(field.grid());
        Ok(self.known[index]
            .2
            .sum_over(&loaded, field.tractions(), point))
    }
}

/// The exact state under a centre where the surface is dragged along, with what the steps of the traction take from it;
/// none without friction, or away from the loaded square.
fn under_centre(
    field: &StressField,
    point: [f64; 2],
    depth: Depth,
) -> Result<Option<SubsurfaceState>, ContactError> {
    let size = field.loaded().size;
    let place = PressureBlocks::new(field, 0).nearest(point);
    if !field.slides() || place.iter().any(|i| !(-1..=size.cast_signed()).contains(i)) {
        return Ok(None);
    }
    let side = field.grid().element_side();
    let foundation = field.tables().foundation();
    let mut stresses = CentreStresses::new(foundation, side, size + 1, field.tractions());
    stresses.move_to(depth)?;
    let pressure = &field.loaded().pressure;
    Ok(Some(stresses.at(pressure, size, place)))
}

/// A depth in the body of these depths.
fn depth_in(depths: &[Depth], z: f64) -> Depth {
    match depths.last() {
        Some(last) if z >= last.z => *last,
        _ => Depth::below(z),
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

/// Returns the value of the same peak on a coarser grid.
fn coarse_value(
    coarse: &mut PeakSearch,
    rough: &mut RoughDepths,
    quantity: StressQuantity,
    depths: &[Depth],
    peak: StressPeak,
) -> Result<f64, ContactError> {
    let [x, y, z] = peak.at;
    let depth = depth_in(depths, z);
    if z < coarse.field().grid().element_side() {
        return Ok(coarse.climb(rough, quantity, ([x, y], depth))?.value);
    }
    let apart = |index: &usize| (depths[*index].z - z).abs();
    let nearest = (0..depths.len()).min_by(|one, other| apart(one).total_cmp(&apart(other)));
    let is_at_end = z <= depths[0].z || z >= depths[depths.len() - 1].z;
    let around = match nearest {
        Some(nearest) if !is_at_end => {
            let around = window(depths.len(), nearest);
            let middle = nearest - around.start;
            (depths[around].to_vec(), middle)
        }
        _ => (vec![depth], 0),
    };
    let (found, rise) = coarse.between(rough, quantity, ([x, y], z), (&around.0, around.1))?;
    let [x, y, _] = found.at;
    let state = coarse.state(rough, [x, y], depth)?;
    Ok(quantity.of(&state) * rise)
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
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{Depth, RadialTables};
    use pellicle_kernel::{Foundation, Material};
    use pellicle_texture::Grid;

    use super::*;

    #[test]
    fn starting_points_of_one_peak_are_followed_once_and_none_far_below_the_largest() {
        let depths = [0.0, 0.1, 0.4, 1.0];
        let kept = |starting_points: &[(f64, [f64; 2], usize)]| {
            let starting_points: Vec<_> = starting_points
                .iter()
                .map(|(value, at, depth)| StartingPoint {
                    target: 0,
                    quantity: StressQuantity::VonMises,
                    value: *value,
                    at: *at,
                    depth: *depth,
                })
                .collect();
            let kept = distinct(&starting_points, &depths, 0.1);
            kept.iter().map(|kept| kept.value).collect::<Vec<_>>()
        };
        let first = (10.0, [0.0; 2], 1);
        // At the next depth within an element, and within half the depth; farther; at the same depth; two depths away.
        assert_eq!(kept(&[first, (9.9, [0.06, 0.06], 0)]), [10.0]);
        assert_eq!(kept(&[first, (9.9, [0.1, 0.15], 2)]), [10.0]);
        assert_eq!(kept(&[first, (9.9, [0.08, 0.08], 0)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.9, [0.15, 0.15], 2)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.9, [0.01, 0.0], 1)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.9, [0.01, 0.0], 3)]), [10.0, 9.9]);
        assert_eq!(kept(&[first, (9.7, [0.9, 0.0], 1)]), [10.0]);
        let apart = [0, 1, 2, 3, 4].map(|i| (10.0, [f64::from(i), 0.0], 1));
        assert_eq!(kept(&apart).len(), 4);
    }

    /// Hertz's pressure of radius and peak 1 on a square of side 3.
    fn hertz(size: usize) -> StressField {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let grid = Grid::new(3.0, size).unwrap();
        let pressure = (0..grid.len()).map(|e| {
            let [x, y] = [e / size, e % size].map(|i| grid.centre(i));
            (1.0 - x * x - y * y).max(0.0).sqrt()
        });
        let tables = Arc::new(RadialTables::build(&body).unwrap());
        StressField::of(
            tables,
            grid,
            &pressure.collect::<Vec<_>>(),
            Sliding::default(),
        )
    }

    #[test]
    fn a_peak_is_found_again_on_a_coarser_grid_at_its_depth_or_near_it() {
        let field = hertz(15);
        let value = |[top, bottom]: [f64; 2], z| {
            let peak = StressPeak {
                value: 1.0,
                at: [0.1, 0.0, z],
            };
            let target = Target {
                top,
                bottom,
                quantities: Vec::new(),
            };
            let mut rough = RoughDepths::new(field.tables().foundation(), 0.2, [0.0; 2]).unwrap();
            let depths = target.depths(2.2, 0.2);
            let quantity = StressQuantity::Compression;
            coarse_value(
                &mut PeakSearch::new(&field),
                &mut rough,
                quantity,
                &depths,
                peak,
            )
            .unwrap()
        };
        let there = |z| {
            let state = field.at([0.0; 2], Depth::below(z)).unwrap();
            -state.stress[2]
        };
        // The compression falls with depth. At an end of the range the value is that of the end; inside, it is that at
        // the depth times the rise to the top of the depths around it, which is at most 1.2.
        for end in [0.8, 2.0] {
            assert!((value([0.8, 2.0], end) / there(end) - 1.0).abs() < 1e-5);
        }
        let found = value([0.78, 0.84], 0.81);
        assert!((found / there(0.78) - 1.0).abs() < 1e-4, "{found}");
        assert!((value([0.3, 2.0], 0.8) / there(0.8) - 1.0).abs() < 1e-5);
    }

    /// A half-space of Poisson's ratio 0.3 under an indenter at a depth, on a square of side 1 and grids of up to 32
    /// elements.
    fn solved(indenter: impl Into<crate::Indenter>, depth: f64) -> LoadingPath {
        let model =
            crate::Model::on_half_space([1.0, 0.3], pellicle_texture::Relief::Bare, indenter);
        let options = crate::SolverOptions {
            coarse_pressures: true,
            ..crate::SolverOptions::default()
        };
        let (domain, load) = (crate::Domain::Side(1.0), crate::Load::Penetration(depth));
        crate::solve_path(&model, domain, 32, &[load], &options, &mut ()).unwrap()
    }

    fn found(finder: &ExtremeFinder, targets: &[Target]) -> Vec<Vec<Extreme<3>>> {
        let mut rough = ExtremeFinder::rough_depths(finder.path, Sliding::default()).unwrap();
        finder.find(&mut rough, targets).unwrap()
    }

    #[test]
    fn under_a_ball_the_largest_stresses_are_those_of_hertz_each_in_its_range() {
        let a: f64 = 0.3;
        let path = solved(crate::Paraboloid::new(1.0).unwrap(), a * a);
        // p0 = 2 E* a/(π R)
        let p0 = 2.0 * a / (std::f64::consts::PI * 0.91);
        let body = Target {
            top: 0.0,
            bottom: f64::INFINITY,
            quantities: vec![StressQuantity::VonMises, StressQuantity::MaxShear],
        };
        // −σ_zz = p0/(1 + z²/a²) on the axis, and no shear there.
        let depth = 0.5 * a;
        let interface = Target {
            top: depth,
            bottom: depth,
            quantities: vec![StressQuantity::Compression],
        };
        let deep = Target {
            top: a,
            bottom: 2.0 * a,
            quantities: vec![StressQuantity::Compression],
        };
        let finder = ExtremeFinder::new(&path, &path.steps[0], Sliding::default());
        let found = found(&finder, &[body, interface, deep]);
        // Johnson 1985: 0.62 p0 and 0.31 p0 at 0.48 a.
        for (extreme, wanted, z) in [
            (found[0][0], 0.62, 0.481 * a),
            (found[0][1], 0.31, 0.481 * a),
            (found[1][0], 0.8, depth),
            (found[2][0], 0.5, a),
        ] {
            // Ten elements per radius.
            assert!(
                (extreme.value / p0 / wanted - 1.0).abs() < 0.02,
                "{extreme:?}"
            );
            assert!((extreme.at[2] / z - 1.0).abs() < 0.05, "{extreme:?}");
            assert_eq!(extreme.at[..2], [0.0; 2]);
            let estimate = extreme.estimate.unwrap();
            assert!(estimate < 0.1 * extreme.value, "{extreme:?}");
        }
        assert_eq!([found[0].len(), found[1].len(), found[2].len()], [2, 1, 1]);
    }

    #[test]
    fn an_extreme_at_an_edge_is_not_resolved_and_one_close_to_the_axis_is_moved_to_it() {
        let path = solved(crate::FlatPunch::new(0.2).unwrap(), 0.01);
        let finder = ExtremeFinder::new(&path, &path.steps[0], Sliding::default());
        let side = path.grid.element_side();
        let values = [(8, 1.5), (16, 1.125), (32, 1.03125)];
        let judged = |at: [f64; 3]| finder.judged(StressPeak { value: 1.03125, at }, &values);
        for (at, is_resolved) in [
            ([0.2, 0.0, 1.9 * side], false),
            ([0.2, 0.0, 2.1 * side], true),
            ([0.0, -0.2, 0.0], false),
            ([0.05, 0.05, 0.0], true),
        ] {
            let found = judged(at);
            assert_eq!(found.resolved, is_resolved, "{at:?}");
            assert_eq!((found.value, found.at[2]), (1.03125, at[2]));
            let accuracy =
                path.steps[0].solution.certificate.worst() + path.tables.error_estimate();
            let wanted = ErrorEstimate::of_values(&values, true, !is_resolved, accuracy);
            assert_eq!(found.estimate, wanted.map(|wanted| wanted.estimate));
        }
        let snapped = judged([0.9e-3 * side, -1.1e-3 * side, 0.1]);
        assert_eq!(snapped.at, [0.0, -1.1e-3 * side, 0.1]);
        let snapped = judged([1.1e-3 * side, -0.9e-3 * side, 0.1]);
        assert_eq!(snapped.at, [1.1e-3 * side, 0.0, 0.1]);
    }
}
