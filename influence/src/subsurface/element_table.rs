//! The fields of an element at the offsets of a quarter of a grid.
//!
//! The offsets are tabulated in square tiles. A tile (g, t) of the octant t ≤ g holds the fields at its own offsets
//! (m, n) and those at (n, m), which share their distance and with it the work: under a pressure the ones are the others
//! with x and y in each other's place.

use rayon::prelude::*;

use super::point_kernels::Load;
use super::state::{FIELDS, SubsurfaceState, SurfaceLoad};
use super::under_load::UnderLoad;
use crate::transform::LINES;

/// The field that takes the place of each if x and y change places.
pub const TRANSPOSED: [usize; FIELDS] = [1, 0, 2, 4, 3, 5, 6, 8, 7];

/// Values of one field in a tile.
const TILE: usize = LINES * LINES;

/// The fields under one load at `size` × `size` offsets.
pub struct ElementTable {
    size: usize,
    load: SurfaceLoad,
    /// Tile after tile, (0, 0), (1, 0), (1, 1), (2, 0) …: of each, field after field, at (m, n) and, under a traction,
    /// at (n, m); of each field row after row.
    tiles: Vec<f64>,
}

impl ElementTable {
    pub fn new(size: usize, load: SurfaceLoad) -> Self {
        let groups = size.div_ceil(LINES);
        let count = groups * (groups + 1) / 2;
        let mut table = Self {
            size,
            load,
            tiles: Vec::new(),
        };
        table.tiles = vec![0.0; count * table.per_tile()];
        table
    }

    /// Values in a tile.
    fn per_tile(&self) -> usize {
        match self.load {
            SurfaceLoad::Pressure => FIELDS * TILE,
            SurfaceLoad::Traction => 2 * FIELDS * TILE,
        }
    }

    /// Offsets along a side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// A field at the offsets (m, n) … (m + 7, n), m being a multiple of 8; anything beyond the table.
    #[inline]
    pub fn side_by_side(&self, field: usize, m: usize, n: usize) -> [f64; LINES] {
        let (group, tile, row) = (m / LINES, n / LINES, n % LINES);
        if tile <= group {
            let values = self.tile([group, tile], field);
            return std::array::from_fn(|i| values[i * LINES + row]);
        }
        // The row n of the tile on the other side of the diagonal.
        let field = match self.load {
            SurfaceLoad::Pressure => TRANSPOSED[field],
            SurfaceLoad::Traction => FIELDS + field,
        };
        let values = self.tile([tile, group], field);
        std::array::from_fn(|i| values[row * LINES + i])
    }

    /// A field in a tile of the octant.
    #[inline]
    fn tile(&self, [group, tile]: [usize; 2], field: usize) -> &[f64] {
        let place = group * (group + 1) / 2 + tile;
        &self.tiles[place * self.per_tile() + field * TILE..][..TILE]
    }

    /// Computes the fields of an element under the table's load.
    pub fn fill<L: Load<F>, const F: usize>(&mut self, element: &UnderLoad<L, F>) {
        debug_assert!(self.load == L::LOAD, "the table is made for the load");
        let (size, per_tile) = (self.size, self.per_tile());
        let tiles = self.tiles.par_chunks_exact_mut(per_tile).enumerate();
        tiles.for_each(|(place, values)| {
            // g (g + 1)/2 ≤ place
            let group = ((8 * place + 1).isqrt() - 1) / 2;
            let tile = place - group * (group + 1) / 2;
            for entry in 0..TILE {
                let offset = [group * LINES + entry / LINES, tile * LINES + entry % LINES];
                if offset.iter().any(|along| *along >= size) {
                    continue;
                }
                let offset = offset.map(|along| along as f64);
                let mut set = |first: usize, state: &SubsurfaceState| {
                    for field in 0..FIELDS {
                        values[(first + field) * TILE + entry] = state.field(field);
                    }
                };
                match L::LOAD {
                    SurfaceLoad::Pressure => set(0, &element.at(offset)),
                    SurfaceLoad::Traction => {
                        let [own, other] = element.at_both(offset);
                        set(0, &own);
                        set(FIELDS, &other);
                    }
                }
            }
        });
    }
}
