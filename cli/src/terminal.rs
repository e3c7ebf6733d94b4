//! Standard output, for results, and standard error, for everything else.

use std::io::{self, Write};

/// Standard output cannot be written to.
#[derive(Debug, thiserror::Error)]
#[error("standard output: cannot be written: {0}")]
pub struct NoOutput(pub io::Error);

/// Writes a text to standard output, [cleaned](clean()). It is not an error if the reader closes the pipe (`| head
/// -1`).
///
/// # Errors
///
/// [`NoOutput`] if standard output cannot be written to, as on a full disk.
pub fn print(text: &str) -> Result<(), NoOutput> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(clean(text).as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(cause) if cause.kind() != io::ErrorKind::BrokenPipe => Err(NoOutput(cause)),
        _ => Ok(()),
    }
}

/// Writes a line to standard error, [cleaned](clean()).
pub fn report(line: &str) {
    report_coloured(&clean(line));
}

/// Writes the program's own line, which may be coloured, to standard error; a failure is ignored.
pub fn report_coloured(line: &str) {
    let mut stderr = io::stderr().lock();
    drop(writeln!(stderr, "{line}"));
}

/// The text with every control character except line breaks and tabs escaped (`\\u001b`), so that a terminal shows them
/// instead of obeying them. Inside a JSON or TOML string the escaped text means the same.
#[must_use]
pub fn clean(text: &str) -> String {
    let is_escaped = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    if !text.contains(is_escaped) {
        return text.to_owned();
    }
    let shown = |c: char| {
        if is_escaped(c) {
            format!("\\u{:04x}", u32::from(c))
        } else {
            c.to_string()
        }
    };
    text.chars().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_all_others_kept() {
        assert_eq!(
            clean("µ \u{1b}[31m\u{9b}\u{7}\r\n\tä"),
            "µ \\u001b[31m\\u009b\\u0007\\u000d\n\tä"
        );
    }
}
