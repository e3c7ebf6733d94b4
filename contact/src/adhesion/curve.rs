//! Forces and penetrations of an adhesive contact over its radius.

use std::cell::RefCell;
use std::f64::consts::PI;

use super::contact::{Adhesion, AdhesiveContact};
use super::law::{ADHESION_RANGE, AdhesionLaw};
use super::turns::Turns;
use crate::ContactError;
use crate::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use crate::path::domain::root_finding::where_zero;

/// The contacts of an indenter on a body with a work of adhesion.
///
/// ```
/// use pellicle_contact::adhesion::{Adhesion, AdhesionLaw, AdhesiveCurve};
/// use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
/// use pellicle_kernel::{Foundation, Material};
///
/// let gel = Foundation::half_space(Material::new(10e3, 0.5)?);
/// let ball = AxisymmetricProfile::Paraboloid { radius: 10e-6 };
/// let adhesion = Adhesion { work: 1e-3, law: AdhesionLaw::Jkr };
/// let curve = AdhesiveCurve::new(AxisymmetricElasticity::new(&gel.into()), ball, adhesion)?;
/// // −3/2 π w R; the search ends at 1e-14.
/// let wanted = -1.5 * std::f64::consts::PI * 1e-3 * 10e-6;
/// assert!((curve.pull_off().force / wanted - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct AdhesiveCurve {
    elasticity: AxisymmetricElasticity,
    profile: AxisymmetricProfile,
    adhesion: Adhesion,
    /// Compliance in series, m/N.
    series: f64,
    pull_off: Turns,
    last: Turns,
}

impl AdhesiveCurve {
    /// The curve.
    ///
    /// # Errors
    /// [`ContactError::WorkOfAdhesion`] if w is not positive and finite, [`ContactError::NoDmtFormula`] for DMT under
    /// another shape than a paraboloid or a sphere, [`ContactError::AxisymmetricRadius`] if the indenter ends before
    /// its pull-off, or layers are much thinner than the contact at pull-off is wide.
    pub fn new(
        elasticity: AxisymmetricElasticity,
        profile: AxisymmetricProfile,
        adhesion: Adhesion,
    ) -> Result<Self, ContactError> {
        let work = adhesion.work;
        if !(work > 0.0 && work.is_finite()) {
            return Err(ContactError::WorkOfAdhesion { work });
        }
        let mut curve = Self {
            elasticity,
            profile,
            adhesion,
            series: 0.0,
            pull_off: Turns::default(),
            last: Turns::default(),
        };
        match adhesion.law {
            AdhesionLaw::Dmt => {
                let end = AdhesiveContact {
                    force: -curve.adhesion.pull(profile)?,
                    ..AdhesiveContact::APART
                };
                curve.pull_off = Turns::only(end);
                curve.last = curve.pull_off.clone();
            }
            AdhesionLaw::Jkr => {
                curve.pull_off = curve.turns(|contact| contact.force)?;
                curve.last = curve.turns(|contact| contact.penetration)?;
            }
        }
        Ok(curve)
    }

    /// The same contacts behind a spring of a compliance c (m/N), such as a cantilever, whose end approaches by
    /// `D + c F`: a prescribed penetration is then that of the end of the spring, and the contact jumps out the nearer
    /// to the pull-off the softer the spring.
    ///
    /// # Errors
    /// Those of [`Self::at_radius`].
    pub fn behind_spring(mut self, compliance: f64) -> Result<Self, ContactError> {
        self.series = compliance;
        if self.adhesion.law == AdhesionLaw::Jkr {
            self.last = self.turns(|contact| contact.penetration + compliance * contact.force)?;
        }
        Ok(self)
    }

    /// The penetration of the end of the spring, m.
    fn approach(&self, contact: &AdhesiveContact) -> f64 {
        contact.penetration + self.series * contact.force
    }

    /// The contact under the least force, where it jumps out if the force is prescribed.
    #[must_use]
    pub fn pull_off(&self) -> AdhesiveContact {
        self.pull_off.last()
    }

    /// The contact at the least penetration, where it jumps out if the penetration is prescribed.
    #[must_use]
    pub fn last_contact(&self) -> AdhesiveContact {
        self.last.last()
    }

    /// Where a contact that is withdrawn under a prescribed force leaves the branch of wide contacts: the
    /// [pull-off](Self::pull_off), unless there are two branches.
    #[must_use]
    pub fn end_under_force(&self) -> AdhesiveContact {
        self.pull_off.first()
    }

    /// The same under a prescribed penetration: the [last contact](Self::last_contact), unless there are two branches.
    #[must_use]
    pub fn end_under_penetration(&self) -> AdhesiveContact {
        self.last.first()
    }

    /// The contact of this radius (m), stable or not; its errors are [`AdhesiveContact::errors`].
    ///
    /// # Errors
    /// Those of [`AxisymmetricElasticity::contact`].
    pub fn at_radius(&self, radius: f64) -> Result<AdhesiveContact, ContactError> {
        AdhesiveContact::of(&self.elasticity, self.profile, self.adhesion, radius)
    }

    /// The stable contact under a prescribed force (N); of two the wider, which a withdrawn contact is.
    ///
    /// # Errors
    /// [`ContactError::BeyondPullOff`] if the force is below that of [`Self::pull_off`]; those of [`Self::at_radius`].
    pub fn at_force(&self, force: f64) -> Result<AdhesiveContact, ContactError> {
        let pull_off = self.pull_off().force;
        if force.is_nan() || force < pull_off {
            return Err(ContactError::BeyondPullOff { force, pull_off });
        }
        self.where_reached(&self.pull_off, |contact| contact.force - force)
    }

    /// The stable contact at a prescribed penetration (m), of two the wider, which a withdrawn contact is; none if it
    /// is below that of [`Self::last_contact`].
    ///
    /// # Errors
    /// Those of [`Self::at_radius`].
    pub fn at_penetration(
        &self,
        penetration: f64,
    ) -> Result<Option<AdhesiveContact>, ContactError> {
        if penetration < self.approach(&self.last_contact()) {
            return Ok(None);
        }
        let found = self.where_reached(&self.last, |contact| self.approach(contact) - penetration);
        found.map(Some)
    }

    /// The work lost by a contact that is made and broken under a prescribed penetration, J.
    ///
    /// It jumps in at `D = 0`, where the surfaces meet, and out at the least penetration; the loop between both lies
    /// below the axis. 0 for DMT, whose contact comes back along the same way.
    ///
    /// # Errors
    /// Those of [`Self::at_radius`].
    pub fn work_lost(&self) -> Result<f64, ContactError> {
        let jump_in = self.at_penetration(0.0)?;
        // F d(D + c F) = d(U + c F²/2), and −∫ F d(D + c F) from the last contact to that at 0
        let energy = |of: &AdhesiveContact| of.energy + 0.5 * self.series * of.force.powi(2);
        Ok(jump_in.map_or(0.0, |contact| {
            energy(&self.last_contact()) - energy(&contact)
        }))
    }

    /// Tabor's number `μ = (R w²/(E*² z₀³))^{1/3}` (D. Tabor 1977): the height of the neck at pull-off over the range
    /// `z₀` of adhesion, [`ADHESION_RANGE`]. None for shapes without a radius of curvature at the tip.
    ///
    /// On layers `E*` is `S/(2a)`, the modulus of the half-space on which a contact as wide has the same stiffness, at
    /// pull-off by JKR, and under no force by DMT.
    ///
    /// # Errors
    /// Those of [`Self::at_radius`].
    pub fn tabor_number(&self) -> Result<Option<f64>, ContactError> {
        let Some(radius) = self.profile.tip_radius() else {
            return Ok(None);
        };
        let contact = match self.adhesion.law {
            AdhesionLaw::Jkr => self.pull_off(),
            AdhesionLaw::Dmt => self.at_force(0.0)?,
        };
        let modulus = contact.stiffness / (2.0 * contact.radius);
        // R (w/E*)²/z₀³
        let cube = radius * (self.adhesion.work / modulus).powi(2) / ADHESION_RANGE.powi(3);
        Ok(Some(cube.cbrt()))
    }

    /// A radius of the order of that at pull-off on a half-space of a modulus `E*` (Pa), m: where adhesion pulls back
    /// by the penetration.
    fn scale(&self, modulus: f64) -> f64 {
        let pulled = |a: f64| (2.0 * PI * a * self.adhesion.work / modulus).sqrt();
        let rim = self.profile.rim();
        let ratio = |a: f64| {
            if a < rim {
                (self.profile.half_space_penetration(a) / pulled(a)).ln()
            } else {
                f64::INFINITY
            }
        };
        where_zero(ratio).min(0.5 * rim)
    }

    /// The contacts with the least values.
    fn turns(&self, value: impl Fn(&AdhesiveContact) -> f64) -> Result<Turns, ContactError> {
        let [softest, stiffest] = self.elasticity.moduli();
        let scales = [stiffest, softest].map(|modulus| self.scale(modulus));
        Turns::find(scales, |radius| self.at_radius(radius), value)
    }

    /// The widest contact on a rising branch at which a quantity, least at these turns, is no longer negative.
    fn where_reached(
        &self,
        turns: &Turns,
        excess: impl Fn(&AdhesiveContact) -> f64,
    ) -> Result<AdhesiveContact, ContactError> {
        let Some((first, end)) = turns.branch(|turn| excess(turn) < 0.0) else {
            return Ok(turns.last());
        };
        let unit = if first.radius > 0.0 {
            first.radius
        } else {
            self.scale(self.elasticity.modulus())
        };
        let failure = RefCell::new(None);
        let value = |ratio: f64| {
            let radius = unit * ratio;
            if radius <= first.radius {
                return f64::NEG_INFINITY;
            }
            if radius >= end {
                return f64::INFINITY;
            }
            match self.at_radius(radius) {
                Ok(contact) => excess(&contact),
                // Beyond the rim or the layers: the search turns back.
                Err(error) => {
                    *failure.borrow_mut() = Some(error);
                    f64::INFINITY
                }
            }
        };
        let ratio = where_zero(value);
        match self.at_radius((unit * ratio).max(first.radius)) {
            Err(error) => Err(failure.into_inner().unwrap_or(error)),
            found => found,
        }
    }
}
