//! The elastic body of an indenter: a half-space, or layers of the foundation's own kind.

use std::borrow::Cow;

use pellicle_kernel::{Foundation, KernelError, Material};
use serde::Serialize;

use crate::case::foundation::FoundationCase;
use crate::case::foundation::strength::BodyStrengthCase;
use crate::case::foundation::substrate::{
    MaterialCase, POISSON_RATIO, POISSON_RATIOS, SubstrateCase,
};
use crate::declare::macros::record;
use crate::declare::{Codec, Record, Scope, TableShape, number, pressure, table, together};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// The elastic body of an indenter.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum IndenterBody {
    /// A half-space.
    Homogeneous(ElasticConstants),
    /// Layers on a base.
    Layered(LayeredIndenter),
}

record! {
    /// The elastic constants of an indenter.
    #[derive(Copy)]
    pub struct ElasticConstants {
        young_modulus: f64 = pressure().positive(), "Young's modulus of the indenter";
        poisson_ratio: f64 = number(POISSON_RATIO).within(POISSON_RATIOS), "Poisson's ratio of the indenter";
    }
    check |of: &ElasticConstants, table: &TableReader<'_>, _: &Scope<'_>| {
        // The modulus is known to be positive here, so only the ratio can be rejected.
        let refused = |error| Err(table.required("poisson_ratio", "")?.refused(&error));
        Material::new(of.young_modulus, of.poisson_ratio).map_or_else(refused, |_| Ok(()))
    };
}

record! {
    /// An indenter with layers.
    pub struct LayeredIndenter {
        body: FoundationCase = table(BODY), "its layers and substrate, as those of the foundation, in place of the two constants";
    }
    check |of: &LayeredIndenter, table: &TableReader<'_>, _: &Scope<'_>| {
        if !of.body.is_rigid() {
            return Ok(());
        }
        let substrate = table.required("body", BODY)?.table()?.required("substrate", "")?;
        Err(substrate.unusable(&"without layers on it", "layers too, or no body: an indenter without one is rigid"))
    };
}

const BODY: &str = "a table { substrate = .., layer = [..] }";

impl IndenterBody {
    /// The keys of both.
    pub(super) fn keys() -> Vec<&'static str> {
        let keys = [ElasticConstants::shape(), LayeredIndenter::shape()];
        keys.iter().flat_map(TableShape::keys).collect()
    }

    /// Adds the keys of both to a table.
    pub(super) fn declare(table: &mut TableShape) {
        together::<ElasticConstants>().declare("", "", table);
        let body = crate::declare::table::<FoundationCase>(BODY);
        let body = body.optional("the two constants, or rigid");
        let meaning = LayeredIndenter::shape().fields[0].meaning;
        body.declare("body", meaning, table);
    }

    /// Reads the keys of either; none if none is given.
    pub(super) fn read(
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<Option<Self>, Diagnosis> {
        let Some(body) = table.optional("body") else {
            let constants = together::<ElasticConstants>().take("", table, scope)?;
            return Ok(constants.map(Self::Homogeneous));
        };
        if let [key, ..] = table.given(&["young_modulus", "poisson_ratio"])[..] {
            let wanted = "either a body or the constants of a half-space";
            return Err(body.unusable(&format!("beside {key}"), wanted));
        }
        LayeredIndenter::read_part(table, scope).map(|of| Some(Self::Layered(of)))
    }

    /// The body as a foundation of a case, with its strengths.
    #[must_use]
    pub fn as_foundation(&self) -> Cow<'_, FoundationCase> {
        match self {
            Self::Layered(of) => Cow::Borrowed(&of.body),
            Self::Homogeneous(of) => Cow::Owned(FoundationCase {
                substrate: SubstrateCase::Elastic(MaterialCase {
                    young_modulus: of.young_modulus,
                    poisson_ratio: of.poisson_ratio,
                    strength: BodyStrengthCase::default(),
                }),
                layer: Vec::new(),
            }),
        }
    }

    /// The path of its substrate and of its layers in a case, from `indenter`.
    #[must_use]
    pub fn paths(&self) -> [&'static str; 2] {
        match self {
            Self::Homogeneous(_) => ["indenter", ""],
            Self::Layered(_) => ["indenter.body.substrate", "indenter.body.layer"],
        }
    }

    /// The body itself.
    ///
    /// # Errors
    ///
    /// [`KernelError`] if a value is invalid.
    pub fn build(&self) -> Result<Foundation, KernelError> {
        Ok(self.as_foundation().split()?.foundation)
    }
}

impl From<Material> for IndenterBody {
    fn from(material: Material) -> Self {
        Self::Homogeneous(ElasticConstants {
            young_modulus: material.young_modulus(),
            poisson_ratio: material.poisson_ratio(),
        })
    }
}

impl From<Foundation> for IndenterBody {
    fn from(body: Foundation) -> Self {
        Self::Layered(LayeredIndenter { body: body.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::indenter::IndenterCase;
    use crate::input::table_reader::tests::read_table;

    const COATED: &str =
        "layer = [{ thickness = 2e-6, young_modulus = 3e11, poisson_ratio = 0.25 }]";
    const STEEL: &str = "substrate = { young_modulus = 2.1e11, poisson_ratio = 0.3 }";

    fn read(constants: &str) -> Result<Option<Foundation>, String> {
        let text = format!("kind = \"paraboloid\"\nradius = 1\n{constants}");
        let case = read_table(&text, |table| IndenterCase::read(&table, &Scope::default()))?;
        Ok(case.body.map(|body| body.build().unwrap()))
    }

    #[test]
    fn an_elastic_indenter_requires_both_constants() {
        let diamond = read("young_modulus = \"1141 GPa\"\npoisson_ratio = 0.07").unwrap();
        let expected = Material::new(1141e9, 0.07).unwrap();
        assert_eq!(diamond, Some(expected.into()));
        assert_eq!(read("").unwrap(), None);
        for faulty in [
            "young_modulus = 1",
            "poisson_ratio = 0.3",
            "young_modulus = 0\npoisson_ratio = 0.3",
            "young_modulus = 1\npoisson_ratio = 0.6",
        ] {
            assert!(read(faulty).is_err(), "{faulty}");
        }
    }

    #[test]
    fn a_body_is_a_foundation_of_its_own() {
        let [coating, steel] = [[3e11, 0.25], [2.1e11, 0.3]].map(|[e, nu]| Material::new(e, nu));
        let wanted = Foundation::coated(2e-6, coating.unwrap(), steel.unwrap()).unwrap();
        let found = read(&format!("body = {{ {STEEL}, {COATED} }}")).unwrap();
        assert_eq!(found, Some(wanted));
        let tables = format!(
            "[body]\n{STEEL}\n[[body.layer]]\n{}",
            COATED[9..COATED.len() - 1]
                .replace("{ ", "")
                .replace(" }", "")
                .replace(", ", "\n")
        );
        assert_eq!(read(&tables).unwrap(), found);
    }

    #[test]
    fn what_is_wrong_with_a_body_is_told_in_one_sentence() {
        for (text, wanted) in [
            (
                format!("body = {{ {STEEL} }}\nyoung_modulus = 1e9\npoisson_ratio = 0.3"),
                "key `body`: found a table, beside young_modulus, wanted either a body or the constants of a half-space",
            ),
            (
                format!("body = {{ {COATED} }}"),
                "key `body.substrate`: found no such key, wanted { young_modulus = .., poisson_ratio = .. }",
            ),
            (
                "body = { substrate = \"rigid\" }".into(),
                "key `body.substrate`: found \"rigid\", without layers on it, wanted layers too",
            ),
            (
                format!("body = {{ {STEEL}, {} }}", COATED.replace("2e-6", "-2e-6")),
                "key `body.layer[0].thickness`",
            ),
            ("body = 2".into(), "key `body`: found 2, wanted a table"),
        ] {
            let found = read(&text).unwrap_err();
            assert!(found.contains(wanted), "{found}\n{wanted}");
        }
    }
}
