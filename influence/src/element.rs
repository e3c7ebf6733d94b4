//! One square element: its boundary, quadrature rules over it, and the coefficients that need no radial tables.

pub mod direct;
pub(crate) mod edges;
pub mod love;
pub(crate) mod product_rule;

use crate::error::InfluenceError;

/// Returns an error unless the side is a finite positive length.
pub(crate) fn check_element_side(element_side: f64) -> Result<(), InfluenceError> {
    if element_side.is_finite() && element_side > 0.0 {
        return Ok(());
    }
    Err(InfluenceError::ElementSide {
        found: element_side,
    })
}
