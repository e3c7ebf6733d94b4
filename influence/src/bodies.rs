//! The two elastic bodies whose displacements under a pressure add up, and the directions in their parameters that
//! change the scale or preserve the compliance.

mod parameter;

pub use parameter::ElasticParameter;

use pellicle_kernel::{Base, Foundation, FoundationParameter, Material};

/// A foundation and, if it is elastic too, the counterbody pressed against it: a half-space, like an indenter much
/// larger than the contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticBodies {
    foundation: Foundation,
    counterbody: Option<Material>,
}

/// Rates of change `dθ/dt` of some parameters, each in its own unit.
pub type ElasticDirection = Vec<(ElasticParameter, f64)>;

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
        self.foundation.compliance(wavenumber) + self.counterbody_compliance(wavenumber)
    }

    /// `2/(E_i* k)` of the counterbody alone, m/Pa; 0 if it is rigid.
    pub(crate) fn counterbody_compliance(&self, wavenumber: f64) -> f64 {
        self.counterbody.map_or(0.0, |material| {
            // 2/(E* k)
            2.0 / (material.plane_strain_modulus() * wavenumber.abs())
        })
    }

    /// The counterbody alone, as a half-space under a rigid body; `None` if it is rigid.
    #[must_use]
    pub fn counterbody_alone(&self) -> Option<Self> {
        self.counterbody
            .map(|material| Foundation::half_space(material).into())
    }

    /// Displacement per uniform pressure on a cell that repeats, m/Pa, from the plane where displacements of that cell
    /// are measured.
    ///
    /// The mean displacement of a half-space is infinite and is left out: the foundation's on a half-space, layers
    /// included, and the counterbody's. What remains is the foundation's on a rigid base,
    /// [`Foundation::confined_compliance`]; 0 on a half-space.
    #[must_use]
    pub fn mean_compliance(&self) -> f64 {
        match self.foundation.base() {
            Base::Rigid => self.foundation.confined_compliance(),
            Base::HalfSpace(_) => 0.0,
        }
    }

    /// Whether the mean displacement of a cell that repeats is finite: a rigid base, and no counterbody.
    #[must_use]
    pub fn has_finite_mean(&self) -> bool {
        matches!(self.foundation.base(), Base::Rigid) && self.counterbody.is_none()
    }

    /// The change of all parameters under a change of scale; see
    /// [`Foundation::scaling`](pellicle_kernel::Foundation::scaling).
    #[must_use]
    pub fn scaling(&self, length: f64, modulus: f64) -> ElasticDirection {
        let of_foundation = self.foundation.scaling(length, modulus).into_iter();
        let of_foundation =
            of_foundation.map(|(of, change)| (ElasticParameter::Foundation(of), change));
        let of_counterbody = self.counterbody.map(|material| {
            let change = modulus * material.young_modulus();
            (ElasticParameter::CounterbodyYoungModulus, change)
        });
        of_foundation.chain(of_counterbody).collect()
    }

    /// Changes that preserve the compliance of both bodies together at every wavenumber: those of the
    /// [foundation](pellicle_kernel::Foundation::null_directions), the change of the counterbody's constants at
    /// constant `E_i*`, and on a homogeneous body the change of both moduli at constant `1/E* + 1/E_i*`.
    #[must_use]
    pub fn null_directions(&self) -> Vec<ElasticDirection> {
        let own = |(of, change)| (ElasticParameter::Foundation(of), change);
        let of_foundation = self.foundation.null_directions().into_iter();
        let of_foundation = of_foundation.map(|direction| direction.into_iter().map(own).collect());
        let mut directions: Vec<ElasticDirection> = of_foundation.collect();
        let Some(material) = &self.counterbody else {
            return directions;
        };
        let nu = material.poisson_ratio();
        directions.push(vec![
            // d ln E = −2ν/(1 − ν²) dν
            (
                ElasticParameter::CounterbodyYoungModulus,
                -2.0 * nu / ((1.0 - nu) * (1.0 + nu)) * material.young_modulus(),
            ),
            (ElasticParameter::CounterbodyPoissonRatio, 1.0),
        ]);
        if self.foundation.layers().is_empty() {
            // dE/E = E* dt, dE_i/E_i = −E_i* dt
            let surface = self.foundation.surface_material();
            let rate = |of: &Material| {
                of.young_modulus() * of.plane_strain_modulus() / surface.plane_strain_modulus()
            };
            let modulus = FoundationParameter::YoungModulus { body: 0 };
            directions.push(vec![
                (ElasticParameter::Foundation(modulus), rate(&surface)),
                (ElasticParameter::CounterbodyYoungModulus, -rate(material)),
            ]);
        }
        directions
    }
}

impl From<Foundation> for ElasticBodies {
    /// A foundation under a rigid counterbody.
    fn from(foundation: Foundation) -> Self {
        Self::new(foundation, None)
    }
}
