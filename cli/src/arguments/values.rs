//! Parsers of option values: quantities, ranges, sections and offsets.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;
use pellicle_plot::sheet::colour_map::ColourMap;
use pellicle_plot::sheet::style::Cut;

pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(k) if k > 0.0 && k.is_finite() => Ok(k),
        _ => Err("wanted a positive number".into()),
    }
}

pub(super) fn part(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(part) if (1e-9..=0.1).contains(&part) => Ok(part),
        _ => Err("wanted a number from 1e-9 to 0.1".into()),
    }
}

pub(super) fn paper_width(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(width) if (70.0..=400.0).contains(&width) => Ok(width),
        _ => Err("wanted millimetres from 70 to 400".into()),
    }
}

pub(super) fn resolution(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(dpi) if (50.0..=1200.0).contains(&dpi) => Ok(dpi),
        _ => Err("wanted pixels per inch from 50 to 1200".into()),
    }
}

/// A quantity with or without its unit.
fn quantity(text: &str, dimension: Dimension) -> Result<f64, String> {
    let bare = text.trim().parse().ok();
    let value = bare.or_else(|| quantity::parse(text, dimension).ok());
    let wanted = || {
        let example = dimension.example().trim_matches('"');
        format!(
            "wanted {} such as {example}, or a bare number",
            dimension.noun()
        )
    };
    value
        .filter(|value: &f64| value.is_finite())
        .ok_or_else(wanted)
}

pub(super) fn range(text: &str) -> Result<[f64; 2], String> {
    let (from, to) = text.split_once(':').unwrap_or(("0", text));
    let [from, to] = [from, to].map(|end| quantity(end, Dimension::Pressure));
    let (from, to) = (from?, to?);
    if from < to {
        Ok([from, to])
    } else {
        Err("wanted a range whose end is above its start".into())
    }
}

pub(super) fn section(text: &str) -> Result<Cut, String> {
    match (text, text.split_once('=')) {
        ("axis", _) => Ok(Cut::Axis),
        ("peak", _) => Ok(Cut::Peak),
        (_, Some(("y", y))) => quantity(y, Dimension::Length).map(Cut::AlongX),
        (_, Some(("x", x))) => quantity(x, Dimension::Length).map(Cut::AlongY),
        _ => Err("wanted axis, peak, or a place such as y=\"5 um\" or x=0.1".into()),
    }
}

/// The parser of a colour map by its name.
pub(super) fn colour_map() -> impl TypedValueParser<Value = ColourMap> {
    let names = ColourMap::ALL.map(|(_, name, words)| PossibleValue::new(name).help(words));
    PossibleValuesParser::new(names).map(|found| {
        let named = ColourMap::ALL
            .into_iter()
            .find(|(_, name, _)| *name == found);
        named.map_or_else(ColourMap::default, |(map, ..)| map)
    })
}

pub(super) fn perturbation(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(by) if by > -1.0 && by.is_finite() => Ok(by),
        _ => Err("wanted a number above -1, such as 1e-6".into()),
    }
}

pub(super) fn length(text: &str) -> Result<f64, String> {
    let length = quantity(text, Dimension::Length)?;
    if length > 0.0 {
        Ok(length)
    } else {
        Err("wanted a length above zero".into())
    }
}

pub(super) fn hurst(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(hurst) if (0.0..=1.0).contains(&hurst) => Ok(hurst),
        _ => Err("wanted a number from 0 to 1".into()),
    }
}

pub(super) fn offset(text: &str) -> Result<[isize; 2], String> {
    let count = |text: &str| text.trim().parse().ok();
    let both = text.split_once(',');
    let both = both.and_then(|(m, n)| Some([count(m)?, count(n)?]));
    both.ok_or_else(|| "wanted two integers, such as 3,4".into())
}

pub(super) fn depth(text: &str) -> Result<f64, String> {
    let depth = quantity(text, Dimension::Length)?;
    if depth >= 0.0 {
        Ok(depth)
    } else {
        Err("wanted a depth of zero or more: the surface is at 0".into())
    }
}

pub(super) fn point(text: &str) -> Result<[f64; 3], String> {
    let parts: Vec<_> = text.split(',').collect();
    let [x, y, z] = parts[..] else {
        return Err("wanted three lengths, such as \"0,-1 um,0.5 um\"".into());
    };
    let along = |text| quantity(text, Dimension::Length);
    Ok([along(x)?, along(y)?, depth(z)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_and_sections_are_parsed_from_words_and_units() {
        assert_eq!(range("2 GPa"), Ok([0.0, 2e9]));
        assert_eq!(range("0.5 GPa:2 GPa"), Ok([0.5e9, 2e9]));
        assert_eq!(range("0.1:0.3"), Ok([0.1, 0.3]));
        assert_eq!(section("peak"), Ok(Cut::Peak));
        assert_eq!(section("y=5 um"), Ok(Cut::AlongX(5e-6)));
        assert_eq!(section("x=-0.25"), Ok(Cut::AlongY(-0.25)));
        for text in ["", "2 nm", "3:2", "1:1", "nan", "inf"] {
            assert!(range(text).is_err(), "{text}");
        }
        for text in ["", "z=1", "x=", "y=1 GPa", "top"] {
            assert!(section(text).is_err(), "{text}");
        }
    }

    #[test]
    fn invalid_wavenumbers_offsets_and_depths_are_rejected() {
        for text in ["0", "-1", "nan", "inf", "x", ""] {
            assert!(positive(text).is_err(), "{text}");
        }
        for text in ["1", "1,", "1.5,2", "1,2,3", "a,b", ""] {
            assert!(offset(text).is_err(), "{text}");
        }
        assert_eq!(offset("-1,2"), Ok([-1, 2]));
        assert_eq!(depth("0.5 um"), Ok(0.5e-6));
        for text in ["-1 nm", "1 GPa", "nan", ""] {
            assert!(depth(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_point_is_x_y_and_a_depth() {
        assert_eq!(point("0, -1 um,0.5 um"), Ok([0.0, -1e-6, 0.5e-6]));
        assert_eq!(point(" -2,3e-1,0"), Ok([-2.0, 0.3, 0.0]));
        for text in ["1,2", "1,2,3,4", "1,2,-3", "1,2 GPa,3", "a,b,c", ""] {
            assert!(point(text).is_err(), "{text}");
        }
    }
}
