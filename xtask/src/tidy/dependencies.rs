//! The rule about every `Cargo.toml`: a package uses only packages below it.

use toml::{Table, Value};

use super::violation::Violation;
use crate::Tree;

/// The packages that each package may use. Its tests may also use the packages that these may use.
const ALLOWED: [(&str, &[&str]); 15] = [
    ("pellicle-kernel", &[]),
    ("pellicle-fourier", &[]),
    (
        "pellicle-influence",
        &["pellicle-files", "pellicle-fourier", "pellicle-kernel"],
    ),
    ("pellicle-texture", &["pellicle-fourier"]),
    (
        "pellicle-contact",
        &["pellicle-influence", "pellicle-texture"],
    ),
    (
        "pellicle",
        &[
            "pellicle-contact",
            "pellicle-influence",
            "pellicle-kernel",
            "pellicle-texture",
        ],
    ),
    (
        "pellicle-identify",
        &["pellicle", "pellicle-contact", "pellicle-influence"],
    ),
    ("pellicle-plot", &["pellicle"]),
    ("pellicle-files", &[]),
    ("pellicle-allocator", &[]),
    (
        "pellicle-explore",
        &[
            "pellicle",
            "pellicle-contact",
            "pellicle-files",
            "pellicle-influence",
            "pellicle-plot",
        ],
    ),
    (
        "pellicle-study",
        &[
            "pellicle",
            "pellicle-contact",
            "pellicle-files",
            "pellicle-influence",
        ],
    ),
    (
        "pellicle-validation",
        &[
            "pellicle",
            "pellicle-contact",
            "pellicle-influence",
            "pellicle-kernel",
            "pellicle-texture",
        ],
    ),
    (
        "pellicle-cli",
        &[
            "pellicle",
            "pellicle-contact",
            "pellicle-explore",
            "pellicle-files",
            "pellicle-fourier",
            "pellicle-identify",
            "pellicle-influence",
            "pellicle-kernel",
            "pellicle-plot",
            "pellicle-study",
            "pellicle-texture",
            "pellicle-validation",
        ],
    ),
    (
        "pellicle-python",
        &[
            "pellicle",
            "pellicle-cli",
            "pellicle-contact",
            "pellicle-files",
            "pellicle-identify",
            "pellicle-influence",
            "pellicle-kernel",
            "pellicle-study",
            "pellicle-texture",
        ],
    ),
];
/// Packages above all others: they may use any package, and only they may use each other.
const ON_TOP: [&str; 3] = ["xtask", "pellicle-tests", "pellicle-fuzz"];
const TABLES: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];

/// Every use of a package of the workspace by one that is not above it.
pub(super) fn point_downward(tree: &Tree) -> Vec<Violation> {
    let manifests = || tree.texts_ending("/Cargo.toml");
    let members: Vec<String> = manifests().map(|(_, text)| name(&parsed(text))).collect();
    let mut found = Vec::new();
    for (path, text) in manifests() {
        let table = parsed(text);
        let name = name(&table);
        if ON_TOP.contains(&name.as_str()) {
            continue;
        }
        let Some(allowed) = allowed(&name) else {
            let message = format!("`{name}` has no place in the order of packages");
            found.push(Violation::new(path, None, message));
            continue;
        };
        for (kind, used) in dependencies(&table) {
            if members.contains(used) && !may_use(allowed, used, kind == "dev-dependencies") {
                let message = format!("[{kind}] uses `{used}`, which is not below it");
                found.push(Violation::new(path, None, message));
            }
        }
    }
    found
}

fn allowed(package: &str) -> Option<&'static [&'static str]> {
    let entry = ALLOWED.iter().find(|(name, _)| *name == package);
    entry.map(|(_, allowed)| *allowed)
}

fn may_use(allowed: &[&str], name: &str, in_tests: bool) -> bool {
    let below = |lower: &&str| in_tests && may_use(self::allowed(lower).unwrap_or(&[]), name, true);
    allowed.contains(&name) || allowed.iter().any(below)
}

/// A parsed manifest; empty if it does not parse, which cargo reports.
fn parsed(text: &str) -> Table {
    text.parse().unwrap_or_default()
}

fn name(manifest: &Table) -> String {
    let name = manifest
        .get("package")
        .and_then(|package| package.get("name"));
    name.and_then(Value::as_str).unwrap_or("").to_owned()
}

/// Table and name of every dependency.
fn dependencies(manifest: &Table) -> impl Iterator<Item = (&'static str, &String)> {
    TABLES.into_iter().flat_map(|kind| {
        let table = manifest.get(kind).and_then(Value::as_table);
        table
            .into_iter()
            .flat_map(Table::keys)
            .map(move |name| (kind, name))
    })
}

#[cfg(test)]
mod tests {
    use super::super::broken;
    use super::*;

    /// The rule applied to a workspace whose kernel and contact have these tables.
    fn found(kernel: &str, contact: &str) -> Vec<String> {
        let named =
            |name: &str, tables: &str| format!("[package]\nname = \"pellicle-{name}\"\n{tables}");
        let files = [
            ("kernel/Cargo.toml", &*named("kernel", kernel)),
            ("influence/Cargo.toml", &*named("influence", "")),
            ("contact/Cargo.toml", &*named("contact", contact)),
        ];
        broken(point_downward, &files)
    }

    #[test]
    fn downward_dependencies_are_allowed_and_in_tests_indirect_ones() {
        let downward = |tables| found("", tables).len();
        assert_eq!(
            downward("[dependencies]\npellicle-influence.workspace = true"),
            0
        );
        assert_eq!(
            downward("[dev-dependencies]\npellicle-kernel.workspace = true"),
            0
        );
        assert_eq!(
            downward("[dependencies]\npellicle-kernel.workspace = true"),
            1
        );
    }

    #[test]
    fn upward_dependencies_and_unlisted_packages_are_found() {
        for kind in TABLES {
            let upward = format!("[{kind}]\npellicle-contact.workspace = true");
            assert_eq!(found(&upward, "").len(), 1, "{kind}");
        }
        let placeless = [("kernel/Cargo.toml", "[package]\nname = \"new\"")];
        assert!(broken(point_downward, &placeless)[0].contains("no place"));
    }
}
