//! Derivatives of a model by its numbers: of coefficients, springs or heights, before a grid is chosen and on a grid.

use std::sync::Arc;

use pellicle_influence::{
    CoefficientDerivative, CoefficientTable, ElasticOperator, SurfaceElasticity,
};
use pellicle_texture::Grid;

use super::springs::{SpringChange, difference};
use crate::{
    ContactError, Model, ModelParameter, SampledModel, grid::region::Region,
    problem::model::initial_gap, vector::dot,
};

/// Relative step of the central difference for springs and heights: its square gives an error of 1e-10, rounding as
/// much.
const STEP: f64 = 1e-5;

/// Derivatives of a model by some of its numbers, before a grid is chosen.
#[derive(Debug, Clone)]
pub struct ModelDerivatives {
    model: Model,
    /// Each number with its value.
    numbers: Vec<(ModelParameter, f64, Option<CoefficientDerivative>)>,
}

impl Model {
    /// Computes the derivatives by `parameters`. Each number of the elastic bodies needs radial tables, which take as
    /// long as about five loads on 64 × 64 elements.
    ///
    /// # Errors
    /// [`ContactError::NoParameter`] for a number that the model does not have; an error for a number without
    /// neighbouring values.
    pub fn derivatives(
        &self,
        parameters: &[ModelParameter],
    ) -> Result<ModelDerivatives, ContactError> {
        let number = |parameter: &ModelParameter| {
            let wanted = *parameter;
            let value = self
                .parameter(wanted)
                .ok_or(ContactError::NoParameter { wanted })?;
            let derivative = match wanted {
                ModelParameter::Elastic(of) => Some(self.tables.derivative(of)?),
                _ => None,
            };
            Ok((wanted, value, derivative))
        };
        Ok(ModelDerivatives {
            model: self.clone(),
            numbers: parameters
                .iter()
                .map(number)
                .collect::<Result<_, ContactError>>()?,
        })
    }
}

impl ModelDerivatives {
    /// The model.
    pub(super) fn model(&self) -> &Model {
        &self.model
    }

    /// Returns the value of each number, and the derivatives by it on a grid.
    pub(super) fn on(&self, grid: &Grid) -> Result<Vec<(f64, Change)>, ContactError> {
        let numbers = self.numbers.iter();
        let change = |(parameter, value, derivative): &(_, f64, Option<CoefficientDerivative>)| {
            let change = match derivative {
                Some(derivative) => Change::of_coefficients(&self.model, grid, derivative)?,
                None => Change::of_geometry(&self.model, grid, *parameter, *value)?,
            };
            Ok((*value, change))
        };
        numbers.map(change).collect()
    }
}

/// Derivatives under a pressure `p`, on its region.
pub struct Changed {
    /// `K_θ p + w*_θ(p)`.
    pub image: Vec<f64>,
    /// `½ p·K_θ p + Σ ∂/∂θ ∫ w* dp`.
    pub energy: f64,
    /// `g0_θ`.
    pub gap: Vec<f64>,
}

/// Derivatives by one number θ on a grid, per unit of θ.
pub enum Change {
    /// `K_θ`.
    Coefficients(Box<SurfaceElasticity>),
    /// Derivatives of the springs, and `g0_θ`, N² values.
    Geometry {
        springs: SpringChange,
        initial_gap: Vec<f64>,
    },
}

impl Change {
    fn of_coefficients(
        model: &Model,
        grid: &Grid,
        derivative: &CoefficientDerivative,
    ) -> Result<Self, ContactError> {
        let side = grid.element_side();
        let coefficient = |offset| derivative.coefficient(side, offset);
        let table = Arc::new(CoefficientTable::from_fn(side, grid.size(), coefficient)?);
        let bodies = model.tables.bodies().clone();
        let elasticity = SurfaceElasticity::new(table, bodies);
        Ok(Self::Coefficients(Box::new(elasticity)))
    }

    fn of_geometry(
        model: &Model,
        grid: &Grid,
        parameter: ModelParameter,
        value: f64,
    ) -> Result<Self, ContactError> {
        let step = STEP * value;
        let at = |value: f64| {
            let moved = model.with_parameter(parameter, value)?;
            let SampledModel {
                relief,
                indenter_profile,
                ..
            } = SampledModel::on(*grid, &moved.relief, &moved.indenter);
            let gap = initial_gap(&indenter_profile, relief.profile());
            let law = relief.spring_law();
            Ok::<_, ContactError>(((law, relief.into_parts().2), gap))
        };
        let (more, less) = (at(value + step)?, at(value - step)?);
        Ok(Self::Geometry {
            initial_gap: difference(&more.1, &less.1, step),
            springs: SpringChange::of(more.0, less.0, step),
        })
    }

    /// The derivatives of displacement, energy and gap on a region of the grid, under a pressure `p` on it.
    pub fn under(&self, region: &Region, pressure: &[f64]) -> Changed {
        match self {
            Self::Coefficients(elasticity) => {
                let mut image = vec![0.0; pressure.len()];
                elasticity
                    .operator(region.size())
                    .apply_into(pressure, &mut image);
                Changed {
                    energy: 0.5 * dot(pressure, &image),
                    image,
                    gap: vec![0.0; pressure.len()],
                }
            }
            Self::Geometry {
                springs,
                initial_gap,
            } => {
                let (image, energy) = springs.under(region, pressure);
                Changed {
                    image,
                    energy,
                    gap: region.cut(initial_gap),
                }
            }
        }
    }
}
