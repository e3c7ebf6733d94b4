//! The fast method for influence coefficients: two functions of the radius, tabulated once for a
//! foundation, whatever the grid.

use std::sync::Arc;

use pellicle_kernel::{Base, Foundation, Interface, KernelError, Layer};

use super::element_integrals::{far_integral, fit_borders, near_integral};
use super::functions::RadialFunctions;
use crate::bodies::{ElasticBodies, ElasticBody};
use crate::element::love;
use crate::error::InfluenceError;

/// Tables with a larger estimated error are refused. Contacts are solved to this accuracy. An error of this size with
/// the same sign in all coefficients makes the smallest eigenvalue of their matrix negative where the largest is 1e7
/// times as large: for a coating 1e4 times as stiff as its base, on 1000 elements per side.
const LARGEST_ERROR: f64 = 1e-8;

/// Largest ratio of the total thickness of the layers to that of the top one: a film of atoms on a planet.
const LARGEST_RATIO: f64 = 1e16;

/// Radial tables of one foundation, or of two bodies in contact, which give the coefficient of any element size and
/// offset in a thousandth of the time of direct quadrature or less.
///
/// ```
/// use pellicle_influence::{RadialTables, love};
/// use pellicle_kernel::{Foundation, Material};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let tables = RadialTables::build(&Foundation::coated(2e-6, coating, steel)?)?;
/// // Elements much larger than the coating is thick feel the steel: 1 % is the coating's share at this ratio.
/// let coarse = tables.coefficient(1e-3, [0, 0]) / love::coefficient(&steel, 1e-3, [0, 0]);
/// assert!((coarse - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RadialTables {
    bodies: ElasticBodies,
    /// Of the foundation and of the counterbody. `None` for a homogeneous body, whose coefficients are Love's, and for
    /// a rigid one.
    functions: [Option<Arc<RadialFunctions>>; 2],
    /// Factor of every coefficient: 1, except when a check is tested.
    factor: f64,
}

impl RadialTables {
    /// Goal of [`Self::error_estimate`]: below it, the tables do not affect any digit that a grid resolves.
    pub const GOAL: f64 = 1e-12;

    /// Tabulates the radial functions of the foundation, which takes about as long as the table of coefficients of a
    /// grid of 512 × 512 elements.
    ///
    /// Tables that miss [`Self::GOAL`] are still returned, up to an [`Self::error_estimate`] of 1e-8.
    ///
    /// # Errors
    ///
    /// [`InfluenceError::TableAccuracy`] if the estimated error exceeds 1e-8, at which the matrix of stiff coatings
    /// need not be positive definite; [`InfluenceError::LayerThicknesses`] if the layers together are more than 1e16
    /// times as thick as the top one.
    pub fn build(foundation: &Foundation) -> Result<Self, InfluenceError> {
        Self::of_bodies(&foundation.clone().into())
    }

    /// The same for a foundation under a counterbody, whose coefficients add.
    ///
    /// # Errors
    ///
    /// As [`Self::build`], and [`KernelError::NothingElastic`] if both bodies are rigid.
    pub fn of_bodies(bodies: &ElasticBodies) -> Result<Self, InfluenceError> {
        let functions = |body: &Foundation| {
            let functions = Self::has_functions(body).then(|| accurate_functions(body));
            Ok::<_, InfluenceError>(functions.transpose()?.map(Arc::new))
        };
        let [foundation, counterbody] = bodies.each();
        Self::new(bodies, [functions(foundation)?, functions(counterbody)?])
    }

    /// The tables with these functions; a homogeneous body has none.
    pub(crate) fn new(
        bodies: &ElasticBodies,
        functions: [Option<Arc<RadialFunctions>>; 2],
    ) -> Result<Self, InfluenceError> {
        if bodies.are_rigid() {
            return Err(KernelError::NothingElastic.into());
        }
        Ok(Self {
            bodies: bodies.clone(),
            functions,
            factor: 1.0,
        })
    }

    /// The same bodies, the counterbody as the foundation: every coefficient is the same.
    #[must_use]
    pub fn swapped(&self) -> Self {
        let [foundation, counterbody] = &self.functions;
        Self {
            bodies: self.bodies.swapped(),
            functions: [counterbody.clone(), foundation.clone()],
            factor: self.factor,
        }
    }

    /// Whether there is anything to tabulate.
    pub(crate) fn has_functions(foundation: &Foundation) -> bool {
        !is_homogeneous(foundation)
    }

    /// The same with every coefficient multiplied by `1 + relative`: deliberately wrong, to show that a check can fail.
    ///
    /// A [`Cache`](crate::Cache) neither stores nor looks up coefficients made from them.
    #[must_use]
    pub fn perturbed(&self, relative: f64) -> Self {
        Self {
            factor: self.factor * (1.0 + relative),
            ..self.clone()
        }
    }

    /// Whether the coefficients are deliberately wrong.
    pub(crate) fn is_perturbed(&self) -> bool {
        self.factor.to_bits() != 1_f64.to_bits()
    }

    /// Influence coefficient `k`, m/Pa: displacement of the centre of one square element, of side `element_side`
    /// (m), for unit pressure on another, `offset` elements away. Equation (3.4) of Stepanov and Torskaya (2022),
    /// with u positive into the body; with an elastic counterbody, the displacements of both towards each other.
    ///
    /// Error: see [`Self::error_estimate`].
    #[must_use]
    pub fn coefficient(&self, element_side: f64, offset: [usize; 2]) -> f64 {
        self.factor * self.true_coefficient(element_side, offset)
    }

    fn true_coefficient(&self, element_side: f64, offset: [usize; 2]) -> f64 {
        let of_body = |body| self.coefficient_of(body, element_side, offset);
        of_body(ElasticBody::Foundation) + of_body(ElasticBody::Counterbody)
    }

    /// One body's part of a coefficient, m/Pa; 0 of a rigid one.
    #[must_use]
    pub fn coefficient_of(&self, body: ElasticBody, element_side: f64, offset: [usize; 2]) -> f64 {
        let of = self.bodies.of(body);
        match self.functions(body) {
            Some(functions) => layered_coefficient(of, functions, element_side, offset),
            None if of.is_rigid() => 0.0,
            None => love::coefficient(&of.surface_material(), element_side, offset),
        }
    }

    /// The functions of a layered body.
    pub(crate) fn functions(&self, body: ElasticBody) -> Option<&Arc<RadialFunctions>> {
        let [foundation, counterbody] = &self.functions;
        match body {
            ElasticBody::Foundation => foundation.as_ref(),
            ElasticBody::Counterbody => counterbody.as_ref(),
        }
    }

    /// The foundation of the tables.
    #[must_use]
    pub fn foundation(&self) -> &Foundation {
        self.bodies.foundation()
    }

    /// The foundation and the counterbody above it.
    #[must_use]
    pub fn bodies(&self) -> &ElasticBodies {
        &self.bodies
    }

    /// Estimated error of a coefficient, relative to the largest of
    ///
    /// - `|k|`; where k changes sign with the distance, the largest within an octave of the distance;
    /// - `min(1, Φ(0)) k_Love`, with `min(1, H/r)` for Φ(0) on a rigid base, at the distance r, for the total
    ///   thickness H;
    /// - `P k_Love/r`, where `P` is the largest integral over the distance, up to r, of `k/k_Love` around a point
    ///   force. It is less than the loaded element's own coefficient. So the estimate bounds every error relative to
    ///   the largest coefficient, and the errors of all coefficients together relative to the displacement under a
    ///   uniform pressure, up to the logarithm of the radius.
    ///
    /// It adds the tails of the expansions, rounding, and the errors of the rules over an element, with margins; a
    /// deliberate error counts, too. Of two layered bodies it is the larger.
    #[must_use]
    pub fn error_estimate(&self) -> f64 {
        let functions = self.functions.iter().flatten();
        let errors = functions.map(|functions| functions.worst().error);
        errors.fold(f64::EPSILON, f64::max) + (self.factor - 1.0).abs()
    }
}

/// `k = (1−ν1²)/(πE1) ∫ T(ρ/H)/ρ dA` over an element `offset` away, m/Pa.
pub(super) fn layered_coefficient(
    foundation: &Foundation,
    functions: &RadialFunctions,
    element_side: f64,
    offset: [usize; 2],
) -> f64 {
    let half_side = element_side / 2.0;
    let scale = half_side / foundation.thickness();
    let integral = match functions.borders().rule(offset) {
        Some(rule) => far_integral(functions, rule, scale, offset),
        None => near_integral(functions, scale, offset),
    };
    let modulus = foundation.surface_material().plane_strain_modulus();
    half_side * integral / (std::f64::consts::PI * modulus)
}

/// The functions of a layered foundation, if they are accurate enough.
pub(crate) fn accurate_functions(
    foundation: &Foundation,
) -> Result<RadialFunctions, InfluenceError> {
    let top = foundation.layers().first().map(Layer::thickness);
    let found = foundation.thickness() / top.unwrap_or(f64::NAN);
    if found.is_nan() || found > LARGEST_RATIO {
        return Err(InfluenceError::LayerThicknesses {
            found,
            largest: LARGEST_RATIO,
        });
    }
    let mut functions = RadialFunctions::new(foundation);
    fit_borders(&mut functions);
    let worst = functions.worst();
    if worst.error <= LARGEST_ERROR {
        return Ok(functions);
    }
    Err(InfluenceError::TableAccuracy {
        wanted: LARGEST_ERROR,
        found: worst.error,
        radius: worst.t * foundation.thickness(),
    })
}

/// Whether every layer is bonded to the next and made of the base's material, or there is none.
fn is_homogeneous(foundation: &Foundation) -> bool {
    let Base::HalfSpace(base) = foundation.base() else {
        return foundation.is_rigid();
    };
    let same = |layer: &Layer| layer.material() == base && layer.interface() == Interface::Bonded;
    foundation.layers().iter().all(same)
}
