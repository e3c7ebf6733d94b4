//! A violation of a house rule.

use std::fmt;

/// A violation of a house rule, displayed like a compiler message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// Path of the file from the root of the workspace.
    pub path: String,
    /// Line in the file, from 1; `None` if the rule is about the whole file.
    pub line: Option<usize>,
    /// The finding and the rule.
    pub message: String,
}

impl Violation {
    /// A violation in a file.
    pub(super) fn new(path: &str, line: Option<usize>, message: impl Into<String>) -> Self {
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
