//! Dependencies point only downward: cli → contact → influence → kernel, contact → texture.

use toml::Value;

use crate::manifest::{self, Dependency, Manifest};
use crate::{Tree, Violation};

/// What each package may use, directly. A package's tests may also use what these may use.
const ALLOWED: [(&str, &[&str]); 5] = [
    ("pellicle-kernel", &[]),
    ("pellicle-influence", &["pellicle-kernel"]),
    ("pellicle-texture", &[]),
    (
        "pellicle-contact",
        &["pellicle-influence", "pellicle-texture"],
    ),
    (
        "pellicle-cli",
        &[
            "pellicle-contact",
            "pellicle-influence",
            "pellicle-kernel",
            "pellicle-texture",
        ],
    ),
];

/// Packages that stand above all others: they may use anything, nothing may use them but each other.
const ON_TOP: [&str; 2] = ["xtask", "pellicle-tests"];

/// Every use of a package of the workspace by one that is not above it.
pub(super) fn point_downward(tree: &Tree) -> Vec<Violation> {
    let members = manifest::members(tree);
    let below_top = members.iter().filter(|m| !ON_TOP.contains(&m.name()));
    below_top
        .flat_map(|member| upward_uses(tree, member, &members))
        .collect()
}

fn upward_uses(tree: &Tree, member: &Manifest, members: &[Manifest]) -> Vec<Violation> {
    let Some(allowed) = allowed(member.name()) else {
        let message = format!(
            "package `{}` has no place in the order of dependencies",
            member.name()
        );
        return vec![Violation::in_file(&member.path(), message)];
    };
    let is_member = |name: &str| members.iter().any(|m| m.name() == name);
    let dependencies = member.dependencies();
    let used = dependencies.iter().map(|d| (d, package_name(tree, d)));
    used.filter(|(_, name)| is_member(name))
        .filter(|(d, name)| !may_use(allowed, name, d.is_for_development()))
        .map(|(d, name)| upward(member, d.table, &name))
        .collect()
}

fn allowed(package: &str) -> Option<&'static [&'static str]> {
    let entry = ALLOWED.iter().find(|(name, _)| *name == package);
    entry.map(|(_, allowed)| *allowed)
}

fn may_use(allowed: &[&str], name: &str, in_tests: bool) -> bool {
    let below =
        |&lower: &&str| in_tests && may_use(self::allowed(lower).unwrap_or(&[]), name, true);
    allowed.contains(&name) || allowed.iter().any(below)
}

fn upward(member: &Manifest, table: &str, used: &str) -> Violation {
    let message = format!(
        "[{table}] `{}` uses `{used}`, which is not below it",
        member.name()
    );
    Violation::in_file(&member.path(), message)
}

/// The name of the package behind a dependency, which may carry another name in the root or in the member.
fn package_name(tree: &Tree, dependency: &Dependency) -> String {
    let root = manifest::root(tree);
    let in_root = root
        .get("workspace")
        .and_then(|w| w.get("dependencies")?.get(dependency.name));
    let renamed = [Some(dependency.value), in_root]
        .into_iter()
        .flatten()
        .find_map(|value| value.get("package").and_then(Value::as_str));
    renamed.unwrap_or(dependency.name).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOT: &str = "[workspace]\nmembers = [\"kernel\", \"influence\", \"contact\", \"xtask\"]\n[workspace.dependencies]\n\
         beam = { path = \"contact\", package = \"pellicle-contact\" }\n";

    /// The violations of a workspace in which kernel, influence and contact have the dependency tables given.
    fn violations(kernel: &str, influence: &str, contact: &str) -> Vec<String> {
        let package = |name: &str, tables: &str| format!("[package]\nname = \"{name}\"\n{tables}");
        let tree = Tree::of(&[
            ("Cargo.toml", ROOT),
            ("kernel/Cargo.toml", &package("pellicle-kernel", kernel)),
            (
                "influence/Cargo.toml",
                &package("pellicle-influence", influence),
            ),
            ("contact/Cargo.toml", &package("pellicle-contact", contact)),
            ("xtask/Cargo.toml", &package("xtask", "")),
        ]);
        let messages = point_downward(&tree).into_iter().map(|v| v.message);
        messages.collect()
    }

    #[test]
    fn a_dependency_on_a_lower_package_is_allowed() {
        let influence = "[dependencies]\npellicle-kernel.workspace = true\nserde = \"1\"";
        assert!(violations("", influence, "").is_empty());
    }

    #[test]
    fn tests_may_reach_further_down_than_code() {
        let table = |kind| format!("[{kind}]\npellicle-kernel.workspace = true");
        assert!(violations("", "", &table("dev-dependencies")).is_empty());
        let found = violations("", "", &table("dependencies"));
        assert!(found[0].contains("`pellicle-contact` uses `pellicle-kernel`"));
    }

    #[test]
    fn a_dependency_upward_is_found_whatever_its_kind() {
        for kind in [
            "dependencies",
            "dev-dependencies",
            "target.'cfg(unix)'.dependencies",
        ] {
            let found = violations(
                &format!("[{kind}]\npellicle-influence.workspace = true"),
                "",
                "",
            );
            assert_eq!(found.len(), 1, "{kind}");
            assert!(found[0].contains("`pellicle-kernel` uses `pellicle-influence`"));
        }
    }

    #[test]
    fn a_renamed_dependency_upward_is_found() {
        let found = violations("", "[dependencies]\nbeam.workspace = true", "");
        assert!(found[0].contains("uses `pellicle-contact`"));
    }

    #[test]
    fn nothing_below_may_use_the_packages_on_top() {
        let found = violations("", "", "[dev-dependencies]\nxtask.workspace = true");
        assert!(found[0].contains("uses `xtask`"));
    }

    #[test]
    fn a_package_without_a_place_in_the_order_is_found() {
        let tree = Tree::of(&[
            ("Cargo.toml", "[workspace]\nmembers = [\"new\"]"),
            ("new/Cargo.toml", "[package]\nname = \"pellicle-new\""),
        ]);
        assert!(
            point_downward(&tree)[0]
                .message
                .contains("`pellicle-new` has no place")
        );
    }
}
