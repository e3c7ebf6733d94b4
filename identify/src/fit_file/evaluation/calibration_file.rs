//! The file that a calibration writes, and another evaluation reads.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::span::Source;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree;
use pellicle::input::value_reader::ValueReader;

use super::area::{AREA, Area, coefficients, unit_of_coefficient};
use super::uncertain;
use crate::indentation::{AreaFunction, Calibration};
use crate::measured::sources::MeasurementSources;

/// The text of a calibration.
#[must_use]
pub fn text(of: &Calibration) -> String {
    let terms = of.coefficients.iter().enumerate();
    let coefficients = terms.map(|(k, c)| match k {
        0 => format!("{c:e}"),
        k => {
            let unit = unit_of_coefficient(k);
            format!("\"{c:e} {}\"", unit.trim_matches('"').replace("nm", "m"))
        }
    });
    let coefficients: Vec<String> = coefficients.collect();
    let row = |row: &Vec<f64>| {
        let cells: Vec<String> = row.iter().map(|c| format!("{c:e}")).collect();
        format!("    [{}],\n", cells.join(", "))
    };
    let rows: String = of.covariance.iter().map(row).collect();
    let [least, most] = of.depths;
    let mut text = format!(
        "# Area function of an indenter, from contacts with a body of known modulus.\n\
         area_function = [{}]\n\
         # Covariance of the coefficients, in SI units.\n\
         covariance = [\n{rows}]\n\
         # Least and largest contact depth.\n\
         depths = [\"{least:e} m\", \"{most:e} m\"]\n",
        coefficients.join(", ")
    );
    let frame = of.frame_compliance;
    let _ = writeln!(
        text,
        "frame_compliance = {{ mean = \"{:e} m/N\", sd = \"{:e} m/N\" }}",
        frame.value, frame.sd
    );
    text
}

/// Reads the file that a calibration has written.
pub(super) fn read(
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
    let bytes = sources.read(&path(sources, name));
    let bytes = bytes.map_err(|error| refused(format!("cannot be read: {error}")))?;
    let text =
        String::from_utf8(bytes.into_owned()).map_err(|_| refused("is not a text".into()))?;
    let source = Arc::new(Source::new(name, text));
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

/// The path under which a name is read.
fn path(sources: &MeasurementSources, name: &str) -> PathBuf {
    let first = sources.of(name).into_iter().next();
    first.unwrap_or_else(|| Path::new(name).to_owned())
}
