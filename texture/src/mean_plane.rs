//! The least-squares plane of a map: a scan is tilted by how the sample lay in the instrument.

use rayon::prelude::*;

use crate::HeightMap;

/// The plane nearest to the samples of a map in the least-squares sense.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanPlane {
    /// Rise from sample to sample along x and along y, m.
    per_sample: [f64; 2],
    shape: [usize; 2],
    extent: [f64; 2],
}

impl MeanPlane {
    /// The plane of a map.
    #[must_use]
    pub fn of(map: &HeightMap) -> Self {
        Self::of_samples(&above_mean(map), map)
    }

    /// The plane of a map whose heights above their mean are these.
    pub(crate) fn of_samples(samples: &[f64], map: &HeightMap) -> Self {
        let (shape, extent) = (map.shape(), map.extent());
        let [rows, columns] = shape;
        let count = samples.len() as f64;
        // Positions about the middle, in samples: b = Σ t h / Σ t² along each axis, Σ t² = N (n² − 1)/12.
        let tilt = |products: f64, n: usize| {
            let squares = count * ((n * n) as f64 - 1.0) / 12.0;
            if n > 1 { products / squares } else { 0.0 }
        };
        let lines: Vec<[f64; 2]> = (samples.par_chunks(columns).enumerate())
            .map(|(i, row)| {
                let along = row.iter().enumerate();
                let along = along.map(|(j, h)| place(j, columns) * h).sum();
                [place(i, rows) * row.iter().sum::<f64>(), along]
            })
            .collect();
        let [across, along] = [0, 1].map(|axis: usize| lines.iter().map(|line| line[axis]).sum());
        Self {
            per_sample: [tilt(across, rows), tilt(along, columns)],
            shape,
            extent,
        }
    }

    /// Slopes of the plane along x and along y.
    #[must_use]
    pub fn slopes(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.per_sample[axis] * self.shape[axis] as f64 / self.extent[axis])
    }

    /// The slope along the line of steepest rise.
    #[must_use]
    pub fn steepest(&self) -> f64 {
        let [x, y] = self.slopes();
        x.hypot(y)
    }

    /// Difference between the highest and the lowest corner of the map on the plane, m.
    #[must_use]
    pub fn rise(&self) -> f64 {
        let along = |axis: usize| (self.per_sample[axis] * self.shape[axis] as f64).abs();
        along(0) + along(1)
    }

    /// Root mean square of the heights of the map above the plane, m.
    #[must_use]
    pub fn rms_height_above(&self, map: &HeightMap) -> f64 {
        let mut samples = above_mean(map);
        self.subtract_from(&mut samples);
        let squares = samples.par_chunks(self.shape[1].max(1));
        let squares: Vec<f64> = squares.map(|row| row.iter().map(|h| h * h).sum()).collect();
        (squares.into_iter().sum::<f64>() / samples.len() as f64).sqrt()
    }

    /// Subtracts the plane from heights above their mean.
    pub(crate) fn subtract_from(&self, samples: &mut [f64]) {
        let ([rows, columns], [across, along]) = (self.shape, self.per_sample);
        let lines = samples.par_chunks_mut(columns).enumerate();
        lines.for_each(|(i, row)| {
            let line = across * place(i, rows);
            for (j, h) in row.iter_mut().enumerate() {
                *h -= line + along * place(j, columns);
            }
        });
    }
}

/// Place of a sample about the middle of `n`, in samples.
fn place(i: usize, n: usize) -> f64 {
    i as f64 - 0.5 * (n as f64 - 1.0)
}

/// The heights of a map above their mean, m.
pub(crate) fn above_mean(map: &HeightMap) -> Vec<f64> {
    let ([_, columns], heights) = (map.shape(), map.heights());
    // Subtract one height first: a map may be far from its reference plane.
    let reference = heights[0];
    let mut samples: Vec<f64> = heights.par_iter().map(|h| h - reference).collect();
    let sums: Vec<f64> = samples
        .par_chunks(columns)
        .map(|row| row.iter().sum())
        .collect();
    let above = sums.into_iter().sum::<f64>() / heights.len() as f64;
    samples.par_iter_mut().for_each(|h| *h -= above);
    samples
}

impl HeightMap {
    /// The map above its least-squares plane.
    #[must_use]
    pub fn levelled(self) -> Self {
        let mut samples = above_mean(&self);
        MeanPlane::of_samples(&samples, &self).subtract_from(&mut samples);
        self.with_heights(samples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(shape: [usize; 2], surface: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |axis: usize, i: usize| [2.0, 1.0][axis] * ((i as f64 + 0.5) / shape[axis] as f64);
        let heights = 0..shape[0] * shape[1];
        let heights = heights.map(|k| surface(at(0, k / shape[1]), at(1, k % shape[1])));
        HeightMap::new(heights.collect(), shape, [2.0, 1.0]).unwrap()
    }

    #[test]
    fn the_plane_of_a_tilted_map_is_its_tilt_and_is_gone_when_levelled() {
        let plane = |x: f64, y: f64| 1e3 + 0.2 * x - 0.3 * y;
        for shape in [[20, 30], [2, 2]] {
            let tilted = map(shape, plane);
            let of_map = MeanPlane::of(&tilted);
            let [x, y] = of_map.slopes();
            // Heights of 1000 have a rounding error of 1e-13.
            assert!((x - 0.2).abs() < 1e-11 && (y + 0.3).abs() < 1e-11);
            assert!((of_map.rise() - 0.7).abs() < 1e-11);
            let levelled = tilted.levelled();
            assert!(levelled.heights().iter().all(|h| h.abs() < 1e-11));
        }
        // One line has no slope across it.
        assert_eq!(MeanPlane::of(&map([1, 9], plane)).slopes()[0], 0.0);
    }

    #[test]
    fn a_tilt_changes_nothing_of_a_levelled_map() {
        let rough = |x: f64, y: f64| (7.0 * x).sin() * (5.0 * y).cos();
        let level = map([40, 30], rough).levelled();
        let tilted = map([40, 30], |x, y| rough(x, y) + 0.4 * x - 0.2 * y).levelled();
        let pairs = level.heights().iter().zip(tilted.heights());
        // Some roundings of heights of 1.
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-14));
    }
}
