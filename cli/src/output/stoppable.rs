//! Writing that stops soon after the user asks to stop.

use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use pellicle_files::FileError;
use pellicle_files::causes;
use pellicle_files::partial::PartialFile;

use crate::failure::Failure;
use crate::interrupt;

/// Bytes after which data are forced onto the disk: otherwise the end of a large file would wait for all of them and
/// could not be stopped.
const SYNC: usize = 1 << 25;

/// Largest number of bytes written or compressed between two checks for a request to stop, too few to cause a delay.
const CHUNK: usize = 1 << 20;

/// The error of a file whose writing was stopped.
#[derive(Debug, thiserror::Error)]
#[error("stopped by the user")]
struct WriteStopped;

/// Whether the writing of a file was stopped, which is not a failure.
#[must_use]
pub fn was_stopped(failure: &Failure) -> bool {
    let Failure::File(FileError::Write { cause, .. }) = failure else {
        return false;
    };
    causes(cause).any(<dyn std::error::Error>::is::<WriteStopped>)
}

/// Stops before a file is begun.
///
/// # Errors
///
/// [`FileError::Write`] if [`interrupt::GRACE`] has passed since the user asked to stop.
pub fn check(path: &Path) -> Result<(), Failure> {
    if !interrupt::is_overdue() {
        return Ok(());
    }
    Err(Failure::write(path, io::Error::other(WriteStopped)))
}

/// A writer that passes bytes on until [`interrupt::GRACE`] has passed since the user asked to stop, and then fails.
#[derive(Debug)]
pub struct StoppableWriter<W>(pub W);

impl<W: Write> Write for StoppableWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if interrupt::is_overdue() {
            return Err(io::Error::other(WriteStopped));
        }
        self.0.write(&bytes[..bytes.len().min(CHUNK)])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// A stoppable writer for a file, which is forced onto the disk part by part.
#[derive(Debug)]
pub struct StoppableFile<'a> {
    file: StoppableWriter<&'a mut PartialFile>,
    unsynced: usize,
}

impl<'a> StoppableFile<'a> {
    /// Creates the writer of a new file.
    pub fn new(file: &'a mut PartialFile) -> Self {
        Self::resuming(file, 0)
    }

    /// Creates the writer of a file of which `unsynced` bytes are not yet on the disk.
    pub fn resuming(file: &'a mut PartialFile, unsynced: usize) -> Self {
        Self {
            file: StoppableWriter(file),
            unsynced,
        }
    }

    /// Number of bytes not yet forced onto the disk.
    #[must_use]
    pub fn unsynced(&self) -> usize {
        self.unsynced
    }
}

impl Write for StoppableFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.unsynced += written;
        if self.unsynced > SYNC {
            self.unsynced = 0;
            self.file.flush()?;
            self.file.0.get_ref().as_file().sync_data()?;
        }
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for StoppableFile<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.0.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    #[test]
    fn a_stop_is_distinguished_from_a_disk_error_even_when_wrapped() {
        let failure = |cause| {
            let path = PathBuf::new();
            Failure::File(FileError::Write { path, cause })
        };
        let stopped = || io::Error::other(WriteStopped);
        assert!(was_stopped(&failure(stopped())));
        assert!(was_stopped(&failure(io::Error::other(stopped()))));
        let packed = zip::result::ZipError::Io(stopped());
        assert!(was_stopped(&failure(io::Error::other(packed))));
        let full = || io::Error::from(io::ErrorKind::StorageFull);
        assert!(!was_stopped(&failure(full())));
        assert!(!was_stopped(&failure(io::Error::other(full()))));
    }
}
