//! The hardness of a problem: the largest force, the elements held at the hardness, and the remaining problem of the
//! others.
//!
//! With the pressure `p_max` on the elements of a set `H`, the others form a problem without a limit:
//!
//! ```text
//! g0′ = g0 + K p_H outside H, +∞ on H,      Q′ = Q − 4a² Σ p_H
//! ```

use super::{DiscreteProblem, Identity, fields::check_hardness};
use crate::{ContactError, Load, problem::held_pressure::HeldPressure};

impl DiscreteProblem {
    /// The same problem with the pressure limited to a hardness `p_max` (Pa): `0 ≤ p ≤ p_max`, and `g ≤ 0` allowed
    /// where `p = p_max`.
    ///
    /// # Errors
    /// [`ContactError::Hardness`] unless the hardness is positive and finite.
    pub fn with_hardness(self, hardness: f64) -> Result<Self, ContactError> {
        check_hardness(hardness)?;
        Ok(Self {
            hardness,
            identity: Identity::default(),
            ..self
        })
    }

    /// The hardness `p_max`, in Pa; infinite without a limit.
    #[must_use]
    pub fn hardness(&self) -> f64 {
        self.hardness
    }

    /// Whether the hardness limits the pressure.
    pub(crate) fn has_hardness(&self) -> bool {
        self.hardness.is_finite()
    }

    /// Returns an error if a force exceeds what the elements that can touch can carry.
    pub(crate) fn check_capacity(&self, load: Load) -> Result<(), ContactError> {
        let Load::Force(force) = load else {
            return Ok(());
        };
        if !self.has_hardness() {
            return Ok(());
        }
        let touchable = self.initial_gap.iter().filter(|gap| gap.is_finite());
        let area = self.loaded_area() * touchable.count() as f64;
        let (hardness, most) = (self.hardness, self.hardness * area);
        if force <= most {
            Ok(())
        } else {
            Err(ContactError::BeyondHardness {
                force,
                hardness,
                area,
                most,
            })
        }
    }

    /// Held pressure of no elements.
    pub(crate) fn none_held(&self) -> HeldPressure {
        HeldPressure {
            mask: vec![false; self.elements()],
            gap: self.initial_gap().to_vec(),
            displacement: vec![0.0; self.elements()],
            total: 0.0,
        }
    }

    /// Computes the remaining problem of the other elements from the mask of held ones. Returns the products taken: one
    /// if any element is held.
    pub(crate) fn press_held(&mut self, held: &mut HeldPressure) -> usize {
        let limit = self.hardness();
        held.total = limit * held.count() as f64;
        held.gap.copy_from_slice(self.initial_gap());
        if held.total == 0.0 {
            held.displacement.fill(0.0);
            return 0;
        }
        let mut pressure = vec![0.0; held.mask.len()];
        held.add_to(&mut pressure, limit);
        self.displace(&pressure, &mut held.displacement);
        let fields = held.gap.iter_mut().zip(&held.mask);
        for ((gap, held), u) in fields.zip(&held.displacement) {
            *gap = if *held { f64::INFINITY } else { *gap + u };
        }
        1
    }

    /// Solves with some elements held, as part of the load.
    pub(crate) fn under<T>(
        &mut self,
        held: &mut HeldPressure,
        solve: impl FnOnce(&mut Self) -> T,
    ) -> T {
        self.held = Some(std::mem::take(held));
        let found = solve(self);
        *held = self.held.take().unwrap_or_default();
        found
    }

    /// `Σ p` (Pa) of the elements held at the limit.
    pub(crate) fn held_total(&self) -> f64 {
        self.held.as_ref().map_or(0.0, |held| held.total)
    }
}
