//! Versions of dependencies stand only in the root manifest, so that two members never disagree about one.

use crate::manifest;
use crate::{Tree, Violation};

/// Every dependency of a member that is not taken from the root.
pub(super) fn stand_in_the_root(tree: &Tree) -> Vec<Violation> {
    let mut found = Vec::new();
    for member in manifest::members(tree) {
        for dependency in member.dependencies() {
            if !dependency.is_inherited() {
                let message = format!(
                    "[{}] `{}` must say `workspace = true`; its version belongs in the root manifest",
                    dependency.table, dependency.name
                );
                found.push(Violation::in_file(&member.path(), message));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn violations(dependencies: &str) -> Vec<Violation> {
        stand_in_the_root(&Tree::of(&[
            ("Cargo.toml", "[workspace]\nmembers = [\"kernel\"]"),
            ("kernel/Cargo.toml", dependencies),
        ]))
    }

    #[test]
    fn an_inherited_dependency_may_choose_features() {
        assert!(
            violations("[dependencies]\na = { workspace = true, features = [\"f\"] }").is_empty()
        );
    }

    #[test]
    fn a_version_or_a_path_in_a_member_is_found() {
        for own in ["\"1\"", "{ version = \"1\" }", "{ path = \"../a\" }"] {
            let found = violations(&format!("[dev-dependencies]\na = {own}"));
            assert_eq!(found.len(), 1, "{own}");
            assert!(found[0].message.contains("[dev-dependencies] `a`"));
        }
    }
}
