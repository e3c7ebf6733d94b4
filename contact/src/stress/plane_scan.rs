//! The scan for extremes of stresses, on planes that are denser near the surface.
//!
//! On planes many elements deep the pressure is that of [blocks](super::pressure_blocks) of elements, and everywhere
//! that of blocks that are small beside the contact, if the pressure is smooth on their scale. Between the planes and
//! their places stresses are interpolated.

mod plane_stresses;

use std::collections::BTreeMap;
use std::sync::Arc;

use pellicle_influence::{
    Depth, InfluenceError, PlaneFields, RoughDepths, Squares, SubsurfaceState,
};
pub use plane_stresses::PEAKS;
use plane_stresses::PlaneStresses;

use super::field::StressField;
use super::neighbourhood::{Neighbourhood, OFFSETS, lagrange};
use super::pressure_blocks::{PressureBlocks, doublings};
use super::quantity::StressQuantity;
use super::residual::ResidualStress;

/// The stresses among the fields of a plane.
const STRESSES: [usize; 6] = [3, 4, 5, 6, 7, 8];
/// Ratio of the depths of successive planes.
const RATIO: f64 = 1.4;
/// Fewest steps from one plane to the next in a body below the surface, from which stresses are interpolated.
const FEWEST_STEPS: usize = 4;
/// In a body without a bottom planes reach down to this many sides of the loaded square below its top, or to this many
/// times the depth of its top if that is more.
const REACH: f64 = 2.0;
/// The planes extend beyond the loaded square by this part of it plus this many depths, on either side.
const MARGIN_PART: f64 = 0.3;
const MARGIN_DEPTHS: f64 = 1.5;
/// Peaks above this part of the largest are examined more closely.
const NEARLY: f64 = 0.98;
/// Blocks across the loaded square that suffice for a smooth pressure.
pub const BLOCKS: usize = 32;
/// Number of planes on either side of a depth from which stresses are interpolated.
const PLANES_AROUND: usize = 2;

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
    /// Whether this is an interface.
    pub fn is_interface(&self) -> bool {
        self.top >= self.bottom
    }

    /// The largest value of a quantity without a load, Pa; on an interface there is none.
    pub fn at_rest(&self, quantity: StressQuantity, residual: &ResidualStress) -> f64 {
        if self.is_interface() {
            return 0.0;
        }
        quantity.of(&residual.state(Depth::below(self.top)))
    }

    /// The depths to examine, from the top down, under a loaded square of side `loaded` (m) with elements of side
    /// `element` (m).
    ///
    /// Waves decay from the surface as `e^{−kz}` or, reflected from below, earlier: within a body stresses vary on the
    /// scale of the depth. A stiff layer bends, however thick, and may bear its largest tension on its underside.
    pub fn depths(&self, loaded: f64, element: f64) -> Vec<Depth> {
        let top = self.top;
        let bottom = if self.bottom.is_finite() {
            self.bottom
        } else {
            top + REACH * loaded.max(top)
        };
        if self.is_interface() {
            return vec![Depth::above(top)];
        }
        let mut depths = vec![Depth::below(top)];
        if top > 0.0 {
            let octaves = (bottom / top).ln() / RATIO.ln();
            let steps = super::nearest(octaves.ceil())
                .unsigned_abs()
                .max(FEWEST_STEPS);
            let between = (1..steps).map(|step| {
                let part = step as f64 / steps as f64;
                Depth::below(top * (bottom / top).powf(part))
            });
            depths.extend(between);
        } else {
            // In a thin layer stresses vary little over a sixteenth of its thickness.
            let first = (element / 2.0)
                .max((bottom / 16.0).min(loaded / 16.0))
                .min(bottom / 2.0);
            let between = std::iter::successors(Some(first), |z| Some(z * RATIO));
            let between = between.take_while(|z| *z < bottom / RATIO.sqrt());
            depths.extend(between.map(Depth::below));
        }
        depths.push(Depth::above(bottom));
        depths
    }
}

/// The planes of all targets.
pub struct Scan {
    /// Of each target, from the top down.
    pub planes: Vec<Vec<Arc<ScannedPlane>>>,
    /// Largest first.
    pub starting_points: Vec<StartingPoint>,
}

/// The stresses on a plane, in single precision.
pub struct ScannedPlane {
    pub depth: Depth,
    /// Whether the places are the centres of elements.
    pub is_of_elements: bool,
    /// Places along a side, x and y (m) of the first, and their distance.
    shown: usize,
    first: [f64; 2],
    side: f64,
    stresses: Vec<[f32; 6]>,
}

/// Scans all targets for the peaks of each quantity.
pub fn scan(
    field: &StressField,
    rough: &mut RoughDepths,
    targets: &[Target],
) -> Result<Scan, InfluenceError> {
    let element = field.grid().element_side();
    let loaded = field.loaded().size as f64 * element;
    // The targets and indices of every plane; an interface is also the bottom of a body.
    let mut planes: Vec<(Depth, Vec<[usize; 2]>)> = Vec::new();
    for (target, of) in targets.iter().enumerate() {
        for (index, depth) in of.depths(loaded, element).into_iter().enumerate() {
            match planes.iter_mut().find(|(other, _)| *other == depth) {
                Some((_, of)) => of.push([target, index]),
                None => planes.push((depth, vec![[target, index]])),
            }
        }
    }
    let least = smooth_doublings(field);
    let mut groups = BTreeMap::<u32, Vec<_>>::new();
    for plane in &planes {
        let m = doublings(plane.0.z, element).max(least);
        groups.entry(m).or_default().push(plane);
    }
    let (mut found, mut scanned) = (Vec::new(), Vec::new());
    let mut largest: Vec<Vec<f64>> = targets
        .iter()
        .map(|target| vec![f64::NEG_INFINITY; target.quantities.len()])
        .collect();
    for (m, group) in groups {
        let deepest = group.iter().map(|(depth, _)| depth.z).fold(0.0, f64::max);
        let mut blocks = BlockPlanes::new(field, m, deepest);
        for (depth, of) in group {
            blocks.move_to(rough, *depth)?;
            for [target, index] in of {
                let of_quantities = targets[*target]
                    .quantities
                    .iter()
                    .zip(&mut largest[*target]);
                for (quantity, largest) in of_quantities {
                    let peaks = blocks.stresses.peaks(*quantity, *largest);
                    *largest = peaks
                        .first()
                        .map_or(*largest, |(value, _)| largest.max(*value));
                    found.extend(peaks.into_iter().map(|(value, place)| StartingPoint {
                        target: *target,
                        quantity: *quantity,
                        value,
                        at: blocks.point(place),
                        depth: *index,
                    }));
                }
            }
            let plane = Arc::new(blocks.scanned(*depth, m == 0));
            scanned.extend(of.iter().map(|place| (*place, plane.clone())));
        }
    }
    found.sort_by(|one, other| other.value.total_cmp(&one.value));
    scanned.sort_by_key(|(place, _)| *place);
    let mut planes = vec![Vec::new(); targets.len()];
    for ([target, _], plane) in scanned {
        planes[target].push(plane);
    }
    Ok(Scan {
        planes,
        starting_points: found,
    })
}

/// How often elements are doubled to the largest blocks that are small beside the contact and on whose scale the
/// pressure is smooth.
pub fn smooth_doublings(field: &StressField) -> u32 {
    let size = field.loaded().size;
    let largest = (1..u32::BITS).take_while(|m| size >> m >= BLOCKS).last();
    let m = largest.unwrap_or(0);
    if m > 0 && PressureBlocks::new(field, m).is_smooth(field) {
        m
    } else {
        0
    }
}

/// Whether a value comes near the largest, so that it may be the largest after refinement.
pub fn is_nearly(value: f64, largest: f64) -> bool {
    value >= largest - (1.0 - NEARLY) * largest.abs()
}

/// Finds the peak of a quantity near (x, y) on a plane of a body, between places and planes: value and place.
pub fn refined(
    planes: &[Arc<ScannedPlane>],
    quantity: StressQuantity,
    (mut plane, mut at): (usize, [f64; 2]),
) -> (f64, [f64; 3]) {
    let mut best = (f64::NEG_INFINITY, [at[0], at[1], planes[plane].depth.z]);
    for _ in 0..super::MOST_MOVES {
        let around = window(planes.len(), plane);
        let depths = planes[around.clone()].iter().map(|plane| plane.depth.z);
        let (z, side) = (planes[plane].depth.z, planes[plane].side);
        let mut states = Neighbourhood::new(depths.collect());
        for of in &planes[around] {
            states.take(&Neighbourhood::places([0, 0]).map(|place| {
                let [x, y] = [0, 1].map(|axis| at[axis] + place[axis] as f64 * side);
                of.state([x, y])
            }));
        }
        let [u, v, depth] = states.largest([0.0, 0.0, z], |state| quantity.roughly(state));
        let value = quantity.of(&states.state([u, v, depth]));
        if value <= best.0 {
            break;
        }
        best = (value, [at[0] + u * side, at[1] + v * side, depth]);
        let apart = |other: usize| (planes[other].depth.z - depth).abs();
        let nearest = (0..planes.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b)));
        let nearest = nearest.unwrap_or(plane);
        let is_inside = u.abs().max(v.abs()) < 1.0;
        if is_inside && nearest == plane {
            break;
        }
        (plane, at) = (nearest, [best.1[0], best.1[1]]);
    }
    best
}

/// The planes around one of a number of planes.
pub fn window(count: usize, plane: usize) -> std::ops::Range<usize> {
    plane.saturating_sub(PLANES_AROUND)..(plane + PLANES_AROUND + 1).min(count)
}

impl ScannedPlane {
    /// Whether a place is so near to the edge of the plane that a peak may lie beyond it.
    pub fn is_at_edge(&self, point: [f64; 2]) -> bool {
        let last = (self.shown - 1) as f64;
        point.iter().zip(self.first).any(|(along, first)| {
            let place = (along - first) / self.side;
            place < 1.5 || place > last - 1.5
        })
    }

    /// The state at (x, y), by Lagrange's polynomials through 5 × 5 places.
    fn state(&self, point: [f64; 2]) -> SubsurfaceState {
        let last = self.shown.saturating_sub(3).max(2) as f64;
        let along = [0, 1].map(|axis: usize| {
            let place = (point[axis] - self.first[axis]) / self.side;
            let middle = place.round().clamp(2.0, last);
            // Beyond the plane the state is that at its edge.
            let offset = (place - middle).clamp(-2.0, 2.0);
            (
                super::nearest(middle).unsigned_abs(),
                lagrange(&OFFSETS, offset),
            )
        });
        let [(i, of_rows), (j, of_columns)] = &along;
        let mut state = SubsurfaceState::default();
        for (row, x) in of_rows.iter().enumerate() {
            for (column, y) in of_columns.iter().enumerate() {
                let place = (i + row - 2) * self.shown + j + column - 2;
                let stresses = state.stress.iter_mut().zip(self.stresses[place]);
                stresses.for_each(|(sum, stress)| *sum += x * y * f64::from(stress));
            }
        }
        state
    }
}

/// The number of places beyond a loaded square of this size on either side of planes down to a depth, in places.
pub fn margin(size: usize, deepest: f64) -> usize {
    let margin = MARGIN_PART * size as f64 + MARGIN_DEPTHS * deepest;
    // Two places on either side of every one are needed for interpolation.
    super::nearest(margin.ceil()).unsigned_abs().max(2)
}

/// Planes under blocks of elements.
struct BlockPlanes {
    fields: PlaneFields,
    /// Blocks along a side of the planes.
    shown: usize,
    /// x and y (m) of the first block.
    first: [f64; 2],
    side: f64,
    residual: ResidualStress,
    /// Those of the last plane.
    stresses: PlaneStresses,
}

impl BlockPlanes {
    fn new(field: &StressField, doublings: u32, deepest: f64) -> Self {
        let PressureBlocks {
            size,
            side,
            first,
            pressure,
        } = PressureBlocks::new(field, doublings);
        let margin = margin(size, deepest / side);
        let shown = size + 2 * margin;
        let squares = Squares {
            loaded: size,
            shown,
            before: [margin; 2],
        };
        let foundation = field.tables().foundation();
        Self {
            fields: PlaneFields::new(foundation, side, squares, &pressure, field.tractions()),
            shown,
            first: first.map(|first| first - margin as f64 * side),
            side,
            residual: field.residual().clone(),
            stresses: PlaneStresses::zeros(shown),
        }
    }

    /// Computes the stresses on a plane.
    fn move_to(&mut self, rough: &mut RoughDepths, depth: Depth) -> Result<(), InfluenceError> {
        let Self {
            fields,
            residual,
            stresses,
            ..
        } = self;
        fields.rough_fields_on(rough, depth, &STRESSES, |field, values| {
            stresses.take(field - STRESSES[0], values);
        })?;
        stresses.add_equibiaxial(residual.at(depth));
        stresses.find_invariants();
        Ok(())
    }

    /// The place (x, y; m) of a row and column.
    fn point(&self, place: [usize; 2]) -> [f64; 2] {
        std::array::from_fn(|axis| self.first[axis] + place[axis] as f64 * self.side)
    }

    /// The last plane, at this depth.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "places need no more digits"
    )]
    fn scanned(&self, depth: Depth, is_of_elements: bool) -> ScannedPlane {
        let places = 0..self.shown * self.shown;
        let stresses = places.map(|place| self.stresses.state(place).stress);
        ScannedPlane {
            depth,
            is_of_elements,
            shown: self.shown,
            first: self.first,
            side: self.side,
            stresses: stresses
                .map(|stresses| stresses.map(|stress| stress as f32))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests;
