//! A rule about tests: each package has one binary of integration tests, `tests/main.rs`, and every file beside and
//! below it is one of its modules.

use super::violation::Violation;
use crate::Tree;

/// The root of a package's integration tests.
const ROOT: &str = "main.rs";

/// Every `.rs` file of integration tests that no module names: cargo would make it a binary of its own, or forget it.
pub(super) fn hold_every_test(tree: &Tree) -> Vec<Violation> {
    let manifests = tree.texts_ending("Cargo.toml");
    let packages = manifests.filter_map(|(path, _)| path.strip_suffix("Cargo.toml"));
    let unnamed = packages.flat_map(|package| {
        let tests = format!("{package}tests/");
        let files = tree.texts_ending(".rs").map(|(path, _)| path);
        files.filter_map(move |path| {
            let inside = path.strip_prefix(&tests)?;
            // A package within the folder has its own rule.
            let is_own = tree.text(&format!("{tests}Cargo.toml")).is_none();
            let is_known = inside == ROOT || is_named(tree, &tests, inside);
            (is_own && !is_known).then_some(path)
        })
    });
    let message = "must be a module of its package's one binary of tests, `tests/main.rs`";
    unnamed
        .map(|path| Violation::new(path, None, message))
        .collect()
}

/// Whether the file above names the file `inside` the folder of tests as its module.
fn is_named(tree: &Tree, tests: &str, inside: &str) -> bool {
    let module = inside.strip_suffix(".rs").unwrap_or(inside);
    let (parent, name) = match module.rsplit_once('/') {
        Some((folder, name)) => (format!("{tests}{folder}.rs"), name),
        None => (format!("{tests}{ROOT}"), module),
    };
    let line = format!("mod {name};");
    let text = tree.text(&parent).unwrap_or_default();
    text.lines()
        .any(|found| found.trim_start_matches("pub ") == line)
}

#[cfg(test)]
mod tests {
    use super::super::broken;
    use super::*;

    #[test]
    fn a_file_of_tests_that_no_module_names_is_found() {
        let files = [
            ("a/Cargo.toml", ""),
            ("a/src/lib.rs", ""),
            ("a/tests/main.rs", "mod one;\nmod two;\n"),
            ("a/tests/one.rs", ""),
            ("a/tests/two.rs", "pub mod deep;\n"),
            ("a/tests/two/deep.rs", ""),
        ];
        assert_eq!(broken(hold_every_test, &files), [""; 0]);
        for forgotten in [
            "a/tests/three.rs",
            "a/tests/two/other.rs",
            "a/tests/four/main.rs",
        ] {
            let more = [&files[..], &[(forgotten, "")]].concat();
            let found = broken(hold_every_test, &more);
            assert_eq!(found.len(), 1, "{found:?}");
            assert!(found[0].starts_with(forgotten), "{found:?}");
        }
    }

    #[test]
    fn the_package_of_tests_itself_keeps_the_rule() {
        let files = [
            ("Cargo.toml", ""),
            ("tests/Cargo.toml", ""),
            ("tests/src/program.rs", ""),
            ("tests/tests/main.rs", "mod one;"),
            ("tests/tests/one.rs", ""),
        ];
        assert_eq!(broken(hold_every_test, &files), [""; 0]);
    }
}
