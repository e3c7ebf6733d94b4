//! `kind = "function"`: a shape that no file can hold, handed over by the caller that solves the case.

use serde::Serialize;

use crate::input::toml_tree::TomlValue;
use crate::input::value_reader::ValueReader;

/// The word for such a shape in a case.
const KIND: &str = "function";

/// A shape defined by the caller; only its kind is written. It is not part of the case: all shapes compare equal here,
/// and the caller must tell them apart.
#[derive(Debug, Clone, Serialize)]
pub struct CallerShape<T> {
    /// The shape itself.
    #[serde(skip)]
    pub shape: T,
}

impl<T> PartialEq for CallerShape<T> {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}

/// The shape, if the kind requires one and one was handed over.
#[must_use]
pub fn of_kind<T: Clone>(kind: &ValueReader<'_>, shape: Option<&T>) -> Option<CallerShape<T>> {
    let is_requested = matches!(kind.value(), TomlValue::Text(text) if text == KIND);
    let shape = shape.filter(|_| is_requested).cloned()?;
    Some(CallerShape { shape })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_contact::{Indenter, Paraboloid};

    use crate::case::Case;
    use crate::case::map_sources::MapSources;
    use crate::input::span::Source;

    const CASE: &str = r#"
        [foundation.substrate]
        young_modulus = 1.0
        poisson_ratio = 0.3
        [indenter]
        kind = "function"
        young_modulus = 2.0
        poisson_ratio = 0.2
        [load]
        force = 1.0
    "#;

    fn read(text: &str, maps: &MapSources) -> Result<Case, String> {
        let source = Arc::new(Source::new("case", text.to_owned()));
        Case::parse_with(&source, "case", maps).map_err(|diagnosis| diagnosis.to_string())
    }

    fn with_shape() -> MapSources {
        MapSources::default().with_indenter(Indenter::from(Paraboloid::new(2.0).unwrap()))
    }

    #[test]
    fn a_shape_passed_in_is_used_only_where_the_case_asks_for_one() {
        let case = read(CASE, &with_shape()).unwrap();
        assert_eq!(case.indenter.build().unwrap().height(3.0, 4.0), 6.25);
        assert!(case.indenter.body.is_some());
        let other = CASE.replace("\"function\"", "\"sphere\"\nradius = 7.0");
        let ball = read(&other, &with_shape()).unwrap();
        assert_eq!(ball.indenter.build().unwrap().height(0.0, 7.0), 7.0);
    }

    #[test]
    fn a_case_that_asks_for_a_missing_shape_is_rejected() {
        let refused = read(CASE, &MapSources::default()).unwrap_err();
        assert!(refused.contains("\"function\""), "{refused}");
        let radius = CASE.replace("\"function\"", "\"function\"\nradius = 7.0");
        assert!(read(&radius, &with_shape()).is_err());
    }
}
