//! The two streams: results to standard output, everything meant for a person to standard error.

use std::io::{self, Write};

use crate::failure::Failure;

/// Writes to standard output. A reader that has seen enough (`| head -1`) is no error.
///
/// # Errors
///
/// [`Failure::Output`] if standard output cannot be written to, as on a full disk.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(cause) if cause.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Output { cause }),
        _ => Ok(()),
    }
}

/// Writes a line to standard error, which there is nobody to tell about if it fails.
pub fn tell(line: &str) {
    let mut stderr = io::stderr().lock();
    drop(writeln!(stderr, "{line}"));
}
