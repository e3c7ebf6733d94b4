//! Writing that stops when the user does not want to wait any longer.

use std::error::Error;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use super::partial_file::PartialFile;
use crate::failure::Failure;
use crate::interrupt;

/// Bytes after which what is written is put on the disk: otherwise the end of a large file would wait for all of it,
/// and not stop.
const SYNC: usize = 1 << 25;

/// Most bytes that are written or packed between two looks at the user, too few for the user to wait.
const CHUNK: usize = 1 << 20;

/// The cause of a file that was stopped.
#[derive(Debug, thiserror::Error)]
#[error("stopped by the user")]
struct WriteStopped;

/// Whether a file was stopped half way, which is no failure.
#[must_use]
pub fn was_stopped(failure: &Failure) -> bool {
    let Failure::Write { cause, .. } = failure else {
        return false;
    };
    let mut error = cause.get_ref().map(|inner| inner as &(dyn Error + 'static));
    while let Some(found) = error {
        if found.is::<WriteStopped>() {
            return true;
        }
        let within = found
            .downcast_ref::<io::Error>()
            .and_then(io::Error::get_ref);
        error = within
            .map(|inner| inner as &(dyn Error + 'static))
            .or_else(|| found.source());
    }
    false
}

/// Stops before a file is begun.
///
/// # Errors
///
/// [`Failure::Write`] if the user does not want to wait any longer.
pub fn check(path: &Path) -> Result<(), Failure> {
    if !interrupt::is_overdue() {
        return Ok(());
    }
    Err(Failure::write(path, io::Error::other(WriteStopped)))
}

/// Hands bytes on until the user has asked to stop and [`interrupt::GRACE`] is over, then fails.
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

/// The same for a file, which is put on the disk part by part.
#[derive(Debug)]
pub struct StoppableFile<'a> {
    file: StoppableWriter<&'a mut PartialFile>,
    unsynced: usize,
}

impl<'a> StoppableFile<'a> {
    /// A file that can be stopped.
    pub fn new(file: &'a mut PartialFile) -> Self {
        Self::going_on(file, 0)
    }

    /// The same where so many bytes are not on the disk yet.
    pub fn going_on(file: &'a mut PartialFile, unsynced: usize) -> Self {
        Self {
            file: StoppableWriter(file),
            unsynced,
        }
    }

    /// Bytes that are not on the disk yet.
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
    fn a_stop_is_told_from_a_disk_that_fails_however_it_is_wrapped() {
        let failure = |cause| Failure::Write {
            path: PathBuf::new(),
            cause,
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
