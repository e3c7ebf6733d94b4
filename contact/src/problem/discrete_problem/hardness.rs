//! The hardness of a problem: what it carries at most, and the elements that are held at it.

use super::{DiscreteProblem, Identity, fields::check_hardness};
use crate::{ContactError, Load, problem::held_pressure::HeldPressure};

impl DiscreteProblem {
    /// The same problem with the pressure cut at a hardness `p_max` (Pa): `0 ≤ p ≤ p_max`, and `g ≤ 0` allowed where
    /// `p = p_max`.
    ///
    /// # Errors
    /// [`ContactError::Hardness`] unless it is positive and finite.
    pub fn with_hardness(self, hardness: f64) -> Result<Self, ContactError> {
        check_hardness(hardness)?;
        Ok(Self {
            hardness,
            identity: Identity::default(),
            ..self
        })
    }

    /// The hardness `p_max`, in Pa; infinite where nothing limits the pressure.
    #[must_use]
    pub fn hardness(&self) -> f64 {
        self.hardness
    }

    /// Whether the hardness limits the pressure.
    pub(crate) fn has_hardness(&self) -> bool {
        self.hardness.is_finite()
    }

    /// Refuses a force that the elements which can touch do not carry.
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

    /// Solves with some elements held at a pressure, as a part of the load.
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

    /// `Σ p` (Pa) of the elements that are held at the limit.
    pub(crate) fn held_total(&self) -> f64 {
        self.held.as_ref().map_or(0.0, |held| held.total)
    }
}
