//! Rules about every `Cargo.toml`: who may use whom, and what stands in the root manifest alone.

use toml::{Table, Value};

use super::Violation;
use crate::Tree;

/// What each package may use. A package's tests may also use what these may use.
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
/// Packages that stand above all others: they may use anything, and only each other may use them.
const ON_TOP: [&str; 2] = ["xtask", "pellicle-tests"];
const TABLES: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];
const INHERITED: [&str; 4] = ["version", "edition", "rust-version", "license"];

/// The manifest of a member, with its path.
struct Manifest {
    path: String,
    table: Table,
}

/// Every use of a package of the workspace by one that is not above it.
pub(super) fn dependencies_point_downward(tree: &Tree) -> Vec<Violation> {
    let members = members(tree);
    let mut found = Vec::new();
    for member in members.iter().filter(|m| !ON_TOP.contains(&m.name())) {
        let Some(allowed) = allowed(member.name()) else {
            let message = format!("`{}` has no place in the order of packages", member.name());
            found.push(Violation::new(&member.path, None, message));
            continue;
        };
        for (table, name, _) in member.dependencies() {
            let is_member = members.iter().any(|other| other.name() == name);
            if is_member && !may_use(allowed, name, table == "dev-dependencies") {
                let message = format!("[{table}] uses `{name}`, which is not below it");
                found.push(Violation::new(&member.path, None, message));
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

/// Every dependency of a member that is not taken from the root, so that two members cannot disagree about its version.
pub(super) fn versions_stand_in_the_root(tree: &Tree) -> Vec<Violation> {
    let mut found = Vec::new();
    for member in members(tree) {
        let own = member
            .dependencies()
            .filter(|(.., value)| !inherits(Some(value)));
        for (table, name, _) in own {
            let message = format!("[{table}] `{name}` must say `workspace = true`");
            found.push(Violation::new(&member.path, None, message));
        }
    }
    found
}

/// Every member that sets a field of its own where the workspace has one, or lints of its own.
pub(super) fn fields_are_inherited(tree: &Tree) -> Vec<Violation> {
    let mut found = Vec::new();
    for member in members(tree) {
        let own = INHERITED
            .into_iter()
            .filter(|field| !inherits(member.package(field)))
            .map(|field| format!("[package] must say `{field}.workspace = true`"));
        let lints = (!inherits(member.table.get("lints")))
            .then(|| "must say `[lints] workspace = true`".to_owned());
        found.extend(
            own.chain(lints)
                .map(|message| Violation::new(&member.path, None, message)),
        );
    }
    found
}

fn inherits(value: Option<&Value>) -> bool {
    value.and_then(|value| value.get("workspace")?.as_bool()) == Some(true)
}

impl Manifest {
    fn name(&self) -> &str {
        self.package("name").and_then(Value::as_str).unwrap_or("")
    }

    fn package(&self, key: &str) -> Option<&Value> {
        self.table.get("package")?.get(key)
    }

    /// Table, name and value of every dependency of every kind, those for one target included.
    fn dependencies(&self) -> impl Iterator<Item = (&'static str, &str, &Value)> {
        let targets = self.table.get("target").and_then(Value::as_table);
        let for_targets = targets.into_iter().flat_map(Table::values);
        let places = std::iter::once(&self.table).chain(for_targets.filter_map(Value::as_table));
        places.flat_map(|place| {
            TABLES.into_iter().flat_map(move |name| {
                let table = place.get(name).and_then(Value::as_table);
                table
                    .into_iter()
                    .flatten()
                    .map(move |(key, value)| (name, key.as_str(), value))
            })
        })
    }
}

/// The manifests that the root lists. One that does not parse is empty, and cargo says why.
fn members(tree: &Tree) -> Vec<Manifest> {
    let parse = |path: &str| -> Table { tree.text(path).unwrap_or("").parse().unwrap_or_default() };
    let root = parse("Cargo.toml");
    let members = root
        .get("workspace")
        .and_then(|workspace| workspace.get("members"));
    let folders = members.and_then(Value::as_array).into_iter().flatten();
    let paths = folders
        .filter_map(Value::as_str)
        .map(|folder| format!("{folder}/Cargo.toml"));
    paths
        .map(|path| Manifest {
            table: parse(&path),
            path,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::broken;
    use super::*;

    const ROOT: (&str, &str) = (
        "Cargo.toml",
        "[workspace]\nmembers = [\"kernel\", \"influence\", \"contact\"]",
    );

    /// A rule on a workspace whose kernel and contact hold these tables.
    fn rule(rule: super::super::Rule, kernel: &str, contact: &str) -> Vec<String> {
        let named =
            |name: &str, tables: &str| format!("[package]\nname = \"pellicle-{name}\"\n{tables}");
        let files = [
            ROOT,
            ("kernel/Cargo.toml", &named("kernel", kernel)),
            ("influence/Cargo.toml", &named("influence", "")),
            ("contact/Cargo.toml", &named("contact", contact)),
        ];
        broken(rule, &files)
    }

    #[test]
    fn a_use_downward_is_allowed_and_in_tests_a_longer_one() {
        let downward = |tables| rule(dependencies_point_downward, "", tables);
        assert!(downward("[dependencies]\npellicle-influence.workspace = true").is_empty());
        assert!(downward("[dev-dependencies]\npellicle-kernel.workspace = true").is_empty());
        assert_eq!(
            downward("[dependencies]\npellicle-kernel.workspace = true").len(),
            1
        );
    }

    #[test]
    fn a_use_upward_and_a_package_without_a_place_are_found() {
        for kind in [
            "dependencies",
            "dev-dependencies",
            "target.'cfg(unix)'.dependencies",
        ] {
            let upward = format!("[{kind}]\npellicle-contact.workspace = true");
            assert_eq!(
                rule(dependencies_point_downward, &upward, "").len(),
                1,
                "{kind}"
            );
        }
        let placeless = [ROOT, ("kernel/Cargo.toml", "[package]\nname = \"new\"")];
        assert!(broken(dependencies_point_downward, &placeless)[0].contains("no place"));
    }

    #[test]
    fn a_version_of_a_members_own_is_found() {
        let versions = |tables: &str| rule(versions_stand_in_the_root, tables, "").len();
        assert_eq!(
            versions("[dependencies]\na = { workspace = true, features = [\"f\"] }"),
            0
        );
        for own in ["\"1\"", "{ version = \"1\" }", "{ path = \"../a\" }"] {
            assert_eq!(
                versions(&format!("[dev-dependencies]\na = {own}")),
                1,
                "{own}"
            );
        }
    }

    #[test]
    fn fields_and_lints_of_a_members_own_are_found() {
        let all = INHERITED
            .map(|field| format!("{field}.workspace = true\n"))
            .concat();
        let tidy = format!("{all}[lints]\nworkspace = true");
        let of_kernel = |tables: &str| {
            let found = rule(fields_are_inherited, tables, &tidy);
            found
                .into_iter()
                .filter(|line| line.starts_with("kernel"))
                .count()
        };
        assert_eq!(of_kernel(&tidy), 0);
        assert_eq!(
            of_kernel(&tidy.replace("edition.workspace = true", "edition = \"2021\"")),
            1
        );
        assert_eq!(of_kernel(&all), 1, "no lints");
    }
}
