//! Maps one after another in a text: blocks of lines with an empty line, or any line without numbers, between them.

use super::error::MapError;
use super::text::rows;

/// Refuses lines of numbers in several blocks: of the same number of lines, two or more, or with an empty line between
/// them. Where such a line follows each line of numbers, all of them are one block.
///
/// # Errors
///
/// [`MapError::Several`] with the line that begins the second block.
pub fn refuse(text: &str, head: usize) -> Result<(), MapError> {
    let mut blocks: Vec<(usize, usize)> = Vec::new();
    let (mut is_apart, mut has_empty) = (true, false);
    let mut empty_within = false;
    for ((line, row), whole) in rows(text).zip(text.lines()).skip(head) {
        if row.trim().is_empty() {
            is_apart = true;
            has_empty |= whole.trim().is_empty();
            continue;
        }
        if is_apart {
            empty_within |= has_empty && !blocks.is_empty();
            blocks.push((line, 0));
        }
        (is_apart, has_empty) = (false, false);
        if let Some((_, lines)) = blocks.last_mut() {
            *lines += 1;
        }
    }
    let [(_, first), (line, _), ..] = blocks[..] else {
        return Ok(());
    };
    let are_alike = blocks.iter().all(|(_, lines)| *lines == first);
    match (are_alike, first) {
        (true, 1) => Ok(()),
        (false, _) if !empty_within => Ok(()),
        _ => Err(MapError::Several { line }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_told_from_lines_apart_and_from_remarks() {
        let second = |text: &str| match refuse(text, 0) {
            Err(MapError::Several { line }) => Some(line),
            _ => None,
        };
        assert_eq!(second("1 2\n3 4\n\n5 6\n7 8\n"), Some(4));
        assert_eq!(second("1 2\n3 4\n# second\n5 6\n7 8\n"), Some(4));
        assert_eq!(second("1 2\n3 4\n\n5 6\n"), Some(4));
        for one in [
            "\n1 2\n3 4\n\n",
            "1 2\n\n3 4\n\n5 6\n",
            "1 2\n3 4\n# a remark\n5 6\n",
            "",
        ] {
            assert_eq!(second(one), None, "{one:?}");
        }
    }
}
