//! The search for the largest value of a quantity near a point, in depth and plane.
//!
//! From a start the search climbs from element centre to element centre and, between depths, by parabolas within a
//! bracket. Interpolation then places the peak between them. At depths less than an element's side the stresses show
//! the steps of the pressure, and only those under the centres count.

use std::collections::HashMap;

use pellicle_influence::{CentreStresses, Depth, InfluenceError, SubsurfaceState};
use rayon::prelude::*;

use super::field::{LoadedSquare, StressField};
use super::neighbourhood::Neighbourhood;
use super::quantity::StressQuantity;

/// Depths are bracketed to this part of the initial bracket, in at most this many trials.
const NARROW: f64 = 0.25;
const TRIALS: usize = 16;
/// Distance between the depths of an interpolation, as a part of the initial bracket.
const DEPTH_PART: f64 = 0.125;
/// Offsets tabulated beyond those needed initially, in elements.
const SLACK: usize = 16;
/// A climb ends at a distance of one side of the loaded square plus this many depths beside it.
const FARTHEST_DEPTHS: f64 = 4.0;
/// Number of moves after which the stride of a climb doubles, and the longest stride, in elements.
const PATIENCE: usize = 4;
const LONGEST_STRIDE: isize = 16;
/// The golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// A largest value and its place.
#[derive(Debug, Clone, Copy)]
pub struct StressPeak {
    /// Value, in Pa.
    pub value: f64,
    /// Place (x, y, z), in m.
    pub at: [f64; 3],
}

/// A search for the largest value of a quantity under one field.
pub struct PeakSearch<'a> {
    field: &'a StressField,
    quantity: StressQuantity,
    /// Depth range of the search, in m.
    range: [f64; 2],
    /// The plane used last.
    plane: Option<Plane>,
}

/// The stresses under the centres of elements at one depth.
struct Plane {
    depth: Option<Depth>,
    stresses: CentreStresses,
    /// States by the place of the element, counted from the first loaded one.
    known: HashMap<[isize; 2], SubsurfaceState>,
}

impl Plane {
    fn new(field: &StressField, offsets: usize) -> Self {
        let (foundation, side) = (field.tables().foundation(), field.grid().element_side());
        Self {
            depth: None,
            stresses: CentreStresses::new(foundation, side, offsets, field.tractions()),
            known: HashMap::new(),
        }
    }

    fn move_to(&mut self, depth: Depth) -> Result<(), InfluenceError> {
        if self.depth != Some(depth) {
            self.stresses.move_to(depth)?;
            self.known.clear();
            self.depth = Some(depth);
        }
        Ok(())
    }
}

impl<'a> PeakSearch<'a> {
    /// A search between two depths in one body.
    pub fn new(field: &'a StressField, quantity: StressQuantity, range: [f64; 2]) -> Self {
        Self {
            field,
            quantity,
            range,
            plane: None,
        }
    }

    /// Climbs from (x, y) and returns the value under the best centre reached.
    pub fn climb(&mut self, [x, y]: [f64; 2], z: f64) -> Result<StressPeak, InfluenceError> {
        let tried = self.tried(self.place([x, y]), z)?;
        Ok(StressPeak {
            value: tried.value,
            at: self.point(tried.place, z),
        })
    }

    /// Finds the largest value near (x, y) in the bracket of depths around `start`.
    pub fn peak(
        &mut self,
        [x, y]: [f64; 2],
        [before, start, after]: [f64; 3],
    ) -> Result<StressPeak, InfluenceError> {
        let first = self.tried(self.place([x, y]), start)?;
        let mut bracket = Bracket::around(first, [before, after]);
        for end in [before, after] {
            let tried = self.tried(first.place, end)?;
            bracket.take(tried);
        }
        for _ in 0..TRIALS {
            if bracket.is_narrow() {
                break;
            }
            let tried = self.tried(bracket.best[0].place, bracket.next())?;
            bracket.take(tried);
        }
        let DepthTrial { z, value, place } = bracket.best[0];
        let peak = StressPeak {
            value,
            at: self.point(place, z),
        };
        if z < self.field.grid().element_side() {
            return Ok(peak);
        }
        self.between_centres(peak, place, after - before)
    }

    /// Finds the peak between the element centres and the depths tried, starting from the best: its place by
    /// interpolation, its value by a sum over the loaded elements.
    fn between_centres(
        &mut self,
        start: StressPeak,
        place: [isize; 2],
        width: f64,
    ) -> Result<StressPeak, InfluenceError> {
        let [low, high] = self.range;
        let apart = (DEPTH_PART * width).min((high - low) / 2.0);
        let z = start.at[2].clamp(low + apart, high - apart);
        let depths = if apart > 0.0 {
            [z - apart, z, z + apart]
                .map(|z| z.clamp(low, high))
                .to_vec()
        } else {
            vec![z]
        };
        let mut around = Neighbourhood::new(depths);
        for index in 0..around.depths().len() {
            let z = around.depths()[index];
            let plane = self.plane_with(Neighbourhood::places(place).to_vec(), z)?;
            around.take(&Neighbourhood::places(place).map(|place| plane.known[&place]));
        }
        let offset = around.largest([0.0, 0.0, start.at[2]], |state| self.quantity.of(state));
        let side = self.field.grid().element_side();
        let at = [
            start.at[0] + offset[0] * side,
            start.at[1] + offset[1] * side,
            offset[2],
        ];
        let state = self.field.at([at[0], at[1]], self.depth(at[2]))?;
        let value = self.quantity.of(&state);
        Ok(if value > start.value {
            StressPeak { value, at }
        } else {
            start
        })
    }

    /// A depth in the body of the range.
    fn depth(&self, z: f64) -> Depth {
        if z < self.range[1] {
            Depth::below(z)
        } else {
            Depth::above(z)
        }
    }

    /// Climbs at a depth and returns the best value reached.
    fn tried(&mut self, start: [isize; 2], z: f64) -> Result<DepthTrial, InfluenceError> {
        // A compressive stress that decays away from the contact has no peak in tension.
        let size = self.field.loaded().size.cast_signed();
        let depth = z / self.field.grid().element_side();
        let margin = size + super::nearest((FARTHEST_DEPTHS * depth).ceil());
        let within = |along: isize| along.clamp(-margin, size + margin);
        let mut place = start.map(within);
        let (mut stride, mut moves) = (1, 0);
        loop {
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [i, j]));
            let around = around
                .map(|[i, j]| [place[0] + stride * i, place[1] + stride * j].map(within))
                .collect();
            let (value, best) = self.best_of(around, z)?;
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
                return Ok(DepthTrial { z, value, place });
            }
        }
    }

    /// The largest value under some centres; among equal ones, the middle centre takes precedence, then the first.
    fn best_of(
        &mut self,
        places: Vec<[isize; 2]>,
        z: f64,
    ) -> Result<(f64, [isize; 2]), InfluenceError> {
        let quantity = self.quantity;
        let middle = places[places.len() / 2];
        let plane = self.plane_with(places.clone(), z)?;
        let value = |place: [isize; 2]| quantity.of(&plane.known[&place]);
        let mut best = (value(middle), middle);
        for place in places {
            let value = value(place);
            if value > best.0 {
                best = (value, place);
            }
        }
        Ok(best)
    }

    /// Returns the plane at a depth, with the stresses under these centres computed.
    fn plane_with(&mut self, places: Vec<[isize; 2]>, z: f64) -> Result<&Plane, InfluenceError> {
        let LoadedSquare { size, pressure, .. } = self.field.loaded();
        let last = size.cast_signed() - 1;
        let farthest = places.iter().flatten();
        let farthest =
            farthest.map(|along| along.unsigned_abs().max((last - along).unsigned_abs()));
        let farthest = farthest.max().unwrap_or(0);
        let depth = self.depth(z);
        let reaches = |plane: &Plane| farthest < plane.stresses.offsets();
        let known = self.plane.take().filter(reaches);
        let mut plane =
            known.unwrap_or_else(|| Plane::new(self.field, farthest + farthest / 4 + SLACK));
        plane.move_to(depth)?;
        let missing = places
            .into_par_iter()
            .filter(|place| !plane.known.contains_key(place));
        let found: Vec<_> = missing
            .map(|place| (place, plane.stresses.at(pressure, *size, place)))
            .collect();
        plane.known.extend(found);
        Ok(self.plane.insert(plane))
    }

    /// The element nearest to a point, counted from the first loaded one.
    fn place(&self, point: [f64; 2]) -> [isize; 2] {
        let (grid, origin) = (self.field.grid(), self.field.loaded().origin);
        std::array::from_fn(|axis| {
            super::nearest((point[axis] - grid.centre(origin[axis])) / grid.element_side())
        })
    }

    fn point(&self, place: [isize; 2], z: f64) -> [f64; 3] {
        let (grid, origin) = (self.field.grid(), self.field.loaded().origin);
        let along =
            |axis: usize| grid.centre(origin[axis]) + place[axis] as f64 * grid.element_side();
        [along(0), along(1), z]
    }
}

/// A trial depth, with the best value there and its element.
#[derive(Clone, Copy)]
struct DepthTrial {
    z: f64,
    value: f64,
    place: [isize; 2],
}

/// Depths between which a peak lies.
struct Bracket {
    low: f64,
    high: f64,
    /// Initial width.
    width: f64,
    /// The best three trials, best first.
    best: [DepthTrial; 3],
}

impl Bracket {
    fn around(first: DepthTrial, [low, high]: [f64; 2]) -> Self {
        Self {
            low,
            high,
            width: high - low,
            best: [first; 3],
        }
    }

    fn is_narrow(&self) -> bool {
        self.high - self.low <= NARROW * self.width
    }

    /// Adds a trial and narrows the bracket with it.
    fn take(&mut self, tried: DepthTrial) {
        let [first, second, _] = self.best;
        if tried.value > first.value {
            // The previous best becomes an end.
            let end = if tried.z > first.z {
                &mut self.low
            } else {
                &mut self.high
            };
            *end = first.z;
            self.best = [tried, first, second];
            return;
        }
        let end = if tried.z > first.z {
            &mut self.high
        } else {
            &mut self.low
        };
        *end = tried.z;
        self.best = if tried.value > second.value {
            [first, tried, second]
        } else {
            [first, second, tried]
        };
    }

    /// The next depth to try: the vertex of the parabola through the best three, or the golden section of the wider
    /// side.
    fn next(&self) -> f64 {
        let (low, high, at) = (self.low, self.high, self.best[0].z);
        let margin = NARROW / 4.0 * self.width;
        let is_useful =
            |z: &f64| *z > low + margin && *z < high - margin && (z - at).abs() > margin;
        let golden = if at - low > high - at {
            at - GOLDEN * (at - low)
        } else {
            at + GOLDEN * (high - at)
        };
        vertex(self.best.map(|tried| [tried.z, tried.value]))
            .filter(is_useful)
            .unwrap_or(golden)
    }
}

/// The vertex of the parabola through three points (z, value), if it has a peak.
fn vertex([[a, fa], [b, fb], [c, fc]]: [[f64; 2]; 3]) -> Option<f64> {
    // With divided differences, f = fa + d (z − a) + e (z − a)(z − b).
    let d = (fb - fa) / (b - a);
    let e = ((fc - fb) / (c - b) - d) / (c - a);
    (e < 0.0)
        .then(|| 0.5 * (a + b) - 0.5 * d / e)
        .filter(|z| z.is_finite())
}

#[cfg(test)]
mod tests;
