//! The laws of adhesion and where they hold.

use serde::{Deserialize, Serialize};

/// Distance z₀ over which adhesion acts, m: about that of atoms at rest on each other, 0.3 nm.
pub const ADHESION_RANGE: f64 = 3e-10;

/// JKR holds for elastic spheres with a Tabor number above this (K. L. Johnson and J. A. Greenwood 1997).
const JKR_FROM: f64 = 5.0;

/// DMT holds below this (the same).
const DMT_UP_TO: f64 = 0.1;

/// A law of adhesion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AdhesionLaw {
    /// Adhesion within the contact: soft bodies, large radii.
    #[default]
    Jkr,
    /// Adhesion outside the contact: stiff bodies, small radii.
    Dmt,
}

/// The part of the map of adhesion to which a Tabor number belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TaborRange {
    /// JKR holds, above 5.
    Jkr,
    /// Neither holds: the pull-off force of a sphere lies between both.
    Between,
    /// DMT holds, below 0.1.
    Dmt,
}

impl TaborRange {
    /// The part to which a Tabor number belongs.
    #[must_use]
    pub fn of(tabor_number: f64) -> Self {
        if tabor_number > JKR_FROM {
            Self::Jkr
        } else if tabor_number < DMT_UP_TO {
            Self::Dmt
        } else {
            Self::Between
        }
    }

    /// Whether a law holds here.
    #[must_use]
    pub fn admits(self, law: AdhesionLaw) -> bool {
        matches!(
            (self, law),
            (Self::Jkr, AdhesionLaw::Jkr) | (Self::Dmt, AdhesionLaw::Dmt)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_law_holds_in_its_range_only() {
        let [soft, middle, stiff] = [100.0, 1.0, 0.01].map(TaborRange::of);
        assert!(soft.admits(AdhesionLaw::Jkr) && !soft.admits(AdhesionLaw::Dmt));
        assert!(stiff.admits(AdhesionLaw::Dmt) && !stiff.admits(AdhesionLaw::Jkr));
        assert!(!middle.admits(AdhesionLaw::Jkr) && !middle.admits(AdhesionLaw::Dmt));
    }
}
