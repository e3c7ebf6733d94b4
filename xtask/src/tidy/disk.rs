//! A rule about changes of the disk: the program makes them through `pellicle_files::disk`, so that its tests can
//! refuse each of them.

use super::violation::Violation;
use crate::Tree;

/// The one file that calls the system.
const DISK: &str = "files/src/disk.rs";

/// Sources of the program.
const SOURCES: [&str; 9] = [
    "influence/src/",
    "texture/src/",
    "contact/src/",
    "pellicle/src/",
    "identify/src/",
    "plot/src/",
    "files/src/",
    "study/src/",
    "cli/src/",
];

/// Calls that change the disk.
const CHANGES: [&str; 10] = [
    "fs::write(",
    "fs::copy(",
    "fs::rename(",
    "fs::remove_",
    "fs::create_dir",
    "fs::hard_link(",
    "fs::set_permissions(",
    "File::create",
    "OpenOptions",
    "NamedTempFile",
];

/// Every line of the program, apart from its tests, that changes the disk by itself.
pub(super) fn is_changed_in_one_place(tree: &Tree) -> Vec<Violation> {
    let mut found = Vec::new();
    for (path, text) in tree.texts_ending(".rs") {
        let is_of_program = SOURCES.iter().any(|source| path.starts_with(source));
        if !is_of_program || path == DISK || is_of_tests(tree, path) {
            continue;
        }
        let lines = text.lines().take_while(|line| *line != "#[cfg(test)]");
        for (index, line) in lines.enumerate() {
            let is_code = !line.trim_start().starts_with("//");
            if is_code && CHANGES.iter().any(|change| calls(line, change)) {
                let message = "changes of the disk go through `pellicle_files::disk`";
                found.push(Violation::new(path, Some(index + 1), message));
            }
        }
    }
    found
}

/// Whether a line has this call, not as the end of a longer name.
fn calls(line: &str, change: &str) -> bool {
    line.match_indices(change).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|before| before.is_alphanumeric() || before == '_')
    })
}

/// Whether the file above names this file as a module of its tests.
fn is_of_tests(tree: &Tree, path: &str) -> bool {
    let Some((folder, module)) = path.trim_end_matches(".rs").rsplit_once('/') else {
        return false;
    };
    let parent = tree.text(&format!("{folder}.rs")).unwrap_or_default();
    parent.contains(&format!("#[cfg(test)]\nmod {module};"))
}

#[cfg(test)]
mod tests {
    use super::super::broken;
    use super::*;

    #[test]
    fn only_one_file_and_tests_change_the_disk() {
        let files = [
            (DISK, "fs::rename(from, to)"),
            (
                "study/src/a.rs",
                "disk::rename(a, b)\n// fs::rename(a, b)\n#[cfg(test)]\nmod tests;\n",
            ),
            ("study/src/a/tests.rs", "fs::write(a, b)"),
            (
                "study/src/b.rs",
                "#[cfg(test)]\nmod tests { fs::write(a, b) }",
            ),
            ("study/tests/c.rs", "fs::write(a, b)"),
        ];
        assert_eq!(broken(is_changed_in_one_place, &files), [""; 0]);
    }

    #[test]
    fn a_change_elsewhere_is_found() {
        for line in [
            "    fs::rename(a, b)?;",
            "std::fs::remove_file(a)",
            "File::create(a)",
        ] {
            let text = format!("\n{line}\n");
            let found = broken(is_changed_in_one_place, &[("cli/src/a.rs", &*text)]);
            assert_eq!(found.len(), 1, "{line}");
            assert!(found[0].starts_with("cli/src/a.rs:2: "), "{found:?}");
        }
    }
}
