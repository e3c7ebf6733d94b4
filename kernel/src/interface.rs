//! The interface between two bodies of a foundation.

use crate::KernelError;

/// The boundary between a layer and the body below it.
///
/// All kinds are *bilateral*: they transmit tension like compression, so that the foundation stays linear and a layer
/// cannot lift off. A layer on a frictionless interface is therefore held normal to the surface at every wavenumber. In
/// the plane it slides freely; only a wave of zero wavenumber (a rigid translation) could carry it away, and a normal
/// pressure never excites one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Interface {
    /// Displacements and tractions are continuous.
    #[default]
    Bonded,
    /// The shear traction is zero; normal displacement and traction are continuous.
    Frictionless,
    /// Tractions are continuous and displacements jump in proportion to them; built by [`Interface::spring`].
    Spring(Spring),
}

/// The compliances of an imperfect bond, at least one of which is neither bonded nor frictionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    normal: f64,
    shear: f64,
}

impl Interface {
    /// An imperfect bond: from the body above to the one below, `u_z` jumps by `c_n σ_zz` and `u_x`, `u_y` by `c_s`
    /// times the shear traction. Both compliances are in m/Pa; 0 is bonded, `c_s = ∞` frictionless.
    ///
    /// A thin interlayer of thickness `t` that is much softer than its neighbours is such a bond:
    /// `c_n = t (1 − 2ν)(1 + ν) / ((1 − ν) E)`, `c_s = t/G`.
    ///
    /// ```
    /// use pellicle_kernel::Interface;
    ///
    /// assert_eq!(Interface::spring(0.0, 0.0)?, Interface::Bonded);
    /// assert_eq!(Interface::spring(0.0, f64::INFINITY)?, Interface::Frictionless);
    /// assert!(Interface::spring(-1e-15, 0.0).is_err());
    /// # Ok::<(), pellicle_kernel::KernelError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`KernelError::NormalCompliance`] if `c_n` is negative, infinite or not a number: nothing would hold
    /// the layer. [`KernelError::ShearCompliance`] if `c_s` is negative or not a number.
    pub fn spring(normal_compliance: f64, shear_compliance: f64) -> Result<Self, KernelError> {
        let (normal, shear) = (normal_compliance, shear_compliance);
        if !(normal.is_finite() && normal >= 0.0) {
            return Err(KernelError::NormalCompliance { found: normal });
        }
        if shear.is_nan() || shear < 0.0 {
            return Err(KernelError::ShearCompliance { found: shear });
        }
        Ok(if normal > 0.0 || (shear > 0.0 && shear.is_finite()) {
            Self::Spring(Spring { normal, shear })
        } else if shear > 0.0 {
            Self::Frictionless
        } else {
            Self::Bonded
        })
    }

    /// `c_n`, m/Pa: the jump of `u_z` per `σ_zz`.
    #[must_use]
    pub fn normal_compliance(&self) -> f64 {
        match self {
            Self::Bonded | Self::Frictionless => 0.0,
            Self::Spring(spring) => spring.normal,
        }
    }

    /// `c_s`, m/Pa: the jump of `u_x` per `σ_xz`, infinite if frictionless.
    #[must_use]
    pub fn shear_compliance(&self) -> f64 {
        match self {
            Self::Bonded => 0.0,
            Self::Frictionless => f64::INFINITY,
            Self::Spring(spring) => spring.shear,
        }
    }

    /// Whether the interface transmits no shear.
    #[must_use]
    pub fn is_frictionless(&self) -> bool {
        self.shear_compliance().is_infinite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limiting_spring_compliances_give_the_plain_interfaces() {
        assert_eq!(Interface::spring(0.0, 0.0), Ok(Interface::Bonded));
        assert_eq!(Interface::spring(-0.0, -0.0), Ok(Interface::Bonded));
        let sliding = Interface::spring(0.0, f64::INFINITY);
        assert_eq!(sliding, Ok(Interface::Frictionless));
        let spring = Interface::spring(2.0, f64::INFINITY).unwrap();
        assert!(matches!(spring, Interface::Spring(_)) && spring.is_frictionless());
        assert!((spring.normal_compliance() - 2.0).abs() <= 0.0);
    }

    #[test]
    fn negative_and_infinite_compliances_are_refused_with_their_value() {
        for found in [-1.0, f64::INFINITY] {
            let refused = Interface::spring(found, 0.0);
            assert_eq!(refused, Err(KernelError::NormalCompliance { found }));
        }
        let refused = Interface::spring(0.0, -2.0);
        assert_eq!(refused, Err(KernelError::ShearCompliance { found: -2.0 }));
        assert!(Interface::spring(f64::NAN, 0.0).is_err());
        assert!(Interface::spring(0.0, f64::NAN).is_err());
    }
}
