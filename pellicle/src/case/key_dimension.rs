//! The dimension of the values of a case.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::Case;
use crate::declare::keys::dimensions;
use crate::input::dimension::Dimension;

static DIMENSIONS: LazyLock<BTreeMap<String, Dimension>> =
    LazyLock::new(|| dimensions(&Case::shape()));

/// The dimension of the value at a path such as `foundation.layer[0].thickness`, or of the ends of its range; none if
/// it is a number without a unit, or no number.
#[must_use]
pub fn of_path(path: &str) -> Option<Dimension> {
    let keys = path
        .split('.')
        .map(|key| key.split('[').next().unwrap_or(key));
    let keys: Vec<_> = keys.filter(|key| key.parse::<usize>().is_err()).collect();
    let of = |keys: &[&str]| DIMENSIONS.get(&keys.join(".")).copied();
    of(&keys).or_else(|| match keys.split_last()? {
        (&("from" | "to"), range) => of(range),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::Shape;
    use crate::declare::keys::fields;
    use crate::input::units::PROSE;

    #[test]
    fn values_have_the_dimension_of_their_declaration() {
        for (path, wanted) in [
            ("foundation.layer[0].thickness", Dimension::Length),
            ("foundation.layer.1.young_modulus.from", Dimension::Pressure),
            ("load.forces", Dimension::Force),
            (
                "foundation.layer[0].interface.shear_compliance",
                Dimension::Compliance,
            ),
            ("indenter.face_angle", Dimension::Angle),
            ("indenter.coefficient", Dimension::Length),
            ("wear.coefficient", Dimension::WearCoefficient),
            ("wear.distances.to", Dimension::Length),
        ] {
            assert_eq!(of_path(path), Some(wanted), "{path}");
        }
        for path in [
            "foundation.substrate.poisson_ratio",
            "from",
            "grid.elements",
            "indenter.kind",
            "title",
        ] {
            assert_eq!(of_path(path), None, "{path}");
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
