//! Where a curve was measured: the lines above its table state it, or its name has it, as `map_x03_y12.txt`.

use std::path::Path;

use pellicle_identify::fit_file::FitFile;
use pellicle_identify::measured::stated::{StatedNumber, StatedQuantity};

use super::EachCurve;

/// Gives the curves their positions, where all of them have one of the same kind; those in names have no unit.
pub fn place(curves: &mut [EachCurve], file: &FitFile) {
    let tables = file.data.iter();
    let stated = tables.flat_map(|table| {
        table
            .files
            .iter()
            .map(move |path| (path, table.stated(path)))
    });
    let stated: Vec<_> = stated
        .map(|(path, of)| (path.display().to_string(), in_header(&of)))
        .collect();
    let of_header = |curve: &EachCurve| {
        let found = stated.iter().find(|(path, _)| *path == curve.file);
        found.and_then(|(_, position)| *position)
    };
    let of_name = |curve: &EachCurve| in_name(Path::new(&curve.file));
    let all = |of: &dyn Fn(&EachCurve) -> Option<[f64; 2]>| {
        curves.iter().map(of).collect::<Option<Vec<_>>>()
    };
    let positions = all(&of_header)
        .or_else(|| all(&of_name))
        .unwrap_or_default();
    for (curve, position) in curves.iter_mut().zip(positions) {
        curve.position = Some(position);
    }
}

/// Whether positions are in metres, as files state them.
#[must_use]
pub fn are_in_metres(curves: &[EachCurve]) -> bool {
    let is_in_name = |curve: &EachCurve| in_name(Path::new(&curve.file)) == curve.position;
    !curves.iter().all(is_in_name)
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
            ("X1Y2.csv", None),
            ("cell-x10-y4.csv", Some([10.0, 4.0])),
            ("matrix2-y4.csv", None),
            ("test01.csv", None),
        ] {
            assert_eq!(in_name(Path::new(name)), wanted, "{name}");
        }
    }
}
