//! Peaks less than an element below the surface.
//!
//! At the rim of a punch, under a sharp tip and on a rough surface stresses are largest there. Where the pressure is
//! smooth, such a peak is not: only the steps from element to element are seen so near to the surface.

use pellicle_influence::Depth;

use super::judgement::BESIDE_EDGE;
use super::{ExtremeFinder, Shared, depth_in};
use crate::result::peak::place_near;
use crate::stress::edge_extreme::is_near_edge;
use crate::stress::peak_search::StressPeak;
use crate::stress::plane_scan::Target;
use crate::stress::quantity::StressQuantity;
use crate::{ContactError, PeakPlace};

/// Peaks less than this many elements below the surface are compared with the values under centres at these parts of an
/// element.
const ELEMENTS_BELOW_SURFACE: f64 = 3.0;
const BELOW_SURFACE: [f64; 3] = [0.25, 0.5, 0.75];
/// A peak is climbed to from a centre with this part of the largest value known.
const NEARLY: f64 = 0.7;

impl ExtremeFinder<'_> {
    /// Replaces the peaks of a target's quantities by larger ones near the surface.
    pub(super) fn look_near_surface(
        &self,
        Shared {
            is_smooth,
            fine,
            rough,
            ..
        }: &mut Shared,
        target: &Target,
        depths: &[Depth],
        peaks: &mut [StressPeak],
    ) -> Result<(), ContactError> {
        let element = self.field.grid().element_side();
        let ends = [depths[0].z, depths[depths.len() - 1].z];
        if ends[0] >= ELEMENTS_BELOW_SURFACE * element {
            return Ok(());
        }
        let is_wanted = |(quantity, peak): (&StressQuantity, &StressPeak)| {
            peak.at[2] < ELEMENTS_BELOW_SURFACE * element
                && *quantity != StressQuantity::MinPrincipal
                && !(*is_smooth && self.is_away_from_sharp(peak.at))
        };
        let wanted: Vec<bool> = target
            .quantities
            .iter()
            .zip(&*peaks)
            .map(is_wanted)
            .collect();
        // Depth by depth, so that the quantities share its stresses.
        for z in BELOW_SURFACE.map(|part| part * element) {
            if z <= ends[0] || z >= ends[1] {
                continue;
            }
            let depth = depth_in(depths, z);
            let quantities = target.quantities.iter().zip(&mut *peaks).zip(&wanted);
            for ((quantity, peak), _) in quantities.filter(|(_, is_wanted)| **is_wanted) {
                let [x, y, _] = peak.at;
                let there = fine.under_nearest(rough, *quantity, ([x, y], depth))?;
                if there.value < NEARLY * peak.value {
                    continue;
                }
                let below = fine.climb(rough, *quantity, ([x, y], depth))?;
                if below.value > peak.value {
                    *peak = below;
                }
            }
        }
        Ok(())
    }

    /// Whether a place is some elements away from anything sharp.
    fn is_away_from_sharp(&self, [x, y, _]: [f64; 3]) -> bool {
        let (path, side) = (self.path, self.path.grid.element_side());
        place_near(&path.relief, &path.indenter, side, [x, y]) == PeakPlace::Inside
    }

    /// Whether a place is some elements away from anything sharp and from the contact's edge.
    pub(super) fn is_away_from_edges(&self, at: [f64; 3]) -> bool {
        self.is_away_from_sharp(at) && !is_near_edge(&self.field, [at[0], at[1]], BESIDE_EDGE)
    }
}
