//! `[foundation]`: the substrate and the layers on it.

pub mod depths;
pub mod layer;
pub mod modulus;
pub mod strength;
pub mod substrate;

use std::sync::Arc;

use pellicle_contact::Criterion;
use pellicle_kernel::{Foundation, KernelError};
use serde::Serialize;

use self::layer::LayerCase;
use self::strength::BodyStrengthCase;
use self::substrate::SubstrateCase;
use super::diagnosis::Diagnosis;
use super::document;
use super::source::Source;
use super::table_reader::TableReader;
use super::value_reader::ValueReader;

/// The foundation of a case, every value in SI units or the case's own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FoundationCase {
    /// The base of the layers.
    pub substrate: SubstrateCase,
    /// The layers from the surface down.
    pub layer: Vec<LayerCase>,
}

/// A foundation whose graded layers are split into homogeneous ones.
#[derive(Debug, Clone)]
pub struct SplitFoundation {
    /// The foundation itself.
    pub foundation: Foundation,
    /// The splits of the graded layers, from the surface down.
    pub splits: Vec<Split>,
}

/// The split of a graded layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Split {
    /// The layer, counted from 0 at the surface.
    pub layer: usize,
    /// Number of sublayers.
    pub sublayers: usize,
    /// Estimated relative error of `C(k)` due to the split.
    pub error: f64,
}

/// The error of a foundation, and the layer of the case that causes it.
struct RefusedLayer {
    layer: usize,
    error: KernelError,
}

impl FoundationCase {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&["substrate", "layer"])?;
        let layers = match table.optional("layer") {
            Some(field) => field.items("a list of tables, each [[foundation.layer]]")?,
            None => Vec::new(),
        };
        let layer = layers.into_iter().map(LayerCase::read);
        let layer = layer.collect::<Result<Vec<_>, _>>()?;
        let substrate = table.required("substrate", substrate::WANTED)?;
        let foundation = Self {
            substrate: SubstrateCase::read(substrate)?,
            layer,
        };
        match foundation.try_split() {
            Ok(_) => Ok(foundation),
            Err(refusal) => Err(blamed(table, &refusal)?.refused(&refusal.error)),
        }
    }

    /// Reads the text of a case of which only `[foundation]` matters.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key.
    pub fn parse(source: &Arc<Source>) -> Result<Self, Diagnosis> {
        let root = document::parse(source)?;
        let table = TableReader::root(&root)?;
        let foundation = table.required("foundation", "a table [foundation]")?;
        Self::read(&foundation.table()?)
    }

    /// The foundation itself, with its graded layers split.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if the kernel refuses a value.
    pub fn split(&self) -> Result<SplitFoundation, KernelError> {
        self.try_split().map_err(|refusal| refusal.error)
    }

    /// Splits from the bottom up, since the split of a layer depends on what lies below it.
    fn try_split(&self) -> Result<SplitFoundation, RefusedLayer> {
        let refused = |layer| move |error| RefusedLayer { layer, error };
        let base = self.substrate.build().map_err(refused(0))?;
        let (mut below, mut splits) = (Vec::new(), Vec::new());
        // The layer of the case that each layer belongs to.
        let mut origins = Vec::new();
        for (i, layer) in self.layer.iter().enumerate().rev() {
            let (layers, error) = layer.split(&below, base).map_err(refused(i))?;
            let sublayers = layers.len() - below.len();
            splits.extend(error.map(|error| Split {
                layer: i,
                sublayers,
                error,
            }));
            origins.splice(0..0, std::iter::repeat_n(i, sublayers));
            below = layers;
        }
        splits.reverse();
        let foundation = Foundation::new(below, base).map_err(|error| {
            let found = match error {
                KernelError::ModulusRatio { layer, .. } => layer,
                KernelError::TotalThickness { layers, .. } => layers.saturating_sub(1),
                _ => 0,
            };
            let layer = origins.get(found).copied().unwrap_or(self.layer.len());
            RefusedLayer { layer, error }
        })?;
        Ok(SplitFoundation { foundation, splits })
    }

    /// Young's modulus at the surface, Pa; none on a bare rigid base, which is no foundation.
    #[must_use]
    pub fn surface_young_modulus(&self) -> Option<f64> {
        match (self.layer.first(), self.substrate) {
            (Some(layer), _) => Some(layer.young_modulus.at_top()),
            (None, SubstrateCase::Elastic(material)) => Some(material.young_modulus),
            (None, SubstrateCase::Rigid) => None,
        }
    }

    /// Hardness of the surface, Pa: of the topmost layer, or of a substrate without layers.
    #[must_use]
    pub fn hardness(&self) -> Option<f64> {
        match (self.layer.first(), self.substrate) {
            (Some(layer), _) => layer.strength.hardness,
            (None, SubstrateCase::Elastic(material)) => material.strength.hardness,
            (None, SubstrateCase::Rigid) => None,
        }
    }

    /// Whether a body or an interface has a strength.
    #[must_use]
    pub fn has_strengths(&self) -> bool {
        !self.criteria().is_empty()
    }

    /// The criteria of the strengths given, each with the body or interface that it is of, as results name it.
    #[must_use]
    pub fn criteria(&self) -> Vec<(String, Criterion)> {
        let substrate = match self.substrate {
            SubstrateCase::Rigid => BodyStrengthCase::default(),
            SubstrateCase::Elastic(material) => material.strength,
        };
        let bodies = self.layer.iter().map(|layer| layer.strength);
        let bodies = self.body_names().into_iter().zip(bodies.chain([substrate]));
        let of_bodies = bodies.flat_map(|(name, strength)| {
            [
                (strength.yield_strength, Criterion::Yield),
                (strength.tensile_strength, Criterion::Tension),
            ]
            .map(|(strength, criterion)| (strength, name.clone(), criterion))
        });
        let of_interfaces = self.layer.iter().enumerate().flat_map(|(i, layer)| {
            let strength = layer.interface_strength;
            [
                (strength.interface_shear_strength, Criterion::InterfaceShear),
                (
                    strength.interface_tensile_strength,
                    Criterion::InterfaceTension,
                ),
            ]
            .map(|(strength, criterion)| (strength, format!("interface[{i}]"), criterion))
        });
        let given = of_bodies.chain(of_interfaces);
        let given = given.filter(|(strength, ..)| strength.is_some());
        given
            .map(|(_, name, criterion)| (name, criterion))
            .collect()
    }
}

/// The value to change if the layers and the substrate are valid but do not go together.
fn blamed<'a>(
    table: &TableReader<'a>,
    refusal: &RefusedLayer,
) -> Result<ValueReader<'a>, Diagnosis> {
    let in_layer = |key| {
        let layers = table.required("layer", "")?.items("")?;
        let layer = layers.into_iter().nth(refusal.layer);
        let layer = layer.map(ValueReader::table).transpose()?;
        layer.unwrap_or_else(|| table.clone()).required(key, "")
    };
    match refusal.error {
        KernelError::ModulusRatio { .. } | KernelError::Grading { .. } => in_layer("young_modulus"),
        KernelError::TotalThickness { .. } | KernelError::Thickness { .. } => in_layer("thickness"),
        _ => table.required("substrate", substrate::WANTED),
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::Layer;

    use super::super::table_reader::tests::read_table;
    use super::layer::{InterfaceCase, NamedInterface};
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
        let sliding = InterfaceCase::Named(NamedInterface::Frictionless);
        assert_eq!(foundation.layer[0].interface, sliding);
        assert_eq!(foundation.surface_young_modulus(), Some(70e9));
    }

    /// The modulus at the middle of each sublayer of a layer graded so, on the substrate.
    fn graded(modulus: &str) -> Result<SplitFoundation, String> {
        let layer = LAYER.replace("\"70 GPa\"", modulus);
        let foundation = read(&format!("{SUBSTRATE}{layer}"))?;
        Ok(foundation.split().unwrap())
    }

    #[test]
    fn an_interface_may_be_an_imperfect_bond() {
        let spring = "interface = { normal_compliance = 0, shear_compliance = \"2 nm/GPa\" }";
        let foundation = read(&format!("{SUBSTRATE}{LAYER}{spring}")).unwrap();
        let built = foundation.split().unwrap().foundation;
        let interface = built.layers()[0].interface();
        assert_eq!(interface.shear_compliance(), 2e-18);
        assert_eq!(interface.normal_compliance(), 0.0);
        for (interface, wanted) in [
            ("{ shear_compliance = 1e-18 }", "normal_compliance"),
            (
                "{ normal_compliance = -1e-18, shear_compliance = 0 }",
                "a compliance of zero or more",
            ),
            (
                "{ normal_compliance = 0, shear_compliance = \"1 GPa\" }",
                "a compliance of zero or more",
            ),
            (
                "{ normal_compliance = 0, shear_compliance = 0, stiffness = 1 }",
                "stiffness",
            ),
            ("\"glued\"", "bonded"),
        ] {
            let refused = read(&format!("{SUBSTRATE}{LAYER}interface = {interface}")).unwrap_err();
            let text = format!("{refused:?} {refused}");
            assert!(text.contains(wanted), "{interface}: {text}");
        }
    }

    #[test]
    fn a_graded_layer_is_split_until_its_compliance_is_right() {
        for (profile, middle) in [("linear", 40e9), ("exponential", 10e9 * 7_f64.sqrt())] {
            let grading =
                format!("{{ from = \"10 GPa\", to = \"70 GPa\", profile = \"{profile}\" }}");
            let SplitFoundation { foundation, splits } = graded(&grading).unwrap();
            let layers = foundation.layers();
            let [split] = splits[..] else {
                panic!("{splits:?}")
            };
            assert_eq!((split.layer, split.sublayers), (0, layers.len()));
            assert!(split.error > 0.0 && split.error <= 1e-4, "{}", split.error);
            let thickness: f64 = layers.iter().map(Layer::thickness).sum();
            approx::assert_relative_eq!(thickness, 1e-8, max_relative = 1e-12);
            let mut depth = 0.0;
            let of_middle = layers.iter().find(|layer| {
                depth += layer.thickness();
                depth > 0.5e-8
            });
            let modulus = of_middle.unwrap().material().young_modulus();
            assert!(
                (modulus / middle - 1.0).abs() < 0.1,
                "{profile}: {modulus:e}"
            );
        }
    }

    #[test]
    fn a_layer_graded_between_equal_moduli_is_a_homogeneous_one() {
        let same = graded("{ from = \"70 GPa\", to = \"70 GPa\", profile = \"linear\" }").unwrap();
        let one = graded("\"70 GPa\"").unwrap().foundation;
        for k in [1e6, 1e8, 1e10] {
            let (split, whole) = (same.foundation.compliance(k), one.compliance(k));
            approx::assert_relative_eq!(split, whole, max_relative = 1e-12);
        }
    }

    #[test]
    fn a_grading_that_is_none_is_diagnosed_at_its_key() {
        let message = |modulus: &str| graded(modulus).err().unwrap();
        for (modulus, wanted) in [
            ("{ from = 1, to = 2 }", "young_modulus.profile`"),
            (
                "{ from = 1, to = 2, profile = \"liner\" }",
                "wanted one of \"linear\", \"exponential\"",
            ),
            (
                "{ from = 0, to = 2, profile = \"linear\" }",
                "young_modulus.from`",
            ),
            (
                "{ from = 1, too = 2, profile = \"linear\" }",
                "young_modulus.too`",
            ),
            ("[1, 2]", "young_modulus`"),
        ] {
            assert!(message(modulus).contains(wanted), "{}", message(modulus));
        }
    }

    #[test]
    fn layers_may_rest_on_a_rigid_base() {
        let foundation = read(&format!("substrate = \"rigid\"\n{LAYER}")).unwrap();
        assert_eq!(foundation.substrate, SubstrateCase::Rigid);
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
