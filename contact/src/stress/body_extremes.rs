//! The extremes of the stresses in each body and at each interface.

use serde::{Deserialize, Serialize};

use super::extreme::Extreme;
use super::extreme_finder::ExtremeFinder;
use super::model::StressModel;
use super::plane_scan::Target;
use super::quantity::{OF_BODIES, OF_INTERFACES};
use crate::{Boundary, ContactError, LoadingPath};

/// The largest ratios of stresses to the strengths of a body; none if no strength is given.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyUtilisation {
    /// Von Mises' stress to the yield strength.
    #[serde(rename = "yield")]
    pub yielding: Option<f64>,
    /// Largest principal stress to the tensile strength.
    pub tension: Option<f64>,
}

/// The extremes in one body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyStress {
    /// `layer[0]`, …, or `substrate`.
    pub name: String,
    /// Largest von Mises stress.
    pub max_von_mises: Extreme<3>,
    /// Largest principal stress.
    pub max_principal: Extreme<3>,
    /// Least principal stress.
    pub min_principal: Extreme<3>,
    /// Tresca's largest shear, half the difference of the principal stresses.
    pub max_shear: Extreme<3>,
    /// Ratios to the strengths given.
    pub utilisation: BodyUtilisation,
}

/// The largest ratios of tractions to the strengths of an interface; none if no strength is given.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct InterfaceUtilisation {
    /// Shear traction to the shear strength.
    pub shear: Option<f64>,
    /// Tension to the tensile strength.
    pub tension: Option<f64>,
}

/// The extremes of the tractions on one interface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InterfaceStress {
    /// Index, counted from 0 at the surface.
    pub index: usize,
    /// Depth, in m.
    pub depth: f64,
    /// Largest `τ = |(σ_xz, σ_yz)|`.
    pub max_shear_traction: Extreme<2>,
    /// Largest `σ_zz`, 0 without tension.
    pub max_tension: Extreme<2>,
    /// Largest `−σ_zz`.
    pub max_compression: Extreme<2>,
    /// Ratios to the strengths given.
    pub utilisation: InterfaceUtilisation,
}

/// The extremes of all bodies and interfaces under one load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressExtremes {
    /// From the surface down.
    pub bodies: Vec<BodyStress>,
    /// From the surface down.
    pub interfaces: Vec<InterfaceStress>,
}

/// Finds the extremes of the stresses in the bodies and on the interfaces under the pressure of a step.
///
/// The search starts on planes that are denser near the surface, on the scale of their depth, then proceeds between the
/// planes and the element centres, to 1e-4; it knows stresses to 2e-6 of the largest at a depth. Within one element's
/// side of the surface, where the stresses show the steps of the pressure, only values under element centres count. The
/// error estimates come from the pressures of the step's [coarser grids](crate::SolverOptions::coarse_pressures).
///
/// # Errors
/// [`ContactError::Periodic`] for a periodic cell; an error for a body or interface outside the foundation, or for
/// amplitudes that the kernel cannot compute.
///
/// # Panics
/// If the path has no such step.
pub fn stress_extremes(
    path: &LoadingPath,
    step: usize,
    stress: &StressModel,
) -> Result<StressExtremes, ContactError> {
    if path.boundary == Boundary::Periodic {
        return Err(ContactError::Periodic { what: "stresses" });
    }
    let bodies = stress.bodies.iter().map(|body| Target {
        top: body.top,
        bottom: body.bottom,
        quantities: OF_BODIES.to_vec(),
    });
    let interfaces = stress.interfaces.iter().map(|interface| Target {
        top: interface.depth,
        bottom: interface.depth,
        quantities: OF_INTERFACES.to_vec(),
    });
    let targets: Vec<Target> = bodies.chain(interfaces).collect();
    let finder = ExtremeFinder::new(path, &path.steps[step], stress.sliding);
    let mut rough = ExtremeFinder::rough_depths(path, stress.sliding)?;
    let mut found = finder.find(&mut rough, &targets)?.into_iter();
    let bodies = stress.bodies.iter().zip(found.by_ref());
    let bodies = bodies.map(|(body, extremes)| {
        let [max_von_mises, max_principal, min_principal, max_shear] =
            [0, 1, 2, 3].map(|i: usize| extremes[i]);
        let utilisation = BodyUtilisation {
            yielding: body
                .strengths
                .yield_strength
                .map(|strength| max_von_mises.value / strength),
            tension: body
                .strengths
                .tensile_strength
                .map(|strength| max_principal.value.max(0.0) / strength),
        };
        BodyStress {
            name: body.name.clone(),
            max_von_mises,
            max_principal,
            min_principal: Extreme {
                value: -min_principal.value,
                ..min_principal
            },
            max_shear,
            utilisation,
        }
    });
    let bodies = bodies.collect();
    let interfaces = stress.interfaces.iter().zip(found);
    let interfaces = interfaces.map(|(interface, extremes)| {
        let flat = |extreme: &Extreme<3>| Extreme {
            value: extreme.value.max(0.0),
            at: [extreme.at[0], extreme.at[1]],
            resolved: extreme.resolved,
            estimate: extreme.estimate,
        };
        let [max_shear_traction, max_tension, max_compression] =
            [0, 1, 2].map(|i: usize| flat(&extremes[i]));
        let utilisation = InterfaceUtilisation {
            shear: interface
                .strengths
                .shear_strength
                .map(|strength| max_shear_traction.value / strength),
            tension: interface
                .strengths
                .tensile_strength
                .map(|strength| max_tension.value / strength),
        };
        InterfaceStress {
            index: interface.index,
            depth: interface.depth,
            max_shear_traction,
            max_tension,
            max_compression,
            utilisation,
        }
    });
    let interfaces = interfaces.collect();
    Ok(StressExtremes { bodies, interfaces })
}

#[cfg(test)]
mod tests {

    use pellicle_texture::Relief;

    use super::*;
    use crate::{
        Domain, Load, Model, Paraboloid, SolverOptions, solve_path,
        stress::model::{BodyPart, BodyStrengths, InterfacePart, InterfaceStrengths},
    };

    #[test]
    fn extremes_and_utilisations_of_a_body_and_a_plane_are_those_of_hertz() {
        let model = Model::on_half_space([1.0, 0.3], Relief::Bare, Paraboloid::new(1.0).unwrap());
        let a: f64 = 0.3;
        let p0 = 2.0 * a / (std::f64::consts::PI * 0.91);
        let (load, options) = (Load::Penetration(a * a), SolverOptions::default());
        let path = solve_path(&model, Domain::Side(1.0), 24, &[load], &options, &mut ());
        let stress = StressModel {
            bodies: vec![BodyPart {
                name: "half".to_owned(),
                top: 0.3 * a,
                bottom: a,
                strengths: BodyStrengths {
                    yield_strength: Some(p0),
                    tensile_strength: Some(p0),
                },
            }],
            interfaces: vec![InterfacePart {
                index: 3,
                depth: a,
                strengths: InterfaceStrengths {
                    shear_strength: Some(2.0 * p0),
                    tensile_strength: Some(p0),
                },
            }],
            ..StressModel::default()
        };
        let found = stress_extremes(&path.unwrap(), 0, &stress).unwrap();
        let [body] = &found.bodies[..] else {
            panic!("one body")
        };
        let [plane] = &found.interfaces[..] else {
            panic!("one plane")
        };
        // Seven elements per radius.
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 0.04;
        assert!(near(body.max_von_mises.value, 0.62 * p0));
        assert!(near(body.max_shear.value, 0.31 * p0));
        assert!(near(body.utilisation.yielding.unwrap(), 0.62));
        // The least principal stress is that along z on the axis, largest at the top of the range.
        assert!(
            near(body.min_principal.value, -p0 / (1.0 + 0.09)),
            "{body:?}"
        );
        assert!(near(plane.max_compression.value, p0 / 2.0), "{plane:?}");
        assert_eq!(
            (plane.index, plane.depth, plane.max_tension.value),
            (3, a, 0.0)
        );
        assert_eq!(plane.utilisation.tension, Some(0.0));
        let shear = plane.max_shear_traction.value;
        assert!(shear > 0.05 * p0 && shear < 0.3 * p0);
        assert_eq!(plane.utilisation.shear, Some(shear / (2.0 * p0)));
        let tension = body.utilisation.tension.unwrap();
        assert_eq!(tension, body.max_principal.value.max(0.0) / p0);
    }
}
