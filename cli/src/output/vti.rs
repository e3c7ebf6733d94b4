//! `fields-NNN.vti`: the fields of one loading step, for `ParaView` and everything else that reads VTK's XML.
//!
//! An image with a cell for each element; the numbers follow the text in binary, each array after its length in bytes.
//! Single precision is enough for any picture and halves the file; `fields-NNN.npz` has full precision. The
//! descriptions of the arrays and their lengths are the same in every file of this XML.

use std::io::{self, Write};
use std::path::Path;

use pellicle::input::units::Units;
use pellicle::result::fields::{Fields, TRUTHS};

use super::large_file::write_stoppable;
use crate::failure::Failure;

/// Size in bytes of the length of an array, which precedes its values.
pub const LENGTH: usize = size_of::<u64>();

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("fields-{step:03}.vti")
}

/// Writes the numeric fields with their units, the mask and the contact, as cell data.
///
/// # Errors
///
/// [`Failure::File`] if the file cannot be written.
pub fn write(path: &Path, fields: &Fields<'_>, units: Units) -> Result<(), Failure> {
    write_stoppable(path, |file| {
        file.write_all(head(fields, units).as_bytes())?;
        for (_, values) in fields.numbers() {
            write_numbers(file, fields, values)?;
        }
        for truth in TRUTHS {
            write_truths(file, fields.lengths(), &truth.of(fields))?;
        }
        file.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
    })
}

/// The text before the first array.
fn head(fields: &Fields<'_>, units: Units) -> String {
    let [columns, rows] = fields.lengths();
    let extent = format!("0 {columns} 0 {rows} 0 0");
    let (elements, side) = (columns * rows, fields.element_side());
    let [left, low] = fields.corner();
    let arrays: Vec<_> = fields.numbers().collect();
    let each = LENGTH + size_of::<f32>() * elements;
    let numbers = arrays.iter().enumerate();
    let numbers: String = numbers
        .map(|(i, (field, _))| number_array(field.name, units.name(field.unit), i * each))
        .collect();
    let first = arrays.len() * each;
    let length = LENGTH + elements;
    let truths = TRUTHS.iter().enumerate();
    let truths: String = truths
        .map(|(i, truth)| byte_array(truth.name, first + i * length))
        .collect();
    format!(
        r#"<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{extent}" Origin="{left:e} {low:e} 0" Spacing="{side:e} {side:e} {side:e}">
    <Piece Extent="{extent}">
      <CellData Scalars="pressure">
{numbers}{truths}      </CellData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
_"#
    )
}

fn write_numbers(file: &mut impl Write, fields: &Fields<'_>, values: &[f64]) -> io::Result<()> {
    write_length(file, size_of::<f32>() * values.len())?;
    for e in along_x(fields.lengths()) {
        #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
        file.write_all(&(values[e] as f32).to_le_bytes())?;
    }
    Ok(())
}

fn write_truths(file: &mut impl Write, lengths: [usize; 2], values: &[bool]) -> io::Result<()> {
    write_length(file, values.len())?;
    for e in along_x(lengths) {
        file.write_all(&[u8::from(values[e])])?;
    }
    Ok(())
}

/// The elements in VTK's order: along x first.
fn along_x([along_x, along_y]: [usize; 2]) -> impl Iterator<Item = usize> {
    (0..along_y).flat_map(move |j| (0..along_x).map(move |i| i * along_y + j))
}

/// Describes an array of numbers in single precision with its unit, `offset` bytes after the first array.
#[must_use]
pub fn number_array(name: &str, unit: &str, offset: usize) -> String {
    format!(
        r#"        <DataArray type="Float32" Name="{name}" format="appended" offset="{offset}">
          <InformationKey name="UNITS_LABEL" location="vtkDataArray">{unit}</InformationKey>
        </DataArray>
"#
    )
}

/// Describes an array of bytes, `offset` bytes after the first array.
#[must_use]
pub fn byte_array(name: &str, offset: usize) -> String {
    format!(
        r#"        <DataArray type="UInt8" Name="{name}" format="appended" offset="{offset}"/>
"#
    )
}

/// Writes the length of an array in bytes.
///
/// # Errors
///
/// The errors of the file.
pub fn write_length(file: &mut impl Write, bytes: usize) -> io::Result<()> {
    file.write_all(&(bytes as u64).to_le_bytes())
}
