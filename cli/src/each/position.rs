//! Where a curve was measured: the lines above its table state it, or its name has it, as `map_x03_y12.txt`.

use std::path::Path;

use pellicle_identify::fit_file::FitFile;
use pellicle_identify::measured::stated::{StatedNumber, StatedQuantity};

use super::EachCurve;

/// Gives the curves their positions: those that files state, or else those in names, which have no unit.
pub fn place(curves: &mut [EachCurve], file: &FitFile) {
    let tables = file.data.iter();
    let paths = tables.flat_map(|table| table.files.iter().map(move |path| (table, path)));
    let stated: Vec<_> = paths
        .filter_map(|(table, path)| {
            Some((path.display().to_string(), in_header(&table.stated(path))?))
        })
        .collect();
    for curve in curves {
        let of_header = stated.iter().find(|(path, _)| *path == curve.file);
        curve.position = match of_header {
            None if stated.is_empty() => in_name(Path::new(&curve.file)),
            found => found.map(|(_, position)| *position),
        };
    }
}

/// Whether positions are in metres, as files state them.
#[must_use]
pub fn are_in_metres(curves: &[EachCurve]) -> bool {
    let is_of_header = |curve: &EachCurve| {
        curve.position.is_some() && in_name(Path::new(&curve.file)) != curve.position
    };
    curves.iter().any(is_of_header)
}

fn in_header(stated: &[StatedNumber]) -> Option<[f64; 2]> {
    let of = |quantity| StatedNumber::of(quantity, stated).map(|stated| stated.value);
    Some([
        of(StatedQuantity::PositionX)?,
        of(StatedQuantity::PositionY)?,
    ])
}

/// The numbers behind an x and a y in the name of a file.
fn in_name(path: &Path) -> Option<[f64; 2]> {
    let stem = path.file_stem()?.to_string_lossy().to_lowercase();
    Some([behind('x', &stem)?, behind('y', &stem)?])
}

/// The number behind a letter that begins a word: `x03`, `x=1.5`, `x_-2`.
fn behind(letter: char, name: &str) -> Option<f64> {
    let starts = name.match_indices(letter).map(|(place, _)| place);
    let mut words = starts.filter(|place| !name[..*place].ends_with(char::is_alphabetic));
    words.find_map(|place| {
        let rest = name[place + 1..].trim_start_matches(['=', '_']);
        let is_part = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
        let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        rest[..end].trim_end_matches(['.', '-']).parse().ok()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_stand_in_names_behind_x_and_y() {
        for (name, wanted) in [
            ("map_x03_y12.txt", Some([3.0, 12.0])),
            ("x=1.5,y=-2.txt", Some([1.5, -2.0])),
            ("X1Y2.csv", Some([1.0, 2.0])),
            ("cell-x10-y4.csv", Some([10.0, 4.0])),
            ("matrix2-y4.csv", None),
            ("test01.csv", None),
        ] {
            assert_eq!(in_name(Path::new(name)), wanted, "{name}");
        }
    }
}
