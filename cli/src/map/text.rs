//! Numbers in columns: `.csv`, and what Gwyddion and NumPy write as text.
//!
//! Numbers are separated by commas, semicolons, tabs or spaces; what follows a `#` is a comment.

use super::{MapError, MapFile};

/// Reads the text; each line is a row of the picture, from the top down.
///
/// # Errors
///
/// A [`MapError`] of the first line that does not fit.
pub fn parse(bytes: &[u8]) -> Result<MapFile, MapError> {
    let text = std::str::from_utf8(bytes).map_err(|error| MapError::NotText {
        at: error.valid_up_to(),
    })?;
    let (mut picture, mut columns) = (Vec::new(), 0);
    for (i, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let before = picture.len();
        row(i + 1, line, &mut picture)?;
        match picture.len() - before {
            0 => {}
            found if columns == 0 => columns = found,
            found if found == columns => {}
            found => {
                return Err(MapError::Ragged {
                    line: i + 1,
                    found,
                    wanted: columns,
                });
            }
        }
    }
    match columns {
        0 => Err(MapError::Empty),
        _ => Ok(MapFile::from_picture(columns, &picture)),
    }
}

/// Adds the numbers of a line.
fn row(line: usize, text: &str, picture: &mut Vec<f64>) -> Result<(), MapError> {
    let text = text.split_once('#').map_or(text, |(before, _)| before);
    let separator = |c: char| matches!(c, ',' | ';') || c.is_whitespace();
    for word in text.split(separator).filter(|word| !word.is_empty()) {
        let number = word.parse().map_err(|_| MapError::NotANumber {
            line,
            found: word.chars().take(40).collect(),
        })?;
        picture.push(number);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_separator_is_read_and_comments_are_skipped() {
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
    fn what_is_no_table_of_numbers_is_told_by_its_line() {
        let message = |text: &str| parse(text.as_bytes()).unwrap_err().to_string();
        assert!(message("x,y\n1,2").contains("line 1 holds \"x\""));
        assert!(message("1,2\n\n3").contains("line 3 holds 1 numbers and those before 2"));
        assert!(message("# nothing\n").contains("no numbers"));
        assert!(
            parse(b"1\xff")
                .unwrap_err()
                .to_string()
                .contains("no UTF-8")
        );
    }
}
