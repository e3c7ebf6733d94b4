//! Storage of the factor's blocks and products with them.

/// Numbers processed together, so that the arithmetic fills the registers.
const LANES: usize = 4;
/// Most lanes filled by a tile's own elements.
const MOST_LANES: usize = 3;

/// One lane of a block or of a product with it. Single precision is enough for a preconditioner.
type Lane = [f32; LANES];

/// `G r` of a tile.
pub type Product = [Lane; MOST_LANES];

/// Blocks of `G`, one after the other.
#[derive(Default)]
pub struct FactorBlocks {
    heads: Vec<BlockHead>,
    /// For each unknown of each block, its distance in the field's index from the tile's first place.
    distances: Vec<i32>,
    /// For each unknown, its entries in the rows of the tile's own elements; the last lane is padded with zeros.
    entries: Vec<Lane>,
}

/// The layout of a block of `G`.
#[derive(Clone, Copy, Default)]
struct BlockHead {
    /// Lanes per unknown.
    lanes: usize,
    /// The ends of its distances and entries; they begin at the ends of the previous block.
    distances_end: usize,
    entries_end: usize,
}

/// A view of one block.
pub struct Block<'a> {
    lanes: usize,
    distances: &'a [i32],
    entries: &'a [Lane],
}

/// Reserved space for a block.
pub struct Room<'a> {
    lanes: usize,
    distances: &'a mut [i32],
    entries: &'a mut [Lane],
}

impl Room<'_> {
    /// Stores a block given by the entries of each unknown in the rows of the tile's own elements.
    pub fn fill<const N: usize>(self, distances: impl Iterator<Item = i32>, rows: &[[f32; N]]) {
        (self.distances.iter_mut().zip(distances)).for_each(|(room, distance)| *room = distance);
        let entries = self.entries.chunks_exact_mut(self.lanes);
        for (room, entries) in entries.zip(rows) {
            let room = room.as_flattened_mut();
            room.copy_from_slice(&entries[..room.len()]);
        }
    }
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

    /// Appends space for blocks with these numbers of unknowns and own elements, and returns it.
    pub fn make_room(&mut self, sizes: &[[usize; 2]]) -> Vec<Room<'_>> {
        let from = [self.distances.len(), self.entries.len()];
        let [mut distances_end, mut entries_end] = from;
        for [unknowns, own] in sizes {
            let lanes = own.div_ceil(LANES);
            distances_end += unknowns;
            entries_end += unknowns * lanes;
            self.heads.push(BlockHead {
                lanes,
                distances_end,
                entries_end,
            });
        }
        self.distances.resize(distances_end, 0);
        self.entries.resize(entries_end, [0.0; LANES]);
        let mut distances = &mut self.distances[from[0]..];
        let mut entries = &mut self.entries[from[1]..];
        let rooms = sizes.iter().map(|[unknowns, own]| {
            let lanes = own.div_ceil(LANES);
            Room {
                lanes,
                distances: (distances.split_off_mut(..*unknowns)).expect("made room"),
                entries: (entries.split_off_mut(..unknowns * lanes)).expect("made room"),
            }
        });
        rooms.collect()
    }

    /// The block with this number.
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
    /// Computes `G r` for the tile whose first place has the index `first`.
    pub fn multiply(&self, first: i32, field: &[f32]) -> Product {
        match self.lanes {
            1 => self.multiply_lanes::<1>(first, field),
            2 => self.multiply_lanes::<2>(first, field),
            _ => self.multiply_lanes::<MOST_LANES>(first, field),
        }
    }

    /// Adds `Gᵀ y` for that tile to the field.
    pub fn add_transposed(&self, first: i32, y: &Product, field: &mut [f64]) {
        match self.lanes {
            1 => self.add_transposed_lanes::<1>(first, y, field),
            2 => self.add_transposed_lanes::<2>(first, y, field),
            _ => self.add_transposed_lanes::<MOST_LANES>(first, y, field),
        }
    }

    /// The product for a tile whose own elements fill `N` lanes. Even and odd unknowns are summed apart, so that each
    /// addition need not wait for the one before.
    fn multiply_lanes<const N: usize>(&self, first: i32, field: &[f32]) -> Product {
        let mut sums = [[[0.0; LANES]; N]; 2];
        let (columns, _) = self.entries.as_chunks::<N>();
        let add = |sums: &mut [Lane; N], distance: i32, column: &[Lane; N]| {
            let value = field[at(first, distance)];
            for (sums, lane) in sums.iter_mut().zip(column) {
                for (sum, g) in sums.iter_mut().zip(lane) {
                    *sum += g * value;
                }
            }
        };
        let (pairs, last) = self.distances.as_chunks::<2>();
        let (columns, last_column) = columns.as_chunks::<2>();
        for (distances, columns) in pairs.iter().zip(columns) {
            add(&mut sums[0], distances[0], &columns[0]);
            add(&mut sums[1], distances[1], &columns[1]);
        }
        for (distance, column) in last.iter().zip(last_column) {
            add(&mut sums[0], *distance, column);
        }
        let mut product = [[0.0; LANES]; MOST_LANES];
        for (lane, product) in product.iter_mut().take(N).enumerate() {
            for (own, product) in product.iter_mut().enumerate() {
                *product = sums[0][lane][own] + sums[1][lane][own];
            }
        }
        product
    }

    fn add_transposed_lanes<const N: usize>(&self, first: i32, y: &Product, field: &mut [f64]) {
        let (columns, _) = self.entries.as_chunks::<N>();
        for (distance, column) in self.distances.iter().zip(columns) {
            let mut sums = [0.0; LANES];
            for (lane, y) in column.iter().zip(y) {
                for (sum, (g, y)) in sums.iter_mut().zip(lane.iter().zip(y)) {
                    *sum += g * y;
                }
            }
            let [a, b, c, d] = sums;
            field[at(first, *distance)] += f64::from((a + b) + (c + d));
        }
    }
}

/// The element at a distance in the field's index, which must be on the grid.
#[expect(clippy::cast_sign_loss, reason = "a place on the grid, below 2²⁸")]
fn at(first: i32, distance: i32) -> usize {
    (first + distance) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::single;

    #[test]
    fn a_block_is_padded_to_whole_lanes() {
        let mut blocks = FactorBlocks::default();
        for (own, entries) in [(1, 5 * 4), (4, 5 * 4), (5, 5 * 8), (9, 5 * 12)] {
            let before = (blocks.len(), blocks.entries());
            blocks.make_room(&[[5, own]]);
            assert_eq!(
                (blocks.len(), blocks.entries()),
                (before.0 + 1, before.1 + entries)
            );
        }
    }

    #[test]
    fn blocks_of_every_width_multiply_like_their_columns() {
        let distances = [-3, 0, 2, 7, 8, 11, 12, 15, 16, 20, 21, 25, 30, 31];
        let field: Vec<f32> = (0..64)
            .map(|i| single(f64::from(i * i % 17) - 8.0))
            .collect();
        let mut blocks = FactorBlocks::default();
        // Quarters, which are exact in single precision.
        let g = |a: usize, own: usize| ((a * 5 + own * 3) % 11) as f64 / 4.0 - 1.0;
        let rows = |of: usize| -> Vec<[f32; LANES * MOST_LANES]> {
            let entry = |a: usize, own: usize| if own < of { single(g(a, own)) } else { 0.0 };
            let unknowns = (0..distances.len()).map(|a| std::array::from_fn(|own| entry(a, own)));
            unknowns.collect()
        };
        let own = [1, 4, 5, 8, 9, 12];
        // In two parts, in succession.
        for own in own.chunks(4) {
            let sizes: Vec<_> = own.iter().map(|own| [distances.len(), *own]).collect();
            for (room, own) in blocks.make_room(&sizes).into_iter().zip(own) {
                room.fill(distances.into_iter(), &rows(*own));
            }
        }
        assert_eq!(blocks.len(), own.len());
        let first = 5_i32;
        let value = |distance: i32| f64::from(field[at(first, distance)]);
        for (number, width) in (0..).zip(own) {
            let block = blocks.block(number);
            let product = block.multiply(first, &field);
            let found: Vec<f64> = product.into_iter().flatten().map(f64::from).collect();
            let mut transposed = vec![0.0; field.len()];
            block.add_transposed(first, &product, &mut transposed);
            for (own, found) in found.iter().enumerate() {
                let terms = distances.iter().enumerate();
                let wanted = terms.filter(|_| own < width);
                let wanted: f64 = wanted.map(|(a, d)| g(a, own) * value(*d)).sum();
                assert_eq!(*found, wanted, "{number} {own}");
            }
            for (a, distance) in distances.iter().enumerate() {
                let terms = (0..width).map(|own| g(a, own) * found[own]);
                assert_eq!(
                    transposed[at(first, *distance)],
                    terms.sum::<f64>(),
                    "{number} {a}"
                );
            }
        }
    }
}
