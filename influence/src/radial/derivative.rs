//! Derivatives of coefficients with respect to a parameter of the bodies.

use std::sync::Arc;

use pellicle_kernel::{Base, Foundation, FoundationParameter};

use super::functions::RadialFunctions;
use super::tables::{RadialTables, layered_coefficient};
use crate::bodies::{ElasticBody, ElasticParameter};
use crate::error::InfluenceError;
use crate::response::ResponseTable;

/// Wavenumbers, over a reciprocal thickness, at which the response's sensitivity is sampled: `10^(i/8)`.
const SAMPLES: std::ops::RangeInclusive<i32> = -48..=24;
/// Largest relative change of the response.
const LARGEST_CHANGE: f64 = 0.5;
/// Relative error of a derivative of the response: 1e-10 by `ResponseDerivative`, most of it common to many waves. Its
/// rounding, which expansions cannot follow, is a hundredth of that.
const TOLERANCE: f64 = 2e-12;

/// `∂k/∂θ` of the influence coefficients for one parameter θ of the bodies.
///
/// The response `Φ̃ = Φ + w ∂Φ/∂θ` belongs to no body, but has functions T̃, P̃ and coefficients k̃ like any other, and
/// all of them are linear in it:
///
/// ```text
/// ∂k/∂θ = (k̃ − k)/w − k ∂ ln E₁*/∂θ
/// ```
///
/// Only the part of the body that has the parameter changes.
///
/// Accuracy: `θ ∂k/∂θ` to 1e-9 of k (`tests/derivative.rs`); for Poisson's ratio, `∂k/∂ν`.
///
/// ```
/// use pellicle_influence::{ElasticParameter, RadialTables};
/// use pellicle_kernel::{Foundation, FoundationParameter, Material};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let tables = RadialTables::build(&Foundation::coated(2e-6, coating, steel)?)?;
/// let modulus = |body| ElasticParameter::Foundation(FoundationParameter::YoungModulus { body });
/// let by = |body| tables.derivative(modulus(body));
/// let (by_coating, by_steel) = (by(0)?, by(1)?);
/// // All moduli together scale the coefficient: Σ E ∂k/∂E = −k.
/// let at = [1e-6, 2e-6].map(|side| {
///     let sum = 400e9 * by_coating.coefficient(side, [3, 1]) + 210e9 * by_steel.coefficient(side, [3, 1]);
///     sum / tables.coefficient(side, [3, 1])
/// });
/// assert!(at.iter().all(|ratio| (ratio + 1.0).abs() < 1e-9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CoefficientDerivative {
    tables: RadialTables,
    /// The body that has the parameter.
    body: ElasticBody,
    moved: Option<Moved>,
    /// `∂ ln E*/∂θ` of the body's surface.
    of_modulus: f64,
}

/// The functions of a response moved along its derivative.
#[derive(Clone, Debug)]
struct Moved {
    /// w, in units of θ.
    by: f64,
    functions: RadialFunctions,
}

impl RadialTables {
    /// The derivative of every coefficient with respect to one parameter, in less time than new tables take.
    ///
    /// # Errors
    ///
    /// [`InfluenceError::Kernel`] if the foundation has no such parameter, or no foundation has a value close to it.
    pub fn derivative(
        &self,
        parameter: ElasticParameter,
    ) -> Result<CoefficientDerivative, InfluenceError> {
        let (body, of) = parameter.parts();
        let foundation = self.bodies().of(body);
        let derivative = foundation.response_derivative(of)?;
        let functions = self.functions(body).map(Arc::as_ref);
        Ok(CoefficientDerivative {
            tables: self.clone(),
            body,
            moved: Moved::along((foundation, functions), of, |k| derivative.value(k)),
            of_modulus: by_modulus(foundation, of),
        })
    }
}

impl CoefficientDerivative {
    /// `∂k/∂θ`, m/Pa per unit of θ, of elements of side `element_side` (m), `offset` elements apart.
    #[must_use]
    pub fn coefficient(&self, element_side: f64, offset: [usize; 2]) -> f64 {
        let coefficient = self.tables.coefficient_of(self.body, element_side, offset);
        let of_response = self.moved.as_ref().map_or(0.0, |moved| {
            let foundation = self.tables.bodies().of(self.body);
            let there = layered_coefficient(foundation, &moved.functions, element_side, offset);
            (there - coefficient) / moved.by
        });
        of_response - coefficient * self.of_modulus
    }
}

impl Moved {
    /// `None` if the response does not depend on the parameter.
    fn along(
        (foundation, functions): (&Foundation, Option<&RadialFunctions>),
        parameter: FoundationParameter,
        derivative: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let thickness = Some(foundation.thickness()).filter(|thickness| *thickness > 0.0)?;
        let waves = SAMPLES.map(|i| 10_f64.powf(f64::from(i) / 8.0) / thickness);
        let relative = waves.map(|k| (derivative(k) / foundation.response(k)).abs());
        let steepest = relative.fold(0.0, f64::max);
        let by = (LARGEST_CHANGE / steepest).min(unit(foundation, parameter));
        let limit = match foundation.base() {
            Base::Rigid => 0.0,
            Base::HalfSpace(_) => foundation.response_at_zero() + by * derivative(0.0),
        };
        // Φ̃ = Φ + w ∂Φ/∂θ
        let moved = |k: f64| foundation.response(k) + by * derivative(k);
        let response = ResponseTable::of(foundation, moved, limit, TOLERANCE);
        Some(Self {
            by,
            functions: RadialFunctions::of_response(&response, functions),
        })
        .filter(|_| steepest > 0.0)
    }
}

/// The value of the parameter, or 1 for a Poisson's ratio.
fn unit(foundation: &Foundation, parameter: FoundationParameter) -> f64 {
    match parameter {
        FoundationParameter::PoissonRatio { .. } => 1.0,
        _ => foundation.parameter(parameter).unwrap_or(1.0),
    }
}

/// `∂ ln E*/∂θ` of the surface, with `E* = E/(1 − ν²)`.
fn by_modulus(foundation: &Foundation, parameter: FoundationParameter) -> f64 {
    let value = foundation.parameter(parameter).unwrap_or(f64::NAN);
    match parameter {
        FoundationParameter::YoungModulus { body: 0 } => 1.0 / value,
        FoundationParameter::PoissonRatio { body: 0 } => {
            2.0 * value / ((1.0 - value) * (1.0 + value))
        }
        _ => 0.0,
    }
}
