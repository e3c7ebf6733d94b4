//! Rules about text: a source begins with its one job, lines of prose fit, and no file contains traces of a developer's
//! machine.

use super::violation::Violation;
use crate::Tree;
use crate::links::{prose, unmarked};

/// Maximum number of characters in a line of prose.
const WIDTH: usize = 120;
/// First folders of absolute paths that exist only on a developer's machine.
const FOLDERS: [&str; 3] = ["work", "tmp", "home"];
/// Marks of open work, in two halves so that this file does not contain them.
const MARKS: [(&str, &str); 2] = [("TO", "DO"), ("FIX", "ME")];

/// Every `.rs` file whose first line is not `//!` with text.
pub(super) fn begin_with_their_job(tree: &Tree) -> Vec<Violation> {
    let has_doc_line = |text: &str| {
        let first = text.lines().next().unwrap_or("");
        first
            .strip_prefix("//!")
            .is_some_and(|rest| !rest.trim().is_empty())
    };
    let undocumented = tree
        .texts_ending(".rs")
        .filter(|(_, text)| !has_doc_line(text));
    let message = "must begin with `//!` and the file's one job";
    undocumented
        .map(|(path, _)| Violation::new(path, Some(1), message))
        .collect()
}

/// Every line of a comment or document that is too long; tables and code may be wider.
pub(super) fn have_lines_of_prose_that_fit(tree: &Tree) -> Vec<Violation> {
    let is_prose = |ending: &str, line: &str| match ending {
        ".rs" => line.trim_start().starts_with("//"),
        ".toml" => line.starts_with('#'),
        ".py" => ["#", "\"\"\""]
            .iter()
            .any(|mark| line.trim_start().starts_with(mark)),
        _ => true,
    };
    let mut found = Vec::new();
    for ending in [".rs", ".md", ".toml", ".py"] {
        for (path, text) in tree.texts_ending(ending) {
            let lines = prose(text).filter(|(_, line)| is_prose(ending, line));
            for (number, line) in lines.filter(|(_, line)| !unmarked(line).starts_with('|')) {
                if line.chars().count() > WIDTH {
                    let message = format!("a line of prose above {WIDTH} characters");
                    found.push(Violation::new(path, Some(number), message));
                }
            }
        }
    }
    found
}

/// Every line of a text file with an absolute path of one machine or a mark of open work.
pub(super) fn hold_no_trace_of_a_machine(tree: &Tree) -> Vec<Violation> {
    let mut found = Vec::new();
    for (path, text) in tree.texts() {
        for (index, line) in text.lines().enumerate() {
            let traces = [machine_path(line), open_work(line)];
            let at_line = |message| Violation::new(path, Some(index + 1), message);
            found.extend(traces.into_iter().flatten().map(at_line));
        }
    }
    found
}

fn machine_path(line: &str) -> Option<String> {
    let paths = FOLDERS.map(|folder| format!("/{folder}/"));
    let is_there = |path: &&String| {
        line.match_indices(*path)
            .any(|(at, _)| is_absolute(line, at))
    };
    let path = paths.iter().find(is_there)?;
    Some(format!("`{path}` is a path of one machine"))
}

/// Whether the slash at `at` begins a path, rather than continuing a path or a host name.
fn is_absolute(line: &str, at: usize) -> bool {
    let before = line[..at].chars().next_back();
    before.is_none_or(|c| !c.is_alphanumeric() && !".-_~})".contains(c))
}

fn open_work(line: &str) -> Option<String> {
    let marks = MARKS.map(|(first, second)| format!("{first}{second}"));
    let mut words = line.split(|c: char| !c.is_alphanumeric());
    let mark = words.find(|word| marks.iter().any(|mark| mark == word))?;
    Some(format!("`{mark}`: finish it or write an issue"))
}

#[cfg(test)]
mod tests {
    use super::super::broken;
    use super::*;

    #[test]
    fn a_file_that_does_not_begin_with_its_job_is_found() {
        let count = |text| broken(begin_with_their_job, &[("a/b.rs", text)]).len();
        assert_eq!(count("//! Its job.\n"), 0);
        for text in [
            "",
            "use std::fmt;\n//! Late.",
            "//!\n//! Late.",
            "// No doc comment.",
        ] {
            assert_eq!(count(text), 1, "{text:?}");
        }
    }

    #[test]
    fn long_lines_of_prose_are_found_and_tables_and_code_may_be_wider() {
        let count = |path, text: &str| broken(have_lines_of_prose_that_fit, &[(path, text)]).len();
        let long = "é".repeat(WIDTH);
        let source = format!(
            "let x = \"{long}\";\n//! {long}\n    // {long}\n/// ```\n/// {long}\n/// ```\n"
        );
        assert_eq!(count("a.rs", &source), 2);
        let page = format!("{long}\n| {long} |\n```\n{long}x\n```\n{long}x\n");
        assert_eq!(count("a.md", &page), 1);
    }

    #[test]
    fn absolute_paths_are_found_and_addresses_and_relative_paths_are_not() {
        let count = |text: &str| broken(hold_no_trace_of_a_machine, &[("a.txt", text)]).len();
        for folder in FOLDERS {
            for start in ["https://x.org", "..", "results", "~", "${ROOT}"] {
                assert_eq!(count(&format!("{start}/{folder}/y")), 0, "{start} {folder}");
            }
            for start in ["", "in ", "\"", "file://", "="] {
                assert_eq!(count(&format!("{start}/{folder}/y")), 1, "{start} {folder}");
            }
        }
        for (first, second) in MARKS {
            assert_eq!(count(&format!("fine\n// {first}{second}: later")), 1);
            assert_eq!(count(&format!("{first}{second}S")), 0);
        }
    }
}
