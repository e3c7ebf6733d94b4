//! A measured height map and the surface between its samples.

use rayon::prelude::*;

use crate::error::{Quantity, TextureError, positive};
use crate::interpolation::{Interpolation, Stencil};
use crate::step_limit::StepLimit;

/// Rounding error of a position, in samples, for a map of one sample.
const ON_A_SAMPLE: f64 = 4.0 * f64::EPSILON;

/// Heights (m) measured at the centres of `shape[0]` × `shape[1]` equal pixels that fill a rectangle centred on the
/// origin.
///
/// Sample `(i, j)` has the index `i * shape[1] + j` and stands at `x_i = (i + ½) w_x − L_x/2`,
/// `y_j = (j + ½) w_y − L_y/2`, where `L` is the extent and `w = L / shape` a pixel: the layout of a
/// [`Grid`](crate::Grid), and that of the usual instrument files.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    heights: Vec<f64>,
    shape: [usize; 2],
    extent: [f64; 2],
    interpolation: Interpolation,
    /// Limits beside steps, for bicubic interpolation.
    step_limit: Option<StepLimit>,
    /// Samples at each end of x and of y that only repeat those of the other side; 0 for a map that does not repeat.
    pub(crate) rim: [usize; 2],
}

impl HeightMap {
    /// Builds a map of `shape[0] * shape[1]` heights (m, above any plane) over a rectangle of sides `extent` (m), with
    /// bicubic interpolation.
    ///
    /// # Errors
    ///
    /// [`TextureError::MapShape`] if the number of heights is not the product of the shape or is zero,
    /// [`TextureError::NotPositive`] if a side of the extent is not positive and finite, [`TextureError::MapSample`] if
    /// a height is NaN or infinite.
    pub fn new(
        heights: Vec<f64>,
        shape: [usize; 2],
        extent: [f64; 2],
    ) -> Result<Self, TextureError> {
        let [rows, columns] = shape;
        if heights.is_empty() || rows.checked_mul(columns) != Some(heights.len()) {
            return Err(TextureError::MapShape {
                shape,
                found: heights.len(),
            });
        }
        for side in extent {
            positive(Quantity::Extent, side)?;
        }
        match heights.iter().position(|height| !height.is_finite()) {
            Some(n) => Err(TextureError::MapSample {
                index: [n / columns, n % columns],
                found: heights[n],
            }),
            None => Ok(Self {
                step_limit: StepLimit::of(&heights, shape),
                heights,
                shape,
                extent,
                interpolation: Interpolation::default(),
                rim: [0; 2],
            }),
        }
    }

    /// Returns the same samples with another interpolation.
    #[must_use]
    pub fn with_interpolation(self, interpolation: Interpolation) -> Self {
        Self {
            interpolation,
            ..self
        }
    }

    /// The same map with other finite heights, m.
    pub(crate) fn with_heights(self, heights: Vec<f64>) -> Self {
        debug_assert_eq!(heights.len(), self.heights.len());
        Self {
            step_limit: StepLimit::of(&heights, self.shape),
            heights,
            ..self
        }
    }

    /// The interpolation between the samples.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The samples as given, m.
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Samples along x and along y.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Sides of the rectangle along x and along y, m.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        self.extent
    }

    /// The smallest sample, m.
    pub(crate) fn least(&self) -> f64 {
        self.heights.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The largest sample, m.
    pub(crate) fn greatest(&self) -> f64 {
        self.heights
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether the point (m) lies in the rectangle of the map, its rim included.
    #[must_use]
    pub fn covers(&self, [x, y]: [f64; 2]) -> bool {
        x.abs() <= 0.5 * self.extent[0] && y.abs() <= 0.5 * self.extent[1]
    }

    /// Distance from the point to the border of the map's rectangle, m: positive inside, negative outside.
    #[must_use]
    pub fn distance_to_border(&self, [x, y]: [f64; 2]) -> f64 {
        let [along_x, along_y] = [
            0.5 * self.extent[0] - x.abs(),
            0.5 * self.extent[1] - y.abs(),
        ];
        if along_x < 0.0 && along_y < 0.0 {
            -along_x.hypot(along_y)
        } else {
            along_x.min(along_y)
        }
    }

    /// Distance from the point to the nearest line of samples along which the surface has a ridge, m: infinite where
    /// the interpolation is smooth. A bicubic surface has ridges where it is limited beside a step.
    #[must_use]
    pub fn distance_to_ridge(&self, point: [f64; 2]) -> f64 {
        if self.interpolation == Interpolation::Bicubic && !self.is_limited(self.cell(point)) {
            return f64::INFINITY;
        }
        let along = |axis: usize| {
            let pixel = self.extent[axis] / self.shape[axis] as f64;
            let (_, _, part) = self.bracket(axis, point[axis]);
            pixel * part.min(1.0 - part)
        };
        along(0).min(along(1))
    }

    /// Height at a point (m) by the map's interpolation. Beyond the outermost samples, it is the height of the nearest
    /// point among them.
    #[must_use]
    pub fn height(&self, point: [f64; 2]) -> f64 {
        match self.interpolation {
            Interpolation::Bicubic => self.bicubic(point),
            Interpolation::Linear => self.bilinear(point),
        }
    }

    fn bicubic(&self, point: [f64; 2]) -> f64 {
        let [along_x, along_y] = [0, 1].map(|axis| self.stencil(axis, point[axis]));
        let height = self.weighed([&along_x, &along_y]);
        self.limited(height, self.cell(point))
    }

    /// The cell of a point (m), by its first sample.
    fn cell(&self, point: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| self.bracket(axis, point[axis]).0)
    }

    /// The point (m) at this place in the cell whose first corner is a sample.
    pub(crate) fn point_in_cell(&self, first: [usize; 2], at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.coordinate(axis, first[axis]) + at[axis] * self.pixel()[axis])
    }

    /// Whether a step nearby limits a bicubic surface in the cell whose first corner is this sample.
    pub(crate) fn is_limited(&self, first: [usize; 2]) -> bool {
        (self.step_limit.as_ref()).is_some_and(|limit| limit.limits(first))
    }

    /// A height of the bicubic surface in a cell, within its limits beside a step.
    fn limited(&self, height: f64, first: [usize; 2]) -> f64 {
        match &self.step_limit {
            Some(limit) if limit.limits(first) => {
                let [least, most] = limit.range(&self.heights, first);
                height.max(least).min(most)
            }
            _ => height,
        }
    }

    /// The samples along an axis on which the height at a coordinate depends: a single one where the coordinate is that
    /// of a sample up to rounding.
    fn stencil(&self, axis: usize, coordinate: f64) -> Stencil {
        let samples = self.shape[axis];
        let (before, after, t) = self.bracket(axis, coordinate);
        let rounding = ON_A_SAMPLE * samples as f64;
        if t > 1.0 - rounding {
            Stencil::cubic(after, 0.0, samples)
        } else if t < rounding {
            Stencil::cubic(before, 0.0, samples)
        } else {
            Stencil::cubic(before, t, samples)
        }
    }

    /// Heights (m) at the crossings of lines of constant x and lines of constant y, given by their coordinates (m), row
    /// by row. They equal the heights at the single points to the last bit.
    pub(crate) fn at_crossings(&self, [x, y]: [&[f64]; 2]) -> Vec<f64> {
        let mut heights = vec![0.0; x.len() * y.len()];
        let rows = heights.par_chunks_exact_mut(y.len()).zip(x);
        if self.interpolation == Interpolation::Linear {
            rows.for_each(|(row, x)| {
                let places = row.iter_mut().zip(y);
                places.for_each(|(height, y)| *height = self.bilinear([*x, *y]));
            });
            return heights;
        }
        let along_y: Vec<Stencil> = y.iter().map(|y| self.stencil(1, *y)).collect();
        rows.for_each_init(Vec::new, |line, (row, x)| {
            self.line_into(&self.stencil(0, *x), line);
            for (height, stencil) in row.iter_mut().zip(&along_y) {
                let terms = stencil.terms().map(|(j, weight)| weight * line[j]);
                *height = terms.sum();
            }
            if self.step_limit.is_some() {
                let places = row.iter_mut().zip(y);
                places.for_each(|(height, y)| *height = self.limited(*height, self.cell([*x, *y])));
            }
        });
        heights
    }

    /// Interpolates along x and writes the heights of the samples along y.
    fn line_into(&self, along_x: &Stencil, line: &mut Vec<f64>) {
        let columns = self.shape[1];
        line.clear();
        // −0 is what an empty sum gives, so the bits are those of a sum.
        line.resize(columns, -0.0);
        for (i, weight) in along_x.terms() {
            let samples = &self.heights[i * columns..][..columns];
            let sums = line.iter_mut().zip(samples);
            sums.for_each(|(sum, sample)| *sum += weight * sample);
        }
    }

    /// The sum of the heights, weighted along both axes.
    fn weighed(&self, [along_x, along_y]: [&Stencil; 2]) -> f64 {
        let column = |j: usize| {
            along_x
                .terms()
                .map(|(i, weight)| weight * self.heights[i * self.shape[1] + j])
                .sum::<f64>()
        };
        along_y.terms().map(|(j, weight)| weight * column(j)).sum()
    }

    fn bilinear(&self, point: [f64; 2]) -> f64 {
        let [(i0, i1, u), (j0, j1, v)] = [0, 1].map(|axis| self.bracket(axis, point[axis]));
        let sample = |i: usize, j: usize| self.heights[i * self.shape[1] + j];
        let along_y = |i: usize| (1.0 - v) * sample(i, j0) + v * sample(i, j1);
        let interpolated = (1.0 - u) * along_y(i0) + u * along_y(i1);
        let corners = [
            sample(i0, j0),
            sample(i0, j1),
            sample(i1, j0),
            sample(i1, j1),
        ];
        // Rounding must not push the mean beyond the corner heights; a NaN coordinate stays NaN.
        let [low, high] = [
            corners.into_iter().fold(f64::INFINITY, f64::min),
            corners.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ];
        interpolated.clamp(low, high)
    }

    /// Sides of a pixel, m.
    pub(crate) fn pixel(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.extent[axis] / self.shape[axis] as f64)
    }

    /// Position of a sample, m.
    pub(crate) fn point(&self, [i, j]: [usize; 2]) -> [f64; 2] {
        [self.coordinate(0, i), self.coordinate(1, j)]
    }

    /// Coordinate of sample `i` along an axis.
    fn coordinate(&self, axis: usize, i: usize) -> f64 {
        let pixel = self.extent[axis] / self.shape[axis] as f64;
        ((2 * i + 1) as f64 - self.shape[axis] as f64) * (0.5 * pixel)
    }

    /// The samples on either side of a coordinate, and the weight of the second.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the indices of the map"
    )]
    fn bracket(&self, axis: usize, coordinate: f64) -> (usize, usize, f64) {
        let samples = self.shape[axis];
        let last = (samples - 1) as f64;
        // t = (x − x_0)/w = x/w + (n − 1)/2
        let position =
            (coordinate * samples as f64 / self.extent[axis] + 0.5 * last).clamp(0.0, last);
        let before = position.floor() as usize;
        (
            before,
            (before + 1).min(samples - 1),
            position - position.floor(),
        )
    }
}

#[cfg(test)]
mod tests;
