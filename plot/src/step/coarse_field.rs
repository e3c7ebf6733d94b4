//! The part of a field that a picture shows, coarsened to its resolution.

use crate::step::crop::Crop;
use pellicle::result::fields::Fields;

/// Pressure and relief within a crop, on cells that are blocks of elements if the field is finer than the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct CoarseField {
    /// Cells per side.
    pub cells: usize,
    /// Coordinates of the left and right side, m.
    pub x: [f64; 2],
    /// Coordinates of the lower and upper side, m.
    pub y: [f64; 2],
    pressure: Vec<f64>,
    mask: Vec<bool>,
}

impl CoarseField {
    /// Coarsens the crop to at most `most` cells per side. A cell has the largest pressure of its elements, so no peak
    /// is lost, and belongs to the relief if half of them do.
    #[must_use]
    pub fn new(fields: &Fields<'_>, crop: &Crop, most: usize) -> Self {
        let block = crop.x.len().div_ceil(most).max(1);
        let cells = crop.x.len().div_ceil(block);
        let (mut pressure, mut mask) = (Vec::new(), Vec::new());
        for i in (0..cells).map(|i| crop.x.start + i * block) {
            for j in (0..cells).map(|j| crop.y.start + j * block) {
                let elements = block_of(fields.size, [i, j], block);
                let largest = elements.iter().map(|e| fields.pressure[*e]);
                pressure.push(largest.fold(0.0, f64::max));
                let on = elements.iter().filter(|e| fields.mask[**e]).count();
                mask.push(on > 0 && 2 * on >= elements.len());
            }
        }
        // The last block may reach past the crop by less than a pixel.
        let ends = |start: usize| [fields.edge(start), fields.edge(start + cells * block)];
        Self {
            cells,
            x: ends(crop.x.start),
            y: ends(crop.y.start),
            pressure,
            mask,
        }
    }

    /// The pressure of a cell, Pa.
    #[must_use]
    pub fn pressure(&self, i: usize, j: usize) -> f64 {
        self.pressure[i * self.cells + j]
    }

    /// Whether a cell belongs to the relief.
    #[must_use]
    pub fn is_relief(&self, i: usize, j: usize) -> bool {
        self.mask[i * self.cells + j]
    }

    /// Ends of the sides along x and along y, m.
    #[must_use]
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.x, self.y]
    }

    /// The largest coordinate, m.
    #[must_use]
    pub fn farthest(&self) -> f64 {
        let ends = [self.x, self.y].concat();
        ends.into_iter().map(f64::abs).fold(0.0, f64::max)
    }
}

/// Indices of the elements of a block that lie within a field of `size` × `size`.
fn block_of(size: usize, [i, j]: [usize; 2], block: usize) -> Vec<usize> {
    let range = |start: usize| start..(start + block).min(size);
    let row = |i: usize| range(j).map(move |j| i * size + j);
    range(i).flat_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::crop::Crop;

    #[test]
    fn a_fine_field_keeps_its_peak_and_its_extent() {
        let mut pressure = vec![0.0; 100];
        pressure[37] = 5.0;
        let zeros = vec![0.0; 100];
        let fields = Fields {
            side: 10.0,
            size: 10,
            pressure: &pressure,
            displacement: &zeros,
            gap: &zeros,
            shortening: &zeros,
            plastic_depth: &[],
            profile: &zeros,
            mask: &[true; 100],
        };
        let crop = Crop { x: 0..10, y: 0..10 };
        let coarse = CoarseField::new(&fields, &crop, 4);
        // Four blocks of three; the last has one element per side.
        assert_eq!((coarse.cells, coarse.x), (4, [-5.0, 7.0]));
        assert_eq!(coarse.pressure(1, 2), 5.0);
        assert!(coarse.is_relief(3, 3));
        let fine = CoarseField::new(&fields, &crop, 10);
        assert_eq!((fine.cells, fine.pressure(3, 7)), (10, 5.0));
    }
}
