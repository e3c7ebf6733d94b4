//! `ARCHITECTURE.md` stays short enough to be read in one sitting.

use crate::{Tree, Violation};

const PATH: &str = "ARCHITECTURE.md";
/// About three screens; a page that needs more repeats what the crates' own documentation says.
const MOST_LINES: usize = 150;

/// A missing or an overlong `ARCHITECTURE.md`.
pub(super) fn stays_short(tree: &Tree) -> Vec<Violation> {
    let message = match tree.text(PATH).map(|text| text.lines().count()) {
        None => "missing".to_owned(),
        Some(lines) if lines > MOST_LINES => format!("{lines} lines, at most {MOST_LINES} wanted"),
        Some(_) => return Vec::new(),
    };
    vec![Violation::in_file(PATH, message)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(lines: usize) -> usize {
        stays_short(&Tree::of(&[(PATH, &"line\n".repeat(lines))])).len()
    }

    #[test]
    fn the_limit_itself_is_allowed_and_one_line_more_is_not() {
        assert_eq!(count(MOST_LINES), 0);
        assert_eq!(count(MOST_LINES + 1), 1);
    }

    #[test]
    fn a_missing_page_is_found() {
        assert_eq!(stays_short(&Tree::default()).len(), 1);
    }
}
