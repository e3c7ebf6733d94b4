//! The area function of an indenter: coefficients, a tip, or the file of a calibration.

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::quantity;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::TomlValue;
use pellicle::input::value_reader::ValueReader;

use super::calibration_file;
use crate::indentation::{AreaFunction, Tip, TipShape, Uncertain};
use crate::measured::sources::MeasurementSources;

/// The largest number of coefficients of an area function.
pub(super) const MOST_COEFFICIENTS: usize = 9;

pub(super) const AREA: &str = "a list such as [24.5, \"120 nm\"], of a number and coefficients with units of length, length^(3/2), \
    length^(7/4), …, or the file of a calibration";

/// An area function with what a calibration tells of it.
pub(super) struct Area {
    pub(super) function: Option<AreaFunction>,
    pub(super) covariance: Vec<Vec<f64>>,
    pub(super) range: Option<[f64; 2]>,
    pub(super) frame_compliance: Option<Uncertain>,
}

impl From<AreaFunction> for Area {
    fn from(function: AreaFunction) -> Self {
        Self {
            function: Some(function),
            covariance: Vec::new(),
            range: None,
            frame_compliance: None,
        }
    }
}

/// The area function; none is needed where the instrument gives the radius of every contact.
pub(super) fn area(
    table: &TableReader<'_>,
    sources: &MeasurementSources,
    are_given: bool,
) -> Result<Area, Diagnosis> {
    match (table.optional("area_function"), table.optional("tip")) {
        (Some(_), Some(tip)) => Err(tip.diagnosis(Fault::Wrong {
            found: "tip and area_function".into(),
            wanted: "one of them".into(),
        })),
        (None, None) if are_given => Ok(Area {
            function: None,
            covariance: Vec::new(),
            range: None,
            frame_compliance: None,
        }),
        (None, None) => {
            let wanted = format!("{AREA}; or a `tip`, such as \"berkovich\", with a `tip_radius`");
            Err(table.missing("area_function", wanted))
        }
        (Some(field), None) => {
            for key in ["tip_radius", "angle"] {
                if let Some(field) = table.optional(key) {
                    return Err(field.wanted("none beside an `area_function`, which has it"));
                }
            }
            match field.value() {
                TomlValue::Text(name) => calibration_file::read(&field, name, sources),
                _ => coefficients(&field).map(|of| AreaFunction::Polynomial(of).into()),
            }
        }
        (None, Some(field)) => tip(table, &field).map(|tip| AreaFunction::Tip(tip).into()),
    }
}

/// Reads the coefficients of a polynomial, m^(2 − power).
pub(super) fn coefficients(field: &ValueReader<'_>) -> Result<Vec<f64>, Diagnosis> {
    let items = field.list(AREA)?;
    if items.len() > MOST_COEFFICIENTS {
        return Err(field.wanted(format!("at most {MOST_COEFFICIENTS} coefficients")));
    }
    let read = |(k, item): (usize, &ValueReader<'_>)| coefficient(k, item);
    items.iter().enumerate().map(read).collect()
}

/// Reads coefficient `k`, m^(2 − power).
fn coefficient(k: usize, item: &ValueReader<'_>) -> Result<f64, Diagnosis> {
    const FIRST: &str = "a positive number, 24.5 for a Berkovich pyramid";
    if let (1.., TomlValue::Text(text)) = (k, item.value()) {
        return with_unit(text, 2.0 - AreaFunction::power(k)).ok_or_else(|| {
            let unit = unit_of_coefficient(k);
            item.wanted(format!("a number with a unit such as {unit}"))
        });
    }
    let value = item.number(if k == 0 {
        FIRST
    } else {
        "a number with its unit"
    })?;
    if k == 0 && value <= 0.0 {
        return Err(item.wanted(FIRST));
    }
    if k > 0 && value != 0.0 {
        let unit = unit_of_coefficient(k);
        let unit = unit.trim_matches('"');
        return Err(item.wanted(format!("its unit, {unit}, as in \"{value} {unit}\"")));
    }
    Ok(value)
}

/// The unit of coefficient `k`, in quotes: `nm`, `nm^(3/2)`, `nm^(7/4)`.
pub(super) fn unit_of_coefficient(k: usize) -> String {
    let (above, below) = ((2_u32 << (k - 1)) - 1, 1_u32 << (k - 1));
    if below == 1 {
        "\"nm\"".into()
    } else {
        format!("\"nm^({above}/{below})\"")
    }
}

/// A number with a power of a length: `120 nm`, `-3.1 nm^(3/2)`, `5 um^1.75`.
fn with_unit(text: &str, power: f64) -> Option<f64> {
    let (number, unit) = text.trim().split_once(char::is_whitespace)?;
    let number: f64 = number
        .parse()
        .ok()
        .filter(|number: &f64| number.is_finite())?;
    let (length, written) = match unit.trim().split_once('^') {
        None => (unit.trim(), 1.0),
        Some((length, written)) => {
            let bare = written.trim().trim_start_matches('(').trim_end_matches(')');
            let value = match bare.split_once('/') {
                Some((above, below)) => {
                    above.trim().parse::<f64>().ok()? / below.trim().parse::<f64>().ok()?
                }
                None => bare.parse().ok()?,
            };
            (length.trim(), value)
        }
    };
    let length = quantity::one(length, Dimension::Length).ok()?;
    ((written - power).abs() < 1e-9).then(|| number * length.powf(power))
}

/// Description of the expected angle.
const ANGLE: &str =
    "the angle between axis and side, above 0 and below 90 deg, such as \"70.3 deg\"";

/// A shape that needs no angle, or one that does.
#[derive(Clone, Copy)]
pub(super) enum Word {
    Shape(TipShape),
    Cone,
}

/// The words of `tip`.
pub(super) const TIPS: [(&str, Word); 5] = [
    ("berkovich", Word::Shape(TipShape::Berkovich)),
    ("vickers", Word::Shape(TipShape::Vickers)),
    ("cube corner", Word::Shape(TipShape::CubeCorner)),
    ("cone", Word::Cone),
    ("sphere", Word::Shape(TipShape::Sphere)),
];

fn tip(table: &TableReader<'_>, field: &ValueReader<'_>) -> Result<Tip, Diagnosis> {
    let shape = match (field.choice(&TIPS)?, table.optional("angle")) {
        (Word::Shape(_), Some(angle)) => {
            return Err(angle.wanted("none: only a cone has an angle of its own"));
        }
        (Word::Shape(shape), None) => shape,
        (Word::Cone, _) => {
            let field = table.required("angle", ANGLE)?;
            let angle = field.quantity(Dimension::Angle, Sign::Positive)?;
            if angle >= std::f64::consts::FRAC_PI_2 {
                return Err(field.wanted(ANGLE));
            }
            TipShape::Cone(angle)
        }
    };
    let radius = match table.optional("tip_radius") {
        Some(field) => field.quantity(Dimension::Length, Sign::NotNegative)?,
        None if shape == TipShape::Sphere => {
            return Err(table.missing("tip_radius", "the radius of the ball".into()));
        }
        None => 0.0,
    };
    Ok(Tip { shape, radius })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_have_units_of_lengths_to_their_powers() {
        let close = |text, power, wanted: f64| {
            let found = with_unit(text, power).unwrap();
            assert!((found / wanted - 1.0).abs() < 1e-12, "{text}: {found}");
        };
        close("120 nm", 1.0, 120e-9);
        close("-3.1 nm^(3/2)", 1.5, -3.1 * 1e-9_f64.powf(1.5));
        close("5 um^1.75", 1.75, 5.0 * 1e-6_f64.powf(1.75));
        for wrong in ["120", "nm", "120 nm^2", "120 GPa", "1 nm^(3/0)", "inf nm"] {
            assert!(with_unit(wrong, 1.0).is_none(), "{wrong}");
        }
        assert_eq!(unit_of_coefficient(1), "\"nm\"");
        assert_eq!(unit_of_coefficient(2), "\"nm^(3/2)\"");
        assert_eq!(unit_of_coefficient(3), "\"nm^(7/4)\"");
    }
}
