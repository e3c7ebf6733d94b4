//! Candidates: the few elements of a grid that may come into contact, to which the solution of a dilute contact is
//! restricted.

use rayon::prelude::*;

/// Elements along a side of the tiles used to look up candidates.
const TILE: usize = 16;
/// Rings of elements around pressing or overlapping ones that are also candidates.
const RINGS: usize = 1;
/// Marks an element that is not a candidate.
const NONE: u32 = u32::MAX;

/// Some elements of a square of `size` × `size`, by ascending index.
#[derive(Debug, Clone)]
pub struct Candidates {
    size: usize,
    elements: Vec<u32>,
    /// For each tile, its index in `places`.
    tiles: Vec<u32>,
    /// For each element of the tiles that hold candidates, its place in the list.
    places: Vec<[u32; TILE * TILE]>,
}

impl Candidates {
    /// Some elements and their neighbours.
    pub fn around(size: usize, members: &[u32]) -> Self {
        Self::of(size, with_rings(size, members))
    }

    /// These candidates, with some elements and their neighbours added.
    pub fn with(&self, members: &[u32]) -> Self {
        let mut elements = with_rings(self.size, members);
        elements.extend(&self.elements);
        elements.sort_unstable();
        elements.dedup();
        Self::of(self.size, elements)
    }

    fn of(size: usize, elements: Vec<u32>) -> Self {
        let width = size.div_ceil(TILE);
        let mut tiles = vec![NONE; width * width];
        let mut places: Vec<[u32; TILE * TILE]> = Vec::new();
        for (at, element) in elements.iter().enumerate() {
            let (tile, within) =
                tile_of([*element as usize / size, *element as usize % size], width);
            if tiles[tile] == NONE {
                tiles[tile] = short(places.len());
                places.push([NONE; TILE * TILE]);
            }
            places[tiles[tile] as usize][within] = short(at);
        }
        Self {
            size,
            elements,
            tiles,
            places,
        }
    }

    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Elements along a side of the square.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The indices `i N + j` in the square, ascending.
    pub fn elements(&self) -> &[u32] {
        &self.elements
    }

    /// Row and column of a candidate.
    pub fn place(&self, candidate: usize) -> [usize; 2] {
        let element = self.elements[candidate] as usize;
        [element / self.size, element % self.size]
    }

    /// The candidate in a row and column of the square, if there is one.
    pub fn at(&self, place: [usize; 2]) -> Option<usize> {
        let (tile, within) = tile_of(place, self.size.div_ceil(TILE));
        let places = self.places.get(self.tiles[tile] as usize)?;
        let candidate = places[within];
        (candidate != NONE).then_some(candidate as usize)
    }

    /// Returns the candidates' values of a field on the square.
    pub fn gather(&self, field: &[f64]) -> Vec<f64> {
        self.elements
            .iter()
            .map(|element| field[*element as usize])
            .collect()
    }

    /// Returns the field on the square with the candidates' values, and 0 elsewhere.
    pub fn scatter(&self, values: &[f64]) -> Vec<f64> {
        let mut field = vec![0.0; self.size * self.size];
        for (element, value) in self.elements.iter().zip(values) {
            field[*element as usize] = *value;
        }
        field
    }
}

/// The elements of a square of `size` × `size` for which `belongs` holds, ascending.
pub fn elements_where(size: usize, belongs: impl Fn([usize; 2]) -> bool + Sync) -> Vec<u32> {
    in_rows(size, &|row| {
        let columns = (0..size).filter(|column| belongs([row, *column]));
        columns.map(|column| short(row * size + column)).collect()
    })
}

/// The elements of each row, one row after the other; compiled once for all rules.
fn in_rows(size: usize, of_row: &(dyn Fn(usize) -> Vec<u32> + Sync)) -> Vec<u32> {
    let rows: Vec<Vec<u32>> = (0..size).into_par_iter().map(of_row).collect();
    rows.concat()
}

/// Some elements and the [`RINGS`] around each, ascending.
fn with_rings(size: usize, members: &[u32]) -> Vec<u32> {
    let mut elements = Vec::new();
    for member in members {
        let member = *member as usize;
        let [rows, columns] = [member / size, member % size]
            .map(|i| i.saturating_sub(RINGS)..(i + RINGS + 1).min(size));
        let around = rows.flat_map(|i| columns.clone().map(move |j| i * size + j));
        elements.extend(around.map(short));
    }
    elements.sort_unstable();
    elements.dedup();
    elements
}

/// The tile of an element, and its place in the tile.
fn tile_of([row, column]: [usize; 2], width: usize) -> (usize, usize) {
    let tile = row / TILE * width + column / TILE;
    (tile, row % TILE * TILE + column % TILE)
}

/// An index of a grid of at most 16,384² elements.
#[expect(clippy::cast_possible_truncation, reason = "at most 2²⁸")]
fn short(index: usize) -> u32 {
    index as u32
}

#[cfg(test)]
mod tests {
    use super::{Candidates, elements_where, short};

    const SIZE: usize = 40;

    #[test]
    fn candidates_are_the_members_and_one_ring_around_and_can_be_looked_up() {
        let members = [0, 21 * SIZE + 15, 39 * SIZE + 20];
        let found = elements_where(SIZE, |[i, j]| members.contains(&(i * SIZE + j)));
        let candidates = Candidates::around(SIZE, &found);
        assert_eq!(candidates.len(), 4 + 9 + 6);
        assert!(candidates.elements().is_sorted());
        for element in 0..SIZE * SIZE {
            let place = [element / SIZE, element % SIZE];
            let near = |member: &usize| {
                (member / SIZE).abs_diff(place[0]) <= 1 && (member % SIZE).abs_diff(place[1]) <= 1
            };
            let found = candidates.at(place);
            assert_eq!(found.is_some(), members.iter().any(near));
            assert!(found.is_none_or(|candidate| candidates.place(candidate) == place));
        }
    }

    #[test]
    fn adding_candidates_keeps_the_existing_ones() {
        let one = Candidates::around(SIZE, &[500]);
        let both = one.with(&[502]);
        assert_eq!(both.len(), 15);
        let field: Vec<f64> = (0..SIZE * SIZE).map(|e| e as f64).collect();
        let around = [459, 460, 461, 462, 463];
        let own = [0, SIZE, 2 * SIZE].map(|down| around.map(|e| short(e + down)));
        assert_eq!(both.elements(), own.as_flattened());
        let values: Vec<f64> = both.elements().iter().map(|e| f64::from(*e)).collect();
        assert_eq!(both.gather(&field), values);
        let scattered = both.scatter(&values);
        assert_eq!(scattered.iter().sum::<f64>(), values.iter().sum::<f64>());
        assert_eq!(
            both.gather(&both.scatter(&both.gather(&field))),
            both.gather(&field)
        );
    }
}
