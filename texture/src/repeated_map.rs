//! A map that repeats: samples of its neighbours around it.

use std::ops::Range;

use crate::error::TextureError;
use crate::height_map::HeightMap;

impl HeightMap {
    /// Surrounds a periodic map with `rim` samples of its neighbours at each end of x and of y.
    ///
    /// Its [highest](Self::highest) and [lowest](Self::lowest) points are sought in the map itself, where the surface
    /// is that of the neighbours too; beyond the last sample of the rim it is not.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn repeated(&self, rim: [usize; 2]) -> Result<Self, TextureError> {
        let (shape, extent) = (self.shape(), self.extent());
        let wider = [0, 1].map(|axis: usize| shape[axis] + 2 * rim[axis]);
        let around = |i: usize, axis: usize| (i + rim[axis] * (shape[axis] - 1)) % shape[axis];
        let heights = (0..wider[0]).flat_map(|i| {
            let row = &self.heights()[around(i, 0) * shape[1]..][..shape[1]];
            (0..wider[1]).map(move |j| row[around(j, 1)])
        });
        let sides =
            [0, 1].map(|axis: usize| extent[axis] * wider[axis] as f64 / shape[axis] as f64);
        let map = Self::new(heights.collect(), wider, sides)?;
        let mut map = map.with_interpolation(self.interpolation());
        map.rim = rim;
        Ok(map)
    }

    /// The samples along an axis of the map without its rim.
    pub(crate) fn own_samples(&self, axis: usize) -> Range<usize> {
        self.rim[axis]..self.shape()[axis] - self.rim[axis]
    }

    /// The first samples along an axis of the cells between samples; with a rim, that of the last sample, too.
    pub(crate) fn own_cells(&self, axis: usize) -> Range<usize> {
        let samples = self.own_samples(axis);
        let last = if self.rim[axis] > 0 {
            samples.end
        } else {
            self.shape()[axis].max(2) - 1
        };
        samples.start..last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that look random, on 12 × 9 samples over a rectangle of 2.4 × 1.8, shifted by whole samples.
    fn rough(seed: u32, [down, right]: [usize; 2]) -> HeightMap {
        let sample = |n: usize| {
            let (i, j) = ((n / 9 + down) % 12, (n % 9 + right) % 9);
            let x = ((i * 9 + j) as f64 * 7.13 + f64::from(seed)).sin() * 43_758.545;
            x - x.floor()
        };
        HeightMap::new((0..12 * 9).map(sample).collect(), [12, 9], [2.4, 1.8]).unwrap()
    }

    #[test]
    fn summits_of_a_repeated_map_do_not_depend_on_where_it_is_cut() {
        for seed in 0..40 {
            let at = |shift: [usize; 2], rim: [usize; 2]| {
                let map = rough(seed, shift).repeated(rim).unwrap();
                let [x, y] = map.lowest_point();
                assert!(x.abs() < 1.4 && y.abs() < 1.1, "{x} {y}");
                assert!((map.height([x, y]) - map.lowest()).abs() < 1e-13);
                [map.highest(), map.lowest()]
            };
            let wanted = at([0, 0], [11, 10]);
            for shift in [[1, 0], [5, 7], [11, 8]] {
                for rim in [[11, 10], [5, 5]] {
                    let found = at(shift, rim);
                    for (found, wanted) in found.into_iter().zip(wanted) {
                        assert!((found - wanted).abs() < 1e-13, "{seed} {shift:?}");
                    }
                }
            }
        }
    }
}
