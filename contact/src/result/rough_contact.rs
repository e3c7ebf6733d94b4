//! The contact of a rough surface beyond its area: islands, perimeter, mean gap, and the distributions of pressures and
//! gaps.
//!
//! **Nominal area.** A periodic cell is in nominal contact all over. Where the surface ends, the nominal area is the
//! convex hull of the elements in contact.
//!
//! **Area by the perimeter.** An element of a boundary-element method is in contact wherever a part of it would be, so
//! counting elements overestimates the area in proportion to the perimeter. Yastrebov, Anciaux and Molinari (2017)
//! subtract this excess,
//!
//! ```text
//! A = A_counted − (π − 1 + ln 2)/24 · S_d h,
//! ```
//!
//! where `S_d` is the length of all sides between elements in contact and others, and `h` the side of an element. The
//! contact area of a [`Summary`](crate::Summary) instead places the edge within its element, from the pressure and the
//! gap beside it. Both are compared with refined grids in `tests/tests/convergence/rough.rs`.

mod histogram;
mod islands;
mod nominal;

pub use histogram::Histogram;
pub use islands::Islands;

use islands::ContactPattern;
use nominal::Nominal;

use crate::{Indenter, Model, result::contact_field::ContactField};
use pellicle_texture::{Relief, nan_from_null};
use serde::{Deserialize, Serialize};

/// `(π − 1 + ln 2)/24`.
const PERIMETER_PART: f64 = (std::f64::consts::PI - 1.0 + std::f64::consts::LN_2) / 24.0;

/// The contact of a rough surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoughContact {
    /// Area of the periodic cell, or of the convex hull of the contact, in m².
    #[serde(deserialize_with = "nan_from_null")]
    pub nominal_area: f64,
    /// [Contact area](crate::Summary::contact_area) over nominal area; 1 where the hull of a contact, which is counted
    /// in whole elements, has less than the area.
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_fraction: f64,
    /// Area of the elements in contact, in m².
    #[serde(deserialize_with = "nan_from_null")]
    pub counted_area: f64,
    /// Counted area less the excess along the perimeter, in m².
    #[serde(deserialize_with = "nan_from_null")]
    pub corrected_area: f64,
    /// Length `S_d` of the sides between elements in contact and others, in m.
    #[serde(deserialize_with = "nan_from_null")]
    pub perimeter: f64,
    /// Gap averaged over the nominal area, 0 where there is contact, in m.
    #[serde(deserialize_with = "nan_from_null")]
    pub mean_gap: f64,
    /// The islands of contact.
    pub islands: Islands,
    /// Pressures in contact, in Pa.
    pub pressures: Histogram,
    /// Gaps out of contact on the nominal area, in m.
    pub gaps: Histogram,
}

impl RoughContact {
    /// Evaluates a contact of this area (m²) in which a measured map takes part; none for others or without contact.
    pub(crate) fn of(field: &ContactField<'_>, contact_area: f64) -> Option<Self> {
        if !is_rough(field.model) {
            return None;
        }
        let pattern = ContactPattern::of(field);
        let nominal = Nominal::of(field, &pattern)?;
        let (side, area) = (field.grid.element_side(), field.grid.element_area());
        let islands = pattern.island_sizes();
        let counted_area = islands.iter().sum::<usize>() as f64 * area;
        let nominal_area = nominal.elements * area;
        let perimeter = pattern.sides() as f64 * side;
        let gaps = nominal.gaps(field);
        let (pressures, _) = Histogram::of(field.region, field.pressure, |_, pressures| {
            pressures.iter().copied().filter(|p| *p > 0.0)
        });
        Some(Self {
            nominal_area,
            contact_fraction: (contact_area / nominal_area).min(1.0),
            counted_area,
            corrected_area: counted_area - PERIMETER_PART * perimeter * side,
            perimeter,
            mean_gap: gaps.mean,
            islands: Islands::of(&islands, area),
            pressures,
            gaps: gaps.histogram,
        })
    }
}

/// Whether a measured map takes part in the contact.
fn is_rough(model: &Model) -> bool {
    matches!(model.relief, Relief::Map(_)) || matches!(model.indenter, Indenter::Map(_))
}

#[cfg(test)]
mod tests;
