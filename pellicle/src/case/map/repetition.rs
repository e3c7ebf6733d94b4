//! A map that repeats: samples of its neighbours around it.

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
    let (shape, extent) = (map.shape(), map.extent());
    let rim = shape.map(|samples| match how {
        Repetition::InPlace => REACH,
        Repetition::Centred => samples.div_ceil(2) + REACH,
    });
    let wider = [0, 1].map(|axis: usize| shape[axis] + 2 * rim[axis]);
    let around = |i: usize, axis: usize| (i + rim[axis] * (shape[axis] - 1)) % shape[axis];
    let heights = (0..wider[0]).flat_map(|i| {
        let row = &map.heights()[around(i, 0) * shape[1]..][..shape[1]];
        (0..wider[1]).map(move |j| row[around(j, 1)])
    });
    let sides = [0, 1].map(|axis: usize| extent[axis] * wider[axis] as f64 / shape[axis] as f64);
    let rimmed = HeightMap::new(heights.collect(), wider, sides)?;
    Ok(rimmed.with_interpolation(map.interpolation()))
}
