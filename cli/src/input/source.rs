//! A text the user wrote: a case file, or one `--set` on the command line.

use miette::NamedSource;

/// A text with the name it goes by in messages: the path of a case file, or `--set`.
pub type Source = NamedSource<String>;

/// The name of the command line's text.
pub const COMMAND_LINE: &str = "--set";

/// The name of the text that `solve --stream` reads, followed by its line.
pub const STREAM: &str = "standard input";
