//! What is done with the heights of a map before they are solved: its tilt is subtracted, its edges are made to fit.

use pellicle_texture::HeightMap;
use serde::Serialize;

/// What is done with the tilt of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LevelCase {
    /// The least-squares plane is subtracted.
    Plane,
    /// Nothing: a plane fitted to a map that repeats, such as a wave, is not zero, and without it the map would not
    /// repeat.
    #[default]
    None,
}

/// What is done where opposite edges of a map do not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub enum EdgesCase {
    /// Nothing.
    #[default]
    #[serde(rename = "as measured")]
    AsMeasured,
    /// Half of the step across the rim is taken from either edge and fades inwards.
    #[serde(rename = "taper")]
    Taper,
}

/// The words of the key `level`.
pub(super) const LEVELS: &[(&str, LevelCase)] =
    &[("plane", LevelCase::Plane), ("none", LevelCase::None)];

/// The words of the key `edges`.
pub(super) const EDGES: &[(&str, EdgesCase)] = &[
    ("as measured", EdgesCase::AsMeasured),
    ("taper", EdgesCase::Taper),
];

/// Whether a word is the default, which is not written.
pub(in crate::case) fn is_default<T: Default + PartialEq>(word: &T) -> bool {
    *word == T::default()
}

/// The heights to be solved.
pub(super) fn prepared(map: HeightMap, level: LevelCase, edges: EdgesCase) -> HeightMap {
    let map = match level {
        LevelCase::Plane => map.levelled(),
        LevelCase::None => map,
    };
    match edges {
        EdgesCase::Taper => map.tapered(),
        EdgesCase::AsMeasured => map,
    }
}
