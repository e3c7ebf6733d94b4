//! Edition, licence, version and lints are the workspace's, in every package.

use toml::Value;

use crate::manifest::{self, Manifest};
use crate::{Tree, Violation};

const INHERITED_FIELDS: [&str; 4] = ["version", "edition", "rust-version", "license"];

/// Every member that sets one of these fields itself or does not take the workspace's lints.
pub(super) fn of_package_fields(tree: &Tree) -> Vec<Violation> {
    let members = manifest::members(tree);
    members.iter().flat_map(own_fields).collect()
}

fn own_fields(member: &Manifest) -> impl Iterator<Item = Violation> {
    let fields = INHERITED_FIELDS
        .into_iter()
        .filter(|field| !is_inherited(member.package(field)))
        .map(|field| format!("[package] must say `{field}.workspace = true`"));
    let lints = (!is_inherited(member.table.get("lints")))
        .then(|| "must say `[lints] workspace = true`".to_owned());
    fields
        .chain(lints)
        .map(|message| Violation::in_file(&member.path(), message))
}

fn is_inherited(value: Option<&Value>) -> bool {
    value.and_then(|v| v.get("workspace")?.as_bool()) == Some(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIDY: &str = "[package]\nversion.workspace = true\nedition.workspace = true\nrust-version.workspace = true\n\
                        license.workspace = true\n[lints]\nworkspace = true";

    fn violations(manifest: &str) -> Vec<Violation> {
        of_package_fields(&Tree::of(&[
            ("Cargo.toml", "[workspace]\nmembers = [\"kernel\"]"),
            ("kernel/Cargo.toml", manifest),
        ]))
    }

    #[test]
    fn a_package_that_inherits_everything_is_tidy() {
        assert_eq!(violations(TIDY), []);
    }

    #[test]
    fn a_field_of_its_own_is_found() {
        let own = TIDY.replace("edition.workspace = true", "edition = \"2021\"");
        assert!(violations(&own)[0].message.contains("edition.workspace"));
    }

    #[test]
    fn missing_lints_are_found() {
        let own = TIDY.replace("[lints]\nworkspace = true", "");
        assert!(violations(&own)[0].message.contains("[lints]"));
    }
}
