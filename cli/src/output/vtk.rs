//! The common parts of VTK's XML files: descriptions of the arrays that follow the text in binary, and their lengths.

use std::io::{self, Write};

/// Size in bytes of the length of an array, which precedes its values.
pub const LENGTH: usize = size_of::<u64>();

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
