//! The largest value of a quantity near a point, in depth and plane.
//!
//! From a start the search climbs from element centre to element centre and, between depths, by parabolas within a
//! bracket. A quadratic through the neighbours then places the peak between the centres. Above one element's side the
//! stresses show the steps of the pressure, and only those under the centres count.

use std::collections::HashMap;

use pellicle_influence::{CentreFields, Depth, ElementFields, InfluenceError};
use rayon::prelude::*;

use super::field::{LoadedSquare, StressField};
use super::quantity::Quantity;

/// Depths are bracketed to this part of the bracket's first width.
const NARROW: f64 = 0.02;
/// Depths tried, at most.
const TRIALS: usize = 24;
/// Quadratics through points between the centres, at most, and the side of their stencils in elements.
const QUADRATICS: usize = 4;
const STENCIL: f64 = 0.5;
/// A quadratic that foretells the value to this part of it is near enough.
const FORETOLD: f64 = 1e-5;
/// Offsets tabulated beyond those needed at first, in elements.
const SLACK: usize = 16;
/// The golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// A largest value and its place.
#[derive(Debug, Clone, Copy)]
pub struct Peak {
    /// In Pa.
    pub value: f64,
    /// (x, y, z), in m.
    pub at: [f64; 3],
}

/// A search for the largest value of a quantity under one field.
pub struct Search<'a> {
    field: &'a StressField,
    quantity: Quantity,
    /// Depths that the search keeps to, in m.
    range: [f64; 2],
    /// The depth looked at last.
    plane: Option<Plane>,
}

/// The values of a quantity under the centres of elements at one depth.
struct Plane {
    z: f64,
    fields: CentreFields,
    /// By the place of the element, counted from the first loaded one.
    known: HashMap<[isize; 2], f64>,
}

impl<'a> Search<'a> {
    /// A search between two depths, which lie in one body.
    pub fn new(field: &'a StressField, quantity: Quantity, range: [f64; 2]) -> Self {
        Self {
            field,
            quantity,
            range,
            plane: None,
        }
    }

    /// The value under the best centre that climbing from (x, y) leads to.
    pub fn climb(&mut self, [x, y]: [f64; 2], z: f64) -> Result<Peak, InfluenceError> {
        let place = self.place([x, y]);
        let (value, place) = self.climb_from(place, z)?;
        Ok(Peak {
            value,
            at: self.point(place, z),
        })
    }

    /// The largest value near (x, y) in the bracket of depths around `start`.
    pub fn peak(
        &mut self,
        [x, y]: [f64; 2],
        [before, start, after]: [f64; 3],
    ) -> Result<Peak, InfluenceError> {
        let [mut low, mut high] = [before, after];
        let width = high - low;
        let (value, place) = self.climb_from(self.place([x, y]), start)?;
        // The best three depths so far, best first.
        let mut best = [(start, value, place); 3];
        for end in [low, high] {
            let (value, place) = self.climb_from(place, end)?;
            if value > best[0].1 {
                best.rotate_right(1);
                best[0] = (end, value, place);
            } else {
                best[2] = (end, value, place);
                best.swap(1, 2);
            }
        }
        for _ in 0..TRIALS {
            let at = best[0].0;
            if high - low <= NARROW * width {
                break;
            }
            let golden = if at - low > high - at {
                at - GOLDEN * (at - low)
            } else {
                at + GOLDEN * (high - at)
            };
            let margin = NARROW / 4.0 * width;
            let is_useful =
                |z: &f64| *z > low + margin && *z < high - margin && (z - at).abs() > margin;
            let trial = vertex(best.map(|(z, value, _)| [z, value]))
                .filter(is_useful)
                .unwrap_or(golden);
            let (value, place) = self.climb_from(best[0].2, trial)?;
            if value > best[0].1 {
                if trial > at {
                    low = at
                } else {
                    high = at
                }
                best = [(trial, value, place), best[0], best[1]];
            } else {
                if trial > at {
                    high = trial
                } else {
                    low = trial
                }
                let second = (trial, value, place);
                best = if value > best[1].1 {
                    [best[0], second, best[1]]
                } else {
                    [best[0], best[1], second]
                };
            }
        }
        let (z, value, place) = best[0];
        let peak = Peak {
            value,
            at: self.point(place, z),
        };
        if z < self.field.grid().element_side() {
            return Ok(peak);
        }
        self.between_centres(peak)
    }

    /// The peak between the element centres, from the best of them.
    fn between_centres(&self, start: Peak) -> Result<Peak, InfluenceError> {
        let side = STENCIL * self.field.grid().element_side();
        let mut best = start;
        for _ in 0..QUADRATICS {
            let middle = self.stencil_middle(best.at, side);
            let values = self.stencil(middle, side)?;
            for (offset, value) in &values {
                if *value > best.value {
                    best = Peak {
                        value: *value,
                        at: moved(middle, *offset, side),
                    };
                }
            }
            let Some((step, foretold)) = quadratic(&values) else {
                continue;
            };
            let mut at = moved(middle, step, side);
            at[2] = at[2].clamp(self.range[0], self.range[1]);
            let value = self.value_at(at)?;
            if value > best.value {
                best = Peak { value, at };
            }
            if (value - foretold).abs() <= FORETOLD * value.abs() {
                break;
            }
        }
        Ok(best)
    }

    /// The middle of a stencil around a point, all of it within the range of depths where that is wide enough.
    fn stencil_middle(&self, [x, y, z]: [f64; 3], side: f64) -> [f64; 3] {
        let [low, high] = self.range;
        let z = if high - low > 2.0 * side {
            z.clamp(low + side, high - side)
        } else {
            z
        };
        [x, y, z]
    }

    /// The values around a point, by the offsets in sides of the stencil: in the plane alone where the range of depths
    /// is too narrow.
    fn stencil(
        &self,
        [x, y, z]: [f64; 3],
        side: f64,
    ) -> Result<Vec<([f64; 3], f64)>, InfluenceError> {
        const PLANE: [[f64; 2]; 9] = [
            [0.0, 0.0],
            [-1.0, 0.0],
            [1.0, 0.0],
            [0.0, -1.0],
            [0.0, 1.0],
            [-1.0, -1.0],
            [-1.0, 1.0],
            [1.0, -1.0],
            [1.0, 1.0],
        ];
        let mut values = Vec::new();
        let [low, high] = self.range;
        for (layer, offsets) in [(0.0, &PLANE[..]), (-1.0, &PLANE[..5]), (1.0, &PLANE[..5])] {
            if layer != 0.0 && high - low <= 2.0 * side {
                continue;
            }
            let points: Vec<[f64; 2]> = offsets
                .iter()
                .map(|[u, v]| [x + u * side, y + v * side])
                .collect();
            let states = self
                .field
                .at_points(&points, self.depth(z + layer * side))?;
            let of_layer = offsets.iter().zip(states);
            values.extend(
                of_layer.map(|([u, v], state)| ([*u, *v, layer], self.quantity.of(&state))),
            );
        }
        Ok(values)
    }

    fn value_at(&self, [x, y, z]: [f64; 3]) -> Result<f64, InfluenceError> {
        let state = self.field.at([x, y], self.depth(z))?;
        Ok(self.quantity.of(&state))
    }

    /// A depth in the body of the range.
    fn depth(&self, z: f64) -> Depth {
        if z < self.range[1] {
            Depth::below(z)
        } else {
            Depth::above(z)
        }
    }

    /// The best value that climbing leads to, and its place.
    fn climb_from(
        &mut self,
        start: [isize; 2],
        z: f64,
    ) -> Result<(f64, [isize; 2]), InfluenceError> {
        let mut place = start;
        loop {
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [i, j]));
            let around = around.map(|[i, j]| [place[0] + i, place[1] + j]).collect();
            let best = self.best_of(around, z)?;
            if best.1 == place {
                return Ok(best);
            }
            place = best.1;
        }
    }

    /// The largest value under some centres; of equal ones the first.
    fn best_of(
        &mut self,
        places: Vec<[isize; 2]>,
        z: f64,
    ) -> Result<(f64, [isize; 2]), InfluenceError> {
        let LoadedSquare { size, pressure, .. } = self.field.loaded();
        let farthest = places.iter().flatten().map(|along| {
            along
                .unsigned_abs()
                .max((size.cast_signed() - 1 - along).unsigned_abs())
        });
        let farthest = farthest.max().unwrap_or(0);
        let known = self
            .plane
            .take_if(|plane| plane.z == z && farthest < plane.fields.offsets());
        let plane = match known {
            Some(plane) => plane,
            None => self.plane_at(z, farthest + SLACK)?,
        };
        let plane = self.plane.insert(plane);
        let quantity = self.quantity;
        let missing = places
            .par_iter()
            .filter(|place| !plane.known.contains_key(*place));
        let values: Vec<_> = missing
            .map(|place| {
                (
                    *place,
                    quantity.of(&plane.fields.at(pressure, *size, *place)),
                )
            })
            .collect();
        plane.known.extend(values);
        let mut best = (f64::NEG_INFINITY, places[0]);
        // The middle first, so that it keeps its place among equals.
        let middle = places.len() / 2;
        for place in std::iter::once(&places[middle]).chain(&places) {
            let value = plane.known[place];
            if value > best.0 {
                best = (value, *place);
            }
        }
        Ok(best)
    }

    fn plane_at(&self, z: f64, offsets: usize) -> Result<Plane, InfluenceError> {
        let mut fields = CentreFields::new(offsets, self.field.tractions());
        let side = self.field.grid().element_side();
        let foundation = self.field.tables().foundation();
        fields.fill(&ElementFields::new(
            foundation,
            side,
            self.depth(z),
            fields.reach(side),
        )?);
        Ok(Plane {
            z,
            fields,
            known: HashMap::new(),
        })
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

/// A point by its offset from another, in sides of a stencil.
fn moved(from: [f64; 3], offset: [f64; 3], side: f64) -> [f64; 3] {
    std::array::from_fn(|axis| from[axis] + offset[axis] * side)
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

/// The step to the vertex of the quadratic through the values of a stencil, and its height; none where it has no peak
/// within twice the stencil.
fn quadratic(values: &[([f64; 3], f64)]) -> Option<([f64; 3], f64)> {
    let at = |offset: [f64; 3]| {
        let found = values.iter().find(|(place, _)| *place == offset);
        found.map(|(_, value)| *value)
    };
    let middle = at([0.0; 3])?;
    let unit = |axis: usize, sign: f64| {
        let mut offset = [0.0; 3];
        offset[axis] = sign;
        offset
    };
    let axes = if at(unit(2, 1.0)).is_some() { 3 } else { 2 };
    let mut gradient = [0.0; 3];
    let mut hessian = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
    for i in 0..axes {
        let [before, after] = [at(unit(i, -1.0))?, at(unit(i, 1.0))?];
        gradient[i] = 0.5 * (after - before);
        hessian[i][i] = after - 2.0 * middle + before;
        for j in 0..i {
            let corner = |one: f64, other: f64| {
                let mut offset = unit(i, one);
                offset[j] = other;
                at(offset)
            };
            let mixed =
                corner(1.0, 1.0)? - corner(1.0, -1.0)? - corner(-1.0, 1.0)? + corner(-1.0, -1.0)?;
            (hessian[i][j], hessian[j][i]) = (0.25 * mixed, 0.25 * mixed);
        }
    }
    let step = descend(hessian, gradient)?;
    let rise: f64 = step
        .iter()
        .zip(gradient)
        .map(|(step, slope)| 0.5 * step * slope)
        .sum();
    step.iter()
        .all(|part| part.abs() <= 2.0)
        .then_some((step, middle + rise))
}

/// The solution of `−H s = g`, if −H is positive definite: by its Cholesky factor.
fn descend(hessian: [[f64; 3]; 3], gradient: [f64; 3]) -> Option<[f64; 3]> {
    let mut factor = [[0.0; 3]; 3];
    let mut forward = [0.0; 3];
    for i in 0..3 {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = -hessian[i][j] - known;
            if i > j {
                factor[i][j] = rest / factor[j][j];
            } else if rest > 0.0 {
                factor[i][i] = rest.sqrt();
            } else {
                return None;
            }
        }
        let known: f64 = (0..i).map(|k| factor[i][k] * forward[k]).sum();
        forward[i] = (gradient[i] - known) / factor[i][i];
    }
    let mut step = [0.0; 3];
    for i in (0..3).rev() {
        let known: f64 = (i + 1..3).map(|k| factor[k][i] * step[k]).sum();
        step[i] = (forward[i] - known) / factor[i][i];
    }
    Some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadratic_returns_its_vertex_in_three_axes_and_in_two() {
        let vertex = [0.31, -0.44, 0.2];
        let value = |at: [f64; 3]| {
            let [x, y, z] = std::array::from_fn(|axis| at[axis] - vertex[axis]);
            9.0 - 2.0 * x * x - 0.7 * x * y - y * y - 1.5 * z * z + 0.4 * x * z - 0.3 * y * z
        };
        let axis = [-1.0, 0.0, 1.0];
        let all: Vec<_> = axis
            .iter()
            .flat_map(|x| axis.iter().flat_map(move |y| axis.map(|z| [*x, *y, z])))
            .map(|at| (at, value(at)))
            .collect();
        let (step, height) = quadratic(&all).unwrap();
        assert!((height - 9.0).abs() < 1e-13, "{height}");
        assert!(
            (0..3).all(|i| (step[i] - vertex[i]).abs() < 1e-13),
            "{step:?}"
        );
        let plane: Vec<_> = all.iter().copied().filter(|(at, _)| at[2] == 0.0).collect();
        let (step, height) = quadratic(&plane).unwrap();
        assert!(step[2] == 0.0 && height < 9.0, "{step:?} {height}");
        let saddle: Vec<_> = all.iter().map(|(at, _)| (*at, at[0] * at[1])).collect();
        assert!(quadratic(&saddle).is_none());
    }

    #[test]
    fn a_parabola_returns_its_vertex() {
        let value = |z: f64| 3.0 - 2.0 * (z - 0.7).powi(2);
        let found = vertex([0.1, 0.5, 2.0].map(|z| [z, value(z)])).unwrap();
        assert!((found - 0.7).abs() < 1e-14, "{found}");
        assert!(vertex([0.1, 0.5, 2.0].map(|z| [z, -value(z)])).is_none());
    }
}
