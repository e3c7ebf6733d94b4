//! The dimension of the values of each key of a case.

use crate::input::dimension::Dimension;

/// The dimension of a key's value, or of the ends of its range; none if it is a number without a unit, or no number.
#[must_use]
pub fn of_key(key: &str) -> Option<Dimension> {
    Some(match key {
        "thickness" | "radius" | "tip_radius" | "height" | "period" | "offset" | "penetration"
        | "penetrations" | "side" | "sides" | "height_unit" | "depths" | "extent" => {
            Dimension::Length
        }
        "young_modulus"
        | "yield_strength"
        | "tensile_strength"
        | "hardness"
        | "interface_shear_strength"
        | "interface_tensile_strength" => Dimension::Pressure,
        "force" | "forces" => Dimension::Force,
        "half_angle" | "face_angle" | "direction" => Dimension::Angle,
        "compliance" | "normal_compliance" | "shear_compliance" => Dimension::Compliance,
        _ => return None,
    })
}
