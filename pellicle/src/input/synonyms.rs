//! Words of other programs and of papers for keys of a case and for their values.

use super::diagnosis::closest;

/// A group of words, the keys that say the same, the likeliest first, and how the number differs, if it does.
type Synonym = (
    &'static [&'static str],
    &'static [&'static str],
    &'static str,
);

const SYNONYMS: [Synonym; 18] = [
    (
        &[
            "e",
            "modulus",
            "youngs_modulus",
            "elastic_modulus",
            "emod",
            "stiffness",
        ],
        &["young_modulus"],
        "",
    ),
    (
        &["nu", "ν", "v", "poisson", "poissons_ratio", "pr"],
        &["poisson_ratio"],
        "",
    ),
    (
        &["r", "radius", "tip", "r_tip"],
        &["radius", "tip_radius"],
        "",
    ),
    (
        &["diameter", "d", "dia"],
        &["radius", "tip_radius"],
        ", half of the diameter",
    ),
    (
        &[
            "mu",
            "µ",
            "μ",
            "cof",
            "friction_coefficient",
            "coefficient_of_friction",
        ],
        &["friction", "coefficient"],
        "",
    ),
    (
        &[
            "f",
            "p",
            "fn",
            "w",
            "q",
            "normal_force",
            "load",
            "weight",
            "newton",
        ],
        &["force", "forces"],
        "",
    ),
    (
        &["pressure", "nominal_pressure", "mean_pressure"],
        &["pressure", "force"],
        "",
    ),
    (
        &["displacement", "indentation", "approach", "depth", "delta"],
        &["penetration", "depth"],
        "",
    ),
    (
        &["t", "h", "thick", "height"],
        &["thickness", "height", "depth"],
        "",
    ),
    (
        &["base", "half_space", "halfspace", "bulk"],
        &["substrate"],
        "",
    ),
    (&["layers", "coating", "film", "coat"], &["layer"], ""),
    (
        &["tip", "ball", "sphere", "counterbody", "probe", "punch"],
        &["indenter"],
        "",
    ),
    (
        &["texture", "relief", "roughness", "topography"],
        &["surface"],
        "",
    ),
    (
        &["pitch", "spacing", "wavelength", "distance"],
        &["period"],
        "",
    ),
    (&["n", "nx", "resolution", "grid_points"], &["elements"], ""),
    (
        &["size", "length", "width", "domain", "window", "lx"],
        &["side", "sides"],
        "",
    ),
    (&["path", "filename", "name"], &["file"], ""),
    (
        &["sigma_y", "yield", "yield_stress"],
        &["yield_strength"],
        "",
    ),
];

/// Words for values, and the values that mean the same, the likeliest first.
const VALUES: [(&[&str], &[&str]); 10] = [
    (
        &["ball", "spherical", "bead", "colloid"],
        &["sphere", "paraboloid"],
    ),
    (&["parabolic", "hertz"], &["paraboloid"]),
    (&["conical", "conosphere", "sphero-conical"], &["cone"]),
    (&["pyramid", "modified-berkovich"], &["berkovich"]),
    (&["punch", "cylinder", "cylindrical"], &["flat-punch"]),
    (&["plane", "plate"], &["flat"]),
    (&["pillars", "columns", "posts", "pins"], &["cylinders"]),
    (&["holes", "pits", "pockets"], &["dimples"]),
    (&["none", "plain", "smooth"], &["bare", "off"]),
    (&["glued", "welded", "stuck", "perfect"], &["bonded"]),
];

/// The value that someone meant who wrote another word: one that it misspells, or that means the same.
#[must_use]
pub fn value_suggestion<'v>(word: &str, known: &[&'v str]) -> Option<&'v str> {
    let lower = word.to_lowercase().replace('_', "-");
    let groups = VALUES.iter().filter(|(words, _)| words.contains(&&*lower));
    let values = groups.flat_map(|(_, values)| values.iter());
    let meant = values.filter_map(|value| known.iter().find(|of| *of == value).copied());
    closest(word, known).or_else(|| meant.into_iter().next())
}

/// What to ask of someone who wrote an unknown `word` where these keys are `known`: a key that it misspells, or that
/// other programs call so.
#[must_use]
pub fn suggestion(word: &str, known: &[&str]) -> Option<String> {
    if let Some(key) = closest(word, known) {
        return Some(format!("did you mean `{key}`?"));
    }
    let lower = word.to_lowercase().replace('-', "_");
    let groups = SYNONYMS
        .iter()
        .filter(|(words, ..)| words.contains(&&*lower));
    let mut found = groups.filter_map(|(_, keys, difference)| {
        let key = keys.iter().find(|key| known.contains(key))?;
        Some(format!("did you mean `{key}`{difference}?"))
    });
    found.next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_of_other_programs_lead_to_those_of_a_case() {
        let ball = ["kind", "radius", "young_modulus", "poisson_ratio"];
        for (word, wanted) in [
            ("E", "did you mean `young_modulus`?"),
            ("nu", "did you mean `poisson_ratio`?"),
            ("Diameter", "did you mean `radius`, half of the diameter?"),
            ("raduis", "did you mean `radius`?"),
        ] {
            assert_eq!(suggestion(word, &ball).as_deref(), Some(wanted));
        }
        assert_eq!(suggestion("colour", &ball), None);
        let shapes = ["paraboloid", "sphere", "cone", "flat-punch"];
        for (word, wanted) in [
            ("ball", Some("sphere")),
            ("Punch", Some("flat-punch")),
            ("shpere", Some("sphere")),
            ("pillars", None),
        ] {
            assert_eq!(value_suggestion(word, &shapes), wanted);
        }
        let friction = suggestion("mu", &["friction", "direction"]);
        assert_eq!(friction.as_deref(), Some("did you mean `friction`?"));
    }
}
