//! `stress-NNN.vtr`: the stresses for `ParaView` and everything else that reads VTK's XML, in single precision.
//!
//! A rectilinear grid of points: along x and y the centres of the elements, along z the planes, two at the depth of an
//! interface. Every field is one array over all planes, so a plane is written at as many positions as there are fields.

use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use super::super::large_file::LongFile;
use super::super::vti::{self, LENGTH};
use super::plane_values::{FIELDS, PlaneValues, StressFile, StressHead};
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("stress-{step:03}.vtr")
}

/// A file being written.
pub struct StressVtr {
    file: LongFile,
    layout: VtrLayout,
    bodies: Vec<u8>,
}

/// The positions of the arrays, in bytes.
#[derive(Debug, Clone, Copy)]
struct VtrLayout {
    /// Number of points along x, and along y.
    size: usize,
    /// Number of planes.
    planes: usize,
    /// The start of the first array.
    start: usize,
}

impl VtrLayout {
    /// Offset of the array of a coordinate from the first array.
    fn coordinate(&self, axis: usize) -> usize {
        axis * (LENGTH + size_of::<f64>() * self.size)
    }

    /// Offset of the array of a field, or of the array of the bodies after the last field.
    fn field(&self, field: usize) -> usize {
        let depths = LENGTH + size_of::<f64>() * self.planes;
        self.coordinate(2) + depths + field * (LENGTH + size_of::<f32>() * self.points())
    }

    fn points(&self) -> usize {
        self.size * self.size * self.planes
    }

    fn end(&self) -> usize {
        self.field(FIELDS.len()) + LENGTH + self.points()
    }

    /// The position in the file of a plane in an array at `offset` whose values have `bytes` bytes.
    fn plane(&self, offset: usize, plane: usize, bytes: usize) -> SeekFrom {
        let before = bytes * self.size * self.size * plane;
        SeekFrom::Start((self.start + offset + LENGTH + before) as u64)
    }

    fn array(&self, offset: usize) -> SeekFrom {
        SeekFrom::Start((self.start + offset) as u64)
    }
}

impl StressVtr {
    /// Writes everything but the planes.
    pub fn begin(folder: &Path, head: &StressHead<'_>) -> Result<Self, Failure> {
        let mut file = LongFile::begin(&folder.join(file(head.step)))?;
        let mut layout = VtrLayout {
            size: head.centres.len(),
            planes: head.planes.len(),
            start: 0,
        };
        let text = text(head, &layout);
        layout.start = text.len();
        let depths: Vec<_> = head.planes.iter().map(|plane| plane.depth.z).collect();
        file.append(|file| {
            file.write_all(text.as_bytes())?;
            for coordinates in [head.centres, head.centres, &depths] {
                vti::write_length(file, size_of_val(coordinates))?;
                write_doubles(file, coordinates)?;
            }
            for field in 0..FIELDS.len() {
                file.seek(layout.array(layout.field(field)))?;
                vti::write_length(file, size_of::<f32>() * layout.points())?;
            }
            file.seek(layout.array(layout.field(FIELDS.len())))?;
            vti::write_length(file, layout.points())
        })?;
        let body = |plane: &pellicle::case::foundation::depths::BodyPlane| {
            u8::try_from(plane.body).unwrap_or(u8::MAX)
        };
        Ok(Self {
            file,
            layout,
            bodies: head.planes.iter().map(body).collect(),
        })
    }
}

impl StressFile for StressVtr {
    fn add(&mut self, plane: usize, values: &PlaneValues) -> Result<(), Failure> {
        let layout = self.layout;
        let body = vec![self.bodies[plane]; layout.size * layout.size];
        self.file.append(|file| {
            for (i, field) in values.fields.iter().enumerate() {
                file.seek(layout.plane(layout.field(i), plane, size_of::<f32>()))?;
                (0..layout.size).try_for_each(|row| write_along_x(file, field, row))?;
            }
            file.seek(layout.plane(layout.field(FIELDS.len()), plane, 1))?;
            file.write_all(&body)
        })
    }

    fn finish(mut self: Box<Self>) -> Result<(), Failure> {
        let layout = self.layout;
        self.file.append(|file| {
            file.seek(layout.array(layout.end()))?;
            file.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
        })?;
        self.file.finish()
    }
}

/// The text before the first array.
fn text(head: &StressHead<'_>, layout: &VtrLayout) -> String {
    let (last, deepest) = (
        layout.size.saturating_sub(1),
        layout.planes.saturating_sub(1),
    );
    let extent = format!("0 {last} 0 {last} 0 {deepest}");
    let units = head.summary.units;
    let numbers = FIELDS
        .iter()
        .enumerate()
        .map(|(i, field)| vti::number_array(field.name, units.name(field.unit), layout.field(i)));
    let numbers: String = numbers.collect();
    let body = vti::byte_array("body", layout.field(FIELDS.len()));
    let coordinates = ["x", "y", "z"].into_iter().enumerate().map(|(axis, name)| {
        let offset = layout.coordinate(axis);
        format!("        <DataArray type=\"Float64\" Name=\"{name}\" format=\"appended\" offset=\"{offset}\"/>\n")
    });
    let coordinates: String = coordinates.collect();
    format!(
        r#"<?xml version="1.0"?>
<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <RectilinearGrid WholeExtent="{extent}">
    <Piece Extent="{extent}">
      <PointData Scalars="von_mises">
{numbers}{body}      </PointData>
      <Coordinates>
{coordinates}      </Coordinates>
    </Piece>
  </RectilinearGrid>
  <AppendedData encoding="raw">
_"#
    )
}

fn write_doubles(file: &mut impl Write, numbers: &[f64]) -> io::Result<()> {
    let bytes: Vec<u8> = numbers
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    file.write_all(&bytes)
}

/// Writes the values of a field at one y, along x.
fn write_along_x(file: &mut impl Write, field: &[f64], row: usize) -> io::Result<()> {
    let size = field.len().isqrt();
    #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
    let values = field[row..].iter().step_by(size).map(|value| *value as f32);
    let bytes: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    file.write_all(&bytes)
}
