//! `pressure-NNN.gsf`: the pressure of one loading step as a simple field of Gwyddion.
//!
//! A line that names the format, lines `name = value`, one to four zero bytes that end at a multiple of four, and the values
//! in single precision by rows from the top: y falls from row to row, x grows along a row.

use std::io::{self, Write};
use std::path::Path;

use super::fields::Fields;
use super::file::write_whole;
use crate::case::units::Units;
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("pressure-{step:03}.gsf")
}

/// Writes the pressure; a case without units has none in the file.
///
/// # Errors
///
/// [`Failure::Write`] if the file cannot be written.
pub fn write(path: &Path, fields: &Fields<'_>, units: Units) -> Result<(), Failure> {
    write_whole(path, |file| {
        file.write_all(&head(fields, units))?;
        write_rows(file, fields)
    })
}

fn head(fields: &Fields<'_>, units: Units) -> Vec<u8> {
    let (size, side, low) = (fields.size, fields.side, fields.edge(0));
    let units = match units {
        Units::Si => "XYUnits = m\nZUnits = Pa\n",
        Units::Consistent => "",
    };
    let text = format!(
        "Gwyddion Simple Field 1.0\nXRes = {size}\nYRes = {size}\nXReal = {side:e}\nYReal = {side:e}\n\
         XOffset = {low:e}\nYOffset = {low:e}\n{units}Title = Pressure\n"
    );
    let mut head = text.into_bytes();
    let padding = 4 - head.len() % 4;
    head.resize(head.len() + padding, 0);
    head
}

fn write_rows(file: &mut impl Write, fields: &Fields<'_>) -> io::Result<()> {
    let size = fields.size;
    for j in (0..size).rev() {
        for i in 0..size {
            #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
            let pressure = fields.pressure[i * size + j] as f32;
            file.write_all(&pressure.to_le_bytes())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_values_begin_at_a_multiple_of_four_after_at_least_one_zero() {
        for side in [1.0, 1.5, 1.25, 1.125, 1.0625] {
            let fields = Fields {
                side,
                size: 1,
                pressure: &[0.0],
                displacement: &[0.0],
                gap: &[0.0],
                shortening: &[0.0],
                profile: &[0.0],
                mask: &[false],
            };
            let head = head(&fields, Units::Si);
            let text = head.iter().position(|byte| *byte == 0).unwrap();
            assert!(head.len().is_multiple_of(4) && head.len() - text <= 4);
            assert!(head[text..].iter().all(|byte| *byte == 0));
        }
    }
}
