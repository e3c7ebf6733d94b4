//! Where something stands in what the user wrote: a case file, or one `--set` on the command line.

use std::ops::Range;
use std::sync::Arc;

use miette::NamedSource;

/// A text the user wrote, with the name it goes by in messages: the path of a case file, or `--set`.
pub type Source = NamedSource<String>;

/// A range of bytes of a [`Source`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The text this is a place in.
    pub source: Arc<Source>,
    /// The bytes meant.
    pub span: Range<usize>,
}

impl Place {
    /// The place `span` of `source`.
    #[must_use]
    pub fn new(source: &Arc<Source>, span: Range<usize>) -> Self {
        let source = Arc::clone(source);
        Self { source, span }
    }

    /// The end of a text: where something missing would be written.
    #[must_use]
    pub fn end_of(source: &Arc<Source>) -> Self {
        let end = source.inner().trim_end().len();
        Self::new(source, end..end)
    }

    /// Number of the line it begins on, from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        let before = self.source.inner().as_bytes().iter().take(self.span.start);
        1 + before.filter(|byte| **byte == b'\n').count()
    }

    /// Text and line in words, `case.toml, line 3`; of the command line only its name, since it has but one line.
    #[must_use]
    pub fn words(&self) -> String {
        let name = self.source.name();
        if name == super::overrides::NAME {
            return name.to_owned();
        }
        format!("{name}, line {}", self.line())
    }

    /// Length in bytes of the line it begins on.
    #[must_use]
    pub fn line_length(&self) -> usize {
        let text = self.source.inner().as_str();
        text.lines().nth(self.line() - 1).map_or(0, str::len)
    }

    /// The text itself.
    #[must_use]
    pub fn text(&self) -> &str {
        self.source
            .inner()
            .get(self.span.clone())
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
        assert_eq!(Place::new(&source(), 0..1).line(), 1);
        assert_eq!(Place::new(&source(), 6..7).line(), 2);
        assert_eq!(Place::new(&source(), 6..11).text(), "b = 2");
    }

    #[test]
    fn the_end_is_behind_the_last_thing_written() {
        assert_eq!(Place::end_of(&source()).line(), 2);
    }
}
