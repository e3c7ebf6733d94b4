//! Stresses around a place, interpolated from those at its neighbours on a square lattice at a few depths.

use nalgebra::{Matrix3, Vector3};
use pellicle_influence::SubsurfaceState;

/// Centres along a side, at whole offsets from −2 to 2 elements, and the most depths.
pub const SIDE: usize = 5;
pub const OFFSETS: [f64; SIDE] = [-2.0, -1.0, 0.0, 1.0, 2.0];
const CENTRES: usize = SIDE * SIDE;
/// Side of the first stencil of a quadratic, in elements and in distances between the depths, and of the smallest one.
const STENCIL: f64 = 0.25;
const SMALLEST: f64 = 0.01;
/// Farthest offset from the middle, in elements.
const FARTHEST: f64 = 1.0;

/// The stresses around a centre.
pub struct Neighbourhood {
    /// At most [`SIDE`].
    depths: Vec<f64>,
    /// Stresses at each depth, row by row.
    stresses: Vec<[[f64; 6]; CENTRES]>,
}

impl Neighbourhood {
    /// An empty neighbourhood at some depths, from the top down.
    pub fn new(depths: Vec<f64>) -> Self {
        Self {
            depths,
            stresses: Vec::new(),
        }
    }

    /// The elements whose stresses are needed around an element.
    pub fn places([i, j]: [isize; 2]) -> [[isize; 2]; CENTRES] {
        let reach = (SIDE / 2).cast_signed();
        std::array::from_fn(|index| {
            let [row, column] = [index / SIDE, index % SIDE].map(usize::cast_signed);
            [i + row - reach, j + column - reach]
        })
    }

    /// Adds the stresses at the next depth.
    pub fn take(&mut self, states: &[SubsurfaceState; CENTRES]) {
        self.stresses.push(states.map(|state| state.stress));
    }

    /// Finds the place (x and y in elements from the middle, z in m) near `start` where a quantity is largest.
    pub fn largest(&self, start: [f64; 3], quantity: impl Fn(&SubsurfaceState) -> f64) -> [f64; 3] {
        let [low, high] = [self.depths[0], self.depths[self.depths.len() - 1]];
        let value = |at: [f64; 3]| quantity(&self.state(at));
        let (mut at, mut largest) = (start, value(start));
        let mut size = STENCIL;
        while size >= SMALLEST {
            let sides = [size, size, size * (high - low) / 2.0];
            let cube: Vec<([f64; 3], f64)> = stencil(self.depths.len() > 1)
                .map(|offset| (offset, value(moved(at, offset, sides))))
                .collect();
            let plane: Vec<_> = cube
                .iter()
                .copied()
                .filter(|(at, _)| at[2] == 0.0)
                .collect();
            let best = cube.iter().max_by(|one, other| one.1.total_cmp(&other.1));
            // The vertex within the plane is the peak where the depth is at its bound.
            let steps = [
                best.map(|(offset, _)| *offset),
                quadratic(&cube),
                quadratic(&plane),
            ];
            let within = |step: [f64; 3]| {
                let [u, v, z] = moved(at, step, sides);
                let along = |part: f64| part.clamp(-FARTHEST, FARTHEST);
                [along(u), along(v), z.clamp(low, high)]
            };
            let reached = steps
                .into_iter()
                .flatten()
                .map(within)
                .map(|at| (value(at), at));
            let next = reached.max_by(|one, other| one.0.total_cmp(&other.0));
            match next {
                Some((reached, place)) if reached > largest => (at, largest) = (place, reached),
                _ => size /= 4.0,
            }
        }
        at
    }

    /// The stress at a place, by Lagrange's polynomials.
    pub fn state(&self, [u, v, z]: [f64; 3]) -> SubsurfaceState {
        let [along_x, along_y] = [u, v].map(|along| lagrange(&OFFSETS, along));
        let in_depth = lagrange(&self.depths, z);
        let mut sums = [0.0; 6];
        for (plane, of_depth) in self.stresses.iter().zip(in_depth) {
            for (row, of_row) in plane.chunks_exact(SIDE).zip(along_x) {
                for (stresses, of_column) in row.iter().zip(along_y) {
                    let weight = of_depth * of_row * of_column;
                    for (sum, stress) in sums.iter_mut().zip(stresses) {
                        *sum += weight * stress;
                    }
                }
            }
        }
        SubsurfaceState {
            displacement: [0.0; 3],
            stress: sums,
        }
    }
}

/// The weights at `x` of the values at some nodes, at most [`SIDE`], in the polynomial through them.
pub fn lagrange(nodes: &[f64], x: f64) -> [f64; SIDE] {
    let mut weights = [0.0; SIDE];
    for (j, (weight, node)) in weights.iter_mut().zip(nodes).enumerate() {
        *weight = 1.0;
        for (m, other) in nodes.iter().enumerate() {
            if m != j {
                *weight *= (x - other) / (node - other);
            }
        }
    }
    weights
}

/// Offsets of a stencil, in units of its sides: a cube without its corners, or a square.
fn stencil(is_cube: bool) -> impl Iterator<Item = [f64; 3]> {
    let side = [-1.0, 0.0, 1.0];
    let all = side
        .into_iter()
        .flat_map(move |u| side.into_iter().flat_map(move |v| side.map(|w| [u, v, w])));
    all.filter(move |[u, v, w]| if is_cube { u * v * w == 0.0 } else { *w == 0.0 })
}

fn moved(from: [f64; 3], offset: [f64; 3], sides: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| from[axis] + offset[axis] * sides[axis])
}

/// The step to the vertex of the quadratic through the values of a stencil; none if it has no peak.
fn quadratic(values: &[([f64; 3], f64)]) -> Option<[f64; 3]> {
    let at = |offset: [f64; 3]| {
        let is_there =
            |place: &[f64; 3]| place.iter().zip(offset).all(|(a, b)| (a - b).abs() < 0.5);
        let found = values.iter().find(|(place, _)| is_there(place));
        found.map(|(_, value)| *value)
    };
    let middle = at([0.0; 3])?;
    let offset = |along: &[(usize, f64)]| {
        let mut offset = [0.0; 3];
        along.iter().for_each(|(axis, part)| offset[*axis] = *part);
        offset
    };
    let axes = if at([0.0, 0.0, 1.0]).is_some() { 3 } else { 2 };
    let mut gradient = Vector3::zeros();
    // Minus the matrix of second derivatives.
    let mut curvature = Matrix3::identity();
    for i in 0..axes {
        let [before, after] = [at(offset(&[(i, -1.0)]))?, at(offset(&[(i, 1.0)]))?];
        gradient[i] = 0.5 * (after - before);
        curvature[(i, i)] = 2.0 * middle - after - before;
        for j in 0..i {
            let corner = |one, other| at(offset(&[(i, one), (j, other)]));
            let rising = corner(1.0, 1.0)? + corner(-1.0, -1.0)?;
            let falling = corner(1.0, -1.0)? + corner(-1.0, 1.0)?;
            curvature[(i, j)] = 0.25 * (falling - rising);
            curvature[(j, i)] = curvature[(i, j)];
        }
    }
    // −H s = g; at a peak −H is positive definite.
    Some(curvature.cholesky()?.solve(&gradient).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vertex_of_a_quadratic_is_recovered_in_three_and_two_dimensions() {
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
        let step = quadratic(&all).unwrap();
        assert!(
            (0..3).all(|i| (step[i] - vertex[i]).abs() < 1e-13),
            "{step:?}"
        );
        let plane: Vec<_> = all.iter().copied().filter(|(at, _)| at[2] == 0.0).collect();
        let step = quadratic(&plane).unwrap();
        assert!(step[2] == 0.0 && step[0] != 0.0, "{step:?}");
        let saddle: Vec<_> = all.iter().map(|(at, _)| (*at, at[0] * at[1])).collect();
        assert!(quadratic(&saddle).is_none());
    }

    /// The stresses `σ_zz` around a centre at some depths.
    fn around(depths: &[f64], stress: impl Fn([f64; 3]) -> f64) -> Neighbourhood {
        let mut around = Neighbourhood::new(depths.to_vec());
        for z in depths {
            let states = Neighbourhood::places([0, 0]).map(|[i, j]| {
                let mut state = SubsurfaceState::default();
                state.stress[2] = stress([i as f64, j as f64, *z]);
                state
            });
            around.take(&states);
        }
        around
    }

    #[track_caller]
    fn assert_near(found: [f64; 3], wanted: [f64; 3]) {
        // The last stencil is a hundredth wide, and terms beyond the quadratic move its vertex by less than a tenth of
        // that.
        let is_near = (0..3).all(|i| (found[i] - wanted[i]).abs() < 1e-3);
        assert!(is_near, "{found:?} {wanted:?}");
    }

    #[test]
    fn the_peak_of_a_polynomial_is_found_between_centres_and_depths() {
        // Of fourth degree in the plane and second in depth, which the interpolation reproduces exactly.
        let wanted = [0.37, -0.81, 1.56];
        let stress = |at: [f64; 3]| {
            let [u, v, z] = std::array::from_fn(|axis| at[axis] - wanted[axis]);
            4.0 - u.powi(4) - u * u - v.powi(4) - 0.5 * v * v - 2.0 * z * z - 0.3 * u * v
        };
        let found = around(&[1.0, 1.5, 2.0], stress);
        for start in [[0.0, 0.0, 1.5], [0.0, 0.0, 1.0], [-1.0, 1.0, 2.0]] {
            assert_near(found.largest(start, |state| state.stress[2]), wanted);
        }
        // With one depth the peak is that of the plane.
        let found = around(&[1.56], stress).largest([0.0, 0.0, 1.56], |state| state.stress[2]);
        assert_near(found, wanted);
    }

    #[test]
    fn the_search_for_a_peak_stops_at_the_ends_of_the_element_and_the_depths() {
        let stress = |[u, v, z]: [f64; 3]| 4.0 - (u - 1.6).powi(2) - (v + 0.4).powi(2) - z * z;
        let found = around(&[1.0, 1.5, 2.0], stress);
        let found = found.largest([0.0, 0.0, 1.5], |state| state.stress[2]);
        assert_near(found, [1.0, -0.4, 1.0]);
    }

    #[test]
    fn neighbouring_centres_form_a_square_listed_row_by_row() {
        let places = Neighbourhood::places([3, -1]);
        assert_eq!(
            [places[0], places[1], places[12], places[24]],
            [[1, -3], [1, -2], [3, -1], [5, 1]]
        );
    }
}
