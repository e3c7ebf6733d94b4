//! Every test that the page of evidence names exists.

use crate::{Tree, Violation};

const PAGE: &str = "docs/evidence.md";

/// Every name in backquotes in the last column of a table of the page that is no function of a source, if that column is headed
/// `test`.
pub(super) fn names_tests_that_exist(tree: &Tree) -> Vec<Violation> {
    let page = tree.text(PAGE).unwrap_or("");
    let (mut found, mut is_table, mut holds_tests) = (Vec::new(), false, false);
    for (index, line) in page.lines().enumerate() {
        let cell = last_cell(line);
        if cell.is_some() && !is_table {
            holds_tests = cell.is_some_and(|heading| heading.trim() == "test");
        }
        is_table = cell.is_some();
        let names = cell.unwrap_or("").split('`').skip(1).step_by(2);
        for name in names.filter(|name| holds_tests && !exists(tree, name)) {
            let message = format!("there is no test `{name}`");
            found.push(Violation::at_line(PAGE, index + 1, message));
        }
    }
    found
}

/// The last cell of a table's row; none of another line.
fn last_cell(line: &str) -> Option<&str> {
    let row = line
        .strip_prefix('|')
        .and_then(|row| row.trim_end().strip_suffix('|'));
    row.and_then(|row| row.rsplit('|').next())
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
        let tests = "| what | test |\n|---|---|\n| warning `x-y` | `one_is_one` |\n";
        let others = "| what | where |\n|---|---|\n| x | `a/tests` |\n";
        let page = &format!("Run `cargo`.\n{tests}\n{others}");
        assert!(messages(page).is_empty());
        assert!(names_tests_that_exist(&Tree::default()).is_empty());
    }

    #[test]
    fn a_test_that_does_not_exist_is_found_with_its_line() {
        let found = messages("| what | test |\n| x | `one_is_one`, `two_is_one` |\n");
        assert_eq!(found, ["docs/evidence.md:2: there is no test `two_is_one`"]);
    }
}
