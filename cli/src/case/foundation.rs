//! `[foundation]`: the substrate and the layers on it.

use pellicle_kernel::{Base, Foundation, Interface, KernelError, Layer, Material};
use serde::Serialize;

use super::diagnosis::Diagnosis;
use super::field::Field;
use super::quantity::Dimension;
use super::reader::Reader;

const SUBSTRATE: &str = "{ young_modulus = .., poisson_ratio = .. } or \"rigid\"";

/// The foundation of a case, every value in SI units or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundationCase {
    /// What everything rests on.
    pub substrate: Substrate,
    /// The layers from the surface down.
    pub layer: Vec<LayerCase>,
}

/// What everything rests on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Substrate {
    /// A base that does not deform.
    Rigid,
    /// An elastic half-space.
    #[serde(untagged)]
    Elastic(MaterialCase),
}

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MaterialCase {
    /// Young's modulus `E`, Pa.
    pub young_modulus: f64,
    /// Poisson's ratio `ν`.
    pub poisson_ratio: f64,
}

/// One layer and how it holds to what lies below.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LayerCase {
    /// Thickness, m.
    pub thickness: f64,
    /// What it is made of.
    #[serde(flatten)]
    pub material: MaterialCase,
    /// How it holds to what lies below.
    pub interface: InterfaceCase,
}

/// How a layer holds to what lies below.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum InterfaceCase {
    /// It sticks.
    Bonded,
    /// It slides.
    Frictionless,
}

impl FoundationCase {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key that no foundation can have.
    pub fn read(table: &Reader<'_>) -> Result<Self, Diagnosis> {
        table.only(&["substrate", "layer"])?;
        let layers = match table.optional("layer") {
            Some(field) => field.items("a list of tables, each [[foundation.layer]]")?,
            None => Vec::new(),
        };
        let layer = layers.into_iter().map(LayerCase::read);
        let layer = layer.collect::<Result<Vec<_>, _>>()?;
        let substrate = table.required("substrate", SUBSTRATE)?;
        let foundation = Self {
            substrate: Substrate::read(substrate)?,
            layer,
        };
        match foundation.build() {
            Ok(_) => Ok(foundation),
            Err(error) => Err(blamed(table, &error)?.refused(&error)),
        }
    }

    /// The foundation itself.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if the kernel refuses a value.
    pub fn build(&self) -> Result<Foundation, KernelError> {
        let layers = self.layer.iter().map(LayerCase::build);
        Foundation::new(layers.collect::<Result<_, _>>()?, self.substrate.build()?)
    }

    /// Young's modulus of what lies at the surface, Pa; none on a bare rigid base, which is no foundation.
    #[must_use]
    pub fn surface_young_modulus(&self) -> Option<f64> {
        match (self.layer.first(), self.substrate) {
            (Some(layer), _) => Some(layer.material.young_modulus),
            (None, Substrate::Elastic(material)) => Some(material.young_modulus),
            (None, Substrate::Rigid) => None,
        }
    }
}

/// The value to change where the layers and the substrate are right but do not go together.
fn blamed<'a>(table: &Reader<'a>, error: &KernelError) -> Result<Field<'a>, Diagnosis> {
    let in_layer = |i: usize, key| {
        let layers = table.required("layer", "")?.items("")?;
        let layer = layers.into_iter().nth(i).map(Field::table).transpose()?;
        layer.unwrap_or_else(|| table.clone()).required(key, "")
    };
    match error {
        KernelError::ModulusRatio { layer, .. } => in_layer(*layer, "young_modulus"),
        KernelError::TotalThickness { layers, .. } => in_layer(layers - 1, "thickness"),
        _ => table.required("substrate", SUBSTRATE),
    }
}

impl Substrate {
    fn read(field: Field<'_>) -> Result<Self, Diagnosis> {
        if !field.is_table() {
            return match field.text() {
                Ok("rigid") => Ok(Self::Rigid),
                _ => Err(field.wanted(SUBSTRATE)),
            };
        }
        let table = field.table()?;
        table.only(&["young_modulus", "poisson_ratio"])?;
        Ok(Self::Elastic(MaterialCase::read(&table)?))
    }

    fn build(self) -> Result<Base, KernelError> {
        match self {
            Self::Rigid => Ok(Base::Rigid),
            Self::Elastic(material) => material.build().map(Base::HalfSpace),
        }
    }
}

impl MaterialCase {
    fn read(table: &Reader<'_>) -> Result<Self, Diagnosis> {
        const RATIO: &str = "Poisson's ratio, a number in [0, 0.5]";
        let material = Self {
            young_modulus: table.positive("young_modulus", Dimension::Pressure)?,
            poisson_ratio: table.required("poisson_ratio", RATIO)?.number(RATIO)?,
        };
        // The modulus is positive by now: what the kernel still refuses is the ratio.
        let ratio = table.required("poisson_ratio", RATIO)?;
        material.build().map_err(|error| ratio.refused(&error))?;
        Ok(material)
    }

    fn build(self) -> Result<Material, KernelError> {
        Material::new(self.young_modulus, self.poisson_ratio)
    }
}

impl LayerCase {
    fn read(field: Field<'_>) -> Result<Self, Diagnosis> {
        let table = field.table()?;
        table.only(&["thickness", "young_modulus", "poisson_ratio", "interface"])?;
        let interface = match table.optional("interface") {
            Some(field) => field.choice(&[
                ("bonded", InterfaceCase::Bonded),
                ("frictionless", InterfaceCase::Frictionless),
            ])?,
            None => InterfaceCase::Bonded,
        };
        Ok(Self {
            thickness: table.positive("thickness", Dimension::Length)?,
            material: MaterialCase::read(&table)?,
            interface,
        })
    }

    fn build(&self) -> Result<Layer, KernelError> {
        let interface = match self.interface {
            InterfaceCase::Bonded => Interface::Bonded,
            InterfaceCase::Frictionless => Interface::Frictionless,
        };
        Layer::new(self.thickness, self.material.build()?, interface)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::read_table;
    use super::*;

    fn read(text: &str) -> Result<FoundationCase, String> {
        read_table(text, |table| FoundationCase::read(&table))
    }

    const SUBSTRATE: &str = "substrate = { young_modulus = \"7 GPa\", poisson_ratio = 0.4 }\n";
    const LAYER: &str =
        "[[layer]]\nthickness = \"10 nm\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n";

    #[test]
    fn a_coated_body_is_read_from_the_surface_down() {
        let foundation = read(&format!("{SUBSTRATE}{LAYER}interface = \"frictionless\"")).unwrap();
        assert_eq!(foundation.layer.len(), 1);
        assert_eq!(foundation.layer[0].thickness, 1e-8);
        assert_eq!(foundation.layer[0].interface, InterfaceCase::Frictionless);
        assert_eq!(foundation.surface_young_modulus(), Some(70e9));
    }

    #[test]
    fn layers_may_rest_on_a_rigid_base() {
        let foundation = read(&format!("substrate = \"rigid\"\n{LAYER}")).unwrap();
        assert_eq!(foundation.substrate, Substrate::Rigid);
        assert!(read("substrate = \"rigid\"").is_err());
    }

    #[test]
    fn a_layer_without_thickness_is_diagnosed_at_its_header() {
        let text = format!(
            "{SUBSTRATE}{}",
            LAYER.replace("thickness = \"10 nm\"\n", "")
        );
        assert_eq!(
            read(&text).unwrap_err(),
            "case.toml, line 2, key `layer[0].thickness`: found no such key, \
             wanted a positive length such as \"5 nm\", or a bare number"
        );
    }

    #[test]
    fn poissons_ratio_of_a_material_that_cannot_be_is_diagnosed_at_its_key() {
        for ratio in ["0.6", "-0.1", "nan", "\"0.3\""] {
            let text = format!(
                "{SUBSTRATE}{}",
                LAYER.replace("ratio = 0.3", &format!("ratio = {ratio}"))
            );
            let message = read(&text).unwrap_err();
            assert!(
                message.starts_with(&format!(
                    "case.toml, line 5, key `layer[0].poisson_ratio`: found {ratio}"
                )),
                "{message}"
            );
            assert!(message.contains("[0, 0.5]"), "{message}");
        }
    }

    #[test]
    fn what_is_no_foundation_is_refused() {
        let faulty = [
            "",
            "substrate = \"rigit\"",
            "substrate = 3",
            "substrate = { young_modulus = \"5 nm\", poisson_ratio = 0.3 }",
            "substrate = { young_modulus = 1 }",
            "substrate = { young_modulus = 1, poisson_ratio = 0.3, density = 1 }",
            "substrate = \"rigid\"\n[layer]\nthickness = 1",
            "substrate = \"rigid\"\nlayer = [1]",
        ];
        for text in faulty {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
