//! The extremes of the stresses in each body and at each interface.

use serde::{Deserialize, Serialize};

use super::extreme::Extreme;
use super::extreme_finder::ExtremeFinder;
use super::model::{BodyPart, InterfacePart, StressModel};
use super::plane_scan::Target;
use super::quantity::{OF_BODIES, OF_INTERFACES, StressQuantity};
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

/// The extremes in one body; none of a quantity that is not wanted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyStress {
    /// `layer[0]`, …, or `substrate`; in an indenter `indenter.layer[0]`, …
    pub name: String,
    /// Largest von Mises stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_von_mises: Option<Extreme<3>>,
    /// Largest principal stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_principal: Option<Extreme<3>>,
    /// Least principal stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_principal: Option<Extreme<3>>,
    /// Tresca's largest shear, half the difference of the principal stresses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_shear: Option<Extreme<3>>,
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

/// The extremes of the tractions on one interface; none of a quantity that is not wanted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InterfaceStress {
    /// Its name: `interface[0]`, or `indenter.interface[0]` in an indenter; empty from a file older than this field.
    #[serde(default)]
    pub name: String,
    /// Index, counted from 0 at the surface.
    pub index: usize,
    /// Depth, in m.
    pub depth: f64,
    /// Largest `τ = |(σ_xz, σ_yz)|`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_shear_traction: Option<Extreme<2>>,
    /// Largest `σ_zz`, 0 without tension.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_tension: Option<Extreme<2>>,
    /// Largest `−σ_zz`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_compression: Option<Extreme<2>>,
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

/// The name of an interface in the body whose first part has this name, such as `indenter.layer[0]`.
pub(crate) fn interface_name(part: Option<&BodyPart>, index: usize) -> String {
    let body = part.and_then(|part| part.name.rsplit_once('.'));
    let prefix = body.map_or(String::new(), |(body, _)| format!("{body}."));
    format!("{prefix}interface[{index}]")
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
    let wanted = |all: &[StressQuantity]| -> Vec<StressQuantity> {
        let wanted = all.iter().filter(|quantity| stress.wants(**quantity));
        wanted.copied().collect()
    };
    let (of_bodies, of_interfaces) = (wanted(&OF_BODIES), wanted(&OF_INTERFACES));
    let bodies = stress.bodies.iter().map(|body| Target {
        top: body.top,
        bottom: body.bottom,
        quantities: of_bodies.clone(),
    });
    let interfaces = stress.interfaces.iter().map(|interface| Target {
        top: interface.depth,
        bottom: interface.depth,
        quantities: of_interfaces.clone(),
    });
    // A target without a wanted quantity is not scanned.
    let targets = bodies.chain(interfaces);
    let targets: Vec<Target> = targets
        .filter(|target| !target.quantities.is_empty())
        .collect();
    let finder = ExtremeFinder::new(path, &path.steps[step], stress.sliding);
    let finder = finder.with_residual(&stress.residual);
    let mut rough = ExtremeFinder::rough_depths(path, stress.sliding)?;
    let mut found = finder.find(&mut rough, &targets)?.into_iter();
    let mut next = |quantities: &[StressQuantity]| Found {
        extremes: if quantities.is_empty() {
            Vec::new()
        } else {
            let extremes = found.next().unwrap_or_default();
            quantities.iter().copied().zip(extremes).collect()
        },
    };
    let bodies = stress.bodies.iter();
    let bodies = bodies.map(|body| of_body(body, &next(&of_bodies)));
    let bodies = bodies.collect();
    let interfaces = stress.interfaces.iter();
    let interfaces = interfaces
        .map(|interface| of_interface(stress.bodies.first(), interface, &next(&of_interfaces)));
    let interfaces = interfaces.collect();
    Ok(StressExtremes { bodies, interfaces })
}

/// The extremes of one target by quantity.
struct Found {
    extremes: Vec<(StressQuantity, Extreme<3>)>,
}

impl Found {
    /// The extreme of a quantity; none if it was not wanted.
    fn of(&self, quantity: StressQuantity) -> Option<Extreme<3>> {
        let mut extremes = self.extremes.iter();
        let found = extremes.find(|(other, _)| *other == quantity);
        found.map(|(_, extreme)| *extreme)
    }

    /// The extreme on an interface, 0 where it is negative.
    fn on_interface(&self, quantity: StressQuantity) -> Option<Extreme<2>> {
        self.of(quantity).map(|extreme| Extreme {
            value: extreme.value.max(0.0),
            at: [extreme.at[0], extreme.at[1]],
            resolved: extreme.resolved,
            estimate: extreme.estimate,
        })
    }
}

/// The ratio of a stress, 0 where it is negative, to a strength; none without either.
fn utilisation<const AXES: usize>(
    extreme: Option<Extreme<AXES>>,
    strength: Option<f64>,
) -> Option<f64> {
    Some(extreme?.value.max(0.0) / strength?)
}

fn of_body(body: &BodyPart, found: &Found) -> BodyStress {
    let max_von_mises = found.of(StressQuantity::VonMises);
    let max_principal = found.of(StressQuantity::MaxPrincipal);
    let min_principal = found.of(StressQuantity::MinPrincipal);
    let strengths = body.strengths;
    BodyStress {
        name: body.name.clone(),
        max_von_mises,
        max_principal,
        min_principal: min_principal.map(|extreme| Extreme {
            value: -extreme.value,
            ..extreme
        }),
        max_shear: found.of(StressQuantity::MaxShear),
        utilisation: BodyUtilisation {
            yielding: utilisation(max_von_mises, strengths.yield_strength),
            tension: utilisation(max_principal, strengths.tensile_strength),
        },
    }
}

fn of_interface(
    part: Option<&BodyPart>,
    interface: &InterfacePart,
    found: &Found,
) -> InterfaceStress {
    let max_shear_traction = found.on_interface(StressQuantity::ShearTraction);
    let max_tension = found.on_interface(StressQuantity::Tension);
    let strengths = interface.strengths;
    InterfaceStress {
        name: interface_name(part, interface.index),
        index: interface.index,
        depth: interface.depth,
        max_shear_traction,
        max_tension,
        max_compression: found.on_interface(StressQuantity::Compression),
        utilisation: InterfaceUtilisation {
            shear: utilisation(max_shear_traction, strengths.shear_strength),
            tension: utilisation(max_tension, strengths.tensile_strength),
        },
    }
}

#[cfg(test)]
mod tests {

    use pellicle_texture::Relief;

    use super::*;
    use crate::{
        Domain, Load, Model, Paraboloid, SolverOptions, solve_path,
        stress::model::{BodyStrengths, InterfaceStrengths},
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
        assert!(near(body.max_von_mises.unwrap().value, 0.62 * p0));
        assert!(near(body.max_shear.unwrap().value, 0.31 * p0));
        assert!(near(body.utilisation.yielding.unwrap(), 0.62));
        // The least principal stress is that along z on the axis, largest at the top of the range.
        assert!(
            near(body.min_principal.unwrap().value, -p0 / (1.0 + 0.09)),
            "{body:?}"
        );
        assert!(
            near(plane.max_compression.unwrap().value, p0 / 2.0),
            "{plane:?}"
        );
        assert_eq!(
            (plane.index, plane.depth, plane.max_tension.unwrap().value),
            (3, a, 0.0)
        );
        assert_eq!(plane.utilisation.tension, Some(0.0));
        let shear = plane.max_shear_traction.unwrap().value;
        assert!(shear > 0.05 * p0 && shear < 0.3 * p0);
        assert_eq!(plane.utilisation.shear, Some(shear / (2.0 * p0)));
        let tension = body.utilisation.tension.unwrap();
        assert_eq!(tension, body.max_principal.unwrap().value.max(0.0) / p0);
    }

    #[test]
    fn only_the_wanted_quantities_are_found_and_they_are_those_of_all() {
        let model = Model::on_half_space([1.0, 0.3], Relief::Bare, Paraboloid::new(1.0).unwrap());
        let (load, options) = (Load::Penetration(0.09), SolverOptions::default());
        let path = solve_path(&model, Domain::Side(1.0), 16, &[load], &options, &mut ()).unwrap();
        let mut stress = StressModel {
            bodies: vec![BodyPart {
                name: "half".to_owned(),
                top: 0.0,
                bottom: 0.3,
                strengths: BodyStrengths {
                    yield_strength: Some(1.0),
                    tensile_strength: Some(1.0),
                },
            }],
            interfaces: vec![InterfacePart {
                index: 0,
                depth: 0.3,
                strengths: InterfaceStrengths::default(),
            }],
            ..StressModel::default()
        };
        let all = stress_extremes(&path, 0, &stress).unwrap();
        let [body, interface] = [
            serde_json::to_value(&all.bodies[0]),
            serde_json::to_value(&all.interfaces[0]),
        ]
        .map(Result::unwrap);
        for only in [
            vec![StressQuantity::VonMises, StressQuantity::Tension],
            vec![StressQuantity::Compression],
            vec![StressQuantity::MaxShear],
        ] {
            stress.only = Some(only.clone());
            let found = stress_extremes(&path, 0, &stress).unwrap();
            let [found_body, found_interface] = [
                serde_json::to_value(&found.bodies[0]),
                serde_json::to_value(&found.interfaces[0]),
            ]
            .map(Result::unwrap);
            for (i, (name, quantity)) in StressQuantity::NAMES.into_iter().enumerate() {
                let (found, all) = if i < OF_BODIES.len() {
                    (&found_body, &body)
                } else {
                    (&found_interface, &interface)
                };
                let wanted = only.contains(&quantity).then(|| &all[name]);
                assert_eq!(found.get(name), wanted, "{name} of {only:?}");
            }
            let has_von_mises = only.contains(&StressQuantity::VonMises);
            let utilisation = found.bodies[0].utilisation;
            assert_eq!(utilisation.yielding.is_some(), has_von_mises);
            assert_eq!(utilisation.tension, None);
        }
    }
}
