//! A text that the user wrote, a case file or one `--set` of the command line, and a position in it.

use std::ops::Range;
use std::sync::Arc;

use miette::NamedSource;

/// A text with its name in messages: the path of a case file, or `--set`.
pub type Source = NamedSource<String>;

/// How the name of an option of the command line begins.
const OPTION: &str = "--";

/// The name of a text from the command line.
pub const COMMAND_LINE: &str = "--set";

/// The name of the text that `solve --stream` reads; the line number follows.
pub const STREAM: &str = "standard input";

/// The end of the name of a text that a program wrote for a call: its lines mean nothing to the user.
pub const CALL: &str = "(…)";

/// A range of bytes of a [`Source`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Span {
    /// The text.
    pub source: Arc<Source>,
    /// The range.
    pub bytes: Range<usize>,
}

impl Span {
    /// The range `bytes` of `source`.
    #[must_use]
    pub fn new(source: &Arc<Source>, bytes: Range<usize>) -> Self {
        let source = Arc::clone(source);
        Self { source, bytes }
    }

    /// The end of a text, where a missing key would be written.
    #[must_use]
    pub fn end_of(source: &Arc<Source>) -> Self {
        let end = source.inner().trim_end().len();
        Self::new(source, end..end)
    }

    /// The line on which the span begins, counted from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        let before = self.source.inner().as_bytes().iter().take(self.bytes.start);
        1 + before.filter(|byte| **byte == b'\n').count()
    }

    /// Source and line in words, `case.toml, line 3`. For an option of the command line, which has a single line, for
    /// standard input, whose name contains the line, and for a [`CALL`], only the name.
    #[must_use]
    pub fn words(&self) -> String {
        let name = self.source.name();
        if name.starts_with(OPTION) || name.starts_with(STREAM) || name.ends_with(CALL) {
            return name.to_owned();
        }
        format!("{name}, line {}", self.line())
    }

    /// Length in bytes of the line on which the span begins.
    #[must_use]
    pub fn line_length(&self) -> usize {
        let text = self.source.inner().as_str();
        text.lines().nth(self.line() - 1).map_or(0, str::len)
    }

    /// The text of the span.
    #[must_use]
    pub fn text(&self) -> &str {
        self.source
            .inner()
            .get(self.bytes.clone())
            .unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source() -> Arc<Source> {
        Arc::new(Source::new("case.toml", "a = 1\nb = 2\n\n".into()))
    }

    #[test]
    fn lines_are_counted_from_one() {
        assert_eq!(Span::new(&source(), 0..1).line(), 1);
        assert_eq!(Span::new(&source(), 6..7).line(), 2);
        assert_eq!(Span::new(&source(), 6..11).text(), "b = 2");
    }

    #[test]
    fn the_end_of_a_file_is_on_its_last_non_blank_line() {
        assert_eq!(Span::end_of(&source()).line(), 2);
    }
}
