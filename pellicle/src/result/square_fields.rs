//! The fields of an oblong cell on a square, in which the cell repeats, for pictures.

use super::fields::{Fields, NUMBERS};

/// Fields on a square: those of a square domain, or those of an oblong cell on the square of its longer side. Where the
/// two sides differ by an odd number of elements, the repeated ones lie half an element beside their places.
#[derive(Debug, Clone)]
pub struct SquareFields<'a> {
    own: Fields<'a>,
    /// None for a square domain.
    repeated: Option<Repeated>,
}

/// The fields of the square, in the order of [`NUMBERS`].
#[derive(Debug, Clone)]
struct Repeated {
    size: usize,
    numbers: [Vec<f64>; NUMBERS.len()],
    mask: Vec<bool>,
}

impl<'a> SquareFields<'a> {
    /// The fields of this domain.
    #[must_use]
    pub fn of(fields: Fields<'a>) -> Self {
        let repeated = (!fields.is_square()).then(|| Repeated::of(&fields));
        Self {
            own: fields,
            repeated,
        }
    }

    /// The fields on the square.
    #[must_use]
    pub fn fields(&self) -> Fields<'_> {
        let Some(Repeated {
            size,
            numbers,
            mask,
        }) = &self.repeated
        else {
            return self.own;
        };
        let [
            pressure,
            displacement,
            gap,
            shortening,
            profile,
            plastic_depth,
        ] = numbers;
        Fields {
            side: self.own.element_side() * *size as f64,
            size: *size,
            pressure,
            displacement,
            gap,
            shortening,
            plastic_depth,
            profile,
            mask,
        }
    }
}

impl Repeated {
    fn of(fields: &Fields<'_>) -> Self {
        let lengths = fields.lengths();
        let size = lengths[0].max(lengths[1]);
        let numbers = NUMBERS.map(|number| repeated(number.of(fields), lengths, size));
        Self {
            size,
            numbers,
            mask: repeated(fields.mask, lengths, size),
        }
    }
}

/// A field of an oblong cell, repeated around its middle on a square of this size; empty if it is.
fn repeated<T: Copy>(field: &[T], lengths: [usize; 2], size: usize) -> Vec<T> {
    if field.is_empty() {
        return Vec::new();
    }
    // The first element of the square lies (N − N_x)/2 before the first of the cell.
    let within = |axis: usize, i: usize| {
        let length = lengths[axis];
        (i + size * length - (size - length) / 2) % length
    };
    let row = |i: usize| (0..size).map(move |j| within(0, i) * lengths[1] + within(1, j));
    (0..size)
        .flat_map(row)
        .map(|element| field[element])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oblong_cell_repeats_around_its_middle() {
        // Two rows of four.
        let field = [0, 1, 2, 3, 10, 11, 12, 13];
        let found = repeated(&field, [2, 4], 4);
        let [one, two] = [&field[..4], &field[4..]];
        assert_eq!(found, [two, one, two, one].concat());
        let found = repeated(&[0, 1, 10, 11, 20, 21], [3, 2], 3);
        assert_eq!(found, [0, 1, 0, 10, 11, 10, 20, 21, 20]);
        assert!(repeated::<f64>(&[], [3, 2], 3).is_empty());
    }
}
