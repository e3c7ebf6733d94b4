//! `[evaluation]` of a fit file: how unloadings are evaluated by Oliver and Pharr.

mod area;
pub mod calibration_file;
mod shape;

use std::ops::RangeInclusive;

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::quantity;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::TomlValue;
use pellicle::input::value_reader::ValueReader;

use self::area::area;
pub use self::shape::shape;
use self::shape::{known_body, material, uncertain_shape};
use crate::indentation::{
    DepthZero, Drift, Epsilon, EvaluationSettings, IndenterMaterial, KnownBody, Uncertain,
};
use crate::measured::channel::Channel;
use crate::measured::data_table::DataTable;
use crate::measured::sources::MeasurementSources;

/// Young's modulus (Pa) and Poisson's ratio of diamond, by default the indenter: ISO 14577-1.
const DIAMOND: [f64; 2] = [1141e9, 0.07];
/// Number of coefficients of a calibration by default.
const COEFFICIENTS: usize = 3;
/// ε by default, that of a paraboloid.
const EPSILON: f64 = 0.75;
/// β is 1 to 1.2 for the tips in use, ε 0.72 of a cone to 1 of a flat punch; what lies outside these is no such factor.
const BETAS: RangeInclusive<f64> = 0.5..=2.0;
const EPSILONS: RangeInclusive<f64> = 0.5..=1.2;

/// The words for where the drift comes from.
const DRIFTS: [&str; 2] = ["hold", "off"];
/// The words for the zero of the depth.
const DEPTH_ZEROS: [&str; 2] = ["first contact", "as recorded"];

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
    table.only(&shape().keys())?;
    let mut unloadings = data.iter().filter(|table| table.is_unloading());
    let are_given = unloadings.all(|table| table.columns.has(Channel::ContactRadius));
    let calibrate = calibrate(&table)?;
    let area = area(&table, sources, are_given || calibrate.is_some())?;
    let frame = match table.optional("frame_compliance") {
        Some(field) => uncertain(&field, Some(Dimension::FrameCompliance), Sign::NotNegative)?,
        None => area.frame_compliance.unwrap_or_default(),
    };
    let factor = |key, default, range: RangeInclusive<f64>| {
        let Some(field) = table.optional(key) else {
            return Ok(Uncertain::exact(default));
        };
        let found = uncertain(&field, None, Sign::Positive)?;
        if range.contains(&found.value) {
            return Ok(found);
        }
        let (least, most) = range.into_inner();
        Err(field.wanted(format!(
            "a factor from {least} to {most}, such as {default}"
        )))
    };
    let ratio = table.required("poisson_ratio", "Poisson's ratio of the body, such as 0.17")?;
    Ok(EvaluationSettings {
        area: area.function,
        area_covariance: area.covariance,
        area_range: area.range,
        beta: factor("beta", 1.0, BETAS)?,
        epsilon: match table.optional("epsilon") {
            Some(field) if field.text().is_ok_and(|text| text == "exponent") => Epsilon::Exponent,
            _ => Epsilon::Fixed(factor("epsilon", EPSILON, EPSILONS)?),
        },
        unloading: part(&table)?,
        frame_compliance: frame,
        drift: drift(&table)?,
        depth_zero: depth_zero(&table)?,
        poisson_ratio: poisson_ratio(&ratio)?,
        indenter: indenter(&table)?,
        thinning: thinning(&table)?,
        calibrate,
    })
}

/// Reads a value, or its mean and standard deviation.
fn uncertain(
    field: &ValueReader<'_>,
    dimension: Option<Dimension>,
    sign: Sign,
) -> Result<Uncertain, Diagnosis> {
    let value = |field: &ValueReader<'_>, sign: Sign| {
        if let Some(dimension) = dimension {
            return field.quantity(dimension, sign);
        }
        let value = field.number("a number")?;
        if sign.allows(value) {
            Ok(value)
        } else {
            Err(field.wanted("a positive number"))
        }
    };
    if !field.is_table() {
        return value(field, sign).map(Uncertain::exact);
    }
    let table = field.clone().table()?;
    table.only(&uncertain_shape(dimension).keys())?;
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
        TomlValue::Text(text) if text == DRIFTS[0] => Ok(Drift::Hold),
        TomlValue::Text(text) if text == DRIFTS[1] => Ok(Drift::Off),
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
        TomlValue::Text(text) if text == DEPTH_ZEROS[0] => Ok(DepthZero::FirstContact),
        TomlValue::Text(text) if text == DEPTH_ZEROS[1] => Ok(DepthZero::AsRecorded),
        TomlValue::Text(text) if quantity::dimension_of(text) != Some(Dimension::Length) => {
            Err(field.wanted(
                "\"first contact\", \"as recorded\" or a depth of the file such as \"3 nm\"",
            ))
        }
        _ => uncertain(&field, Some(Dimension::Length), Sign::Any).map(DepthZero::At),
    }
}

/// The known body of a calibration, whose frame is sought unless it is given.
fn calibrate(table: &TableReader<'_>) -> Result<Option<KnownBody>, Diagnosis> {
    let Some(field) = table.optional("calibrate") else {
        return Ok(None);
    };
    for key in ["area_function", "tip"] {
        if let Some(given) = table.optional(key) {
            return Err(given.wanted("none beside `calibrate`, which finds the area function"));
        }
    }
    let of = field.clone().table()?;
    of.only(&known_body().keys())?;
    let coefficients = of.optional("coefficients").map(|field| {
        let range = 1..=area::MOST_COEFFICIENTS;
        field.count(range, ", the coefficients of the area function")
    });
    Ok(Some(KnownBody {
        young_modulus: of.positive("young_modulus", Dimension::Pressure)?,
        coefficients: coefficients.transpose()?.unwrap_or(COEFFICIENTS),
        seeks_frame: table.optional("frame_compliance").is_none(),
    }))
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
    of.only(&material().keys())?;
    let modulus = of.required("young_modulus", "that of the tip, 1141 GPa of diamond")?;
    let ratio = of.required("poisson_ratio", "that of the tip, 0.07 of diamond")?;
    Ok(Some(IndenterMaterial {
        young_modulus: uncertain(&modulus, Some(Dimension::Pressure), Sign::Positive)?,
        poisson_ratio: poisson_ratio(&ratio)?,
    }))
}
