//! Numbers for human readers, and the quantities of a case.

pub use pellicle_plot::display::{
    DisplayUnit, Unit, count, error_of, memory, position, quantity, settled, short, significant,
    span,
};

use crate::input::dimension::Dimension;
use crate::input::units::Units;

/// A quantity of a case with its unit; an angle, in rad, is shown in degrees, a compliance in nm/GPa.
#[must_use]
pub fn dimensional(value: f64, dimension: Dimension, units: Units) -> String {
    let of = |unit| quantity(value, unit, units);
    match (dimension, units) {
        (Dimension::Angle, _) => format!("{}°", significant(value.to_degrees(), 5)),
        (Dimension::Length, _) => of(Unit::Metre),
        (Dimension::Pressure, _) => of(Unit::Pascal),
        (Dimension::Force, _) => of(Unit::Newton),
        (Dimension::Stiffness, _) => of(Unit::NewtonPerMetre),
        (_, Units::Consistent) => significant(value, 5),
        (Dimension::Compliance, Units::Si) => format!("{} nm/GPa", significant(value * 1e18, 5)),
        (Dimension::FrameCompliance | Dimension::Time, Units::Si) => {
            format!("{} {}", significant(value, 5), dimension.si_unit())
        }
    }
}
