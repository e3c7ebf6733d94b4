//! The command with which the README says to run the tests is the one that `.ci/run` runs, and there is one.

use crate::markdown;
use crate::{Tree, Violation};

const README: &str = "README.md";
const SCRIPT: &str = ".ci/run";
const START: &str = "cargo test";

/// A README with no or with several test commands, or a script that runs something else.
pub(super) fn is_what_ci_runs(tree: &Tree) -> Vec<Violation> {
    let readme = markdown::code_lines(tree.text(README).unwrap_or(""));
    let promised = commands(readme.into_iter());
    let run = commands(tree.text(SCRIPT).unwrap_or("").lines());
    let mut found = Vec::new();
    if promised.len() != 1 {
        let message = format!("must give one test command, gives {promised:?}");
        found.push(Violation::in_file(README, message));
    }
    if run != promised {
        let message = format!("must run the README's test command {promised:?}, runs {run:?}");
        found.push(Violation::in_file(SCRIPT, message));
    }
    found
}

/// The test commands among the lines, without shell keywords before them and redirections after them.
fn commands<'a>(lines: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let code = lines.map(str::trim).filter(|line| !line.starts_with('#'));
    code.filter_map(|line| Some(&line[line.find(START)?..]))
        .map(|line| {
            line.find(['>', '|', ';', '&'])
                .map_or(line, |end| &line[..end])
        })
        .map(|command| command.trim_end_matches(['1', '2']).trim_end())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOCUMENT: &str = "Tests:\n```sh\ncargo test --workspace\n```\n";

    fn count(readme: &str, script: &str) -> usize {
        is_what_ci_runs(&Tree::of(&[(README, readme), (SCRIPT, script)])).len()
    }

    #[test]
    fn the_same_command_is_tidy_whatever_surrounds_it() {
        for script in [
            "cargo test --workspace",
            "if cargo test --workspace >\"$log\" 2>&1; then",
            "# cargo test would be too little\ncargo test --workspace | tee x",
        ] {
            assert_eq!(count(DOCUMENT, script), 0, "{script}");
        }
    }

    #[test]
    fn another_command_is_found() {
        for script in [
            "",
            "cargo test",
            "cargo test --workspace --release",
            "cargo test --workspace\ncargo test",
        ] {
            assert_eq!(count(DOCUMENT, script), 1, "{script}");
        }
    }

    #[test]
    fn a_readme_without_a_test_command_is_found() {
        assert_eq!(count("Run `cargo test`.", ""), 1);
    }
}
