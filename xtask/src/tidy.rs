//! The house rules, each a function from the tree to what breaks it.

mod dependencies;
mod documents;
mod sources;

use std::fmt;

use crate::Tree;

/// A house rule that is broken somewhere; it reads like a message of the compiler.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// Path of the file from the root of the workspace.
    pub path: String,
    /// Line in the file, from 1; none if the rule is about the whole file.
    pub line: Option<usize>,
    /// The finding and the rule.
    pub message: String,
}

/// A house rule.
type Rule = fn(&Tree) -> Vec<Violation>;

const RULES: [Rule; 6] = [
    dependencies::point_downward,
    sources::begin_with_their_job,
    sources::have_lines_of_prose_that_fit,
    sources::hold_no_trace_of_a_machine,
    documents::links_resolve,
    documents::named_tests_exist,
];

/// Everything in the tree that breaks a house rule, rule by rule; empty for a tidy workspace.
#[must_use]
pub fn tidy(tree: &Tree) -> Vec<Violation> {
    RULES.iter().flat_map(|rule| rule(tree)).collect()
}

impl Violation {
    fn new(path: &str, line: Option<usize>, message: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            line,
            message: message.into(),
        }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.path, self.message),
            None => write!(f, "{}: {}", self.path, self.message),
        }
    }
}

/// The violations of one rule on a tree of these files, as text.
#[cfg(test)]
fn broken(rule: Rule, files: &[(&str, &str)]) -> Vec<String> {
    let found = rule(&Tree::of(files));
    found.iter().map(ToString::to_string).collect()
}
