//! Standard output, for results, and standard error, for everything else.

use std::io::{self, Write};

use pellicle::input::clean::clean;

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
