//! The pressure of a field gathered in square blocks of elements, for depths from which single elements are not seen.
//!
//! Pressures that vary over less than z hardly affect the stress at depth z. The blocks lie where their force acts at
//! the same place as that of the elements, so that even a contact smaller than one block acts at its own place.

use super::field::{LoadedSquare, StressField};

/// Blocks are no larger than this part of the depth.
const BLOCK_PART: f64 = 1.0 / 8.0;

/// A pressure is smooth on the scale of blocks if it differs from that interpolated between them by at most this part.
/// Under a ball that is some 3 % with 32 blocks across, from the edge; on a rough surface it is about one.
const ROUGH_PART: f64 = 0.1;

/// A square of blocks with their pressures.
#[derive(Debug, Clone)]
pub struct PressureBlocks {
    /// Blocks along a side.
    pub size: usize,
    /// Side of a block, m.
    pub side: f64,
    /// Centre (x, y) of the first block, m.
    pub first: [f64; 2],
    /// Mean pressures, row by row, in Pa.
    pub pressure: Vec<f64>,
}

/// How often the side of an element is doubled for the largest blocks that may be used at depth `z` (m).
pub fn doublings(z: f64, element: f64) -> u32 {
    let fits = |m: &u32| 2_f64.powi(m.cast_signed()) * element <= BLOCK_PART * z;
    (1..u32::BITS).take_while(fits).last().unwrap_or(0)
}

impl PressureBlocks {
    /// Gathers the pressure in blocks whose side is `2^doublings` elements.
    pub fn new(field: &StressField, doublings: u32) -> Self {
        let (grid, loaded) = (field.grid(), field.loaded());
        let element = grid.element_side();
        let first = loaded.origin.map(|origin| grid.centre(origin));
        if doublings == 0 || loaded.size == 0 {
            return Self {
                size: loaded.size,
                side: element,
                first,
                pressure: loaded.pressure.clone(),
            };
        }
        let elements = 2_f64.powi(doublings.cast_signed());
        let size = super::nearest((loaded.size as f64 / elements).ceil()).unsigned_abs();
        // An even number has a quadrant.
        let size = if size > 1 {
            size.next_multiple_of(2)
        } else {
            size
        };
        let mut pressure = gathered(loaded, elements, size);
        if loaded.is_mirrored() {
            mirror(&mut pressure, size);
        }
        let side = element * elements;
        let own = centroid(&loaded.pressure, loaded.size);
        let of_blocks = centroid(&pressure, size);
        Self {
            size,
            side,
            first: [0, 1].map(|axis| first[axis] + own[axis] * element - of_blocks[axis] * side),
            pressure,
        }
    }
}

/// Where the force acts, in elements from the centre of the first one along x and y.
fn centroid(pressure: &[f64], size: usize) -> [f64; 2] {
    let mut sums = [0.0; 3];
    for (k, p) in pressure.iter().enumerate() {
        let [x, y] = [k / size, k % size].map(|along| along as f64);
        let terms = sums.iter_mut().zip([*p, p * x, p * y]);
        terms.for_each(|(sum, term)| *sum += term);
    }
    [sums[1] / sums[0], sums[2] / sums[0]]
}

/// The places of the centres of a line of loaded elements among those of blocks, in blocks from the first one.
fn places(loaded: usize, elements: f64, size: usize) -> impl Iterator<Item = f64> + Clone {
    let before = ((size as f64 * elements - loaded as f64) / 2.0).floor();
    (0..loaded).map(move |i| (before + i as f64 + 0.5) / elements - 0.5)
}

impl PressureBlocks {
    /// Whether the pressure of the elements hardly differs from that interpolated between the blocks.
    pub fn is_smooth(&self, field: &StressField) -> bool {
        let (loaded, size) = (field.loaded(), self.size);
        let elements = self.side / field.grid().element_side();
        // The blocks on either side of each element, and the weight of the one after it.
        let shares: Vec<([usize; 2], f64)> = places(loaded.size, elements, size)
            .map(|place| {
                let place = place.clamp(0.0, (size - 1) as f64);
                let before = super::nearest(place.floor()).unsigned_abs();
                ([before, (before + 1).min(size - 1)], place.fract())
            })
            .collect();
        let (mut difference, mut sum) = (0.0, 0.0);
        for ((rows, x), pressures) in shares.iter().zip(loaded.pressure.chunks_exact(loaded.size)) {
            for ((columns, y), p) in shares.iter().zip(pressures) {
                let along = |i: usize| {
                    let [one, other] = columns.map(|j| self.pressure[i * size + j]);
                    (1.0 - y) * one + y * other
                };
                let [one, other] = rows.map(along);
                difference += (p - (1.0 - x) * one - x * other).abs();
                sum += p;
            }
        }
        difference <= ROUGH_PART * sum
    }

    /// The block whose centre is nearest to a point (x, y; m), counted from the first one.
    pub fn nearest(&self, point: [f64; 2]) -> [isize; 2] {
        std::array::from_fn(|axis| super::nearest((point[axis] - self.first[axis]) / self.side))
    }

    /// The centres (m) and pressures (Pa) of the blocks that carry pressure.
    pub fn loaded(&self) -> Vec<([f64; 2], f64)> {
        let place = |k: usize| [k / self.size, k % self.size].map(usize::cast_signed);
        let blocks = self.pressure.iter().enumerate().filter(|(_, p)| **p > 0.0);
        blocks.map(|(k, p)| (self.point(place(k)), *p)).collect()
    }

    /// The centre (x, y; m) of a block.
    pub fn point(&self, place: [isize; 2]) -> [f64; 2] {
        std::array::from_fn(|axis| self.first[axis] + place[axis] as f64 * self.side)
    }
}

/// The mean pressures of `size` × `size` blocks around the middle of the loaded square.
fn gathered(loaded: &LoadedSquare, elements: f64, size: usize) -> Vec<f64> {
    let places = places(loaded.size, elements, size);
    let blocks: Vec<usize> = places
        .map(|place| {
            super::nearest((place + 0.5).floor())
                .unsigned_abs()
                .min(size - 1)
        })
        .collect();
    let mut means = vec![0.0; size * size];
    let of_area = 1.0 / (elements * elements);
    for (i, row) in blocks.iter().zip(loaded.pressure.chunks_exact(loaded.size)) {
        for (j, p) in blocks.iter().zip(row) {
            means[i * size + j] += of_area * p;
        }
    }
    means
}

/// Makes pressures that are symmetric up to rounding symmetric to the last bit.
fn mirror(pressure: &mut [f64], size: usize) {
    for i in 0..size.div_ceil(2) {
        for j in 0..size.div_ceil(2) {
            let images = [i, size - 1 - i].map(|i| [j, size - 1 - j].map(|j| i * size + j));
            let [[a, b], [c, d]] = images.map(|pair| pair.map(|place| pressure[place]));
            let mean = (a + b + (c + d)) / 4.0;
            images
                .into_iter()
                .flatten()
                .for_each(|at| pressure[at] = mean);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::RadialTables;
    use pellicle_kernel::{Foundation, Material};
    use pellicle_texture::Grid;

    use super::*;
    use crate::stress::model::Sliding;

    /// A square of 16 × 16 elements of side 0.25 with these pressures.
    fn pressed(pressure: impl Fn([f64; 2]) -> f64) -> StressField {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let grid = Grid::new(4.0, 16).unwrap();
        let pressure: Vec<f64> = grid.centres().map(pressure).collect();
        let tables = Arc::new(RadialTables::build(&body).unwrap());
        StressField::of(tables, grid, &pressure, Sliding::default())
    }

    /// Force and its moments about the axis.
    fn moments(blocks: &PressureBlocks) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (k, p) in blocks.pressure.iter().enumerate() {
            let place = [k / blocks.size, k % blocks.size];
            let [x, y] = [0, 1].map(|axis| blocks.first[axis] + place[axis] as f64 * blocks.side);
            let force = p * blocks.side * blocks.side;
            sums.iter_mut()
                .zip([1.0, x, y])
                .for_each(|(sum, factor)| *sum += force * factor);
        }
        sums
    }

    #[test]
    fn blocks_of_every_size_keep_the_force_and_its_place() {
        let field = pressed(|[x, y]| (1.0 - x * x - 0.7 * y * y + 0.6 * x).max(0.0));
        let exact = moments(&PressureBlocks::new(&field, 0));
        for doublings in [1, 2, 3, 4, 12, 31] {
            let blocks = PressureBlocks::new(&field, doublings);
            let found = moments(&blocks);
            for (found, exact) in found.iter().zip(exact) {
                // Rounding of places up to a block away.
                assert!((found - exact).abs() < 1e-12 * blocks.side.max(1.0));
            }
            assert!(blocks.size <= 10);
        }
    }

    #[test]
    fn a_symmetric_pressure_stays_symmetric_to_the_last_bit() {
        let field = pressed(|[x, y]| (1.0 - x * x - y * y).max(0.0).sqrt());
        for doublings in [1, 2, 5] {
            let PressureBlocks { size, pressure, .. } = PressureBlocks::new(&field, doublings);
            assert!(size == 1 || size.is_multiple_of(2));
            for (k, p) in pressure.iter().enumerate() {
                let [i, j] = [k / size, k % size];
                assert_eq!(*p, pressure[(size - 1 - i) * size + j]);
                assert_eq!(*p, pressure[i * size + size - 1 - j]);
            }
        }
    }

    #[test]
    fn blocks_are_at_most_an_eighth_of_the_depth() {
        let found = [0.0, 1.0, 1.59, 1.61, 3.3, 1e6].map(|z| doublings(z, 0.1));
        assert_eq!(found, [0, 0, 0, 1, 2, 20]);
    }
}
