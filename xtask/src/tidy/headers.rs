//! Every source file opens with what it is for.

use crate::{Tree, Violation};

/// Every `.rs` file whose first line is not `//!` and a text.
pub(super) fn open_every_source(tree: &Tree) -> Vec<Violation> {
    tree.texts_ending(".rs")
        .filter(|(_, text)| !says_something(text.lines().next().unwrap_or("")))
        .map(|(path, _)| {
            Violation::at_line(path, 1, "must begin with `//!` and the file's one job")
        })
        .collect()
}

fn says_something(line: &str) -> bool {
    line.strip_prefix("//!")
        .is_some_and(|rest| !rest.trim().is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_says_its_job_is_tidy() {
        assert_eq!(
            open_every_source(&Tree::of(&[("a.rs", "//! Its job.\n")])),
            []
        );
    }

    #[test]
    fn a_file_without_a_job_is_found() {
        for text in [
            "",
            "use std::fmt;\n//! Late.",
            "//!\n//! Late.",
            "// Not a doc comment.",
        ] {
            let found = open_every_source(&Tree::of(&[("a/b.rs", text)]));
            assert_eq!(found.len(), 1, "{text:?}");
        }
    }
}
