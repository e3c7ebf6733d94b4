//! Every test that the page of evidence names exists.

use crate::{Tree, Violation};

const PAGE: &str = "docs/evidence.md";

/// Every name in backquotes in the last column of a table of the page that is no function of a source.
pub(super) fn names_tests_that_exist(tree: &Tree) -> Vec<Violation> {
    let page = tree.text(PAGE).unwrap_or("");
    let mut found = Vec::new();
    for (index, line) in page.lines().enumerate() {
        for name in last_cell(line).split('`').skip(1).step_by(2) {
            if !exists(tree, name) {
                let message = format!("there is no test `{name}`");
                found.push(Violation::at_line(PAGE, index + 1, message));
            }
        }
    }
    found
}

/// The last cell of a table's row; nothing of another line.
fn last_cell(line: &str) -> &str {
    let row = line
        .strip_prefix('|')
        .and_then(|row| row.trim_end().strip_suffix('|'));
    row.and_then(|row| row.rsplit('|').next()).unwrap_or("")
}

fn exists(tree: &Tree, name: &str) -> bool {
    let function = format!("fn {name}(");
    tree.texts_ending(".rs")
        .any(|(_, text)| text.contains(&function))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(page: &str) -> Vec<String> {
        let source = "#[test]\nfn one_is_one() {}\n";
        let tree = Tree::of(&[(PAGE, page), ("a/tests/b.rs", source)]);
        let found = names_tests_that_exist(&tree);
        found.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn names_of_tests_and_of_other_things_elsewhere_are_tidy() {
        let page = "Run `cargo`.\n| what | test |\n|---|---|\n| warning `x-y` | `one_is_one` |\n";
        assert!(messages(page).is_empty());
        assert!(names_tests_that_exist(&Tree::default()).is_empty());
    }

    #[test]
    fn a_test_that_does_not_exist_is_found_with_its_line() {
        let found = messages("| what | test |\n| x | `one_is_one`, `two_is_one` |\n");
        assert_eq!(found, ["docs/evidence.md:2: there is no test `two_is_one`"]);
    }
}
