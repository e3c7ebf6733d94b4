//! What no curve of a contact can tell: changes of a model that leave every penetration under every force.
//!
//! They follow from the equations, not from data:
//!
//! - **Materials**: see [`ElasticBodies::null_directions`](pellicle_influence::ElasticBodies::null_directions).
//! - **Paraboloid**: with all lengths along the surface times b, `R → b² R`, `H → b H`, `E → E/b` and compliances of
//!   springs times `b²`. **Sharp cone and pyramid**: their slope over b, `H → b H`, `E → E/b`, compliances times `b²`.
//! - **Springs of a film**: `η = H_w/E_w` counts alone where their law is linear.

use pellicle_texture::{Relief, ReliefParameter};

use super::ModelParameter;
use crate::{Indenter, IndenterQuantity, Model};

/// Changes `dθ/dt` of some numbers, each in its own unit.
pub type ModelDirection = Vec<(ModelParameter, f64)>;

impl Model {
    /// Changes of the model that leave the penetration under every force, to first order; the directions are
    /// independent of each other.
    #[must_use]
    pub fn null_directions(&self) -> Vec<ModelDirection> {
        let of_bodies = self.tables.bodies().null_directions().into_iter();
        let elastic = |(of, change)| (ModelParameter::Elastic(of), change);
        let of_bodies = of_bodies.map(|direction| direction.into_iter().map(elastic).collect());
        of_bodies.chain(self.film()).chain(self.gauge()).collect()
    }

    /// Thickness and modulus of a linear film at constant compliance.
    fn film(&self) -> Option<ModelDirection> {
        let Relief::Film(film) = &self.relief else {
            return None;
        };
        if !film.spring_law().is_linear() {
            return None;
        }
        Some(vec![
            (
                ModelParameter::Relief(ReliefParameter::Height),
                film.thickness(),
            ),
            (
                ModelParameter::Relief(ReliefParameter::YoungModulus),
                film.young_modulus(),
            ),
        ])
    }

    /// Lengths along the surface in another scale; none where the indenter or the relief has one of its own.
    fn gauge(&self) -> Option<ModelDirection> {
        let of_indenter = self.gauge_of_indenter()?;
        let of_relief = match &self.relief {
            Relief::Bare => None,
            // η → b² η
            Relief::Film(film) => {
                Some((ReliefParameter::YoungModulus, -2.0 * film.young_modulus()))
            }
            Relief::Cylinders(_) | Relief::Map(_) | Relief::Custom(_) => return None,
        };
        let elastic = self.tables.bodies().scaling(1.0, -1.0).into_iter();
        let elastic = elastic.map(|(of, change)| (ModelParameter::Elastic(of), change));
        let of_relief = of_relief.map(|(of, change)| (ModelParameter::Relief(of), change));
        Some(elastic.chain(of_relief).chain([of_indenter]).collect())
    }

    fn gauge_of_indenter(&self) -> Option<(ModelParameter, f64)> {
        // d cot α = −cot α dt:  dα = sin α cos α dt
        let of_angle = |angle: f64| angle.sin() * angle.cos();
        let (quantity, change) = match &self.indenter {
            Indenter::Paraboloid(shape) => (IndenterQuantity::Radius, 2.0 * shape.radius()),
            Indenter::Cone(shape) if shape.tip_radius() == 0.0 => {
                (IndenterQuantity::HalfAngle, of_angle(shape.half_angle()))
            }
            Indenter::Pyramid(shape) if shape.tip_radius() == 0.0 => {
                (IndenterQuantity::FaceAngle, of_angle(shape.face_angle()))
            }
            _ => return None,
        };
        Some((ModelParameter::Indenter(quantity), change))
    }
}
