//! An archive of arrays for `numpy.load`.

use std::cell::Cell;
use std::io::{self, Seek, SeekFrom, Write};
use std::rc::Rc;

use ndarray_npy::{WriteNpyExt, WriteNpzError};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::stoppable::StoppableWriter;

/// Level of compression, from 1 to 9. The usual level 6 makes files 13 % smaller in three times the time; compression
/// took 13 % of the run of a curve.
const EFFORT: i64 = 1;

/// An archive being written.
///
/// The library completes an archive that is dropped, and prints to standard error if that fails. So after a failure,
/// which the caller is told, the rest goes nowhere.
pub struct NpzArchive<W: Write + Seek> {
    zip: ZipWriter<Abandonable<W>>,
    is_abandoned: Rc<Cell<bool>>,
}

impl<W: Write + Seek> NpzArchive<W> {
    /// Begins an archive.
    pub fn new(file: W) -> Self {
        let is_abandoned = Rc::new(Cell::new(false));
        let zip = ZipWriter::new(Abandonable {
            file,
            position: 0,
            end: 0,
            is_abandoned: Rc::clone(&is_abandoned),
        });
        Self { zip, is_abandoned }
    }

    /// Adds an array.
    ///
    /// # Errors
    ///
    /// [`WriteNpzError`] if it cannot be written.
    pub fn add(&mut self, name: &str, array: &impl WriteNpyExt) -> Result<(), WriteNpzError> {
        let added = self.try_add(name, array);
        if added.is_err() {
            self.is_abandoned.set(true);
        }
        added
    }

    fn try_add(&mut self, name: &str, array: &impl WriteNpyExt) -> Result<(), WriteNpzError> {
        let packed = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
        let packed = packed.compression_level(Some(EFFORT));
        self.zip.start_file(format!("{name}.npy"), packed)?;
        // An array that compresses to almost nothing could otherwise not be stopped before its end.
        array.write_npy(StoppableWriter(&mut self.zip))?;
        Ok(())
    }

    /// Completes the archive.
    ///
    /// # Errors
    ///
    /// [`WriteNpzError`] if it cannot be written.
    pub fn finish(self) -> Result<(), WriteNpzError> {
        self.zip.finish()?;
        Ok(())
    }
}

/// A file that takes everything and keeps nothing once it is abandoned, which its first failure does.
struct Abandonable<W> {
    file: W,
    /// The position at which the next byte would be.
    position: u64,
    /// The farthest position so far. A file that is abandoned stands there: the library, which has gone back to write a
    /// header, assumes that it is at the end of its data.
    end: u64,
    is_abandoned: Rc<Cell<bool>>,
}

impl<W> Abandonable<W> {
    /// Passes on the result of an action on the file; a failure abandons it.
    fn told<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        let is_failure = |error: &io::Error| error.kind() != io::ErrorKind::Interrupted;
        if result.as_ref().is_err_and(is_failure) {
            self.is_abandoned.set(true);
            self.position = self.end;
        }
        result
    }

    fn move_to(&mut self, position: u64) {
        self.position = position;
        self.end = self.end.max(position);
    }
}

impl<W: Write> Write for Abandonable<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = if self.is_abandoned.get() {
            bytes.len()
        } else {
            let written = self.file.write(bytes);
            self.told(written)?
        };
        self.move_to(self.position + written as u64);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.is_abandoned.get() {
            return Ok(());
        }
        let flushed = self.file.flush();
        self.told(flushed)
    }
}

impl<W: Seek> Seek for Abandonable<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let position = if self.is_abandoned.get() {
            match to {
                SeekFrom::Start(position) => position,
                SeekFrom::Current(by) | SeekFrom::End(by) => {
                    self.position.saturating_add_signed(by)
                }
            }
        } else {
            let sought = self.file.seek(to);
            self.told(sought)?
        };
        self.move_to(position);
        Ok(position)
    }
}

#[cfg(test)]
mod tests {
    use ndarray::Array1;

    use super::*;

    /// A file on a disk with space for this many bytes.
    struct Full(io::Cursor<Vec<u8>>, usize);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if self.0.get_ref().len() + bytes.len() > self.1 {
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.0.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.0.seek(to)
        }
    }

    #[test]
    fn an_archive_that_cannot_be_written_fails_once_and_completes_nowhere() {
        let array: Array1<f64> = (0..1000).map(|i| f64::from(i).sin()).collect();
        let write = |space| {
            let mut archive = NpzArchive::new(Full(io::Cursor::default(), space));
            let is_abandoned = Rc::clone(&archive.is_abandoned);
            let added = archive.add("x", &array);
            let written = added.and_then(|()| archive.add("y", &array));
            let written = written.and_then(|()| archive.finish());
            (written.is_err(), is_abandoned.get())
        };
        // From nothing to all of it but the last bytes.
        let whole = (0..1000).find(|blocks| !write(100 * blocks).0).unwrap();
        assert!(whole > 100);
        for blocks in (0..whole).step_by(7).chain([whole - 1]) {
            assert_eq!(write(100 * blocks), (true, true), "{blocks}");
        }
        assert_eq!(write(100 * whole), (false, false));
    }

    /// A file of which one call fails, and no other.
    struct Failing {
        file: io::Cursor<Vec<u8>>,
        calls: Rc<Cell<usize>>,
        fails_at: usize,
    }

    impl Failing {
        fn call(&self) -> io::Result<()> {
            let call = self.calls.replace(self.calls.get() + 1);
            if call == self.fails_at {
                return Err(io::ErrorKind::StorageFull.into());
            }
            Ok(())
        }
    }

    impl Write for Failing {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.call()?;
            self.file.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            self.call()
        }
    }

    impl Seek for Failing {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.call()?;
            self.file.seek(to)
        }
    }

    #[test]
    fn an_archive_survives_the_failure_of_any_call() {
        let array = Array1::from_elem(10, 1.0);
        let calls = Rc::new(Cell::new(0));
        let fails = |fails_at| {
            calls.set(0);
            let file = io::Cursor::default();
            let calls = Rc::clone(&calls);
            let mut archive = NpzArchive::new(Failing {
                file,
                calls,
                fails_at,
            });
            let added = archive.add("x", &array);
            let added = added.and_then(|()| archive.add("y", &array));
            added.and_then(|()| archive.finish()).is_err()
        };
        assert!(!fails(usize::MAX));
        let all = calls.get();
        assert!(all > 20, "{all}");
        let survived = (0..all).filter(|call| !fails(*call)).count();
        assert_eq!(survived, 0);
    }
}
