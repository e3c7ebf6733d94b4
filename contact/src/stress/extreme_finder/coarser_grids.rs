//! The same peak on a coarser grid.

use pellicle_influence::{Depth, RoughDepths};

use super::depth_in;
use crate::ContactError;
use crate::stress::peak_search::{PeakSearch, StressPeak};
use crate::stress::plane_scan::window;
use crate::stress::quantity::StressQuantity;

/// Returns the value of the same peak on a coarser grid.
pub fn coarse_value(
    coarse: &mut PeakSearch,
    rough: &mut RoughDepths,
    quantity: StressQuantity,
    depths: &[Depth],
    peak: StressPeak,
) -> Result<f64, ContactError> {
    let [x, y, z] = peak.at;
    let depth = depth_in(depths, z);
    if z < coarse.field().grid().element_side() {
        return Ok(coarse.climb(rough, quantity, ([x, y], depth))?.value);
    }
    let apart = |index: &usize| (depths[*index].z - z).abs();
    let nearest = (0..depths.len()).min_by(|one, other| apart(one).total_cmp(&apart(other)));
    let is_at_end = z <= depths[0].z || z >= depths[depths.len() - 1].z;
    let around = match nearest {
        Some(nearest) if !is_at_end => {
            let around = window(depths.len(), nearest);
            let middle = nearest - around.start;
            (depths[around].to_vec(), middle)
        }
        _ => (vec![depth], 0),
    };
    let (found, rise) = coarse.between(rough, quantity, ([x, y], z), (&around.0, around.1))?;
    let [x, y, _] = found.at;
    let state = coarse.state(rough, [x, y], depth)?;
    Ok(quantity.of(&state) * rise)
}
