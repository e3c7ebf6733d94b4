//! The order from coarse to fine, and the offsets of the nearest earlier elements.
//!
//! An element with indices (i, j) is on the level `l` for which 2ˡ is the largest power of two that divides both, and
//! has one of three colours by the parities of (i, j)/2ˡ. Higher levels come first; within a level, the elements with
//! both odd, then those with the first odd, then the rest; within a colour, by index. The offsets to earlier elements,
//! in units of 2ˡ, then depend only on the colour.

/// The level and colour of an element, which determine its rank in the order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rank {
    /// `l`: the spacing of elements of this level and above is 2ˡ.
    pub level: u32,
    /// Parities (odd, odd), (odd, even), (even, odd).
    pub colour: u32,
}

/// A level above those of any grid, for the element (0, 0).
pub const TOP: u32 = 20;

impl Rank {
    pub fn of(i: i32, j: i32) -> Self {
        let level = (i | j | 1 << TOP).trailing_zeros();
        let colour = match ((i >> level) & 1, (j >> level) & 1) {
            (1, 0) => 1,
            (0, 1) => 2,
            _ => 0,
        };
        Self { level, colour }
    }
}

/// The `count` offsets, nearest first and in units of the level's spacing, that lead from an element of `colour` to
/// earlier elements.
pub fn earlier_offsets(colour: u32, count: usize) -> Vec<[i32; 2]> {
    let mut offsets = Vec::new();
    let mut reach = 4;
    while offsets.len() < count {
        reach *= 2;
        offsets = within(colour, reach);
    }
    offsets.sort_by_key(|[x, y]| (x * x + y * y, *x, *y));
    offsets.truncate(count);
    offsets
}

/// The offsets to earlier elements within a radius.
fn within(colour: u32, reach: i32) -> Vec<[i32; 2]> {
    let places = (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| [x, y]));
    places
        .filter(|[x, y]| x * x + y * y <= reach * reach && is_earlier(colour, [*x, *y]))
        .collect()
}

fn is_earlier(colour: u32, [x, y]: [i32; 2]) -> bool {
    match (colour, x & 1, y & 1) {
        // The same colour: by index.
        (_, 0, 0) => x < 0 || (x == 0 && y < 0),
        // To coarser levels, and from the second colour to the first; from the third to all others.
        (0, 1, 1) | (1, 1, 0) | (1, 0, 1) | (2, _, _) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{Rank, earlier_offsets};

    /// The sort key of the whole order.
    fn place(i: i32, j: i32) -> (u32, u32, i32, i32) {
        let Rank { level, colour } = Rank::of(i, j);
        (20 - level, colour, i, j)
    }

    #[test]
    fn every_offset_leads_to_an_earlier_element() {
        for (i, j) in [(17, 23), (17, 22), (18, 23), (24, 40), (20, 36), (16, 24)] {
            let Rank { level, colour } = Rank::of(i, j);
            for [x, y] in earlier_offsets(colour, 60) {
                let (other_i, other_j) = (i + (x << level), j + (y << level));
                assert!(
                    place(other_i, other_j) < place(i, j),
                    "{i} {j} to {other_i} {other_j}"
                );
            }
        }
    }

    #[test]
    fn no_earlier_neighbour_of_the_finest_level_is_left_out() {
        for (i, j) in [(101, 101), (101, 100), (100, 101)] {
            let near = (-3..=3).flat_map(|x| (-3..=3).map(move |y| [x, y]));
            let earlier = near.filter(|[x, y]| place(i + x, j + y) < place(i, j));
            let listed = earlier_offsets(Rank::of(i, j).colour, 100);
            assert!(earlier.into_iter().all(|offset| listed.contains(&offset)));
        }
    }
}
