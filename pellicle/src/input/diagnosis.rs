//! The fault of a case: its key, its position, the value found and the values wanted.

use std::fmt;
use std::io::IsTerminal;
use std::sync::Arc;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};

use super::clean::clean;
use super::span::{Source, Span};

/// The longest line that is quoted, in bytes; a longer one was not written by hand, and only its number is given.
const MAX_DRAWN_LINE_LENGTH: usize = 400;

/// A fault at a position in the text.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// A value that cannot be used.
    #[error("found {found}, wanted {wanted}")]
    Wrong {
        /// The user's text, or a description of it.
        found: String,
        /// A description of valid values.
        wanted: String,
    },
    /// A required key is missing.
    #[error("found no such key, wanted {wanted}")]
    Missing {
        /// A description of valid values.
        wanted: String,
    },
    /// A key that is not known here.
    #[error("found an unknown key, wanted {wanted}")]
    Unknown {
        /// The keys known here.
        wanted: String,
    },
    /// A key that was known to earlier versions.
    #[error("found a withdrawn key, wanted {wanted}")]
    Withdrawn {
        /// What to use instead.
        wanted: String,
    },
    /// A value of the right kind that the model rejects.
    #[error("{reason}")]
    Refused {
        /// The message of the crate that rejected it, which gives the value found and the values wanted.
        reason: String,
    },
}

impl Fault {
    /// What was found, in the words of the sentence; none where it is a missing or an unknown key.
    #[must_use]
    pub fn found(&self) -> Option<&str> {
        match self {
            Self::Wrong { found, .. } => Some(found),
            Self::Refused { reason } => Some(found_and_wanted(reason)?.0),
            Self::Missing { .. } | Self::Unknown { .. } | Self::Withdrawn { .. } => None,
        }
    }

    /// What is wanted, in the words of the sentence.
    #[must_use]
    pub fn wanted(&self) -> Option<&str> {
        match self {
            Self::Wrong { wanted, .. }
            | Self::Missing { wanted }
            | Self::Unknown { wanted }
            | Self::Withdrawn { wanted } => Some(wanted),
            Self::Refused { reason } => Some(found_and_wanted(reason)?.1),
        }
    }
}

/// The value found and what is wanted, from the sentence `found 2 for the ratio, wanted 1`.
fn found_and_wanted(reason: &str) -> Option<(&str, &str)> {
    let (found, wanted) = reason.split_once("found ")?.1.split_once(", wanted ")?;
    let value = found.split_once(" for ").map_or(found, |(value, _)| value);
    Some((value, wanted))
}

/// A diagnosis, which can be shown at its position in the case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnosis {
    /// Dotted path of the key, such as `foundation.layer[0].thickness`; none if the whole file is meant.
    pub key: Option<String>,
    /// Its position.
    pub span: Box<Span>,
    /// The fault.
    pub fault: Fault,
    /// A hint, if any.
    pub help: Option<String>,
}

impl Diagnosis {
    /// Creates the diagnosis of the whole text, or of a position without a key.
    #[must_use]
    pub fn of_text(span: Span, fault: Fault) -> Self {
        Self {
            key: None,
            span: Box::new(span),
            fault,
            help: None,
        }
    }

    /// Creates the diagnosis of a key, given by its dotted path.
    #[must_use]
    pub fn of_key(key: impl Into<String>, span: Span, fault: Fault) -> Self {
        Self {
            key: Some(key.into()),
            ..Self::of_text(span, fault)
        }
    }

    /// Adds a hint.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Renders the diagnosis with its line of the text, coloured if standard error is a terminal.
    #[must_use]
    pub fn render(&self) -> String {
        let mut drawn = String::new();
        let clean = self.cleaned();
        let handler = GraphicalReportHandler::new_themed(theme());
        // Writing to a String cannot fail; if it did, the sentence alone would suffice.
        match handler
            .with_wrap_lines(false)
            .render_report(&mut drawn, &clean)
        {
            Ok(()) => drawn.trim_end().to_owned(),
            Err(fmt::Error) => self.to_string(),
        }
    }

    /// Replaces control characters in the text by others of the same length.
    fn cleaned(&self) -> Self {
        let (source, bytes) = (&self.span.source, self.span.bytes.clone());
        let text = source.inner().chars().map(harmless).collect();
        let source = Arc::new(Source::new(clean(source.name()), text));
        Self {
            span: Box::new(Span { source, bytes }),
            help: self.help.as_deref().map(clean),
            ..self.clone()
        }
    }

    fn label(&self) -> &'static str {
        match self.fault {
            Fault::Wrong { .. } | Fault::Refused { .. } => "this",
            Fault::Missing { .. } => "missing here",
            Fault::Unknown { .. } => "unknown",
            Fault::Withdrawn { .. } => "withdrawn",
        }
    }
}

/// The character itself, or a harmless one of the same length in place of a control character.
fn harmless(c: char) -> char {
    match c {
        '\n' | '\t' => c,
        '\r' => ' ',
        c if c.is_control() && c.len_utf8() == 1 => '?',
        // U+0080 to U+009F, two bytes each.
        c if c.is_control() => '\u{bf}',
        c => c,
    }
}

/// Colours and box characters for a terminal, plain ASCII for anything else.
fn theme() -> GraphicalTheme {
    let colourless = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    match (std::io::stderr().is_terminal(), colourless) {
        (false, _) => GraphicalTheme::none(),
        (true, true) => GraphicalTheme::unicode_nocolor(),
        (true, false) => GraphicalTheme::unicode(),
    }
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let key = self.key.as_ref().map(|key| format!(", key `{key}`"));
        let (span, key) = (self.span.words(), key.unwrap_or_default());
        f.write_str(&clean(&format!("{span}{key}: {}", self.fault)))
    }
}

impl std::error::Error for Diagnosis {}

impl Diagnostic for Diagnosis {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as _)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        let drawable = self.span.line_length() <= MAX_DRAWN_LINE_LENGTH;
        drawable.then(|| self.span.source.as_ref() as _)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let bytes = self.span.bytes.clone();
        let label = LabeledSpan::new_with_span(Some(self.label().to_owned()), bytes);
        Some(Box::new(std::iter::once(label)))
    }
}

/// The word of `known` that `word` most likely misspells.
#[must_use]
pub fn closest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase().replace('-', "_");
    let distance = |key: &str| strsim::damerau_levenshtein(&word, &key.replace('-', "_"));
    // A name without its first part, such as `tension` for `max_tension`.
    let ends = format!("_{word}");
    let near = |key: &&&str| {
        let key = key.replace('-', "_");
        distance(&key) <= 1 + key.len() / 4 || key.ends_with(&ends)
    };
    let near = known.iter().filter(near);
    near.min_by_key(|key| distance(key)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_tells_what_its_sentence_found_and_wants() {
        let fault = Fault::Refused {
            reason: "found 2 for Poisson's ratio, wanted a number in [0, 0.5]".into(),
        };
        assert_eq!(fault.found(), Some("2"));
        assert_eq!(fault.wanted(), Some("a number in [0, 0.5]"));
        let missing = Fault::Missing {
            wanted: "a length".into(),
        };
        assert_eq!(
            (missing.found(), missing.wanted()),
            (None, Some("a length"))
        );
    }

    #[test]
    fn no_suggestion_is_made_for_a_key_unlike_any_other() {
        assert_eq!(closest("colour", &["thickness", "young_modulus"]), None);
        assert_eq!(
            closest("Flat_Punch", &["flat-punch", "cone"]),
            Some("flat-punch")
        );
        assert_eq!(
            closest("tension", &["max_shear", "max_tension"]),
            Some("max_tension")
        );
    }
}
