//! What the house rules need to know of a `Cargo.toml`.

use toml::{Table, Value};

use crate::Tree;

const DEPENDENCY_TABLES: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];

/// The manifest of one member of the workspace.
pub(crate) struct Manifest {
    /// Folder of the member from the root.
    pub folder: String,
    /// The parsed file; empty if it does not parse, which cargo itself reports.
    pub table: Table,
}

/// One line of a dependency table.
pub(crate) struct Dependency<'a> {
    /// The table it stands in.
    pub table: &'static str,
    /// Its key.
    pub name: &'a str,
    /// Its value.
    pub value: &'a Value,
}

impl Dependency<'_> {
    /// Whether version and source are taken from the root manifest.
    pub fn is_inherited(&self) -> bool {
        self.value.get("workspace").and_then(Value::as_bool) == Some(true)
    }

    /// Whether only tests, benchmarks and examples see it.
    pub fn is_for_development(&self) -> bool {
        self.table == "dev-dependencies"
    }
}

impl Manifest {
    /// Path of the file from the root.
    pub fn path(&self) -> String {
        format!("{}/Cargo.toml", self.folder)
    }

    /// The package's name; empty if the manifest gives none.
    pub fn name(&self) -> &str {
        self.package("name").and_then(Value::as_str).unwrap_or("")
    }

    /// The value of `key` in `[package]`.
    pub fn package(&self, key: &str) -> Option<&Value> {
        self.table.get("package")?.get(key)
    }

    /// Every dependency of every kind, those for one target included.
    pub fn dependencies(&self) -> Vec<Dependency<'_>> {
        let targets = self.table.get("target").and_then(Value::as_table);
        let for_targets = targets
            .into_iter()
            .flat_map(Table::values)
            .filter_map(Value::as_table);
        std::iter::once(&self.table)
            .chain(for_targets)
            .flat_map(dependencies_in)
            .collect()
    }
}

fn dependencies_in(tables: &Table) -> impl Iterator<Item = Dependency<'_>> {
    DEPENDENCY_TABLES.into_iter().flat_map(move |table| {
        let entries = tables.get(table).and_then(Value::as_table);
        entries
            .into_iter()
            .flatten()
            .map(move |(name, value)| Dependency { table, name, value })
    })
}

/// The root manifest; empty if it is missing or does not parse.
pub(crate) fn root(tree: &Tree) -> Table {
    parse(tree, "Cargo.toml")
}

/// The manifests of all members, in the order in which the root lists them.
pub(crate) fn members(tree: &Tree) -> Vec<Manifest> {
    let root = root(tree);
    let members = root.get("workspace").and_then(|w| w.get("members"));
    let folders = members.and_then(Value::as_array).into_iter().flatten();
    folders
        .filter_map(Value::as_str)
        .map(|folder| Manifest {
            folder: folder.to_owned(),
            table: parse(tree, &format!("{folder}/Cargo.toml")),
        })
        .collect()
}

fn parse(tree: &Tree, path: &str) -> Table {
    let text = tree.text(path).unwrap_or("");
    text.parse().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dependencies_of_every_kind_and_target_are_listed() {
        let tree = Tree::of(&[
            ("Cargo.toml", "[workspace]\nmembers = [\"kernel\"]"),
            (
                "kernel/Cargo.toml",
                "[package]\nname = \"pellicle-kernel\"\n[dependencies]\na.workspace = true\n\
                 [dev-dependencies]\nb = \"1\"\n[target.'cfg(unix)'.build-dependencies]\nc = { path = \"x\" }",
            ),
        ]);
        let members = members(&tree);
        let names: Vec<_> = members[0]
            .dependencies()
            .iter()
            .map(|d| (d.name.to_owned(), d.is_inherited(), d.is_for_development()))
            .collect();
        let expected = [("a", true, false), ("b", false, true), ("c", false, false)];
        assert_eq!(members[0].name(), "pellicle-kernel");
        assert_eq!(names, expected.map(|(n, i, d)| (n.to_owned(), i, d)));
    }
}
