//! Elements held at the hardness, and what they leave of the problem for the others.
//!
//! Where the elements of a set `H` have the pressure `p_max`, the others solve a problem without a limit:
//!
//! ```text
//! g0′ = g0 + K p_H outside H, +∞ on H,      Q′ = Q − 4a² Σ p_H
//! ```

use crate::{DiscreteProblem, Load};

/// Some elements held at the hardness; fields hold N² values.
#[derive(Default)]
pub struct HeldPressure {
    /// Which.
    pub mask: Vec<bool>,
    /// `g0′`, in m.
    pub gap: Vec<f64>,
    /// `K p_H`, in m.
    pub displacement: Vec<f64>,
    /// `Σ p_H`, in Pa.
    pub total: f64,
}

impl HeldPressure {
    /// None of so many.
    pub fn none(problem: &DiscreteProblem) -> Self {
        Self {
            mask: vec![false; problem.elements()],
            gap: problem.initial_gap().to_vec(),
            displacement: vec![0.0; problem.elements()],
            total: 0.0,
        }
    }

    /// Finds what is left for the others of the elements now in the mask; returns the products that it took: one, where
    /// there are any.
    pub fn press(&mut self, problem: &mut DiscreteProblem) -> usize {
        let limit = problem.hardness();
        self.total = limit * self.count() as f64;
        self.gap.copy_from_slice(problem.initial_gap());
        if self.total == 0.0 {
            self.displacement.fill(0.0);
            return 0;
        }
        let mut pressure = vec![0.0; self.mask.len()];
        self.add_to(&mut pressure, limit);
        problem.displace(&pressure, &mut self.displacement);
        let fields = self.gap.iter_mut().zip(&self.mask);
        for ((gap, held), u) in fields.zip(&self.displacement) {
            *gap = if *held { f64::INFINITY } else { *gap + u };
        }
        1
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.mask.iter().filter(|held| **held).count()
    }

    /// The load that is left for the others.
    pub fn rest_of(&self, load: Load, loaded_area: f64) -> Load {
        match load {
            Load::Force(force) => Load::Force(force - loaded_area * self.total),
            penetration @ Load::Penetration(_) => penetration,
        }
    }

    /// Sets the pressures held to the limit (Pa).
    pub fn add_to(&self, pressure: &mut [f64], limit: f64) {
        let held = pressure.iter_mut().zip(&self.mask);
        held.filter(|(_, held)| **held)
            .for_each(|(p, _)| *p = limit);
    }

    /// Sets the pressures held to 0.
    pub fn take_from(&self, pressure: &mut [f64]) {
        self.add_to(pressure, 0.0);
    }
}
