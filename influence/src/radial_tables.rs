//! The fast path to influence coefficients: two functions of the radius, tabulated once for a foundation, whatever the grid.

mod stored;

use pellicle_kernel::{Base, Foundation, Interface};

use crate::coefficient_table::CoefficientTable;
use crate::error::InfluenceError;
use crate::love;
use crate::near::near_integral;
use crate::product_rule::ProductRule;
use crate::radial::RadialFunctions;

/// The largest estimated error, relative to the displacement's scale, that a table may have.
const LARGEST_ERROR: f64 = 1e-12;

/// Radial tables of one foundation, from which the coefficient of any element size and offset follows in under a microsecond.
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
    foundation: Foundation,
    /// None for a homogeneous body, whose coefficients are Love's.
    functions: Option<RadialFunctions>,
    /// What every coefficient is multiplied by: 1 but for a test of tests.
    factor: f64,
}

impl RadialTables {
    /// Tabulates the foundation's radial functions; some tens of milliseconds.
    ///
    /// # Errors
    ///
    /// [`InfluenceError::TableAccuracy`] if the estimated error exceeds 1e-12.
    pub fn build(foundation: &Foundation) -> Result<Self, InfluenceError> {
        let functions = (!is_homogeneous(foundation)).then(|| RadialFunctions::new(foundation));
        if let Some(functions) = &functions {
            let worst = functions.worst();
            if worst.error.is_nan() || worst.error > LARGEST_ERROR {
                return Err(InfluenceError::TableAccuracy {
                    wanted: LARGEST_ERROR,
                    found: worst.error,
                    radius: worst.t * foundation.thickness(),
                });
            }
        }
        Ok(Self {
            foundation: foundation.clone(),
            functions,
            factor: 1.0,
        })
    }

    /// The same with every coefficient multiplied by `1 + relative`: wrong on purpose, so that a check can be seen to fail.
    ///
    /// A [`Cache`](crate::Cache) neither keeps nor finds what is made from them.
    #[must_use]
    pub fn perturbed(&self, relative: f64) -> Self {
        Self {
            factor: self.factor * (1.0 + relative),
            ..self.clone()
        }
    }

    /// Whether the coefficients are wrong on purpose.
    pub(crate) fn is_perturbed(&self) -> bool {
        self.factor.to_bits() != 1_f64.to_bits()
    }

    /// Influence coefficient `k`, m/Pa: displacement of the centre of one square element, of side `element_side` (m), for unit pressure on
    /// another, `offset` elements away. Equation (3.4) of Stepanov and Torskaya (2022), with u positive into the body.
    ///
    /// Error: see [`Self::error_estimate`].
    #[must_use]
    pub fn coefficient(&self, element_side: f64, offset: [usize; 2]) -> f64 {
        self.factor * self.true_coefficient(element_side, offset)
    }

    fn true_coefficient(&self, element_side: f64, offset: [usize; 2]) -> f64 {
        let surface = self.foundation.surface_material();
        let Some(functions) = &self.functions else {
            return love::coefficient(&surface, element_side, offset);
        };
        let half_side = element_side / 2.0;
        let scale = half_side / self.foundation.thickness();
        let integral = match functions.borders().rule(offset) {
            Some(rule) => far_integral(functions, rule, scale, offset),
            None => near_integral(functions, scale, offset),
        };
        // k = (1−ν1²)/(πE1) ∫ T(ρ/H)/ρ dA
        half_side * integral / (std::f64::consts::PI * surface.plane_strain_modulus())
    }

    /// The foundation the tables are of.
    #[must_use]
    pub fn foundation(&self) -> &Foundation {
        &self.foundation
    }

    /// Estimated error of a coefficient, relative to `max(|k|, min(1, Φ(0)) k_Love)`: tails of the expansions and rounding.
    ///
    /// Where k changes sign with the distance, |k| is the largest within an octave of the distance.
    #[must_use]
    pub fn error_estimate(&self) -> f64 {
        self.functions
            .as_ref()
            .map_or(f64::EPSILON, |functions| functions.worst().error)
    }
}

impl CoefficientTable {
    /// The coefficients of the `size` × `size` elements of side `element_side` (m) of one grid, in parallel on the current rayon pool.
    ///
    /// # Errors
    ///
    /// See [`CoefficientTable::from_fn`].
    pub fn assemble(
        tables: &RadialTables,
        element_side: f64,
        size: usize,
    ) -> Result<Self, InfluenceError> {
        Self::from_fn(element_side, size, |offset| {
            tables.coefficient(element_side, offset)
        })
    }
}

/// `∫ T/ρ dA` over a far element, in half sides; `scale` is half a side over the thickness.
fn far_integral(
    functions: &RadialFunctions,
    rule: &ProductRule,
    scale: f64,
    offset: [usize; 2],
) -> f64 {
    let squared = scale * scale;
    // T/ρ = (a/H) T/t
    let term = |(square, weight): (f64, f64)| weight * functions.over_root(squared * square);
    scale * rule.points(offset).map(term).sum::<f64>()
}

/// Whether every layer is bonded to the next and made of the base's material.
fn is_homogeneous(foundation: &Foundation) -> bool {
    let Base::HalfSpace(base) = foundation.base() else {
        return false;
    };
    let same = |layer: &pellicle_kernel::Layer| {
        layer.material() == base && layer.interface() == Interface::Bonded
    };
    foundation.layers().iter().all(same)
}
