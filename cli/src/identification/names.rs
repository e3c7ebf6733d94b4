//! The parameters of a model in words.

use super::exact_evaluation::{AREA, BETA, FRAME};

/// Names the parameter of a key: `Young's modulus of layer 0`; returns the key itself if it is not that of a parameter.
#[must_use]
pub fn of_key(key: &str) -> String {
    let Some((place, quantity)) = key.rsplit_once('.') else {
        return of_nuisance(key);
    };
    let quantity = match quantity {
        "young_modulus" => "Young's modulus",
        "poisson_ratio" => "Poisson's ratio",
        "thickness" => "thickness",
        "normal_compliance" => "normal compliance",
        "shear_compliance" => "shear compliance",
        "radius" => "radius",
        "tip_radius" => "tip radius",
        "half_angle" => "half-angle",
        "face_angle" => "face angle",
        "exponent" => "exponent",
        "coefficient" => "coefficient",
        "height" => "height",
        "compliance" => "compliance",
        "spring_constant" => "spring constant",
        "deflection" => "sensitivity of the deflection",
        _ => return of_nuisance(key),
    };
    match of_place(place) {
        Some(place) => format!("{quantity} of {place}"),
        None => key.to_owned(),
    }
}

fn of_place(place: &str) -> Option<String> {
    let found = match place {
        "foundation.substrate" => "the substrate",
        "indenter" => "the indenter",
        "surface" => "the surface",
        // The place is a table of measurements.
        _ if place.starts_with("data[") => place.trim_end_matches(".units"),
        _ => {
            let (index, rest) = place.strip_prefix("foundation.layer[")?.split_once(']')?;
            return match rest {
                "" => Some(format!("layer {index}")),
                ".interface" => Some(format!("the interface below layer {index}")),
                _ => None,
            };
        }
    };
    Some(found.to_owned())
}

/// Names the parameter of a key in symbols: `E, layer 0`.
#[must_use]
pub fn symbol(key: &str) -> String {
    let (place, quantity) = key.rsplit_once('.').unwrap_or(("", key));
    let letter = match (quantity, place) {
        ("young_modulus", _) => "E",
        ("poisson_ratio", _) => "ν",
        ("thickness", _) => "H",
        ("normal_compliance", _) => "c_n",
        ("shear_compliance", _) => "c_s",
        ("radius", "indenter") => return "R".into(),
        ("tip_radius", _) => return "R_b".into(),
        ("half_angle", _) => return "half-angle".into(),
        ("face_angle", _) => return "face angle".into(),
        ("exponent", _) => return "n".into(),
        ("coefficient", _) => return "c".into(),
        ("height", _) => "h",
        ("compliance", _) => "η",
        ("spring_constant", _) => "k",
        ("deflection", _) => "s",
        _ => return of_key(key),
    };
    match of_place(place) {
        Some(place) => format!("{letter}, {}", place.trim_start_matches("the ")),
        None => key.to_owned(),
    }
}

/// Writes a product of powers of keys in symbols: `E (substrate) · R^0.5`.
#[must_use]
pub fn combination(expression: &str) -> String {
    let factor = |factor: &str| {
        let (key, exponent) = factor.split_once('^').unwrap_or((factor, ""));
        let symbol = match symbol(key).split_once(", ") {
            Some((letter, place)) => format!("{letter} ({place})"),
            None => symbol(key),
        };
        match exponent {
            "" => symbol,
            exponent => format!("{symbol}^{exponent}"),
        }
    };
    let factors: Vec<_> = expression.split(" * ").map(factor).collect();
    factors.join(" · ")
}

fn of_nuisance(key: &str) -> String {
    match key {
        "frame_compliance" => "compliance of the frame".into(),
        "depth_zero" => "zero of the depth, in parts of the largest".into(),
        "force_zero" => "zero of the force, in parts of the largest".into(),
        AREA => "areas of all contacts".into(),
        FRAME => "compliance of the frame, in parts of the least of a contact".into(),
        BETA => "β".into(),
        key => key.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_translated_to_physical_terms() {
        for (key, words) in [
            (
                "foundation.layer[0].young_modulus",
                "Young's modulus of layer 0",
            ),
            (
                "foundation.substrate.poisson_ratio",
                "Poisson's ratio of the substrate",
            ),
            (
                "foundation.layer[1].interface.normal_compliance",
                "normal compliance of the interface below layer 1",
            ),
            ("indenter.tip_radius", "tip radius of the indenter"),
            ("surface.thickness", "thickness of the surface"),
            ("frame_compliance", "compliance of the frame"),
            ("data[0].spring_constant", "spring constant of data[0]"),
            (
                "data[0].units.deflection",
                "sensitivity of the deflection of data[0]",
            ),
            ("foundation.mystery.radius", "foundation.mystery.radius"),
        ] {
            assert_eq!(of_key(key), words);
        }
    }

    #[test]
    fn combinations_are_written_in_symbols() {
        let known = "foundation.substrate.young_modulus * indenter.radius^0.5";
        assert_eq!(combination(known), "E (substrate) · R^0.5");
        assert_eq!(symbol("foundation.layer[0].thickness"), "H, layer 0");
    }
}
