//! The prescribed quantity: force or penetration.

use crate::ContactError;

/// The control of one loading step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// Normal force `Q` on the indenter, in N (equilibrium (2.3) of the paper); positive.
    Force(f64),
    /// Penetration `D` of the indenter's lowest point below the undeformed plane of the tops, in m.
    ///
    /// Zero and negative values are valid: the indenter may just touch the surface or be above it.
    Penetration(f64),
}

impl Load {
    /// Checks that the value is finite, and positive for a force.
    ///
    /// # Errors
    /// [`ContactError::Force`] or [`ContactError::Penetration`] with the value found.
    pub fn checked(self) -> Result<Self, ContactError> {
        match self {
            Self::Force(force) if !(force > 0.0 && force.is_finite()) => {
                Err(ContactError::Force { force })
            }
            Self::Penetration(penetration) if !penetration.is_finite() => {
                Err(ContactError::Penetration { penetration })
            }
            load => Ok(load),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_must_be_positive_and_a_penetration_finite() {
        assert!(Load::Force(1.0).checked().is_ok());
        assert!(Load::Penetration(-1.0).checked().is_ok());
        for force in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Load::Force(force).checked(),
                Err(ContactError::Force { .. })
            ));
        }
        assert!(Load::Penetration(f64::NAN).checked().is_err());
    }
}
