//! The exact value of a peak that the search has found.

use pellicle_influence::{CentreStresses, Depth, ElementDepths, ElementFields, SubsurfaceState};

use super::{ON_AXIS, depth_in};
use crate::ContactError;
use crate::stress::field::StressField;
use crate::stress::peak_search::StressPeak;
use crate::stress::pressure_blocks::{PressureBlocks, doublings};
use crate::stress::quantity::StressQuantity;

/// Exact states under one field; those at one depth share their functions.
pub struct ExactStates<'a> {
    field: &'a StressField,
    depths: ElementDepths,
    known: Vec<(Depth, f64, ElementFields)>,
}

impl<'a> ExactStates<'a> {
    pub fn new(field: &'a StressField) -> Result<Self, ContactError> {
        let side = field.grid().element_side();
        Ok(Self {
            field,
            depths: ElementDepths::new(field.tables().foundation(), side)?,
            known: Vec::new(),
        })
    }

    /// The peak with its exact value, on an axis if it is as near as places are accurate.
    pub fn peak(
        &mut self,
        quantity: StressQuantity,
        depths: &[Depth],
        peak: StressPeak,
    ) -> Result<StressPeak, ContactError> {
        let [x, y, z] = peak.at;
        let element = self.field.grid().element_side();
        let block = element * 2_f64.powi(doublings(z, element).cast_signed());
        let [x, y] = [x, y].map(|along| {
            if along.abs() < ON_AXIS * block {
                0.0
            } else {
                along
            }
        });
        let depth = depth_in(depths, z);
        let under_centre = if z < element {
            under_centre(self.field, [x, y], depth)?
        } else {
            None
        };
        let state = match under_centre {
            Some(state) => state,
            None => self.at([x, y], depth)?,
        };
        Ok(StressPeak {
            value: quantity.of(&state),
            at: [x, y, z],
        })
    }

    /// The state at a point.
    fn at(&mut self, point: [f64; 2], depth: Depth) -> Result<SubsurfaceState, ContactError> {
        let field = self.field;
        let farthest = point[0].hypot(point[1]) + field.grid().side();
        let is_known =
            |(other, reach, _): &(Depth, f64, ElementFields)| *other == depth && *reach >= farthest;
        let known = self.known.iter().position(is_known);
        let index = if let Some(index) = known {
            index
        } else {
            let fields = self.depths.fields(depth, farthest)?;
            self.known.push((depth, farthest, fields));
            self.known.len() - 1
        };
        let loaded = field.loaded().elements(field.grid());
        Ok(self.known[index]
            .2
            .sum_over(&loaded, field.tractions(), point))
    }
}

/// The exact state under a centre where the surface is dragged along, with what the steps of the traction take from it;
/// none without friction, or away from the loaded square.
fn under_centre(
    field: &StressField,
    point: [f64; 2],
    depth: Depth,
) -> Result<Option<SubsurfaceState>, ContactError> {
    let size = field.loaded().size;
    let place = PressureBlocks::new(field, 0).nearest(point);
    if !field.slides() || place.iter().any(|i| !(-1..=size.cast_signed()).contains(i)) {
        return Ok(None);
    }
    let side = field.grid().element_side();
    let foundation = field.tables().foundation();
    let mut stresses = CentreStresses::new(foundation, side, size + 1, field.tractions());
    stresses.move_to(depth)?;
    let pressure = &field.loaded().pressure;
    Ok(Some(stresses.at(pressure, size, place)))
}
