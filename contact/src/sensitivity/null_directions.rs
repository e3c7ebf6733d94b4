//! Null directions of contact curves: changes of a model that leave the penetration under every force unchanged.
//!
//! They follow from the equations, not from data:
//!
//! - **Materials**: see [`ElasticBodies::null_directions`](pellicle_influence::ElasticBodies::null_directions).
//! - **Paraboloid**: with all lengths along the surface times b, `R → b² R` (both radii of an elliptic one), `H → b H`,
//!   `E → E/b` and compliances of springs times `b²`. **Sharp cone and pyramid**: with their slope divided by b, `H → b
//!   H`, `E → E/b`, compliances times `b²`. **Power law**: `c → b^(n/(n − 1)) c` in place of R.
//! - **Springs of a film**: only `η = H_w/E_w` matters if their law is linear.

use pellicle_texture::{Relief, ReliefParameter};

use crate::ModelParameter;
use crate::{Indenter, IndenterQuantity, Model, PowerLaw};

/// Changes `dθ/dt` of some numbers, each in its own unit.
pub type ModelDirection = Vec<(ModelParameter, f64)>;

impl Model {
    /// Returns the changes of the model that leave the penetration under every force unchanged, to first order; the
    /// directions are linearly independent.
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

    /// A scaling of lengths along the surface; none if the indenter or the relief has a length scale of its own.
    fn gauge(&self) -> Option<ModelDirection> {
        let of_indenter = self.gauge_of_indenter()?.into_iter();
        let of_indenter = of_indenter.map(|(of, change)| (ModelParameter::Indenter(of), change));
        let of_relief = match &self.relief {
            Relief::Bare => None,
            // η → b² η
            Relief::Film(film) => {
                Some((ReliefParameter::YoungModulus, -2.0 * film.young_modulus()))
            }
            Relief::Cylinders(_) | Relief::Recesses(_) | Relief::Map(_) | Relief::Custom(_) => {
                return None;
            }
        };
        let elastic = self.tables.bodies().scaling(1.0, -1.0).into_iter();
        let elastic = elastic.map(|(of, change)| (ModelParameter::Elastic(of), change));
        let of_relief = of_relief.map(|(of, change)| (ModelParameter::Relief(of), change));
        Some(elastic.chain(of_relief).chain(of_indenter).collect())
    }

    fn gauge_of_indenter(&self) -> Option<Vec<(IndenterQuantity, f64)>> {
        // d cot α = −cot α dt:  dα = sin α cos α dt
        let of_angle = |angle: f64| angle.sin() * angle.cos();
        let (quantity, change) = match &self.indenter {
            Indenter::Paraboloid(shape) => (IndenterQuantity::Radius, 2.0 * shape.radius()),
            Indenter::EllipticParaboloid(shape) => {
                let [x, y] = shape.radii();
                return Some(vec![
                    (IndenterQuantity::RadiusAlongX, 2.0 * x),
                    (IndenterQuantity::RadiusAlongY, 2.0 * y),
                ]);
            }
            // ρⁿ/cⁿ⁻¹ with ρ → b ρ
            Indenter::PowerLaw(shape) if shape.exponent() > PowerLaw::LEAST_EXPONENT => {
                let n = shape.exponent();
                (
                    IndenterQuantity::Coefficient,
                    n / (n - 1.0) * shape.coefficient(),
                )
            }
            Indenter::Cone(shape) if shape.tip_radius() == 0.0 => {
                (IndenterQuantity::HalfAngle, of_angle(shape.half_angle()))
            }
            Indenter::Pyramid(shape) if shape.tip_radius() == 0.0 => {
                (IndenterQuantity::FaceAngle, of_angle(shape.face_angle()))
            }
            _ => return None,
        };
        Some(vec![(quantity, change)])
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_3;

    use pellicle_influence::ElasticParameter;
    use pellicle_texture::Film;

    use super::*;
    use crate::{Cone, FlatPunch, Paraboloid, Pyramid};

    const YOUNG: f64 = 2.0;

    fn model(relief: Relief, indenter: impl Into<Indenter>) -> Model {
        Model::on_half_space([YOUNG, 0.3], relief, indenter)
    }

    /// For the direction that changes the indenter: its change, and the relative changes of the film's and the body's
    /// moduli.
    fn gauge(model: &Model) -> Option<[f64; 3]> {
        let directions = model.null_directions();
        let of_indenter = |direction: &&ModelDirection| {
            let mut parts = direction.iter();
            parts.any(|(of, _)| matches!(of, ModelParameter::Indenter(_)))
        };
        let direction = directions.iter().find(of_indenter)?;
        let mut changes = [0.0; 3];
        for (of, change) in direction {
            match of {
                ModelParameter::Indenter(_) => changes[0] += change,
                ModelParameter::Relief(ReliefParameter::YoungModulus) => changes[1] += change,
                ModelParameter::Elastic(ElasticParameter::Foundation(_)) => {
                    changes[2] += change / YOUNG;
                }
                other => panic!("{other:?}"),
            }
        }
        Some(changes)
    }

    #[test]
    fn no_closed_form_changes_along_the_scale_of_lengths() {
        // D³ ~ Q²/(R E²) under a ball
        let radius = 0.5;
        let [change, _, modulus] =
            gauge(&model(Relief::Bare, Paraboloid::new(radius).unwrap())).unwrap();
        assert!((change / radius + 2.0 * modulus).abs() < 1e-14 && modulus != 0.0);
        // Both radii of an ellipse grow alike.
        let ellipse = crate::EllipticParaboloid::new([radius, 3.0 * radius]).unwrap();
        let [both, _, modulus] = gauge(&model(Relief::Bare, ellipse)).unwrap();
        assert!((both / (4.0 * radius) + 2.0 * modulus).abs() < 1e-14 && modulus != 0.0);
        // D² ~ Q cot α/E under a cone of half angle α to the axis; the same under a pyramid.
        let cone = Cone::new(FRAC_PI_3, 0.0).unwrap();
        let [change, _, modulus] = gauge(&model(Relief::Bare, cone)).unwrap();
        let slope = 1.0 / FRAC_PI_3.tan();
        let step = 1e-6;
        let of_slope = (1.0 / (FRAC_PI_3 + step * change).tan() / slope).ln() / step;
        assert!((of_slope - modulus).abs() < 1e-5, "{of_slope} {modulus}");
        // D^(1 + 1/n) ~ Q c^(1/n − 1)/E under a power law
        let (exponent, coefficient) = (3.5, 0.7);
        let power = PowerLaw::new(exponent, coefficient).unwrap();
        let [change, _, modulus] = gauge(&model(Relief::Bare, power)).unwrap();
        let of_penetration = (1.0 / exponent - 1.0) * change / coefficient - modulus;
        assert!(of_penetration.abs() < 1e-14 && modulus != 0.0);
        let cone = PowerLaw::new(1.0, coefficient).unwrap();
        assert!(gauge(&model(Relief::Bare, cone)).is_none());
        // The compliance of a film, η = H/E, scales with b², as R does.
        let film = Film::new(0.01, 3.0).unwrap();
        let on_film = model(Relief::Film(film), Paraboloid::new(radius).unwrap());
        let [change, of_film, _] = gauge(&on_film).unwrap();
        assert!((of_film / 3.0 + change / radius).abs() < 1e-14);
        // An indenter with a length scale of its own has no such direction.
        assert!(gauge(&model(Relief::Bare, FlatPunch::new(1.0).unwrap())).is_none());
        let berkovich = Pyramid::berkovich(0.01).unwrap();
        assert!(gauge(&model(Relief::Bare, berkovich)).is_none());
    }

    #[test]
    fn thickness_and_modulus_of_a_linear_film_may_grow_together() {
        let film = Film::new(0.01, 3.0).unwrap();
        let of_film = |film: Film| {
            let model = model(Relief::Film(film), FlatPunch::new(1.0).unwrap());
            let height = ModelParameter::Relief(ReliefParameter::Height);
            let directions = model.null_directions().into_iter();
            directions
                .filter(|direction| direction.iter().any(|(of, _)| *of == height))
                .collect::<Vec<_>>()
        };
        let found = of_film(film);
        let modulus = ModelParameter::Relief(ReliefParameter::YoungModulus);
        let height = ModelParameter::Relief(ReliefParameter::Height);
        assert_eq!(found, [[(height, 0.01), (modulus, 3.0)]]);
        assert!(of_film(film.stiffening()).is_empty());
    }
}
