//! `stress-NNN.nc`: the stresses as NetCDF-3, in double precision.
//!
//! Dimensions `z`, `x` and `y`; variables `z`, the depth of a plane, `body`, the body in which it lies, and the fields
//! over `(z, x, y)`. `z` is the record dimension: the planes follow one another, and a file may have any size.

use std::io::{self, Write};
use std::path::Path;

use pellicle_files::netcdf::{Attribute, Header, Kind, RECORDS, Variable};

use super::super::large_file::LongFile;
use super::plane_values::{FIELDS, PlaneValues, StressFile, StressHead};
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("stress-{step:03}.nc")
}

/// A file being written.
pub struct StressNetcdf {
    file: LongFile,
    /// Depth and body of each plane.
    planes: Vec<(f64, i32)>,
}

impl StressNetcdf {
    /// Writes everything before the first plane.
    pub fn begin(folder: &Path, head: &StressHead<'_>) -> Result<Self, Failure> {
        let mut file = LongFile::begin(&folder.join(file(head.step)))?;
        let planes = head.planes.iter().map(|plane| {
            let body = i32::try_from(plane.body).unwrap_or(i32::MAX);
            (plane.depth.z, body)
        });
        file.append(|file| {
            file.write_all(&header(head).bytes()?)?;
            // Along x and along y.
            write_numbers(file, head.centres)?;
            write_numbers(file, head.centres)
        })?;
        Ok(Self {
            file,
            planes: planes.collect(),
        })
    }
}

impl StressFile for StressNetcdf {
    fn add(&mut self, plane: usize, values: &PlaneValues) -> Result<(), Failure> {
        let (depth, body) = self.planes[plane];
        self.file.append(|file| {
            file.write_all(&depth.to_be_bytes())?;
            file.write_all(&body.to_be_bytes())?;
            values.fields.iter().try_for_each(|field| {
                let mut rows = field.chunks(values.size);
                rows.try_for_each(|row| write_numbers(file, row))
            })
        })
    }

    fn finish(self: Box<Self>) -> Result<(), Failure> {
        self.file.finish()
    }
}

fn header(head: &StressHead<'_>) -> Header {
    let size = head.centres.len();
    let units = head.summary.units;
    let variable = |name, dimensions: &[usize], kind, unit: Option<&'static str>, meaning: &str| {
        let unit = unit.map(|unit| Attribute::Text("units", units.name(unit).to_owned()));
        let meaning = Attribute::Text("long_name", meaning.to_owned());
        Variable {
            name,
            dimensions: dimensions.to_vec(),
            attributes: unit.into_iter().chain([meaning]).collect(),
            kind,
        }
    };
    let coordinate =
        |name, dimension, meaning| variable(name, &[dimension], Kind::Double, Some("m"), meaning);
    let bodies = format!("body of the plane: {}", numbered(&head.bodies));
    let mut variables = vec![
        coordinate("x", 1, "centre of the element"),
        coordinate("y", 2, "centre of the element"),
        coordinate(
            "z",
            0,
            "depth below the surface; of an interface twice, above it and below",
        ),
        variable("body", &[0], Kind::Integer, None, &bodies),
    ];
    variables.extend(FIELDS.map(|field| {
        let unit = Some(field.unit);
        variable(field.name, &[0, 1, 2], Kind::Double, unit, field.meaning)
    }));
    Header {
        records: head.planes.len(),
        dimensions: vec![("z", RECORDS), ("x", size), ("y", size)],
        attributes: attributes(head),
        variables,
    }
}

/// `0 is layer[0], 1 is substrate`
fn numbered(bodies: &[String]) -> String {
    let named = bodies.iter().enumerate();
    let named: Vec<_> = named.map(|(i, name)| format!("{i} is {name}")).collect();
    named.join(", ")
}

fn attributes(head: &StressHead<'_>) -> Vec<Attribute> {
    let (summary, step) = (head.summary, &head.summary.steps[head.step]);
    vec![
        Attribute::Text("title", summary.title.clone()),
        Attribute::Text("source", format!("pellicle {}", summary.version)),
        Attribute::Text("bodies", head.bodies.join(" ")),
        Attribute::Number("force", step.force),
        Attribute::Text("force_units", summary.units.name("N").to_owned()),
        Attribute::Number("friction", head.stress.friction),
        Attribute::Number("direction_degrees", head.stress.direction_degrees()),
        Attribute::Text(
            "certificate_satisfied",
            step.certificate.satisfied.to_string(),
        ),
    ]
}

fn write_numbers(file: &mut impl Write, numbers: &[f64]) -> io::Result<()> {
    let bytes: Vec<u8> = numbers
        .iter()
        .flat_map(|value| value.to_be_bytes())
        .collect();
    file.write_all(&bytes)
}
