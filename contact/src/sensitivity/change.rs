//! What one number of a model changes on a grid: coefficients, springs or heights.

use std::sync::Arc;

use pellicle_influence::{CoefficientTable, ElasticOperator, SurfaceElasticity};
use pellicle_texture::Grid;

use super::ModelParameter;
use crate::{ContactError, Model, SampledModel, grid::window::Window, problem::model::initial_gap};

/// Relative step of the central difference by which springs and heights are differentiated: an error of 1e-10 by its
/// square, and as much by rounding.
const STEP: f64 = 1e-5;

/// Derivatives by one number θ, per unit of it.
pub enum Change {
    /// `K_θ`.
    Coefficients(SurfaceElasticity),
    /// `η_θ` and `g0_θ`, N² values each.
    Geometry {
        compliance: Vec<f64>,
        initial_gap: Vec<f64>,
    },
}

impl Change {
    /// What `parameter` changes of `model` on `grid`.
    pub fn of(model: &Model, grid: &Grid, parameter: ModelParameter) -> Result<Self, ContactError> {
        match parameter {
            ModelParameter::Elastic(of) => {
                let (derivative, side) = (model.tables.derivative(of)?, grid.element_side());
                let coefficient = |offset| derivative.coefficient(side, offset);
                let table = CoefficientTable::from_fn(side, grid.size(), coefficient)?;
                let bodies = model.tables.bodies().clone();
                let elasticity = SurfaceElasticity::new(Arc::new(table), bodies);
                Ok(Self::Coefficients(elasticity))
            }
            ModelParameter::Relief(_) | ModelParameter::Indenter(_) => {
                let value = model.parameter(parameter).unwrap_or(f64::NAN);
                let step = STEP * value;
                let at = |value: f64| {
                    let moved = model.with_parameter(parameter, value)?;
                    let SampledModel {
                        relief,
                        indenter_profile,
                        ..
                    } = SampledModel::on(*grid, &moved.relief, &moved.indenter);
                    let gap = initial_gap(&indenter_profile, relief.profile());
                    Ok::<_, ContactError>((relief.into_parts().2, gap))
                };
                let (more, less) = (at(value + step)?, at(value - step)?);
                Ok(Self::Geometry {
                    compliance: difference(&more.0, &less.0, step),
                    initial_gap: difference(&more.1, &less.1, step),
                })
            }
        }
    }

    /// `(K_θ + η_θ) p` and `g0_θ` on a window of the grid, for a pressure `p` on it.
    pub fn under(&self, window: &Window, pressure: &[f64]) -> [Vec<f64>; 2] {
        match self {
            Self::Coefficients(elasticity) => {
                let mut image = vec![0.0; pressure.len()];
                elasticity
                    .operator(window.size())
                    .apply_into(pressure, &mut image);
                [image, vec![0.0; pressure.len()]]
            }
            Self::Geometry {
                compliance,
                initial_gap,
            } => {
                let springs = window.cut(compliance);
                let image = springs.iter().zip(pressure).map(|(eta, p)| eta * p);
                [image.collect(), window.cut(initial_gap)]
            }
        }
    }
}

/// `(more − less)/(2 step)`; 0 where both are infinite, beyond the indenter's end.
fn difference(more: &[f64], less: &[f64], step: f64) -> Vec<f64> {
    let pairs = more.iter().zip(less);
    let slope = |(more, less): (&f64, &f64)| {
        if more.is_finite() && less.is_finite() {
            (more - less) / (2.0 * step)
        } else {
            0.0
        }
    };
    pairs.map(slope).collect()
}
