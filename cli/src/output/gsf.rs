//! `pressure-NNN.gsf`, `mask-NNN.gsf`, `contact-NNN.gsf`: one field of a loading step each, in Gwyddion's simple field
//! format.
//!
//! A file of this format contains one field; a truth value is 1 or 0. The file consists of a line that names the
//! format, lines `name = value`, one to four zero bytes up to a multiple of four, and the values in single precision by
//! rows from the top: y decreases from row to row, x increases along a row.

use std::io::{self, Write};
use std::path::Path;

use pellicle::input::units::Units;

use super::fields::Fields;
use super::file::write_stoppable;
use crate::failure::Failure;

/// The field of a file.
struct GsfChannel<'a> {
    title: &'a str,
    /// Its unit in SI, if it has one.
    unit: Option<&'static str>,
}

/// Name of the file of a step in a results folder, for the pressure, the mask or the contact.
#[must_use]
pub fn file(name: &str, step: usize) -> String {
    format!("{name}-{step:03}.gsf")
}

/// Writes the pressure, the mask and the contact of a step into a folder; the files of a case without units have none.
///
/// # Errors
///
/// [`Failure::Write`] if a file cannot be written.
pub fn write(folder: &Path, fields: &Fields<'_>, units: Units, step: usize) -> Result<(), Failure> {
    let pressure = GsfChannel {
        title: "Pressure",
        unit: Some("Pa"),
    };
    #[expect(clippy::cast_possible_truncation, reason = "single precision is meant")]
    let pressures = |e: usize| fields.pressure[e] as f32;
    let path = folder.join(file("pressure", step));
    write_channel(&path, fields, units, &pressure, pressures)?;
    fields.truths().into_iter().try_for_each(|truth| {
        let channel = GsfChannel {
            title: truth.name,
            unit: None,
        };
        let values = |e: usize| f32::from(u8::from(truth.values[e]));
        write_channel(
            &folder.join(file(truth.name, step)),
            fields,
            units,
            &channel,
            values,
        )
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
    bytes.extend(rows(size).flat_map(|e| value(e).to_le_bytes()));
    bytes
}

fn write_channel(
    path: &Path,
    fields: &Fields<'_>,
    units: Units,
    channel: &GsfChannel<'_>,
    value: impl Fn(usize) -> f32,
) -> Result<(), Failure> {
    write_stoppable(path, |file| {
        file.write_all(&head(fields, units, channel))?;
        write_rows(file, fields.size, value)
    })
}

fn head(fields: &Fields<'_>, units: Units, channel: &GsfChannel<'_>) -> Vec<u8> {
    let (size, side, low) = (fields.size, fields.side, fields.edge(0));
    let unit = |name: &str, unit: &str| format!("{name} = {unit}\n");
    let units = match units {
        Units::Si => {
            let own = channel.unit.map(|own| unit("ZUnits", own));
            unit("XYUnits", "m") + &own.unwrap_or_default()
        }
        Units::Consistent => String::new(),
    };
    let title = channel.title;
    let text = format!(
        "Gwyddion Simple Field 1.0\nXRes = {size}\nYRes = {size}\nXReal = {side:e}\nYReal = {side:e}\n\
         XOffset = {low:e}\nYOffset = {low:e}\n{units}Title = {title}\n"
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
fn rows(size: usize) -> impl Iterator<Item = usize> {
    let row = move |j: usize| (0..size).map(move |i| i * size + j);
    (0..size).rev().flat_map(row)
}

fn write_rows(file: &mut impl Write, size: usize, value: impl Fn(usize) -> f32) -> io::Result<()> {
    rows(size).try_for_each(|e| file.write_all(&value(e).to_le_bytes()))
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
            let channel = GsfChannel {
                title: "Pressure",
                unit: Some("Pa"),
            };
            let head = head(&fields, Units::Si, &channel);
            let text = head.iter().position(|byte| *byte == 0).unwrap();
            assert!(head.len().is_multiple_of(4) && head.len() - text <= 4);
            assert!(head[text..].iter().all(|byte| *byte == 0));
        }
    }
}
