//! The stresses that act along the surface, averaged over four points of an element, by sums over the loaded elements.
//!
//! Under element centres the surface stresses of a piecewise constant traction are first order in the element's side h:
//! the odd symbols of a traction alias with `Σ (−1)^m cos(2πm ξ/h)/m = −ln(2 cos(π ξ/h))` at the place ξ of an element,
//! so that `σ_xx` misses `(2 ln 2/π) h ∂q/∂x` at ξ = 0. At ξ = ±h/3 the sum vanishes, and the mean over the four points
//! (±h/3, ±h/3) is second order, under a pressure and under a traction alike.
//!
//! The mean of a closed form over the points is a sum over the corners of nine overlapping squares, whose coordinates
//! are whole numbers ± 1/6: four corners an element.

mod layers;

use layers::{LayerMeans, Means};
use pellicle_kernel::{Base, Foundation};
use rayon::prelude::*;

use super::centre_stresses::Line;
use super::homogeneous::surface_corners;
use super::parity::{UNDER_PRESSURE, under_traction};
use crate::element::check_element_side;
use crate::error::InfluenceError;

/// The fields `σ_xx`, `σ_yy`, `σ_xy` in the order of `SubsurfaceState`.
const ALONG_SURFACE: [usize; 3] = [3, 4, 6];
/// Those that replace them when x and y are exchanged.
const EXCHANGED: [usize; 3] = [1, 0, 2];

/// Three stresses at the offsets of a quarter, row by row.
type Tables = [Vec<f64>; 3];

/// `σ_xx`, `σ_yy`, `σ_xy` on the surface under unit pressure or unit traction on one element, averaged over four points
/// of another, and their sums over many.
#[derive(Clone, Debug)]
pub struct SurfaceMeans {
    offsets: usize,
    normal: Tables,
    along_x: Tables,
    along_y: Tables,
}

impl SurfaceMeans {
    /// Tabulates the means for elements of side `element_side` (m) at offsets below `offsets` along x and y.
    ///
    /// Accuracy: 1e-5 of the largest stress; under a pressure and a traction without layers, to rounding.
    ///
    /// # Errors
    /// A side that is not finite and positive; amplitudes that the kernel cannot compute.
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        offsets: usize,
    ) -> Result<Self, InfluenceError> {
        check_element_side(element_side)?;
        let nu = foundation.surface_material().poisson_ratio();
        let [mut normal, mut along_x] = homogeneous_means(nu, offsets);
        let is_homogeneous =
            foundation.layers().is_empty() && matches!(foundation.base(), Base::HalfSpace(_));
        if !is_homogeneous {
            let farthest = std::f64::consts::SQRT_2 * (offsets + 1) as f64;
            let layers = LayerMeans::new(foundation, element_side, farthest)?;
            add_layers([&mut normal, &mut along_x], &layers, offsets);
        }
        let along_y = EXCHANGED.map(|stress| transposed(&along_x[stress], offsets));
        Ok(Self {
            offsets,
            normal,
            along_x,
            along_y,
        })
    }

    /// Offsets along x and y.
    #[must_use]
    pub fn offsets(&self) -> usize {
        self.offsets
    }

    /// `σ_xx`, `σ_yy`, `σ_xy` at the element at `place`, counted from the first of a square of `size` × `size` loaded
    /// elements, under their pressures (Pa), row by row along x.
    ///
    /// # Panics
    /// If an element with pressure is farther away than the offsets.
    #[must_use]
    pub fn under_pressure(&self, pressure: &[f64], size: usize, place: [isize; 2]) -> [f64; 3] {
        let parities = ALONG_SURFACE.map(|field| UNDER_PRESSURE[field]);
        let mut sums = [0.0; 3];
        self.lines(pressure, size, place, |line| {
            for ((sum, table), parities) in sums.iter_mut().zip(&self.normal).zip(parities) {
                *sum += line.sum(table, parities);
            }
        });
        sums
    }

    /// The same under tractions of the pressures times `along`, a vector in the surface's plane.
    ///
    /// # Panics
    /// As [`Self::under_pressure`].
    #[must_use]
    pub fn under_traction(
        &self,
        pressure: &[f64],
        size: usize,
        place: [isize; 2],
        along: [f64; 2],
    ) -> [f64; 3] {
        let parities = ALONG_SURFACE.map(under_traction);
        let exchanged = EXCHANGED.map(|stress| {
            let [y, x] = parities[stress];
            [x, y]
        });
        let mut sums = [0.0; 3];
        self.lines(pressure, size, place, |line| {
            for (stress, sum) in sums.iter_mut().enumerate() {
                if along[0] != 0.0 {
                    *sum += along[0] * line.sum(&self.along_x[stress], parities[stress]);
                }
                if along[1] != 0.0 {
                    *sum += along[1] * line.sum(&self.along_y[stress], exchanged[stress]);
                }
            }
        });
        sums
    }

    /// Calls `take` with every row of loaded elements, as seen from a place.
    fn lines(&self, pressure: &[f64], size: usize, place: [isize; 2], mut take: impl FnMut(&Line)) {
        for (row, pressures) in pressure.chunks_exact(size).enumerate() {
            if let Some(line) = Line::of(pressures, row, place, self.offsets) {
                take(&line);
            }
        }
    }
}

/// The means on a half-space under a pressure and under a traction along x.
fn homogeneous_means(poisson_ratio: f64, offsets: usize) -> [Tables; 2] {
    // Corners at −5/6, −1/6, 1/6, 5/6, 7/6 …: those at 2m and 2m + 1 are below the offset m, the next two above it.
    let count = 2 * offsets + 2;
    let place = |index: usize| {
        (index / 2) as f64
            + if index.is_multiple_of(2) {
                -5.0 / 6.0
            } else {
                -1.0 / 6.0
            }
    };
    let row = |i: usize| -> Vec<_> {
        let columns = 0..=i;
        columns
            .map(|j| surface_corners(poisson_ratio, [place(i), place(j)]))
            .collect()
    };
    let octant: Vec<Vec<[[[f64; 3]; 2]; 2]>> = (0..count).into_par_iter().map(row).collect();
    let corner = |i: usize, j: usize| {
        if j <= i {
            &octant[i][j][0]
        } else {
            &octant[j][i][1]
        }
    };
    let mut means = [(); 2].map(|()| [(); 3].map(|()| Vec::with_capacity(offsets * offsets)));
    let signs = [-0.5, -0.5, 0.5, 0.5];
    for m in 0..offsets {
        for n in 0..offsets {
            let mut sums = [[0.0; 3]; 2];
            for (i, sign_x) in signs.iter().enumerate() {
                for (j, sign_y) in signs.iter().enumerate() {
                    let corner = corner(2 * m + i, 2 * n + j);
                    for (sums, values) in sums.iter_mut().zip(corner) {
                        for (sum, value) in sums.iter_mut().zip(values) {
                            *sum += sign_x * sign_y * value;
                        }
                    }
                }
            }
            for (tables, sums) in means.iter_mut().zip(sums) {
                for (table, sum) in tables.iter_mut().zip(sums) {
                    table.push(sum);
                }
            }
        }
    }
    means
}

/// Adds what the layers change, or replaces the values where only the whole is known.
fn add_layers(tables: [&mut Tables; 2], layers: &LayerMeans, offsets: usize) {
    let row = |m: usize| -> Vec<Means> {
        let columns = 0..=m;
        columns.map(|n| layers.at([m as f64, n as f64])).collect()
    };
    let octant: Vec<Vec<Means>> = (0..offsets).into_par_iter().map(row).collect();
    let kept = if layers.are_added() { 1.0 } else { 0.0 };
    for (tables, load) in tables.into_iter().zip(0..) {
        for (m, row) in octant.iter().enumerate() {
            for (n, means) in row.iter().enumerate() {
                let places = [m * offsets + n, n * offsets + m];
                // A place on the diagonal is its own image.
                let count = if m == n { 1 } else { 2 };
                for (place, values) in places.into_iter().zip(means[load]).take(count) {
                    for (table, value) in tables.iter_mut().zip(values) {
                        table[place] = kept * table[place] + value;
                    }
                }
            }
        }
    }
}

/// A table with its axes exchanged.
fn transposed(table: &[f64], size: usize) -> Vec<f64> {
    (0..size * size)
        .map(|index| table[index % size * size + index / size])
        .collect()
}

#[cfg(test)]
mod tests;
