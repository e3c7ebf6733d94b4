//! The blocks of the factor as they are kept and multiplied.

use faer::Mat;

/// Numbers of a block side by side, so that their arithmetic fills the registers.
const LANES: usize = 4;
/// The most lanes that a tile's own elements fill.
const MOST_LANES: usize = 3;

/// Numbers of a block in lanes.
type Lane = [f32; LANES];

/// `G r` of a tile.
pub type Product = [[f64; LANES]; MOST_LANES];

/// Blocks of `G`, one after the other.
#[derive(Default)]
pub struct FactorBlocks {
    heads: Vec<BlockHead>,
    /// Of each unknown of each block: its distance in the field's index from the tile's first place.
    distances: Vec<i32>,
    /// Of each unknown: its entries in the rows of the tile's own elements, the last lane filled up with zeros. Single
    /// precision is enough for a preconditioner.
    entries: Vec<Lane>,
}

/// A block of `G`.
#[derive(Clone, Copy, Default)]
struct BlockHead {
    /// Lanes of an unknown.
    lanes: usize,
    /// Where its distances and entries end; they begin where those of the block before end.
    distances_end: usize,
    entries_end: usize,
}

/// One block.
pub struct Block<'a> {
    lanes: usize,
    distances: &'a [i32],
    entries: &'a [Lane],
}

impl FactorBlocks {
    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.heads.len()
    }

    /// Numbers in all blocks.
    pub fn entries(&self) -> usize {
        self.entries.len() * LANES
    }

    /// Adds a block of these columns, one for each of the tile's own elements.
    pub fn push(&mut self, distances: impl Iterator<Item = i32>, columns: &Mat<f64>) {
        self.distances.extend(distances);
        let lanes = columns.ncols().div_ceil(LANES);
        for unknown in 0..columns.nrows() {
            for lane in 0..lanes {
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "a preconditioner needs no more"
                )]
                self.entries.push(std::array::from_fn(|within| {
                    let column = lane * LANES + within;
                    if column < columns.ncols() {
                        columns[(unknown, column)] as f32
                    } else {
                        0.0
                    }
                }));
            }
        }
        self.heads.push(BlockHead {
            lanes,
            distances_end: self.distances.len(),
            entries_end: self.entries.len(),
        });
    }

    /// Adds the blocks of another after these.
    pub fn append(&mut self, others: Self) {
        let (distances, entries) = (self.distances.len(), self.entries.len());
        self.distances.extend(others.distances);
        self.entries.extend(others.entries);
        let heads = others.heads.into_iter();
        self.heads.extend(heads.map(|head| BlockHead {
            distances_end: distances + head.distances_end,
            entries_end: entries + head.entries_end,
            ..head
        }));
    }

    /// The block of this number.
    pub fn block(&self, block: u32) -> Block<'_> {
        let block = block as usize;
        let before = block.checked_sub(1).map(|before| self.heads[before]);
        let (from, head) = (before.unwrap_or_default(), self.heads[block]);
        Block {
            lanes: head.lanes,
            distances: &self.distances[from.distances_end..head.distances_end],
            entries: &self.entries[from.entries_end..head.entries_end],
        }
    }
}

impl Block<'_> {
    /// `G r` of the tile whose first place has the index `first`.
    pub fn multiply(&self, first: i32, field: &[f64]) -> Product {
        match self.lanes {
            1 => self.multiply_lanes::<1>(first, field),
            2 => self.multiply_lanes::<2>(first, field),
            _ => self.multiply_lanes::<MOST_LANES>(first, field),
        }
    }

    /// Adds `Gᵀ y` of that tile.
    pub fn add_transposed(&self, first: i32, y: &Product, field: &mut [f64]) {
        match self.lanes {
            1 => self.add_transposed_lanes::<1>(first, y, field),
            2 => self.add_transposed_lanes::<2>(first, y, field),
            _ => self.add_transposed_lanes::<MOST_LANES>(first, y, field),
        }
    }

    /// The product where the tile's own elements fill `N` lanes.
    fn multiply_lanes<const N: usize>(&self, first: i32, field: &[f64]) -> Product {
        let mut sums = [[0.0; LANES]; N];
        let (columns, _) = self.entries.as_chunks::<N>();
        for (distance, column) in self.distances.iter().zip(columns) {
            let value = field[at(first, *distance)];
            for (sums, lane) in sums.iter_mut().zip(column) {
                for (sum, g) in sums.iter_mut().zip(lane) {
                    *sum += f64::from(*g) * value;
                }
            }
        }
        let mut product = [[0.0; LANES]; MOST_LANES];
        product[..N].copy_from_slice(&sums);
        product
    }

    fn add_transposed_lanes<const N: usize>(&self, first: i32, y: &Product, field: &mut [f64]) {
        let (columns, _) = self.entries.as_chunks::<N>();
        for (distance, column) in self.distances.iter().zip(columns) {
            let mut sums = [0.0; LANES];
            for (lane, y) in column.iter().zip(y) {
                for (sum, (g, y)) in sums.iter_mut().zip(lane.iter().zip(y)) {
                    *sum += f64::from(*g) * y;
                }
            }
            let [a, b, c, d] = sums;
            field[at(first, *distance)] += (a + b) + (c + d);
        }
    }
}

/// The element at a distance in the field's index, which lies on the grid.
#[expect(clippy::cast_sign_loss, reason = "a place on the grid, below 2²⁸")]
fn at(first: i32, distance: i32) -> usize {
    (first + distance) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_has_as_many_numbers_as_fill_its_lanes() {
        let mut blocks = FactorBlocks::default();
        for (own, entries) in [(1, 5 * 4), (4, 5 * 4), (5, 5 * 8), (9, 5 * 12)] {
            let before = (blocks.len(), blocks.entries());
            blocks.push(0..5, &Mat::zeros(5, own));
            assert_eq!(
                (blocks.len(), blocks.entries()),
                (before.0 + 1, before.1 + entries)
            );
        }
    }

    #[test]
    fn blocks_of_every_width_multiply_as_their_columns_do() {
        let distances = [-3, 0, 2, 7, 8, 11, 12, 15, 16, 20, 21, 25, 30, 31];
        let field: Vec<f64> = (0..64).map(|i| f64::from(i * i % 17) - 8.0).collect();
        let mut blocks = FactorBlocks::default();
        let columns = [1, 4, 5, 8, 9, 12].map(|own| {
            // Quarters, which single precision has exactly.
            Mat::from_fn(distances.len(), own, |a, b| {
                ((a * 5 + b * 3) % 11) as f64 / 4.0 - 1.0
            })
        });
        for (number, columns) in columns.iter().enumerate() {
            // Every other one comes from another part of the work.
            let mut others = FactorBlocks::default();
            let part = if number % 2 == 0 {
                &mut blocks
            } else {
                &mut others
            };
            part.push(distances.into_iter(), columns);
            blocks.append(others);
        }
        assert_eq!(blocks.len(), columns.len());
        let first = 5_i32;
        let value = |distance: i32| field[at(first, distance)];
        for (number, columns) in (0..).zip(&columns) {
            let block = blocks.block(number);
            let product = block.multiply(first, &field);
            let found: Vec<f64> = product.into_iter().flatten().collect();
            let mut transposed = vec![0.0; field.len()];
            block.add_transposed(first, &product, &mut transposed);
            for (own, found) in found.iter().enumerate() {
                let terms = distances.iter().enumerate();
                let wanted = terms.filter(|_| own < columns.ncols());
                let wanted: f64 = wanted.map(|(a, d)| columns[(a, own)] * value(*d)).sum();
                assert_eq!(*found, wanted, "{number} {own}");
            }
            for (a, distance) in distances.iter().enumerate() {
                let terms = (0..columns.ncols()).map(|own| columns[(a, own)] * found[own]);
                assert_eq!(
                    transposed[at(first, *distance)],
                    terms.sum::<f64>(),
                    "{number} {a}"
                );
            }
        }
    }
}
