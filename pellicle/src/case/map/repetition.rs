//! A map that repeats: how far its neighbours are needed around it.

use pellicle_texture::{HeightMap, TextureError};

/// The range over which a periodic map is needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repetition {
    /// The square and the reach of the interpolation; the map lies on the cell.
    InPlace,
    /// Half a side more, since the lowest point of the map is put on the axis.
    Centred,
}

/// Surrounds a periodic map with samples of its neighbours on all sides.
pub(super) fn with_rim(map: &HeightMap, how: Repetition) -> Result<HeightMap, TextureError> {
    /// The number of samples that an interpolation uses, and one more.
    const REACH: usize = 5;
    map.repeated(map.shape().map(|samples| match how {
        Repetition::InPlace => REACH,
        Repetition::Centred => samples.div_ceil(2) + REACH,
    }))
}
