//! `[foundation]`: the substrate and the layers on it.

pub mod depths;
pub mod layer;
pub mod modulus;
pub mod strength;
pub mod substrate;

use std::sync::Arc;

use pellicle_contact::{Criterion, ResidualStress};
use pellicle_kernel::{Base, Foundation, KernelError};

use self::layer::LayerCase;
use self::strength::BodyStrengthCase;
use self::substrate::SubstrateCase;
use super::indenter::IndenterCase;
use crate::declare::macros::record;
use crate::declare::{Codec, Record, Scope, tables};
use crate::input::diagnosis::Diagnosis;
use crate::input::span::Source;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree;
use crate::input::value_reader::ValueReader;

record! {
    /// The foundation of a case; every value is in SI units or the case's own.
    pub struct FoundationCase {
        substrate: SubstrateCase = SubstrateCase::codec(), "the base of the layers, elastic or rigid";
        layer: Vec<LayerCase> = tables(LAYERS).or(Vec::new(), "no layers"), "the layers from the surface down";
    }
    check |foundation: &FoundationCase, table: &TableReader<'_>, _: &Scope<'_>| {
        let refused = |refusal: RefusedLayer| Err(faulty_field(table, &refusal)?.refused(&refusal.error));
        foundation.try_split().map_or_else(refused, |_| Ok(()))
    };
}

const LAYERS: &str = "a list of tables, one a layer, such as [[foundation.layer]]";

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

/// The error of a foundation, with the layer of the case that causes it.
struct RefusedLayer {
    layer: usize,
    error: KernelError,
}

impl FoundationCase {
    /// Reads only the `[foundation]` of the text of a case.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first invalid key.
    pub fn parse(source: &Arc<Source>) -> Result<Self, Diagnosis> {
        let root = toml_tree::parse(source)?;
        let table = TableReader::root(&root)?;
        let table = table
            .required("foundation", "a table [foundation]")?
            .table()?;
        let foundation = Self::read(&table, &Scope::default())?;
        foundation.refuse_rigid(&table)?;
        Ok(foundation)
    }

    /// Refuses a foundation that does not deform, on which no rigid body can be pressed.
    pub(super) fn refuse_rigid(&self, table: &TableReader<'_>) -> Result<(), Diagnosis> {
        if self.is_rigid() {
            return Err(table
                .required("substrate", "")?
                .refused(&KernelError::NothingElastic));
        }
        Ok(())
    }

    /// Whether it is a rigid base without layers.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.layer.is_empty() && self.substrate == SubstrateCase::Rigid
    }

    /// The foundation itself, with its graded layers split.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if the kernel rejects a value.
    pub fn split(&self) -> Result<SplitFoundation, KernelError> {
        self.try_split().map_err(|refusal| refusal.error)
    }

    /// Splits from the bottom up, since the split of a layer depends on the layers below it.
    fn try_split(&self) -> Result<SplitFoundation, RefusedLayer> {
        let refused = |layer| move |error| RefusedLayer { layer, error };
        let base = self.substrate.build().map_err(refused(0))?;
        let (mut below, mut splits) = (Vec::new(), Vec::new());
        // For each layer of the foundation, the layer of the case to which it belongs.
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
        if self.is_rigid() {
            let foundation = Foundation::rigid();
            return Ok(SplitFoundation { foundation, splits });
        }
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

    /// Young's modulus at the surface, Pa; none for a bare rigid base.
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

    /// Hardness of the softer of its surface and the indenter's, Pa.
    #[must_use]
    pub fn hardness_against(&self, indenter: &IndenterCase) -> Option<f64> {
        let other = indenter.foundation().and_then(|body| body.hardness());
        [self.hardness(), other]
            .into_iter()
            .flatten()
            .reduce(f64::min)
    }

    /// The residual stress of the layers, at the depths of the `foundation`.
    #[must_use]
    pub fn residual_stress(&self, foundation: &Foundation) -> ResidualStress {
        let stresses = self.layer.iter().map(|layer| layer.residual_stress);
        ResidualStress::new(self.bottoms(foundation).into_iter().zip(stresses))
    }

    /// The names of the bodies in results.
    #[must_use]
    pub fn body_names(&self) -> Vec<String> {
        let layers = (0..self.layer.len()).map(|i| format!("layer[{i}]"));
        let substrate = match self.substrate {
            SubstrateCase::Rigid => None,
            SubstrateCase::Elastic(_) => Some("substrate".to_owned()),
        };
        layers.chain(substrate).collect()
    }

    /// The names of the layers of the split foundation and its base, those of a graded layer with their number of all.
    #[must_use]
    pub fn names_of_split(&self) -> Vec<String> {
        let splits = self.split().map_or(Vec::new(), |split| split.splits);
        let of_layer = |i: usize| match splits.iter().find(|split| split.layer == i) {
            Some(Split { sublayers, .. }) => (1..=*sublayers)
                .map(|part| format!("layer[{i}] (part {part} of {sublayers})"))
                .collect(),
            None => vec![format!("layer[{i}]")],
        };
        let layers = (0..self.layer.len()).flat_map(of_layer);
        layers.chain(["the substrate".to_owned()]).collect()
    }

    /// Whether a body or an interface has a strength.
    #[must_use]
    pub fn has_strengths(&self) -> bool {
        !self.criteria().is_empty()
    }

    /// The criteria of the given strengths, each with the name of its body or interface in results.
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

/// The value to change if the layers and the substrate are valid but incompatible.
fn faulty_field<'a>(
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
        _ => table.required("substrate", ""),
    }
}

impl From<Foundation> for FoundationCase {
    fn from(foundation: Foundation) -> Self {
        Self {
            substrate: match foundation.base() {
                Base::Rigid => SubstrateCase::Rigid,
                Base::HalfSpace(material) => SubstrateCase::Elastic(material.into()),
            },
            layer: foundation
                .layers()
                .iter()
                .map(|layer| (*layer).into())
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests;
