//! The elements held at a hardness, as a part of the load.

use crate::Load;

/// Elements held at the hardness; fields hold N² values.
#[derive(Default)]
pub struct HeldPressure {
    /// The held elements.
    pub mask: Vec<bool>,
    /// `g0′`, in m.
    pub gap: Vec<f64>,
    /// `K p_H`, in m.
    pub displacement: Vec<f64>,
    /// `Σ p_H`, in Pa.
    pub total: f64,
}

impl HeldPressure {
    /// Number of held elements.
    pub fn count(&self) -> usize {
        self.mask.iter().filter(|held| **held).count()
    }

    /// The load that remains for the other elements.
    pub fn rest_of(&self, load: Load, loaded_area: f64) -> Load {
        match load {
            Load::Force(force) => Load::Force(force - loaded_area * self.total),
            penetration @ Load::Penetration(_) => penetration,
        }
    }

    /// Sets the pressures of held elements to `limit` (Pa).
    pub fn add_to(&self, pressure: &mut [f64], limit: f64) {
        let held = pressure.iter_mut().zip(&self.mask);
        held.filter(|(_, held)| **held)
            .for_each(|(p, _)| *p = limit);
    }

    /// Sets the pressures of held elements to 0.
    pub fn take_from(&self, pressure: &mut [f64]) {
        self.add_to(pressure, 0.0);
    }
}
