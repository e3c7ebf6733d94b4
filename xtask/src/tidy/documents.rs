//! Rules about documents: links resolve, and named tests exist.

use std::collections::BTreeSet;

use super::violation::Violation;
use crate::Tree;
use crate::links::{prose, resolved, targets};

/// Pages that name tests, in a table's last column headed `test` or on a separate line.
const PAGES: [&str; 2] = ["docs/evidence.md", "docs/paper.md"];

/// Every relative link in a `.md` file without a target file or heading. Links to other sites are not followed.
pub(super) fn links_resolve(tree: &Tree) -> Vec<Violation> {
    let paths = tree.paths();
    let mut found = Vec::new();
    for (path, text) in tree.texts_ending(".md") {
        for (number, target) in targets(text) {
            if !resolves(tree, &paths, path, &target) {
                let message = format!("the link to `{target}` leads nowhere");
                found.push(Violation::new(path, Some(number), message));
            }
        }
    }
    found
}

/// Every test that a page promises but that is not a `#[test]` in any source.
pub(super) fn named_tests_exist(tree: &Tree) -> Vec<Violation> {
    let tests: BTreeSet<&str> = tree
        .texts_ending(".rs")
        .flat_map(|(_, text)| tests(text))
        .collect();
    let mut found = Vec::new();
    for page in PAGES {
        for (number, name) in named_as_tests(tree.text(page).unwrap_or("")) {
            if !tests.contains(name) {
                let message = format!("there is no test `{name}`");
                found.push(Violation::new(page, Some(number), message));
            }
        }
    }
    found
}

/// The functions of a source marked with `#[test]`, even with other attributes and comments in between.
fn tests(text: &str) -> Vec<&str> {
    let (mut found, mut is_test) = (Vec::new(), false);
    for line in text.lines().map(str::trim) {
        let function = line
            .strip_prefix("fn ")
            .and_then(|rest| rest.split(['(', '<']).next());
        match function {
            Some(name) if is_test => {
                found.push(name);
                is_test = false;
            }
            _ if line == "#[test]" => is_test = true,
            _ if line.ends_with(['}', ';']) => is_test = false,
            _ => {}
        }
    }
    found
}

/// The names in backquotes that a page gives as tests, with their lines.
fn named_as_tests(page: &str) -> Vec<(usize, &str)> {
    let (mut found, mut is_table, mut holds_tests) = (Vec::new(), false, false);
    for (number, line) in prose(page) {
        let cell = line
            .strip_prefix('|')
            .and_then(|row| row.trim_end().strip_suffix('|')?.rsplit('|').next());
        if let Some(cell) = cell {
            holds_tests = if is_table {
                holds_tests
            } else {
                cell.trim() == "test"
            };
            let names = cell.split('`').skip(1).step_by(2).filter(|_| holds_tests);
            found.extend(names.map(|name| (number, name)));
        } else if let Some(name) = line
            .strip_prefix('`')
            .and_then(|rest| rest.strip_suffix('`'))
        {
            found.extend((!name.contains('`')).then_some((number, name)));
        }
        is_table = cell.is_some();
    }
    found
}

fn resolves(tree: &Tree, paths: &BTreeSet<&str>, from: &str, target: &str) -> bool {
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let Some(path) = resolved(from, file).filter(|path| paths.contains(path.as_str())) else {
        return false;
    };
    let is_heading = |text: &str| {
        prose(text).any(|(_, line)| line.starts_with('#') && self::anchor(line) == anchor)
    };
    let document = tree.texts_ending(".md").find(|(other, _)| *other == path);
    // An anchor in a source is a line number.
    anchor.is_empty() || document.is_none_or(|(_, text)| is_heading(text))
}

/// The anchor that GitHub gives a heading: lower case, punctuation dropped, spaces as hyphens.
fn anchor(heading: &str) -> String {
    let lower = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = lower
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.collect::<String>().replace(' ', "-")
}

#[cfg(test)]
mod tests {
    use super::super::broken;
    use super::*;

    fn links(text: &str) -> Vec<String> {
        let files = [
            ("README.md", "# Pellicle\n"),
            (
                "docs/notation.md",
                "# Notation\n## Of the paper, in short\n",
            ),
            ("docs/page.md", text),
        ];
        broken(links_resolve, &files)
    }

    #[test]
    fn links_to_files_folders_headings_and_other_sites_are_tidy() {
        let text = "# Here\n[a](../README.md) [b](notation.md#of-the-paper-in-short) [c](../docs) [d](#here)\n\
                    [e](https://x.org/y) `[f](g.md)`\n```text\n[h](i.md)\n```\n";
        assert_eq!(links(text), [""; 0]);
    }

    #[test]
    fn links_to_missing_files_missing_headings_and_outside_the_tree_are_found() {
        let found = links("# Here\n\n![a](images/none.png)\n");
        assert_eq!(
            found,
            ["docs/page.md:3: the link to `images/none.png` leads nowhere"]
        );
        for target in ["../../README.md", "notation.md#of-the-book", "#gone"] {
            assert_eq!(links(&format!("[a]({target})")).len(), 1, "{target}");
        }
        assert_eq!(links("[j]: k.md").len(), 1);
    }

    #[test]
    fn a_test_that_does_not_exist_is_found_with_its_line() {
        let source = "#[test]\n#[ignore = \"slow\"]\nfn one_is_one() {}\n\nfn helper() {\n}\n";
        let page = "Run `cargo`.\n| `x` | test |\n|---|---|\n| x | `one_is_one`, `helper` |\n\n\
                    | what | where |\n|---|---|\n| x | `a/tests` |\n";
        let claims = "# A claim\n\n`two_is_one`\n\n`one_is_one`\n";
        let files = [
            (PAGES[0], page),
            (PAGES[1], claims),
            ("a/tests/b.rs", source),
        ];
        let wanted = [
            "docs/evidence.md:4: there is no test `helper`",
            "docs/paper.md:3: there is no test `two_is_one`",
        ];
        assert_eq!(broken(named_tests_exist, &files), wanted);
    }
}
