//! `pressure-NNN.gsf`: the pressure of a loading step in Gwyddion's simple field format.
//!
//! A file of this format contains one field. It consists of a line that names the format, lines `name = value`, one to
//! four zero bytes up to a multiple of four, and the values in single precision by rows from the top: y decreases from
//! row to row, x increases along a row.

use std::io::Write;
use std::path::Path;

use pellicle::input::units::Units;
use pellicle::result::fields::Fields;

use super::large_file::write_stoppable;
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("pressure-{step:03}.gsf")
}

/// Writes the pressure of a step into a folder; the file of a case without units has none.
///
/// # Errors
///
/// [`Failure::File`] if the file cannot be written.
pub fn write(folder: &Path, fields: &Fields<'_>, units: Units, step: usize) -> Result<(), Failure> {
    write_stoppable(&folder.join(file(step)), |file| {
        file.write_all(&head(fields, units))?;
        #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
        let pressure = |e: usize| fields.pressure[e] as f32;
        rows(fields.lengths()).try_for_each(|e| file.write_all(&pressure(e).to_le_bytes()))
    })
}

/// Encodes a square height map in metres.
#[must_use]
pub fn height_map(heights: &[f64], size: usize, side: f64) -> Vec<u8> {
    let text = format!(
        "Gwyddion Simple Field 1.0\nXRes = {size}\nYRes = {size}\nXReal = {side:e}\nYReal = {side:e}\n\
         XYUnits = m\nZUnits = m\nTitle = Height\n"
    );
    let mut bytes = padded(text);
    #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
    let value = |e: usize| heights[e] as f32;
    bytes.extend(rows([size; 2]).flat_map(|e| value(e).to_le_bytes()));
    bytes
}

fn head(fields: &Fields<'_>, units: Units) -> Vec<u8> {
    let ([columns, rows], [left, low]) = (fields.lengths(), fields.corner());
    let [along_x, along_y] = [-2.0 * left, -2.0 * low];
    let units = match units {
        Units::Si => "XYUnits = m\nZUnits = Pa\n",
        Units::Consistent => "",
    };
    let text = format!(
        "Gwyddion Simple Field 1.0\nXRes = {columns}\nYRes = {rows}\nXReal = {along_x:e}\nYReal = {along_y:e}\n\
         XOffset = {left:e}\nYOffset = {low:e}\n{units}Title = Pressure\n"
    );
    padded(text)
}

/// Pads a header with zeros to the next multiple of four after it.
fn padded(text: String) -> Vec<u8> {
    let mut head = text.into_bytes();
    let padding = 4 - head.len() % 4;
    head.resize(head.len() + padding, 0);
    head
}

/// The elements in the order of a file.
fn rows([along_x, along_y]: [usize; 2]) -> impl Iterator<Item = usize> {
    let row = move |j: usize| (0..along_x).map(move |i| i * along_y + j);
    (0..along_y).rev().flat_map(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_begin_at_a_multiple_of_four_after_at_least_one_zero_byte() {
        for side in [1.0, 1.5, 1.25, 1.125, 1.0625] {
            let fields = Fields {
                side,
                size: 1,
                pressure: &[0.0],
                displacement: &[0.0],
                gap: &[0.0],
                shortening: &[0.0],
                plastic_depth: &[],
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
