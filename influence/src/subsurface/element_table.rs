//! The fields of an element at the offsets of a quarter of a grid.
//!
//! The offsets are tabulated in square tiles. A tile (g, t) of the octant t ≤ g holds the fields at its own offsets
//! (m, n) and those at (n, m), which have the same distance and so share the work: under a pressure each set is the
//! other with x and y exchanged.

use rayon::prelude::*;

use super::point_kernels::PointLoad;
use super::state::{FIELDS, SubsurfaceState, SurfaceLoad};
use super::traction_steps::TractionSteps;
use super::under_load::UnderLoad;
use crate::transform::LINES;

/// The field that replaces each one when x and y are exchanged.
pub const TRANSPOSED: [usize; FIELDS] = [1, 0, 2, 4, 3, 5, 6, 8, 7];

/// Indices of the stresses that a traction's steps change.
const XX: usize = 3;
const YY: usize = 4;
const ZZ: usize = 5;
const XY: usize = 6;

/// The fields under one load at `size` × `size` offsets.
pub struct ElementTable {
    size: usize,
    load: SurfaceLoad,
    /// Tile by tile, (0, 0), (1, 0), (1, 1), (2, 0) …; in each, field by field, at (m, n) and, under a
    /// traction, at (n, m).
    tiles: Vec<Tile>,
}

/// One field in a tile, row by row.
type Tile = [[f64; LINES]; LINES];

/// The fields of an element under one load; places are in sides of the element from its centre.
pub trait ElementStates: Sync {
    /// The load.
    const LOAD: SurfaceLoad;

    /// The state at (x, y).
    fn at(&self, place: [f64; 2]) -> SubsurfaceState;

    /// The states at (x, y) and at (y, x).
    fn at_both(&self, place: [f64; 2]) -> [SubsurfaceState; 2];
}

impl<L: PointLoad<F>, const F: usize> ElementStates for UnderLoad<L, F> {
    const LOAD: SurfaceLoad = L::LOAD;

    fn at(&self, place: [f64; 2]) -> SubsurfaceState {
        Self::at(self, place)
    }

    fn at_both(&self, place: [f64; 2]) -> [SubsurfaceState; 2] {
        Self::at_both(self, place)
    }
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
        table.tiles = vec![[[0.0; LINES]; LINES]; count * table.fields()];
        table
    }

    /// Number of fields stored at each offset of a tile.
    fn fields(&self) -> usize {
        match self.load {
            SurfaceLoad::Pressure => FIELDS,
            SurfaceLoad::Traction => 2 * FIELDS,
        }
    }

    /// Offsets along a side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// A field at the offsets (m, n) … (m + 7, n), where m is a multiple of 8; zeros beyond the table.
    #[inline]
    pub fn side_by_side(&self, field: usize, m: usize, n: usize) -> [f64; LINES] {
        let (group, tile, row) = (m / LINES, n / LINES, n % LINES);
        if tile <= group {
            return self
                .tile([group, tile], field)
                .each_ref()
                .map(|values| values[row]);
        }
        // Row n of the tile on the other side of the diagonal.
        let field = match self.load {
            SurfaceLoad::Pressure => TRANSPOSED[field],
            SurfaceLoad::Traction => FIELDS + field,
        };
        self.tile([tile, group], field)[row]
    }

    /// A field in a tile of the octant.
    #[inline]
    fn tile(&self, [group, tile]: [usize; 2], field: usize) -> &[[f64; LINES]; LINES] {
        let place = group * (group + 1) / 2 + tile;
        &self.tiles[place * self.fields() + field]
    }

    /// Computes the fields of an element under the table's load.
    pub fn fill<L: PointLoad<F>, const F: usize>(&mut self, element: &UnderLoad<L, F>) {
        self.fill_with(element);
    }

    /// The same from an element of any accuracy.
    pub fn fill_with<E: ElementStates>(&mut self, element: &E) {
        assert!(self.load == E::LOAD, "the table is made for the load");
        let (size, fields) = (self.size, self.fields());
        let tiles = self.tiles.par_chunks_exact_mut(fields).enumerate();
        tiles.for_each(|(place, values)| {
            // g (g + 1)/2 ≤ place
            let group = ((8 * place + 1).isqrt() - 1) / 2;
            let tile = place - group * (group + 1) / 2;
            for (i, j) in (0..LINES).flat_map(|i| (0..LINES).map(move |j| (i, j))) {
                let offset = [group * LINES + i, tile * LINES + j];
                if offset.iter().any(|along| *along >= size) {
                    continue;
                }
                let place = offset.map(|along| along as f64);
                let mut set = |first: usize, state: &SubsurfaceState| {
                    for (field, value) in values[first..][..FIELDS].iter_mut().enumerate() {
                        value[i][j] = state.field(field);
                    }
                };
                match E::LOAD {
                    SurfaceLoad::Pressure => set(0, &element.at(place)),
                    SurfaceLoad::Traction => {
                        let [own, other] = element.at_both(place);
                        set(0, &own);
                        set(FIELDS, &other);
                    }
                }
            }
        });
    }

    /// Adds what the steps of a traction take from the stresses under centres.
    pub fn add_steps(&mut self, TractionSteps { along_x, along_y }: TractionSteps) {
        for (field, lost) in [XX, YY, ZZ].into_iter().zip(along_x) {
            self.add([1, 0], field, lost);
        }
        self.add([0, 1], XY, along_y);
    }

    /// Adds to a field under a traction at an offset in the first tile.
    fn add(&mut self, [m, n]: [usize; 2], field: usize, value: f64) {
        if m.max(n) < self.size {
            self.tiles[field][m][n] += value;
            self.tiles[FIELDS + field][n][m] += value;
        }
    }
}
