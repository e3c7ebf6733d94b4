//! One broken rule.

use std::fmt;

/// A house rule that is broken somewhere, ready to be shown to a person.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Violation {
    /// Path of the file from the root of the workspace.
    pub path: String,
    /// Line in the file, from 1; `None` if the rule is about the whole file.
    pub line: Option<usize>,
    /// What was found and what is wanted.
    pub message: String,
}

impl Violation {
    /// A violation by the whole file `path`.
    pub fn in_file(path: &str, message: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            line: None,
            message: message.into(),
        }
    }

    /// A violation at `line` (from 1) of the file `path`.
    pub fn at_line(path: &str, line: usize, message: impl Into<String>) -> Self {
        Self {
            line: Some(line),
            ..Self::in_file(path, message)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_violation_reads_like_a_compiler_message() {
        let with_line = Violation::at_line("kernel/src/lib.rs", 7, "a function");
        assert_eq!(with_line.to_string(), "kernel/src/lib.rs:7: a function");
        let without = Violation::in_file("README.md", "missing");
        assert_eq!(without.to_string(), "README.md: missing");
    }
}
