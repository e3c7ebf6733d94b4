//! The error of an extreme, and whether the grid resolves it; beside the contact's edge it is that of the edge.

use pellicle_influence::Depth;

use super::{ExtremeFinder, ON_AXIS, Shared};
use crate::result::peak::place_near;
use crate::stress::edge_extreme::{Wanted, edge_extreme, is_near_edge};
use crate::stress::extreme::Extreme;
use crate::stress::peak_search::StressPeak;
use crate::stress::plane_scan::Target;
use crate::stress::quantity::StressQuantity;
use crate::{ContactError, ErrorEstimate, PeakPlace};

/// An extreme within this many elements of the surface and near something sharp grows with the grid.
const ELEMENTS_FROM_SURFACE: f64 = 2.0;
/// Stresses sampled on the surface within this many elements of the contact's edge are not those of the continuum,
/// whose tension has a cusp there.
pub const BESIDE_EDGE: isize = 3;
/// The pressures of the two outermost elements are up to 15 % off, and so are stresses under sliding on the surface
/// there.
const OUTERMOST: isize = 2;

impl ExtremeFinder<'_> {
    /// The extreme of a quantity, in the topmost body or another one, where sampled stresses beside the edge of the
    /// contact are not those of the continuum.
    pub(super) fn judged_beside_edge(
        &self,
        (quantity, is_on_top): (StressQuantity, bool),
        judged: Extreme<3>,
    ) -> Result<Extreme<3>, ContactError> {
        if is_on_top && quantity == StressQuantity::MaxPrincipal {
            return self.or_at_edge(judged, Wanted::Error(self.coarser.last()));
        }
        let ([x, y, z], element) = (judged.at, self.field.grid().element_side());
        let slides = self.field.slides();
        let is_outermost = slides && z < element && is_near_edge(&self.field, [x, y], OUTERMOST);
        Ok(Extreme {
            resolved: judged.resolved && !is_outermost,
            ..judged
        })
    }

    /// Replaces the largest tension of the topmost body by that at the contact's edge if this is larger, or if the
    /// value was sampled beside the edge and is not clearly larger: the cusp at the edge is sampled too small, and what
    /// is larger is a peak of its own, as where a coating bends.
    pub(super) fn or_at_edge(
        &self,
        sampled: Extreme<3>,
        wanted: Wanted,
    ) -> Result<Extreme<3>, ContactError> {
        let Self {
            path, step, field, ..
        } = self;
        let at_edge = edge_extreme(path, step, field, wanted)?;
        let [x, y, z] = sampled.at;
        let is_beside = z < field.grid().element_side() && is_near_edge(field, [x, y], BESIDE_EDGE);
        Ok(match at_edge {
            Some(edge) if edge.value >= sampled.value => edge,
            Some(edge) if is_beside && edge.resolved => {
                let errors = edge.estimate.unwrap_or(0.0) + sampled.estimate.unwrap_or(0.0);
                if sampled.value - edge.value > errors {
                    sampled
                } else {
                    edge
                }
            }
            _ => Extreme {
                resolved: sampled.resolved && !is_beside,
                ..sampled
            },
        })
    }

    /// Adds to the error of an extreme what the steps of a graded body leave unknown: stresses along the surface jump
    /// from each of its layers to the next, so one is off by up to half the jump above or below.
    pub(super) fn with_grading(
        &self,
        shared: &mut Shared<'_>,
        (target, quantity): (&Target, StressQuantity),
        extreme: Extreme<3>,
    ) -> Result<Extreme<3>, ContactError> {
        let foundation = self.field.tables().foundation();
        let steps = (1..=foundation.layers().len()).map(|index| foundation.interface_depth(index));
        let steps = steps.filter(|z| *z > target.top && *z < target.bottom);
        let [x, y, z] = extreme.at;
        let mut steps: Vec<f64> = steps.collect();
        steps.sort_by(|one, other| (one - z).abs().total_cmp(&(other - z).abs()));
        let mut part = 0.0_f64;
        for step in steps.into_iter().take(2) {
            let mut value = |depth: Depth| {
                let state = shared.fine.state(shared.rough, [x, y], depth)?;
                Ok::<_, ContactError>(quantity.of(&state))
            };
            let [above, below] = [value(Depth::above(step))?, value(Depth::below(step))?];
            part = part.max(0.5 * (above - below).abs() / above.abs().max(below.abs()));
        }
        Ok(Extreme {
            estimate: extreme
                .estimate
                .map(|error| error + part * extreme.value.abs()),
            ..extreme
        })
    }

    /// Replaces an extreme in a body with residual stress that is larger far from the contact: by the value there, at a
    /// corner of the domain.
    pub(super) fn or_far_away(
        &self,
        near: Extreme<3>,
        target: &Target,
        quantity: StressQuantity,
    ) -> Extreme<3> {
        let residual = self.field.residual();
        let value = target.at_rest(quantity, residual);
        if residual.is_none() || target.is_interface() || value <= near.value {
            return near;
        }
        let corner = 0.5 * self.field.grid().side();
        Extreme {
            value,
            at: [corner, corner, target.top],
            resolved: true,
            estimate: Some(0.0),
        }
    }

    /// Returns the extreme with its error, from pairs of elements per side and value.
    pub(super) fn judged(&self, peak: StressPeak, values: &[(usize, f64)]) -> Extreme<3> {
        let Self { path, step, .. } = self;
        let [x, y, z] = peak.at;
        let side = path.grid.element_side();
        let is_near = place_near(&path.relief, &path.indenter, side, [x, y]) != PeakPlace::Inside;
        let is_at_edge = z < ELEMENTS_FROM_SURFACE * side && is_near;
        let meets_outline = step
            .grid_error
            .levels
            .iter()
            .any(|level| level.meets_outline);
        let accuracy = step.solution.certificate.worst() + path.tables.error_estimate();
        let error = ErrorEstimate::of_values(values, meets_outline, is_at_edge, accuracy);
        // A peak nearer to the axis than rounding resolves lies on it.
        let snapped = |along: f64| {
            if along.abs() < ON_AXIS * side {
                0.0
            } else {
                along
            }
        };
        Extreme {
            value: peak.value,
            at: [snapped(x), snapped(y), z],
            resolved: error.is_some_and(|error| error.resolved) && step.grid_error.resolves_waves(),
            estimate: error.map(|error| error.estimate),
        }
    }
}
