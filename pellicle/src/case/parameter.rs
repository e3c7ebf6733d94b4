//! The parameters of a case on which a solution depends smoothly, by their keys.

use pellicle_contact::{IndenterQuantity, Model, ModelParameter};
use pellicle_influence::ElasticParameter;
use pellicle_kernel::{FoundationParameter, KernelError};
use pellicle_texture::{Relief, ReliefParameter};

use super::Case;
use super::foundation::FoundationCase;
use crate::input::dimension::Dimension;

/// The key of the work of adhesion.
pub const WORK_OF_ADHESION: &str = "load.work_of_adhesion";

/// A parameter of a case and of its model.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseParameter {
    /// Its key in the case, such as `foundation.layer[0].young_modulus`.
    pub key: String,
    /// The parameter of the model.
    pub parameter: ModelParameter,
    /// Its dimension; none for Poisson's ratio and an exponent.
    pub dimension: Option<Dimension>,
}

impl CaseParameter {
    /// Its SI unit.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        unit(self.dimension)
    }
}

/// The SI unit of a quantity of this dimension; `1` without a dimension.
#[must_use]
pub fn unit(dimension: Option<Dimension>) -> &'static str {
    dimension.map_or("1", Dimension::si_unit)
}

impl Case {
    /// Returns all parameters of the case's model on which a solution depends smoothly, and its work of adhesion. Those
    /// of graded layers are left out: each stands for many layers of the model.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if a graded layer cannot be split.
    pub fn parameters(&self, model: &Model) -> Result<Vec<CaseParameter>, KernelError> {
        let foundation = layer_keys(
            &self.foundation,
            ["foundation.substrate", "foundation.layer"],
        )?;
        let indenter = match &self.indenter.body {
            Some(body) => layer_keys(&body.as_foundation(), body.paths())?,
            None => Vec::new(),
        };
        let all = model.parameters().into_iter();
        let named = all.filter_map(|parameter| {
            let (key, dimension) = match parameter {
                ModelParameter::Elastic(ElasticParameter::Foundation(of)) => {
                    of_body(of, &foundation)?
                }
                ModelParameter::Elastic(ElasticParameter::Counterbody(of)) => {
                    of_body(of, &indenter)?
                }
                ModelParameter::Relief(of) => of_relief(of, &model.relief),
                ModelParameter::Indenter(of) => of_indenter(of)?,
                ModelParameter::WorkOfAdhesion => return None,
            };
            Some(CaseParameter {
                key,
                parameter,
                dimension,
            })
        });
        let adhesion = self.load.work_of_adhesion.map(|_| CaseParameter {
            key: WORK_OF_ADHESION.into(),
            parameter: ModelParameter::WorkOfAdhesion,
            dimension: Some(Dimension::EnergyPerArea),
        });
        Ok(named.chain(adhesion).collect())
    }
}

/// The keys of the model's layers and its substrate, at these paths; none for the sublayers of a graded layer.
fn layer_keys(
    body: &FoundationCase,
    [substrate, layers]: [&str; 2],
) -> Result<Vec<Option<String>>, KernelError> {
    let splits = body.split()?.splits;
    let of_layer = |i: usize| match splits.iter().find(|split| split.layer == i) {
        Some(graded) => vec![None; graded.sublayers],
        None => vec![Some(format!("{layers}[{i}]"))],
    };
    let of_layers = (0..body.layer.len()).flat_map(of_layer);
    Ok(of_layers.chain([Some(substrate.to_owned())]).collect())
}

fn of_body(
    parameter: FoundationParameter,
    keys: &[Option<String>],
) -> Option<(String, Option<Dimension>)> {
    use FoundationParameter::{
        NormalCompliance, PoissonRatio, ShearCompliance, Thickness, YoungModulus,
    };
    let (body, name, dimension) = match parameter {
        YoungModulus { body } => (body, "young_modulus", Some(Dimension::Pressure)),
        PoissonRatio { body } => (body, "poisson_ratio", None),
        Thickness { layer } => (layer, "thickness", Some(Dimension::Length)),
        NormalCompliance { layer } => (
            layer,
            "interface.normal_compliance",
            Some(Dimension::Compliance),
        ),
        ShearCompliance { layer } => (
            layer,
            "interface.shear_compliance",
            Some(Dimension::Compliance),
        ),
    };
    let body = keys.get(body)?.as_ref()?;
    Some((format!("{body}.{name}"), dimension))
}

fn of_relief(parameter: ReliefParameter, relief: &Relief) -> (String, Option<Dimension>) {
    let (name, dimension) = match (parameter, relief) {
        (ReliefParameter::YoungModulus, _) => ("young_modulus", Dimension::Pressure),
        (ReliefParameter::Height, Relief::Film(_)) => ("thickness", Dimension::Length),
        (ReliefParameter::Height, _) => ("height", Dimension::Length),
        (ReliefParameter::Compliance, _) => ("compliance", Dimension::Compliance),
    };
    (format!("surface.{name}"), Some(dimension))
}

fn of_indenter(quantity: IndenterQuantity) -> Option<(String, Option<Dimension>)> {
    let (name, dimension) = match quantity {
        IndenterQuantity::Radius => ("radius", Some(Dimension::Length)),
        IndenterQuantity::RadiusAlongX => ("radii[0]", Some(Dimension::Length)),
        IndenterQuantity::RadiusAlongY => ("radii[1]", Some(Dimension::Length)),
        IndenterQuantity::TipRadius => ("tip_radius", Some(Dimension::Length)),
        IndenterQuantity::HalfAngle => ("half_angle", Some(Dimension::Angle)),
        IndenterQuantity::FaceAngle => ("face_angle", Some(Dimension::Angle)),
        IndenterQuantity::Exponent => ("exponent", None),
        IndenterQuantity::Coefficient => ("coefficient", Some(Dimension::Length)),
        _ => return None,
    };
    Some((format!("indenter.{name}"), dimension))
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use pellicle_influence::Cache;

    use super::*;
    use crate::input::span::Source;

    const CASE: &str = r#"
[foundation]
substrate = { young_modulus = 1, poisson_ratio = 0.3 }
[[foundation.layer]]
thickness = 0.1
young_modulus = { from = 10, to = 2, profile = "linear" }
poisson_ratio = 0.2
[[foundation.layer]]
thickness = 0.2
young_modulus = 4
poisson_ratio = 0.25
interface = { normal_compliance = 0.1, shear_compliance = 0.0 }
[surface]
kind = "film"
thickness = 0.01
young_modulus = 0.5
[indenter]
kind = "berkovich"
tip_radius = 0.3
young_modulus = 100
poisson_ratio = 0.1
[load]
force = 0.1
"#;

    #[test]
    fn every_parameter_except_those_of_graded_layers_has_its_key() {
        check(
            CASE,
            &[
                "foundation.layer[1].young_modulus",
                "foundation.layer[1].poisson_ratio",
                "foundation.layer[1].thickness",
                "foundation.layer[1].interface.normal_compliance",
                "foundation.substrate.young_modulus",
                "foundation.substrate.poisson_ratio",
                "indenter.young_modulus",
                "indenter.poisson_ratio",
                "surface.young_modulus",
                "surface.thickness",
                "indenter.face_angle",
                "indenter.tip_radius",
            ],
        );
    }

    #[test]
    fn the_parameters_of_a_layered_indenter_have_keys_of_its_body() {
        let of_body = r#"body = { substrate = "rigid", layer = [
            { thickness = 0.1, young_modulus = { from = 10, to = 2, profile = "linear" }, poisson_ratio = 0.2 },
            { thickness = 0.2, young_modulus = 4, poisson_ratio = 0.25, interface = { normal_compliance = 0.1, shear_compliance = 0.0 } },
        ] }"#;
        let of_half_space = "young_modulus = 100\npoisson_ratio = 0.1";
        let text = CASE.replace(of_half_space, of_body);
        check(
            &text,
            &[
                "foundation.layer[1].young_modulus",
                "foundation.layer[1].poisson_ratio",
                "foundation.layer[1].thickness",
                "foundation.layer[1].interface.normal_compliance",
                "foundation.substrate.young_modulus",
                "foundation.substrate.poisson_ratio",
                "indenter.body.layer[1].young_modulus",
                "indenter.body.layer[1].poisson_ratio",
                "indenter.body.layer[1].thickness",
                "indenter.body.layer[1].interface.normal_compliance",
                "surface.young_modulus",
                "surface.thickness",
                "indenter.face_angle",
                "indenter.tip_radius",
            ],
        );
    }

    /// The keys, each of which sets the number that it names.
    fn check(text: &str, wanted: &[&str]) {
        let source = Arc::new(Source::new("case.toml", text.into()));
        let read = |sets: &[String]| Case::parse(&source, "case", Path::new(""), sets).unwrap();
        let case = read(&[]);
        let model = |case: &Case| case.model(&Cache::none()).unwrap().value;
        let parameters = case.parameters(&model(&case)).unwrap();
        let keys: Vec<&str> = parameters.iter().map(|of| of.key.as_str()).collect();
        assert_eq!(keys, wanted);
        for CaseParameter { key, parameter, .. } in parameters {
            let value = model(&case).parameter(parameter).unwrap() * 1.01;
            let other = model(&read(&[format!("{key}={value}")]));
            assert_eq!(other.parameter(parameter), Some(value), "{key}");
        }
    }

    #[test]
    fn each_radius_of_an_ellipse_is_replaced_and_named_by_its_key() {
        let text = CASE.replace(
            "kind = \"berkovich\"\ntip_radius = 0.3",
            "kind = \"paraboloid\"\nradii = [0.3, 2]",
        );
        let source = Arc::new(Source::new("case.toml", text));
        let set = ["indenter.radii[1]=5".to_owned()];
        let case = Case::parse(&source, "case", Path::new(""), &set).unwrap();
        let model = case.model(&Cache::none()).unwrap().value;
        let parameters = case.parameters(&model).unwrap();
        let values = parameters.iter().filter_map(|of| {
            let value = model.parameter(of.parameter)?;
            Some((of.key.strip_prefix("indenter.radii")?, value))
        });
        assert_eq!(values.collect::<Vec<_>>(), [("[0]", 0.3), ("[1]", 5.0)]);
    }
}
