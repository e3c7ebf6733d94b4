//! The section of a worn surface in a summary, from which its picture is drawn.

use pellicle_contact::SampledModel;
use pellicle_contact::wear::StepWear;

/// Most points of a section: a picture has fewer pixels.
const MOST: usize = 512;

/// The heights after wear along x beside the axis, at equally spaced points, m: of many each is the lowest of some.
pub fn section(unworn: &SampledModel, wear: &StepWear) -> Vec<f64> {
    let [rows, columns] = unworn.grid.lengths();
    let profile = unworn.relief.profile();
    let height = |row: usize| {
        let place = row * columns + columns / 2;
        profile[place] - wear.depth[place]
    };
    let heights: Vec<f64> = (0..rows).map(height).collect();
    let together = rows.div_ceil(MOST);
    // Equally spaced points need equally long parts.
    let together = (together..=rows)
        .find(|part| rows.is_multiple_of(*part))
        .unwrap_or(1);
    let lowest = |part: &[f64]| {
        part.iter()
            .fold(f64::INFINITY, |low, height| low.min(*height))
    };
    heights.chunks_exact(together).map(lowest).collect()
}
