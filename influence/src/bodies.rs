//! The two elastic bodies whose displacements under a pressure add up.

mod direction;
mod parameter;

pub use direction::ElasticDirection;
pub use parameter::ElasticParameter;

use pellicle_kernel::{Foundation, Material};

/// A foundation and, if it is elastic too, the counterbody pressed against it: a half-space, like an indenter much
/// larger than the contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticBodies {
    foundation: Foundation,
    counterbody: Option<Material>,
}

impl ElasticBodies {
    /// A foundation under a counterbody; rigid if there is no material.
    #[must_use]
    pub fn new(foundation: Foundation, counterbody: Option<Material>) -> Self {
        Self {
            foundation,
            counterbody,
        }
    }

    /// The foundation.
    #[must_use]
    pub fn foundation(&self) -> &Foundation {
        &self.foundation
    }

    /// The material of the counterbody; `None` if it is rigid.
    #[must_use]
    pub fn counterbody(&self) -> Option<&Material> {
        self.counterbody.as_ref()
    }

    /// `C(k)` of both bodies together, m/Pa, at the wavenumber `k` (1/m): `C` of the foundation and `2/(E_i* k)` of
    /// the counterbody.
    #[must_use]
    pub fn compliance(&self, wavenumber: f64) -> f64 {
        let of_counterbody = self.counterbody.map_or(0.0, |material| {
            // 2/(E* k)
            2.0 / (material.plane_strain_modulus() * wavenumber.abs())
        });
        self.foundation.compliance(wavenumber) + of_counterbody
    }
}

impl From<Foundation> for ElasticBodies {
    /// A foundation under a rigid counterbody.
    fn from(foundation: Foundation) -> Self {
        Self::new(foundation, None)
    }
}
