//! A file under way that stops where the user does not want to wait any longer.

use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};

use crate::interrupt;

/// Bytes after which what is written is put on the disk: the end of a large file would otherwise wait for all of it, deaf to the user.
const SYNC: usize = 1 << 25;

/// Writes until the user has asked to stop and [`interrupt::GRACE`] is over, then fails.
#[derive(Debug)]
pub struct Watched<'a> {
    file: &'a mut BufWriter<File>,
    unsynced: usize,
}

impl<'a> Watched<'a> {
    /// Watches over a file.
    pub fn new(file: &'a mut BufWriter<File>) -> Self {
        Self { file, unsynced: 0 }
    }
}

impl Write for Watched<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if interrupt::is_overdue() {
            return Err(io::Error::other("stopped by the user"));
        }
        self.unsynced += bytes.len();
        if self.unsynced > SYNC {
            self.unsynced = 0;
            self.file.flush()?;
            self.file.get_ref().sync_data()?;
        }
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Watched<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}
