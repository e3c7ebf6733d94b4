//! The dimension of the values of each key of a case.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::Case;
use crate::declare::keys::dimensions;
use crate::input::dimension::Dimension;

static DIMENSIONS: LazyLock<BTreeMap<&str, Dimension>> =
    LazyLock::new(|| dimensions(&Case::shape()));

/// The dimension of a key's value, or of the ends of its range; none if it is a number without a unit, or no number.
#[must_use]
pub fn of_key(key: &str) -> Option<Dimension> {
    DIMENSIONS.get(key).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::Shape;
    use crate::declare::keys::fields;
    use crate::input::units::PROSE;

    #[test]
    fn keys_have_the_dimension_of_their_declaration() {
        assert_eq!(of_key("thickness"), Some(Dimension::Length));
        assert_eq!(of_key("forces"), Some(Dimension::Force));
        assert_eq!(of_key("shear_compliance"), Some(Dimension::Compliance));
        assert_eq!(of_key("face_angle"), Some(Dimension::Angle));
        for key in ["poisson_ratio", "from", "to", "elements", "kind", "title"] {
            assert_eq!(of_key(key), None, "{key}");
        }
    }

    #[test]
    fn the_texts_of_a_case_are_known_as_prose() {
        let shape = Case::shape();
        let texts = fields(&shape).into_iter();
        let texts: Vec<_> = texts.filter(|(_, shape)| **shape == Shape::Text).collect();
        let texts: Vec<_> = texts.into_iter().map(|(key, _)| key).collect();
        let mut prose = PROSE.to_vec();
        prose.sort_unstable();
        assert_eq!(texts, prose);
    }
}
