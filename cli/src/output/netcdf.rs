//! `fields-NNN.nc`: the fields of one loading step in the layout of contact.engineering's results.
//!
//! Dimensions `x` and `y`; variables `pressure`, `contacting_points`, `gap`, `displacement` over `(x, y)`, in addition
//! the coordinates, `shortening`, `profile`, `mask` and `contact`, which are the same in every format; global
//! attributes `total_contact_area`, the part of the domain in contact, and `type` with the meaning they have there.
//! `mean_pressure` is that of the summary, force over contact area; its meaning there, force over the whole domain, is
//! here `nominal_pressure`. The file has the classic format with 64-bit offsets, described in its
//! [header](pellicle_files::netcdf).

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use pellicle::result::fields::{Fields, TRUTHS};
use pellicle::summary::RunSummary;
use pellicle_files::netcdf::{Attribute, Header, Kind, Variable};

use super::large_file::write_stoppable;
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("fields-{step:03}.nc")
}

/// The values of a variable.
#[derive(Clone)]
enum VariableValues<'a> {
    /// Along x or y: the coordinate, whose dimension has this number.
    Centres(usize),
    /// Over the grid.
    Numbers(&'a [f64]),
    /// Over the grid.
    Truths(Cow<'a, [bool]>),
}

/// One variable with its values.
struct FilledVariable<'a> {
    name: &'static str,
    attributes: Vec<Attribute>,
    values: VariableValues<'a>,
}

/// Writes the fields of a step.
///
/// # Errors
///
/// [`Failure::File`] if the file cannot be written.
pub fn write(
    path: &Path,
    fields: &Fields<'_>,
    summary: &RunSummary,
    step: usize,
) -> Result<(), Failure> {
    let variables = variables(fields, summary);
    let attributes = global_attributes(fields, summary, step);
    write_stoppable(path, |file| {
        file.write_all(&header(fields.lengths(), attributes, &variables).bytes()?)?;
        for variable in &variables {
            write_values(file, fields, &variable.values)?;
        }
        Ok(())
    })
}

fn variables<'a>(fields: &Fields<'a>, summary: &RunSummary) -> Vec<FilledVariable<'a>> {
    let described = |unit, meaning: &str| {
        let unit = Attribute::Text("units", summary.units.name(unit).to_owned());
        vec![unit, Attribute::Text("long_name", meaning.to_owned())]
    };
    let coordinate = |name, dimension| FilledVariable {
        name,
        attributes: described("m", "centre of the element"),
        values: VariableValues::Centres(dimension),
    };
    let mut variables = vec![coordinate("x", 0), coordinate("y", 1)];
    variables.extend(fields.numbers().map(|(field, values)| FilledVariable {
        name: field.name,
        attributes: described(field.unit, field.meaning),
        values: VariableValues::Numbers(values),
    }));
    // The contact under the name that it has there, too.
    let contacting_points = TRUTHS.iter().filter(|truth| truth.name == "contact");
    let contacting_points = contacting_points.map(|contact| ("contacting_points", contact));
    let truths = TRUTHS.iter().map(|truth| (truth.name, truth));
    variables.extend(
        contacting_points
            .chain(truths)
            .map(|(name, truth)| FilledVariable {
                name,
                // xarray recognises a truth value, for which the format has no type, by this attribute.
                attributes: vec![
                    Attribute::Text("dtype", "bool".into()),
                    Attribute::Text("long_name", truth.meaning.to_owned()),
                ],
                values: VariableValues::Truths(truth.of(fields)),
            }),
    );
    variables
}

fn global_attributes(fields: &Fields<'_>, summary: &RunSummary, step: usize) -> Vec<Attribute> {
    let area = fields.area();
    let (length, force) = (summary.units.name("m"), summary.units.name("N"));
    let of_step = &summary.steps[step];
    vec![
        Attribute::Text("title", summary.title.clone()),
        Attribute::Text("source", format!("pellicle {}", summary.version)),
        Attribute::Text("type", "nonperiodic".into()),
        Attribute::Number("mean_pressure", of_step.summary.mean_pressure),
        Attribute::Number("nominal_pressure", of_step.force / area),
        Attribute::Number("total_contact_area", of_step.summary.contact_area / area),
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

impl FilledVariable<'_> {
    /// The variable without its values.
    fn head(&self) -> Variable {
        let (kind, dimensions) = match &self.values {
            VariableValues::Centres(dimension) => (Kind::Double, vec![*dimension]),
            VariableValues::Numbers(_) => (Kind::Double, vec![0, 1]),
            VariableValues::Truths(_) => (Kind::Byte, vec![0, 1]),
        };
        Variable {
            name: self.name,
            dimensions,
            attributes: self.attributes.clone(),
            kind,
        }
    }
}

fn header(
    [along_x, along_y]: [usize; 2],
    attributes: Vec<Attribute>,
    variables: &[FilledVariable<'_>],
) -> Header {
    Header {
        records: 0,
        dimensions: vec![("x", along_x), ("y", along_y)],
        attributes,
        variables: variables.iter().map(FilledVariable::head).collect(),
    }
}

fn write_values(
    file: &mut impl Write,
    fields: &Fields<'_>,
    values: &VariableValues<'_>,
) -> io::Result<()> {
    match values {
        VariableValues::Centres(axis) => (0..fields.lengths()[*axis]).try_for_each(|i| {
            let centre = fields.centre_along(*axis, i);
            file.write_all(&centre.to_be_bytes())
        }),
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
