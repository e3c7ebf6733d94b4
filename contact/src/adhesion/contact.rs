//! An adhesive contact of one radius.

use std::f64::consts::PI;

use super::law::AdhesionLaw;
use crate::ContactError;
use crate::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};

/// A work of adhesion and where it acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adhesion {
    /// Work of adhesion w, J/m².
    pub work: f64,
    /// Where it acts.
    pub law: AdhesionLaw,
}

impl Adhesion {
    /// The pull of undeformed shapes by DMT, N: `2π w R`.
    pub(super) fn pull(self, profile: AxisymmetricProfile) -> Result<f64, ContactError> {
        match profile {
            AxisymmetricProfile::Paraboloid { radius } | AxisymmetricProfile::Sphere { radius } => {
                Ok(2.0 * PI * self.work * radius)
            }
            AxisymmetricProfile::Cone { .. } | AxisymmetricProfile::Power { .. } => {
                Err(ContactError::NoDmtFormula)
            }
        }
    }
}

/// An adhesive contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdhesiveContact {
    /// Contact radius, m.
    pub radius: f64,
    /// Force, N; negative where the indenter is pulled.
    pub force: f64,
    /// Penetration, m; negative where the surface is pulled above its plane.
    pub penetration: f64,
    /// Stiffness `dF/dD` at constant radius, N/m.
    pub stiffness: f64,
    /// Elastic energy less w times the contact area, J: `dU/dD = F` along the curve.
    pub energy: f64,
    /// Force of the contact without adhesion that has the same radius, N.
    pub force_without: f64,
    /// Its penetration, m.
    pub penetration_without: f64,
    /// Relative accuracy of both.
    pub accuracy: f64,
}

impl AdhesiveContact {
    /// The contact of this radius (m), as [`AdhesiveCurve::at_radius`](super::AdhesiveCurve::at_radius), without the
    /// search for the ends of a curve.
    ///
    /// # Errors
    /// [`ContactError::NoDmtFormula`] for DMT under another shape than a paraboloid or a sphere; those of
    /// [`AxisymmetricElasticity::contact`].
    pub fn of(
        elasticity: &AxisymmetricElasticity,
        profile: AxisymmetricProfile,
        adhesion: Adhesion,
        radius: f64,
    ) -> Result<Self, ContactError> {
        let without = elasticity.contact(profile, radius)?;
        let stiffness = without.punch.stiffness;
        let area = PI * radius * radius;
        // F, D and U = ∫ F dD
        let (force, penetration, energy) = match adhesion.law {
            AdhesionLaw::Jkr => {
                // δ = √(2 w dA/dS)
                let back =
                    (4.0 * PI * radius * adhesion.work / without.punch.stiffness_slope).sqrt();
                let elastic = without.energy - without.force * back + 0.5 * stiffness * back * back;
                let energy = elastic - adhesion.work * area;
                (
                    without.force - stiffness * back,
                    without.penetration - back,
                    energy,
                )
            }
            AdhesionLaw::Dmt => {
                let pull = adhesion.pull(profile)?;
                let energy = without.energy - pull * without.penetration;
                (without.force - pull, without.penetration, energy)
            }
        };
        Ok(Self {
            radius,
            force,
            penetration,
            stiffness,
            energy,
            force_without: without.force,
            penetration_without: without.penetration,
            accuracy: elasticity.accuracy(profile),
        })
    }

    /// The indenter at the surface, without contact.
    pub(super) const APART: Self = Self {
        radius: 0.0,
        force: 0.0,
        penetration: 0.0,
        stiffness: 0.0,
        energy: 0.0,
        force_without: 0.0,
        penetration_without: 0.0,
        accuracy: 0.0,
    };

    /// Error of the force (N) and of the penetration (m) at this radius: the accuracy of the contact without adhesion
    /// times the terms that cancel.
    #[must_use]
    pub fn errors(&self) -> [f64; 2] {
        [
            (self.force_without, self.force),
            (self.penetration_without, self.penetration),
        ]
        .map(|(without, with)| self.accuracy * (without.abs() + (without - with).abs()))
    }
}
