//! No file keeps a trace of the machine or the moment it was written: no absolute paths, no marks of open work.

use crate::{Tree, Violation};

/// First folders of absolute paths that exist on a developer's machine only.
const FOLDERS: [&str; 3] = ["work", "tmp", "home"];

/// Marks of open work, in two halves so that this file does not carry them.
const MARKS: [(&str, &str); 2] = [("TO", "DO"), ("FIX", "ME")];

/// Every line of every text file that holds one of them.
pub(super) fn are_removed(tree: &Tree) -> Vec<Violation> {
    let mut found = Vec::new();
    for (path, text) in tree.texts() {
        for (index, line) in text.lines().enumerate() {
            let messages = [machine_path(line), open_work(line)];
            let at_line = |message| Violation::at_line(path, index + 1, message);
            found.extend(messages.into_iter().flatten().map(at_line));
        }
    }
    found
}

fn machine_path(line: &str) -> Option<String> {
    let paths = FOLDERS.map(|folder| format!("/{folder}/"));
    let path = paths.iter().find(|path| {
        line.match_indices(*path)
            .any(|(at, _)| is_absolute(line, at))
    })?;
    Some(format!("`{path}` is a path of one machine"))
}

/// Whether the slash at `at` begins a path, rather than continuing one or the name of a host.
fn is_absolute(line: &str, at: usize) -> bool {
    let before = line[..at].chars().next_back();
    before.is_none_or(|c| !c.is_alphanumeric() && !".-_~})".contains(c))
}

fn open_work(line: &str) -> Option<String> {
    let marks = MARKS.map(|(first, second)| format!("{first}{second}"));
    let is_word = |word: &str| marks.iter().any(|mark| mark == word);
    let mark = line
        .split(|c: char| !c.is_alphanumeric())
        .find(|w| is_word(w))?;
    Some(format!("`{mark}`: finish it or write an issue"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(text: &str) -> usize {
        are_removed(&Tree::of(&[("a/b.txt", text)])).len()
    }

    #[test]
    fn addresses_and_relative_paths_are_tidy() {
        for folder in FOLDERS {
            for start in ["https://x.org", "..", "results", "~", "${ROOT}"] {
                assert_eq!(count(&format!("{start}/{folder}/y")), 0, "{start} {folder}");
            }
        }
    }

    #[test]
    fn an_absolute_path_is_found_wherever_it_stands() {
        for folder in FOLDERS {
            for start in ["", "in ", "\"", "file://", "="] {
                assert_eq!(count(&format!("{start}/{folder}/y")), 1, "{start} {folder}");
            }
        }
    }

    #[test]
    fn a_mark_of_open_work_is_found_as_a_word() {
        for (first, second) in MARKS {
            assert_eq!(count(&format!("fine\n// {first}{second}: later")), 1);
            assert_eq!(count(&format!("{first}{second}S")), 0);
        }
    }
}
