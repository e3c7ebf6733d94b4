//! `[evaluation]` of a fit file: how unloadings are evaluated by Oliver and Pharr.

use std::path::Path;
use std::sync::Arc;

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::quantity;
use pellicle::input::span::Source;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::{self, TomlValue};
use pellicle::input::value_reader::ValueReader;

use crate::indentation::{
    AreaFunction, DepthZero, Drift, Epsilon, EvaluationSettings, IndenterMaterial, Tip, TipShape,
    Uncertain,
};
use crate::measured::channel::Channel;
use crate::measured::data_table::DataTable;
use crate::measured::sources::MeasurementSources;

/// The largest number of coefficients of an area function.
const MOST_COEFFICIENTS: usize = 9;
/// Young's modulus (Pa) and Poisson's ratio of diamond, by default the indenter: ISO 14577-1.
const DIAMOND: [f64; 2] = [1141e9, 0.07];
/// ε by default, that of a paraboloid.
const EPSILON: f64 = 0.75;

const AREA: &str = "a list such as [24.5, \"120 nm\"], of a number and coefficients with units of length, length^(3/2), \
    length^(7/4), …, or the file of a calibration";

/// Reads the table for these measurements; files of calibrations come from `sources`.
///
/// # Errors
///
/// A [`Diagnosis`] of the first fault.
pub fn read(
    field: &ValueReader<'_>,
    sources: &MeasurementSources,
    data: &[DataTable],
) -> Result<EvaluationSettings, Diagnosis> {
    let table = field.clone().table()?;
    table.only(&[
        "area_function",
        "tip",
        "tip_radius",
        "angle",
        "beta",
        "epsilon",
        "unloading",
        "frame_compliance",
        "drift",
        "depth_zero",
        "poisson_ratio",
        "indenter",
        "thinning",
    ])?;
    let mut unloadings = data.iter().filter(|table| table.is_unloading());
    let are_given = unloadings.all(|table| table.columns.has(Channel::ContactRadius));
    let area = area(&table, sources, are_given)?;
    let frame = match table.optional("frame_compliance") {
        Some(field) => uncertain(&field, Some(Dimension::FrameCompliance), Sign::NotNegative)?,
        None => area.frame_compliance.unwrap_or_default(),
    };
    let number = |key, default| {
        let field = table.optional(key);
        field.map_or(Ok(Uncertain::exact(default)), |field| {
            uncertain(&field, None, Sign::Positive)
        })
    };
    let ratio = table.required("poisson_ratio", "Poisson's ratio of the body, such as 0.17")?;
    Ok(EvaluationSettings {
        area: area.function,
        area_covariance: area.covariance,
        area_range: area.range,
        beta: number("beta", 1.0)?,
        epsilon: match table.optional("epsilon") {
            Some(field) if field.text().is_ok_and(|text| text == "exponent") => Epsilon::Exponent,
            _ => Epsilon::Fixed(number("epsilon", EPSILON)?),
        },
        unloading: part(&table)?,
        frame_compliance: frame,
        drift: drift(&table)?,
        depth_zero: depth_zero(&table)?,
        poisson_ratio: poisson_ratio(&ratio)?,
        indenter: indenter(&table)?,
        thinning: thinning(&table)?,
    })
}

/// An area function with what a calibration tells of it.
struct Area {
    function: Option<AreaFunction>,
    covariance: Vec<Vec<f64>>,
    range: Option<[f64; 2]>,
    frame_compliance: Option<Uncertain>,
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
fn area(
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
                TomlValue::Text(name) => of_file(&field, name, sources),
                _ => coefficients(&field).map(|of| AreaFunction::Polynomial(of).into()),
            }
        }
        (None, Some(field)) => tip(table, &field).map(|tip| AreaFunction::Tip(tip).into()),
    }
}

/// Reads the coefficients of a polynomial, m^(2 − power).
fn coefficients(field: &ValueReader<'_>) -> Result<Vec<f64>, Diagnosis> {
    let items = field.list(AREA)?;
    if items.len() > MOST_COEFFICIENTS {
        return Err(field.wanted(format!("at most {MOST_COEFFICIENTS} coefficients")));
    }
    let read = |(k, item): (usize, &ValueReader<'_>)| match item.value() {
        TomlValue::Text(text) => with_unit(text, 2.0 - AreaFunction::power(k)).ok_or_else(|| {
            item.wanted(format!(
                "a number with a unit such as {}",
                unit_of_coefficient(k)
            ))
        }),
        _ => {
            let value = item.number("a finite number")?;
            if k == 0 && value <= 0.0 {
                return Err(item.wanted("a positive number, 24.5 for a Berkovich pyramid"));
            }
            if k > 0 && value != 0.0 {
                return Err(item.wanted(format!(
                    "its unit, {}, as in \"{value} {0}\"",
                    unit_of_coefficient(k).trim_matches('"')
                )));
            }
            Ok(value)
        }
    };
    items.iter().enumerate().map(read).collect()
}

/// The unit of coefficient `k`, in quotes: `nm`, `nm^(3/2)`, `nm^(7/4)`.
fn unit_of_coefficient(k: usize) -> String {
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

/// Reads the file that a calibration has written.
fn of_file(
    field: &ValueReader<'_>,
    name: &str,
    sources: &MeasurementSources,
) -> Result<Area, Diagnosis> {
    #[derive(Debug, thiserror::Error)]
    #[error("{name}: {reason}")]
    struct NoCalibration {
        name: String,
        reason: String,
    }
    let refused = |reason: String| {
        let name = name.to_owned();
        field.refused(&NoCalibration { name, reason })
    };
    let bytes = sources.read(&sources.path(name));
    let bytes = bytes.map_err(|error| refused(format!("cannot be read: {error}")))?;
    let text =
        String::from_utf8(bytes.into_owned()).map_err(|_| refused("is not a text".into()))?;
    let source = Arc::new(Source::new(name.to_owned(), text));
    let read = || -> Result<Area, Diagnosis> {
        let root = toml_tree::parse(&source)?;
        let table = TableReader::root(&root)?;
        let function = coefficients(&table.required("area_function", AREA)?)?;
        let rows = table.required("covariance", "the covariance of the coefficients, SI")?;
        let number = |of: &ValueReader<'_>| of.number("a finite number");
        let row = |of: &ValueReader<'_>| of.items("a row")?.iter().map(number).collect();
        let covariance: Vec<Vec<f64>> = rows
            .items("rows of numbers")?
            .iter()
            .map(row)
            .collect::<Result<_, _>>()?;
        if covariance.iter().any(|row| row.len() != covariance.len())
            || covariance.len() != function.len()
        {
            return Err(rows.wanted("as many rows and columns as coefficients"));
        }
        let depths = table.required("depths", "the least and the largest contact depth")?;
        let length = |of: &ValueReader<'_>| of.quantity(Dimension::Length, Sign::Positive);
        let depths: Vec<f64> = depths
            .items("two depths")?
            .iter()
            .map(length)
            .collect::<Result<_, _>>()?;
        let frame = table.optional("frame_compliance");
        let frame =
            frame.map(|of| uncertain(&of, Some(Dimension::FrameCompliance), Sign::NotNegative));
        Ok(Area {
            function: Some(AreaFunction::Polynomial(function)),
            covariance,
            range: match depths[..] {
                [least, most] => Some([least, most]),
                _ => None,
            },
            frame_compliance: frame.transpose()?,
        })
    };
    read().map_err(|diagnosis| refused(diagnosis.to_string()))
}

fn tip(table: &TableReader<'_>, field: &ValueReader<'_>) -> Result<Tip, Diagnosis> {
    /// A shape that needs no angle, or one that does.
    #[derive(Clone, Copy)]
    enum Word {
        Shape(TipShape),
        Cone,
    }
    let word = field.choice(&[
        ("berkovich", Word::Shape(TipShape::Berkovich)),
        ("vickers", Word::Shape(TipShape::Vickers)),
        ("cube corner", Word::Shape(TipShape::CubeCorner)),
        ("cone", Word::Cone),
        ("sphere", Word::Shape(TipShape::Sphere)),
    ])?;
    const ANGLE: &str =
        "the angle between axis and side, above 0 and below 90 deg, such as \"70.3 deg\"";
    let shape = match (word, table.optional("angle")) {
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

/// Reads a value, or its mean and standard deviation.
fn uncertain(
    field: &ValueReader<'_>,
    dimension: Option<Dimension>,
    sign: Sign,
) -> Result<Uncertain, Diagnosis> {
    let value = |field: &ValueReader<'_>, sign: Sign| match dimension {
        Some(dimension) => field.quantity(dimension, sign),
        None => {
            let value = field.number("a number")?;
            if sign.allows(value) {
                Ok(value)
            } else {
                Err(field.wanted("a positive number"))
            }
        }
    };
    if !field.is_table() {
        return value(field, sign).map(Uncertain::exact);
    }
    let table = field.clone().table()?;
    table.only(&["mean", "sd"])?;
    Ok(Uncertain {
        value: value(&table.required("mean", "the mean")?, sign)?,
        sd: value(
            &table.required("sd", "the standard uncertainty")?,
            Sign::NotNegative,
        )?,
    })
}

fn part(table: &TableReader<'_>) -> Result<[f64; 2], Diagnosis> {
    const WANTED: &str =
        "the upper and the lower end, as parts of the largest force, such as [0.95, 0.40]";
    let Some(field) = table.optional("unloading") else {
        return Ok([0.95, 0.40]);
    };
    let ends = field.items(WANTED)?;
    let ends: Vec<f64> = ends
        .iter()
        .map(|end| end.number(WANTED))
        .collect::<Result<_, _>>()?;
    match ends[..] {
        [high, low] if high <= 1.0 && low > 0.0 && low < high => Ok([high, low]),
        _ => Err(field.wanted(WANTED)),
    }
}

fn drift(table: &TableReader<'_>) -> Result<Drift, Diagnosis> {
    let Some(field) = table.optional("drift") else {
        return Ok(Drift::OfHoldIfFound);
    };
    match field.value() {
        TomlValue::Text(text) if text == "hold" => Ok(Drift::Hold),
        TomlValue::Text(text) if text == "off" => Ok(Drift::Off),
        TomlValue::Text(text) if quantity::dimension_of(text) != Some(Dimension::Speed) => {
            Err(field.wanted("\"hold\", \"off\" or a rate such as \"0.02 nm/s\""))
        }
        _ => uncertain(&field, Some(Dimension::Speed), Sign::Any).map(Drift::Rate),
    }
}

fn depth_zero(table: &TableReader<'_>) -> Result<DepthZero, Diagnosis> {
    let Some(field) = table.optional("depth_zero") else {
        return Ok(DepthZero::FirstContactIfFound);
    };
    match field.value() {
        TomlValue::Text(text) if text == "first contact" => Ok(DepthZero::FirstContact),
        TomlValue::Text(text) if text == "as recorded" => Ok(DepthZero::AsRecorded),
        TomlValue::Text(text) if quantity::dimension_of(text) != Some(Dimension::Length) => {
            Err(field.wanted(
                "\"first contact\", \"as recorded\" or a depth of the file such as \"3 nm\"",
            ))
        }
        _ => uncertain(&field, Some(Dimension::Length), Sign::Any).map(DepthZero::At),
    }
}

/// The part of the contact depth by which an imprint thins the top layer.
fn thinning(table: &TableReader<'_>) -> Result<f64, Diagnosis> {
    const WANTED: &str = "a part of the contact depth between 0 and 1, such as 0.5";
    let Some(field) = table.optional("thinning") else {
        return Ok(0.0);
    };
    let part = field.number(WANTED)?;
    if (0.0..=1.0).contains(&part) {
        Ok(part)
    } else {
        Err(field.wanted(WANTED))
    }
}

/// Poisson's ratio, with its uncertainty.
fn poisson_ratio(field: &ValueReader<'_>) -> Result<Uncertain, Diagnosis> {
    let ratio = uncertain(field, None, Sign::NotNegative)?;
    if ratio.value > 0.5 {
        return Err(field.wanted("a number in [0, 0.5]"));
    }
    Ok(ratio)
}

fn indenter(table: &TableReader<'_>) -> Result<Option<IndenterMaterial>, Diagnosis> {
    let [modulus, ratio] = DIAMOND.map(Uncertain::exact);
    let Some(field) = table.optional("indenter") else {
        return Ok(Some(IndenterMaterial {
            young_modulus: modulus,
            poisson_ratio: ratio,
        }));
    };
    if field.text().is_ok_and(|text| text == "rigid") {
        return Ok(None);
    }
    if !field.is_table() {
        return Err(field.wanted(
            "\"rigid\" or a table { young_modulus = \"1141 GPa\", poisson_ratio = 0.07 }",
        ));
    }
    let of = field.clone().table()?;
    of.only(&["young_modulus", "poisson_ratio"])?;
    let modulus = of.required("young_modulus", "that of the tip, 1141 GPa of diamond")?;
    let ratio = of.required("poisson_ratio", "that of the tip, 0.07 of diamond")?;
    Ok(Some(IndenterMaterial {
        young_modulus: uncertain(&modulus, Some(Dimension::Pressure), Sign::Positive)?,
        poisson_ratio: poisson_ratio(&ratio)?,
    }))
}

/// The path of a folder's file; of a name that a caller gave, the name.
impl MeasurementSources {
    /// The path under which a name is read.
    fn path(&self, name: &str) -> std::path::PathBuf {
        let found = self.of(name);
        let first = found.into_iter().next();
        first.unwrap_or_else(|| Path::new(name).to_owned())
    }
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
