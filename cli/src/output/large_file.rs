//! Large files, whose writing is given up if the user asks to stop.

use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use pellicle_files::partial::{self, PartialFile};
use pellicle_files::whole::{BUFFER, Existing, write_whole};

use super::stoppable::StoppableFile;
use crate::failure::Failure;

/// Writes a file as [`write_whole`] does, but gives it up if the user asks to stop.
///
/// # Errors
///
/// [`Failure::File`] if any of that fails or is stopped; nothing is left behind then.
pub fn write_stoppable(
    path: &Path,
    write: impl FnOnce(&mut StoppableFile<'_>) -> io::Result<()>,
) -> Result<(), Failure> {
    Ok(write_whole(path, |file| {
        write(&mut StoppableFile::new(file))
    })?)
}

/// A large file written in several parts. It appears once it is finished; nothing is left of one that is dropped
/// before. Writing is given up if the user asks to stop.
pub struct LongFile {
    file: PartialFile,
    /// Number of bytes not yet forced onto the disk.
    unsynced: usize,
    path: PathBuf,
}

impl LongFile {
    /// Begins a file under a temporary name beside its final one.
    ///
    /// # Errors
    ///
    /// [`Failure::File`] if it cannot be created.
    pub fn begin(path: &Path) -> Result<Self, Failure> {
        let file = partial::begin(path).map_err(|cause| Failure::write(path, cause))?;
        Ok(Self {
            file: BufWriter::with_capacity(BUFFER, file),
            unsynced: 0,
            path: path.to_owned(),
        })
    }

    /// Continues writing.
    ///
    /// # Errors
    ///
    /// [`Failure::File`] if it fails or is stopped.
    pub fn append(
        &mut self,
        write: impl FnOnce(&mut StoppableFile<'_>) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let mut file = StoppableFile::resuming(&mut self.file, self.unsynced);
        let written = write(&mut file);
        self.unsynced = file.unsynced();
        written.map_err(|cause| Failure::write(&self.path, cause))
    }

    /// Renames the file once it is on the disk.
    ///
    /// # Errors
    ///
    /// [`Failure::File`] if that fails; nothing is left behind then.
    pub fn finish(self) -> Result<(), Failure> {
        let Self { file, path, .. } = self;
        let place = || {
            let file = file.into_inner()?;
            file.as_file().sync_all()?;
            file.place(&path, Existing::Replace)
        };
        place().map_err(|cause| Failure::write(&path, cause))
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::{Seek, SeekFrom, Write};

    use super::*;

    #[test]
    fn a_long_file_appears_when_finished_and_an_abandoned_one_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let [path, other] = ["a.txt", "b.txt"].map(|name| folder.path().join(name));
        let mut file = LongFile::begin(&path).unwrap();
        file.append(|file| file.write_all(b"half")).unwrap();
        file.append(|file| {
            file.seek(SeekFrom::Start(0))?;
            file.write_all(b"Half and half")
        })
        .unwrap();
        assert!(!path.exists());
        file.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "Half and half");
        let mut given_up = LongFile::begin(&other).unwrap();
        given_up.append(|file| file.write_all(b"half")).unwrap();
        drop(given_up);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
