//! `fields-NNN.nc`: the fields of one loading step in the layout of contact.engineering's results.
//!
//! Dimensions `x` and `y`; variables `pressure`, `contacting_points`, `gap`, `displacement` over `(x, y)`, and beside
//! them the coordinates, `shortening`, `profile`, `mask` and `contact`, which are the same in every format; global
//! attributes `total_contact_area`, the part of the domain in contact, and `type` with the meaning they have there.
//! `mean_pressure` is that of the summary, force over contact area; what it is there, force over the whole domain, is
//! `nominal_pressure`. The file is of the classic format with 64-bit offsets: a header of big-endian numbers and padded
//! names, then the variables one after the other.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use super::fields::{Fields, TruthField};
use super::file::write_stoppable;
use super::summary::Summary;
use crate::failure::Failure;

/// Numbers of the format that say what follows.
const DIMENSIONS: u32 = 10;
const VARIABLES: u32 = 11;
const ATTRIBUTES: u32 = 12;

/// Numbers of the format for the types of values.
const BYTE: u32 = 1;
const CHAR: u32 = 2;
const DOUBLE: u32 = 6;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("fields-{step:03}.nc")
}

/// A named value beside the fields.
enum Attribute {
    Text(&'static str, String),
    Number(&'static str, f64),
}

/// The values of a variable.
#[derive(Clone)]
enum VariableValues<'a> {
    /// Along x or y: the coordinate, whose dimension has this number.
    Centres(u32),
    /// Over the grid.
    Numbers(&'a [f64]),
    /// Over the grid.
    Truths(Cow<'a, [bool]>),
}

/// One variable.
struct Variable<'a> {
    name: &'static str,
    attributes: Vec<Attribute>,
    values: VariableValues<'a>,
}

/// Writes the fields of a step.
///
/// # Errors
///
/// [`Failure::Write`] if the file cannot be written.
pub fn write(
    path: &Path,
    fields: &Fields<'_>,
    summary: &Summary,
    step: usize,
) -> Result<(), Failure> {
    let variables = variables(fields, summary);
    let attributes = global_attributes(fields, summary, step);
    write_stoppable(path, |file| {
        // The offsets are known once the length of the header is: it does not depend on them.
        let length = header(fields.size, &attributes, &variables, 0)?.len();
        file.write_all(&header(fields.size, &attributes, &variables, length)?)?;
        for variable in &variables {
            write_values(file, fields, &variable.values)?;
        }
        Ok(())
    })
}

fn variables<'a>(fields: &Fields<'a>, summary: &Summary) -> Vec<Variable<'a>> {
    let described = |unit, meaning: &str| {
        let unit = Attribute::Text("units", summary.units.name(unit).to_owned());
        vec![unit, Attribute::Text("long_name", meaning.to_owned())]
    };
    let coordinate = |name, dimension| Variable {
        name,
        attributes: described("m", "centre of the element"),
        values: VariableValues::Centres(dimension),
    };
    let mut variables = vec![coordinate("x", 0), coordinate("y", 1)];
    variables.extend(fields.numbers().map(|field| Variable {
        name: field.name,
        attributes: described(field.unit, field.meaning),
        values: VariableValues::Numbers(field.values),
    }));
    let [mask, contact] = fields.truths();
    let contacting_points = TruthField {
        name: "contacting_points",
        ..contact.clone()
    };
    variables.extend([contacting_points, mask, contact].map(|truth| Variable {
        name: truth.name,
        // By this attribute xarray knows a truth value, for which the format has no type.
        attributes: vec![
            Attribute::Text("dtype", "bool".into()),
            Attribute::Text("long_name", truth.meaning.to_owned()),
        ],
        values: VariableValues::Truths(truth.values),
    }));
    variables
}

fn global_attributes(fields: &Fields<'_>, summary: &Summary, step: usize) -> Vec<Attribute> {
    let area = fields.side.powi(2);
    let (length, force) = (summary.units.name("m"), summary.units.name("N"));
    let of_step = &summary.steps[step];
    vec![
        Attribute::Text("title", summary.title.clone()),
        Attribute::Text("source", format!("pellicle {}", summary.version)),
        Attribute::Text("type", "nonperiodic".into()),
        Attribute::Number("mean_pressure", of_step.mean_pressure),
        Attribute::Number("nominal_pressure", of_step.force / area),
        Attribute::Number("total_contact_area", of_step.contact_area / area),
        Attribute::Number("force", of_step.force),
        Attribute::Text("force_units", force.to_owned()),
        Attribute::Number("penetration", of_step.penetration),
        Attribute::Text("penetration_units", length.to_owned()),
        Attribute::Text(
            "certificate_satisfied",
            of_step.certificate.satisfied.to_string(),
        ),
    ]
}

impl VariableValues<'_> {
    fn kind(&self) -> u32 {
        match self {
            Self::Centres(_) | Self::Numbers(_) => DOUBLE,
            Self::Truths(_) => BYTE,
        }
    }

    /// The numbers of its dimensions.
    fn dimensions(&self) -> Vec<u32> {
        match self {
            Self::Centres(dimension) => vec![*dimension],
            Self::Numbers(_) | Self::Truths(_) => vec![0, 1],
        }
    }

    /// Bytes in the file, padding included.
    fn bytes(&self, size: usize) -> usize {
        match self {
            Self::Centres(_) => size_of::<f64>() * size,
            Self::Numbers(_) => size_of::<f64>() * size * size,
            Self::Truths(_) => (size * size).next_multiple_of(4),
        }
    }
}

/// The header of a file whose first variable begins at byte `start`.
fn header(
    size: usize,
    attributes: &[Attribute],
    variables: &[Variable<'_>],
    start: usize,
) -> io::Result<Vec<u8>> {
    let mut header = b"CDF\x02".to_vec();
    // No records.
    push_count(&mut header, 0)?;
    push_u32(&mut header, DIMENSIONS);
    push_count(&mut header, 2)?;
    for name in ["x", "y"] {
        push_text(&mut header, name)?;
        push_count(&mut header, size)?;
    }
    push_attributes(&mut header, attributes)?;
    push_u32(&mut header, VARIABLES);
    push_count(&mut header, variables.len())?;
    let mut begin = start;
    for variable in variables {
        push_variable(&mut header, variable, size, begin)?;
        begin += variable.values.bytes(size);
    }
    Ok(header)
}

fn push_variable(
    header: &mut Vec<u8>,
    variable: &Variable<'_>,
    size: usize,
    begin: usize,
) -> io::Result<()> {
    let dimensions = variable.values.dimensions();
    push_text(header, variable.name)?;
    push_count(header, dimensions.len())?;
    dimensions
        .into_iter()
        .for_each(|dimension| push_u32(header, dimension));
    push_attributes(header, &variable.attributes)?;
    push_u32(header, variable.values.kind());
    push_count(header, variable.values.bytes(size))?;
    header.extend((begin as u64).to_be_bytes());
    Ok(())
}

fn push_attributes(header: &mut Vec<u8>, attributes: &[Attribute]) -> io::Result<()> {
    push_u32(header, ATTRIBUTES);
    push_count(header, attributes.len())?;
    for attribute in attributes {
        match attribute {
            Attribute::Text(name, text) => {
                push_text(header, name)?;
                push_u32(header, CHAR);
                push_text(header, text)?;
            }
            Attribute::Number(name, number) => {
                push_text(header, name)?;
                push_u32(header, DOUBLE);
                push_count(header, 1)?;
                header.extend(number.to_be_bytes());
            }
        }
    }
    Ok(())
}

/// The length in bytes, the bytes, and zeros up to a multiple of four.
fn push_text(header: &mut Vec<u8>, text: &str) -> io::Result<()> {
    push_count(header, text.len())?;
    header.extend(text.as_bytes());
    header.resize(header.len().next_multiple_of(4), 0);
    Ok(())
}

fn push_u32(header: &mut Vec<u8>, number: u32) {
    header.extend(number.to_be_bytes());
}

fn push_count(header: &mut Vec<u8>, count: usize) -> io::Result<()> {
    let count = u32::try_from(count).map_err(io::Error::other)?;
    push_u32(header, count);
    Ok(())
}

fn write_values(
    file: &mut impl Write,
    fields: &Fields<'_>,
    values: &VariableValues<'_>,
) -> io::Result<()> {
    match values {
        VariableValues::Centres(_) => {
            (0..fields.size).try_for_each(|i| file.write_all(&fields.centre(i).to_be_bytes()))
        }
        VariableValues::Numbers(numbers) => numbers
            .iter()
            .try_for_each(|number| file.write_all(&number.to_be_bytes())),
        VariableValues::Truths(truths) => {
            let padding = truths.len().next_multiple_of(4) - truths.len();
            let bytes = truths.iter().map(|truth| u8::from(*truth));
            let bytes: Vec<u8> = bytes.chain(std::iter::repeat_n(0, padding)).collect();
            file.write_all(&bytes)
        }
    }
}
