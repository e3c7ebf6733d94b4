//! What one number of a model changes on a grid: coefficients, springs or heights.

use std::sync::Arc;

use pellicle_influence::{CoefficientTable, ElasticOperator, SurfaceElasticity};
use pellicle_texture::{Grid, SpringLaw};

use super::ModelParameter;
use crate::{
    ContactError, Model, SampledModel, grid::window::Window, problem::model::initial_gap,
    vector::dot,
};

/// Relative step of the central difference by which springs and heights are differentiated: an error of 1e-10 by its
/// square, and as much by rounding.
const STEP: f64 = 1e-5;

/// Derivatives of what springs do.
pub enum Springs {
    /// `η_θ`.
    Linear(Vec<f64>),
    /// Law and compliance at rest a step above and a step below.
    Stiffening([(SpringLaw, Vec<f64>); 2], f64),
}

/// Derivatives under a pressure `p`, on its window.
pub struct Changed {
    /// `K_θ p + w*_θ(p)`.
    pub image: Vec<f64>,
    /// `½ p·K_θ p + Σ ∂/∂θ ∫ w* dp`.
    pub energy: f64,
    /// `g0_θ`.
    pub gap: Vec<f64>,
}

impl Springs {
    /// `w*_θ(p)` and `Σ ∂/∂θ ∫ w* dp`.
    fn under(&self, window: &Window, pressure: &[f64]) -> (Vec<f64>, f64) {
        match self {
            Self::Linear(compliance) => {
                let springs = window.cut(compliance);
                let image = springs.iter().zip(pressure).map(|(eta, p)| eta * p);
                let image: Vec<f64> = image.collect();
                let energy = 0.5 * dot(pressure, &image);
                (image, energy)
            }
            Self::Stiffening(both, step) => {
                let [more, less] = both.each_ref().map(|(law, compliance)| {
                    let springs = window.cut(compliance);
                    let pairs = springs.iter().zip(pressure);
                    let shortening = pairs.clone().map(|(eta, p)| law.shortening(*eta, *p));
                    let energy: f64 = pairs.map(|(eta, p)| law.energy(*eta, *p)).sum();
                    (shortening.collect::<Vec<f64>>(), energy)
                });
                let image = difference(&more.0, &less.0, *step);
                (image, (more.1 - less.1) / (2.0 * step))
            }
        }
    }
}

/// Derivatives by one number θ, per unit of it.
pub enum Change {
    /// `K_θ`.
    Coefficients(SurfaceElasticity),
    /// Springs and `g0_θ`, N² values.
    Geometry {
        springs: Springs,
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
                    let law = relief.spring_law();
                    Ok::<_, ContactError>((relief.into_parts().2, gap, law))
                };
                let (more, less) = (at(value + step)?, at(value - step)?);
                Ok(Self::Geometry {
                    initial_gap: difference(&more.1, &less.1, step),
                    springs: if more.2.is_linear() {
                        Springs::Linear(difference(&more.0, &less.0, step))
                    } else {
                        Springs::Stiffening([(more.2, more.0), (less.2, less.0)], step)
                    },
                })
            }
        }
    }

    /// What it changes on a window of the grid, under a pressure `p` on it.
    pub fn under(&self, window: &Window, pressure: &[f64]) -> Changed {
        match self {
            Self::Coefficients(elasticity) => {
                let mut image = vec![0.0; pressure.len()];
                elasticity
                    .operator(window.size())
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
                let (image, energy) = springs.under(window, pressure);
                Changed {
                    image,
                    energy,
                    gap: window.cut(initial_gap),
                }
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
