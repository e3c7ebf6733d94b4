//! Warnings about a measured curve that was read, each with a code that does not change.

/// A warning about a measured curve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CurveWarning {
    /// A short name, for programs.
    pub code: &'static str,
    /// A sentence, for people.
    pub message: String,
}

impl CurveWarning {
    /// A warning with this code and sentence.
    #[must_use]
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, message }
    }
}
