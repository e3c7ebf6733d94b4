//! A part of a case by itself, for callers that build a case from its parts and want each checked at once.

use std::sync::Arc;

use super::foundation::FoundationCase;
use super::foundation::layer::{LayerCase, SpringCase};
use super::foundation::modulus::GradingCase;
use super::foundation::strength::BodyStrengthCase;
use super::foundation::substrate::{MaterialCase, SubstrateCase};
use super::indenter::IndenterCase;
use super::output::OutputCase;
use super::stress::StressCase;
use super::surface::SurfaceCase;
use super::wear::WearCase;
use crate::declare::{Record, Scope};
use crate::input::diagnosis::Diagnosis;
use crate::input::span::Source;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree;

/// A part of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The table of a homogeneous material.
    Material,
    /// The table of a graded modulus.
    Grading,
    /// The table of an imperfect bond.
    Spring,
    /// The table of a layer.
    Layer,
    /// `[foundation]`
    Foundation,
    /// `[surface]`, without a map
    Surface,
    /// `[indenter]`, without a map
    Indenter,
    /// `[output]`
    Output,
    /// `[stress]`, of any body
    Stress,
    /// `[wear]`
    Wear,
}

impl Part {
    /// The parts by their names.
    pub const NAMES: [(&'static str, Self); 10] = [
        ("material", Self::Material),
        ("grading", Self::Grading),
        ("spring", Self::Spring),
        ("layer", Self::Layer),
        ("foundation", Self::Foundation),
        ("surface", Self::Surface),
        ("indenter", Self::Indenter),
        ("output", Self::Output),
        ("stress", Self::Stress),
        ("wear", Self::Wear),
    ];

    /// Checks the text of the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn check(self, source: &Arc<Source>) -> Result<(), Diagnosis> {
        let root = toml_tree::parse(source)?;
        let table = &TableReader::root(&root)?;
        // What a relief takes from the body by default is there.
        let body = FoundationCase {
            substrate: SubstrateCase::Elastic(MaterialCase {
                young_modulus: 1.0,
                poisson_ratio: 0.0,
                strength: BodyStrengthCase::default(),
            }),
            layer: Vec::new(),
        };
        let scope = &Scope {
            foundation: Some(&body),
            ..Scope::default()
        };
        match self {
            Self::Material => MaterialCase::read(table, scope).map(drop),
            Self::Grading => GradingCase::read(table, scope).map(drop),
            Self::Spring => SpringCase::read(table, scope).map(drop),
            Self::Layer => LayerCase::read(table, scope).map(drop),
            Self::Foundation => FoundationCase::read(table, scope).map(drop),
            Self::Surface => SurfaceCase::read(table, scope).map(drop),
            Self::Indenter => IndenterCase::read(table, scope).map(drop),
            Self::Output => OutputCase::read(table, scope).map(drop),
            Self::Stress => StressCase::read(table, scope).map(drop),
            Self::Wear => WearCase::read(table, scope).map(drop),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_of_a_part_names_the_call_and_the_key_and_no_line() {
        let refused = |part: Part, name: &str, text: &str| {
            let source = Arc::new(Source::new(name, text.to_owned()));
            part.check(&source).unwrap_err().to_string()
        };
        let material = "young_modulus = -1\npoisson_ratio = 0.3";
        let told = refused(Part::Material, "Material(…)", material);
        assert!(
            told.starts_with("Material(…), key `young_modulus`: found -1"),
            "{told}"
        );
        let sphere = "kind = \"sphere\"\nradius = \"0.5 N\"";
        let told = refused(Part::Indenter, "Sphere(…)", sphere);
        assert!(
            told.starts_with("Sphere(…), key `radius`: found \"0.5 N\""),
            "{told}"
        );
        let cylinders = "kind = \"cylinders\"\nradius = 1\nheight = 1\nperiod = 4";
        let source = Arc::new(Source::new("Cylinders(…)", cylinders.to_owned()));
        assert_eq!(Part::Surface.check(&source), Ok(()));
        let told = refused(Part::Stress, "Stress(…)", "friction = -1");
        assert!(
            told.starts_with("Stress(…), key `friction`: found -1"),
            "{told}"
        );
        let told = refused(Part::Wear, "Wear(…)", "coefficient = 1e-15");
        assert!(told.contains("distance"), "{told}");
    }
}
