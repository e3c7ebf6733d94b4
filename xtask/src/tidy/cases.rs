//! Every case file in `cases/` begins with a comment that says what it shows.

use crate::{Tree, Violation};

/// Every `cases/*.toml` whose first line is not a comment.
pub(super) fn say_what_they_show(tree: &Tree) -> Vec<Violation> {
    tree.texts_ending(".toml")
        .filter(|(path, text)| path.starts_with("cases/") && !text.starts_with("# "))
        .map(|(path, _)| {
            Violation::at_line(path, 1, "must begin with a comment that says what it shows")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_with_a_comment_is_tidy() {
        let tree = Tree::of(&[
            ("cases/a.toml", "# Shows a.\n"),
            ("Cargo.toml", "[workspace]"),
        ]);
        assert_eq!(say_what_they_show(&tree), []);
    }

    #[test]
    fn a_case_without_one_is_found() {
        let tree = Tree::of(&[("cases/a.toml", "title = \"a\"\n# Late.\n")]);
        assert_eq!(say_what_they_show(&tree).len(), 1);
    }
}
