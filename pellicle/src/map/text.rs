//! Numbers in columns: `.csv`, and the text formats of Gwyddion, NumPy and ESRI, in any usual encoding.
//!
//! Lines before the first line of numbers are the [head](MapHeader). Numbers are separated by commas, semicolons, tabs
//! or spaces; a `#` starts a comment. If semicolons or blanks separate numbers, a comma is a decimal mark. Words such
//! as `Bad`, `NaN` and `#N/A` stand for heights that are missing, and so does an empty cell, but for one at a line's
//! end.

use std::borrow::Cow;

use super::axes;
use super::blocks;
use super::comma::{Comma, either};
use super::error::MapError;
use super::grid_points::{self, PointsError};
use super::header::MapHeader;
use super::map_file::MapFile;
use crate::input::decode::TextEncoding;

/// From this many lines on, two columns are a profile: no map is two samples wide.
const PROFILE_LINES: usize = 8;

/// Words for a missing height, in small letters.
const MISSING: [&str; 19] = [
    "nan",
    "bad",
    "-",
    "--",
    "---",
    "n/a",
    "na",
    "none",
    "null",
    "masked",
    "#n/a",
    "1.#qnan",
    "-1.#ind",
    "1.#ind",
    "-nan(ind)",
    "*",
    "***",
    "nodata",
    "missing",
];

/// Reads the text; each line is a row of the picture, from the top down, or a point x, y, z of a grid.
///
/// # Errors
///
/// A [`MapError`] for the first invalid line, or if the numbers are no map.
pub fn parse(bytes: &[u8]) -> Result<MapFile, MapError> {
    let decoded = TextEncoding::Guessed.decode(bytes);
    let decoded = decoded.map_err(|error| MapError::NotText {
        encoding: error.encoding,
        line: error.line,
    })?;
    let text = &*unquoted(decoded.text.trim_start_matches('\u{feff}'));
    let head = head(text);
    let comma = Comma::in_text(text, head);
    if comma == Comma::Separator
        && let Some(found) = either(text, head)
    {
        return Err(MapError::CommaOrPoint { found });
    }
    let mut header = MapHeader::above(text, head);
    (text.lines().take(head)).try_for_each(|line| header.read(line))?;
    let (mut picture, mut columns) = (Vec::new(), 0);
    let mut other_head = None;
    let mut are_alike = true;
    for ((line, row), whole) in rows(text).zip(text.lines()).skip(head) {
        let before = picture.len();
        comma.read(line, row, &mut picture)?;
        match picture.len() - before {
            0 if columns > 0 && begins_map(whole) => {
                other_head.get_or_insert(line);
            }
            0 => {}
            _ if let Some(line) = other_head => return Err(MapError::Several { line }),
            found if columns == 0 => columns = found,
            found if found == columns => {}
            // As many numbers as the head says may be wrapped anywhere.
            _ if header.counts().has_columns() => are_alike = false,
            found => {
                return Err(MapError::Ragged {
                    line,
                    found,
                    wanted: columns,
                });
            }
        }
    }
    if columns != 3 && !header.counts().has_columns() {
        blocks::refuse(text, head)?;
    }
    let mut map = match header.counts().columns(columns, picture.len(), are_alike)? {
        columns if header.counts().has_columns() => MapFile::from_picture(columns, &picture),
        columns => of_columns(columns, &picture, &header)?,
    };
    header.apply(&mut map)?;
    Ok(map)
}

/// The map of numbers in this many columns, which the head may name x, y and z.
fn of_columns(columns: usize, picture: &[f64], header: &MapHeader) -> Result<MapFile, MapError> {
    const OTHERWISE: &str =
        "if each line is a row of three heights, say so by a line \"ncols 3\" above them";
    let lines = picture.len().checked_div(columns).unwrap_or(0);
    match (columns, lines) {
        (0, _) => Err(MapError::Empty),
        (1, 2..) | (2, PROFILE_LINES..) => Err(MapError::Columns { columns, lines }),
        (3, _) => match (grid_points::map(picture), header.names_points()?) {
            (Ok(map), _) => Ok(map),
            (Err(reason), are_named) if are_named || grid_points::are_points(picture) => {
                Err(MapError::Points(PointsError {
                    lines,
                    reason,
                    otherwise: OTHERWISE,
                }))
            }
            (Err(_), _) => Ok(MapFile::from_picture(3, picture)),
        },
        _ => {
            axes::check(columns, picture)?;
            Ok(MapFile::from_picture(columns, picture))
        }
    }
}

/// Number of lines before the first line of numbers: comments, and lines that begin with a word and have no more
/// numbers than words.
fn head(text: &str) -> usize {
    let is_head = |row: &str| {
        let words = row.split([';', ',', ' ', '\t', '\r']);
        let words: Vec<_> = words.filter(|word| !word.is_empty()).collect();
        let is_number = |word: &str| word.parse::<f64>().is_ok() || is_missing(word);
        let numbers = words.iter().filter(|word| is_number(word)).count();
        words.first().is_none_or(|word| !is_number(word)) && 2 * numbers <= words.len()
    };
    rows(text).take_while(|(_, row)| is_head(row)).count()
}

/// The text without quotation marks; a comma between two of them is a decimal mark.
fn unquoted(text: &str) -> Cow<'_, str> {
    if !text.contains('"') {
        return text.into();
    }
    let parts = text.split('"').enumerate();
    let plain = |(index, part): (usize, &str)| match index % 2 {
        1 if !part.contains('\n') => part.replace(',', "."),
        _ => part.to_owned(),
    };
    parts.map(plain).collect::<String>().into()
}

/// Whether a line is a comment of the head of a map.
fn begins_map(line: &str) -> bool {
    line.trim_start().starts_with('#') && MapHeader::has_key(line)
}

pub(super) fn is_missing(word: &str) -> bool {
    MISSING.contains(&word.to_lowercase().as_str())
}

/// The lines without their comments, counted from 1.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines().map(|line| &line[..comment(line)]))
}

/// Where the comment of a line begins: at a `#` that belongs to no word for a missing height.
fn comment(line: &str) -> usize {
    let is_comment = |place: &usize| {
        let is_of_number = line[..*place].ends_with("1.");
        let rest = line.get(*place..*place + 4).unwrap_or_default();
        !is_of_number && !rest.eq_ignore_ascii_case("#n/a")
    };
    let mut places = line.match_indices('#').map(|(place, _)| place);
    places.find(is_comment).unwrap_or(line.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_separator_is_accepted_and_comments_are_skipped() {
        for text in [
            "1,2\n3,4",
            "1;2\n3;4\n",
            "# Channel: Height\n\n1\t2 # top\n3\t4\n",
            "\u{feff}  1.0 2e0\r\n 3 4\r\n\r\n",
        ] {
            let map = parse(text.as_bytes()).unwrap();
            assert_eq!(
                (map.shape, &map.heights[..]),
                ([2, 2], &[3.0, 1.0, 4.0, 2.0][..]),
                "{text:?}"
            );
        }
    }

    #[test]
    fn an_empty_cell_is_a_missing_height_and_none_moves_its_neighbours() {
        for text in [
            "1,,3\n,5,6",
            "1;;3\n;5;6;\n",
            "1\t\t3\n\t5\t6\n",
            "1, ,3,\n ,5,6,",
            "1 #N/A 3\n1.#QNAN 5 6 # the last",
        ] {
            let map = parse(text.as_bytes()).unwrap();
            assert_eq!(map.shape, [3, 2], "{text:?}");
            let is_missing = map.heights.iter().map(|height| height.is_nan());
            let missing: Vec<_> = is_missing.collect();
            // The columns one after the other, each from the bottom up.
            assert_eq!(
                missing,
                [true, false, false, true, false, false],
                "{text:?}"
            );
        }
    }

    #[test]
    fn a_comma_beside_other_separators_is_a_decimal_mark() {
        for text in [
            "1,5;2,5\n-3,25;4e1\n",
            "1,5\t2,5\n-3,25\t4e1\n",
            "1,5  2,5 \n -3,25 40",
            "1,5; 2,5\n-3,25 ;40,0",
        ] {
            let map = parse(text.as_bytes()).unwrap();
            assert_eq!(
                (map.shape, &map.heights[..]),
                ([2, 2], &[-3.25, 1.5, 40.0, 2.5][..]),
                "{text:?}"
            );
        }
        assert_eq!(parse(b"1 , 2,3, 4\n5,6 ,7,8").unwrap().shape, [4, 2]);
    }

    #[test]
    fn ambiguous_commas_are_rejected_with_their_line() {
        for text in [
            "1;2\n1,2,3;4",
            "1;2\n1,5;2.5,",
            "1.5;2\n1,234.5;2",
            "1;2\n,5;2",
            "1,2 3\n1, 2",
            "1,2,3 4,5,6\n1,2,3 4,5,6",
        ] {
            let message = parse(text.as_bytes()).unwrap_err().to_string();
            assert!(message.contains("decimal mark"), "{text:?}: {message}");
        }
    }

    #[test]
    fn one_column_of_decimal_commas_is_not_two_of_integers() {
        let message = parse(b"# nm\n1,5\n-2,25\n3,0\n").unwrap_err().to_string();
        assert!(message.contains("\"1,5\""), "{message}");
        assert!(message.contains("decimal point"), "{message}");
        for text in [
            "1,5\n2,5\n3,-1\n",
            "1,5\n2,5\n3,1.0\n",
            "1, 5\n2, 5\n3, 1\n",
        ] {
            assert_eq!(parse(text.as_bytes()).unwrap().shape, [2, 3], "{text:?}");
        }
    }

    #[test]
    fn points_of_a_grid_are_not_three_columns_of_heights() {
        let map = parse(b"0 0 5\n1 0 6\n0 2 7\n1 2 8\n").unwrap();
        assert_eq!((map.shape, map.sides), ([2, 2], Some([2.0, 4.0])));
        assert_eq!(map.heights, [5.0, 7.0, 6.0, 8.0]);
        let rows = parse(b"0 0 5\n1 0 6\n0 2 7\n1 3 8\n").unwrap();
        assert_eq!((rows.shape, rows.sides), ([3, 4], None));
    }

    #[test]
    fn every_encoding_and_a_head_are_read() {
        let text = "Width: 4 µm\n1 2\n3 4\n";
        let utf_16: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let latin = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap());
        let latin: Vec<u8> = latin.collect();
        for bytes in [text.as_bytes(), &utf_16, &latin] {
            let map = parse(bytes).unwrap();
            assert_eq!(
                (map.shape, map.lateral_unit.as_deref()),
                ([2, 2], Some("m"))
            );
        }
        // The counts above points are those of their table.
        for head in ["x,y,z", "Columns: 3\nRows: 4\nx,y,z"] {
            let points = format!("{head}\n0,0,5\n1,0,6\n0,2,7\n1,2,8\n");
            assert_eq!(parse(points.as_bytes()).unwrap().shape, [2, 2]);
        }
    }

    #[test]
    fn two_maps_are_not_one() {
        let head = |name: &str| format!("# Channel: {name}\n# Width: 4 um\n");
        let [first, second] = ["Forward", "Backward"].map(head);
        let message = parse(format!("{first}1 2\n3 4\n\n{second}5 6\n7 8\n").as_bytes());
        let message = message.unwrap_err().to_string();
        assert!(message.contains("line 6 begins a second map"), "{message}");
        let map = parse(format!("{first}1 2\n# a remark\n3 4\n{second}").as_bytes());
        assert_eq!(map.unwrap().shape, [2, 2]);
    }

    #[test]
    fn missing_heights_are_read_as_such() {
        let map = parse(b"1 Bad 3\n4 NaN 6\n").unwrap();
        assert_eq!(
            map.heights.iter().filter(|height| height.is_nan()).count(),
            2
        );
        assert_eq!((map.shape, map.missing_points), ([3, 2], 0));
    }

    #[test]
    fn an_invalid_table_is_reported_with_its_line() {
        let message = |text: &str| parse(text.as_bytes()).unwrap_err().to_string();
        assert!(message("1,2\nx,2").contains("line 2 holds \"x\""));
        assert!(message("1,2\n\n3").contains("line 3 holds 1 numbers and those before it 2"));
        assert!(message("# nothing\n").contains("no numbers"));
        assert!(message("1\n2\n3").contains("one column"));
        assert!(message(&"1.5 2.5\n".repeat(9)).contains("two columns"));
        let scattered = |n: u32| format!("{} {} 5\n", n % 7, (n * n) % 13);
        let scattered = (0..40).map(scattered).collect::<Vec<_>>().concat();
        assert!(message(&scattered).contains("points x, y, z"));
    }
}
