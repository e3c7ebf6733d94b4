//! The order from coarse to fine, by tiles, and the offsets of the nearest earlier elements of a tile.
//!
//! An element with indices (i, j) is on the level `l` for which 2ˡ is the largest power of two that divides both.
//! Higher levels come first. The elements of a level are grouped into tiles of [`TILE`] × [`TILE`] places with spacing
//! 2ˡ, coloured with four colours; a level is ordered by colour, and tiles of one colour by index. So the offsets from
//! a tile to earlier elements, in units of 2ˡ, depend only on its colour.

/// Places along the side of a tile, an even number.
pub const TILE: i32 = 4;
/// Number of colours.
pub const COLOURS: u32 = 4;

/// The colour of a tile by its indices; tiles of the first two colours touch only at corners.
pub fn colour(x: i32, y: i32) -> u32 {
    match (x & 1, y & 1) {
        (0, 0) => 0,
        (1, 1) => 1,
        (0, _) => 2,
        _ => 3,
    }
}

/// The places of a tile's own elements, from its first place and in units of the level's spacing: those not on a
/// coarser level.
pub fn own_offsets() -> Vec<[i32; 2]> {
    let places = (0..TILE).flat_map(|x| (0..TILE).map(move |y| [x, y]));
    places.filter(|[x, y]| (x | y) & 1 == 1).collect()
}

/// The `count` offsets from the first place of a tile of `colour` to earlier elements, nearest to the tile first, in
/// units of the level's spacing.
pub fn earlier_offsets(of: u32, count: usize) -> Vec<[i32; 2]> {
    let mut offsets = Vec::new();
    let mut reach = 4;
    while offsets.len() < count {
        reach *= 2;
        offsets = within(of, reach);
    }
    offsets.sort_by_key(|offset| (distance_squared(*offset), *offset));
    offsets.truncate(count);
    offsets
}

/// The offsets to earlier elements within a distance from the tile.
fn within(of: u32, reach: i32) -> Vec<[i32; 2]> {
    let along = -reach..reach + TILE;
    let places = along
        .clone()
        .flat_map(|x| along.clone().map(move |y| [x, y]));
    places
        .filter(|offset| distance_squared(*offset) <= reach * reach && is_earlier(of, *offset))
        .collect()
}

/// The square of the distance from the tile.
fn distance_squared(offset: [i32; 2]) -> i32 {
    let along = offset.map(|along| (-along).max(along + 1 - TILE).max(0));
    along.iter().map(|along| along * along).sum()
}

fn is_earlier(of: u32, [x, y]: [i32; 2]) -> bool {
    let is_coarser = (x | y) & 1 == 0;
    // A tile whose indices have the parities of the colour.
    let first = [[0, 0], [1, 1], [0, 1], [1, 0]][of as usize];
    let away = [x, y].map(|along| along.div_euclid(TILE));
    let other = colour(first[0] + away[0], first[1] + away[1]);
    is_coarser || (other, away) < (of, [0, 0])
}

#[cfg(test)]
mod tests {
    use super::{TILE, colour, earlier_offsets, own_offsets};

    /// The level of an element.
    fn level(i: i32, j: i32) -> u32 {
        (i | j | 1 << 20).trailing_zeros()
    }

    /// The sort key of tiles.
    fn place([i, j]: [i32; 2]) -> (u32, u32, [i32; 2]) {
        let level = level(i, j);
        let tile = [i, j].map(|along| (along >> level).div_euclid(TILE));
        (20 - level, colour(tile[0], tile[1]), tile)
    }

    #[test]
    fn every_offset_leads_to_an_earlier_element() {
        for (first, level) in [([64, 64], 0), ([68, 68], 0), ([64, 72], 1), ([136, 128], 1)] {
            let tile: [i32; 2] = first.map(|i| (i >> level) / TILE);
            for own in own_offsets() {
                let own = place([0, 1].map(|axis| first[axis] + (own[axis] << level)));
                for offset in earlier_offsets(colour(tile[0], tile[1]), 60) {
                    let other = [0, 1].map(|axis| first[axis] + (offset[axis] << level));
                    assert!(place(other) < own, "{first:?} to {other:?}");
                }
            }
        }
    }

    #[test]
    fn no_earlier_neighbour_of_the_finest_level_is_left_out() {
        for first in [[64, 64], [68, 68], [64, 68], [68, 64]] {
            let colour = colour(first[0] / TILE, first[1] / TILE);
            let own = place([first[0], first[1] + 1]);
            let near = (-3..TILE + 3).flat_map(|x| (-3..TILE + 3).map(move |y| [x, y]));
            let earlier = near.filter(|[x, y]| place([first[0] + x, first[1] + y]) < own);
            let listed = earlier_offsets(colour, 150);
            assert!(earlier.into_iter().all(|offset| listed.contains(&offset)));
        }
    }
}
