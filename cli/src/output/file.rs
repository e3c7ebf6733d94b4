//! Files that are written completely or not at all. A file has its own random name until it is complete; no existing
//! file is opened.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::partial_file::{self, PartialFile};
use super::stoppable::StoppableFile;
use crate::failure::Failure;
use crate::unfinished::Unfinished;

/// Bytes written per system call: the folder of a curve takes 4,000 calls instead of 30,000.
const BUFFER: usize = 1 << 17;

/// The treatment of an existing file or folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Keep it.
    Keep,
    /// Replace it once the new one is complete.
    Replace,
}

/// Writes a file under a temporary name beside its own and renames it once it is complete and on the disk.
///
/// # Errors
///
/// [`Failure::Write`] if any of that fails; nothing is left behind then.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut PartialFile) -> io::Result<()>,
) -> Result<(), Failure> {
    let durably = |file: &mut PartialFile| {
        write(file)?;
        file.flush()?;
        file.get_ref().as_file().sync_all()
    };
    put(path, Existing::Replace, durably).map_err(|cause| Failure::write(path, cause))
}

/// Writes a large file likewise, but gives it up if the user asks to stop.
///
/// # Errors
///
/// [`Failure::Write`] if any of that fails or is stopped; nothing is left behind then.
pub fn write_stoppable(
    path: &Path,
    write: impl FnOnce(&mut StoppableFile<'_>) -> io::Result<()>,
) -> Result<(), Failure> {
    write_whole(path, |file| write(&mut StoppableFile::new(file)))
}

/// Writes bytes likewise, but without forcing them onto the disk: they can be produced again.
///
/// # Errors
///
/// [`Failure::Write`] if any of that fails; nothing is left behind then.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let written = put(path, Existing::Replace, |file| file.write_all(bytes));
    written.map_err(|cause| Failure::write(path, cause))
}

/// Writes a file likewise that must not exist yet.
///
/// # Errors
///
/// [`Failure::Exists`] if something of that name exists, [`Failure::Write`] if it cannot be written.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let written = put(path, Existing::Keep, |file| file.write_all(bytes));
    written.map_err(|cause| match cause.kind() {
        ErrorKind::AlreadyExists => Failure::Exists {
            path: path.to_owned(),
        },
        _ => Failure::write(path, cause),
    })
}

/// A large file written in several parts. It appears once it is finished; nothing is left of one that is dropped
/// before. Writing is given up if the user asks to stop.
pub struct LongFile {
    file: PartialFile,
    /// Number of bytes not yet forced onto the disk.
    unsynced: usize,
    path: PathBuf,
    _unfinished: Unfinished,
}

impl LongFile {
    /// Begins a file under a temporary name beside its final one.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if it cannot be created.
    pub fn begin(path: &Path) -> Result<Self, Failure> {
        let file = partial_file::begin(path).map_err(|cause| Failure::write(path, cause))?;
        Ok(Self {
            _unfinished: Unfinished::file(file.path()),
            file: BufWriter::with_capacity(BUFFER, file),
            unsynced: 0,
            path: path.to_owned(),
        })
    }

    /// Continues writing.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if it fails or is stopped.
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
    /// [`Failure::Write`] if that fails; nothing is left behind then.
    pub fn finish(self) -> Result<(), Failure> {
        let Self { file, path, .. } = self;
        let place = || {
            let file = file.into_inner()?;
            file.as_file().sync_all()?;
            file.persist(&path).map_err(|failed| failed.error)
        };
        place()
            .map(drop)
            .map_err(|cause| Failure::write(&path, cause))
    }
}

fn put(
    path: &Path,
    existing: Existing,
    write: impl FnOnce(&mut PartialFile) -> io::Result<()>,
) -> io::Result<()> {
    let file = partial_file::begin(path)?;
    let _unfinished = Unfinished::file(file.path());
    let mut file = BufWriter::with_capacity(BUFFER, file);
    write(&mut file)?;
    let file = file.into_inner()?;
    // The file stays open, and thereby locked, until it has its name.
    let placed = match existing {
        Existing::Keep => file.persist_noclobber(path),
        Existing::Replace => file.persist(path),
    };
    placed.map(drop).map_err(|failed| failed.error)
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::{Seek, SeekFrom};

    use super::*;

    #[test]
    fn a_file_appears_only_when_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_whole(&path, |file| {
            file.write_all(b"half")?;
            assert!(!path.exists());
            file.write_all(b" and half")
        })
        .unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "half and half");
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let full = |_: &mut PartialFile| Err(io::Error::from(ErrorKind::StorageFull));
        assert!(write_whole(&path, full).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

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

    #[test]
    fn a_new_file_never_replaces_an_existing_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_new(&path, b"mine").unwrap();
        let again = write_new(&path, b"other");
        assert!(matches!(again, Err(Failure::Exists { .. })));
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    }

    #[test]
    fn partial_files_of_dead_processes_are_removed_and_those_of_live_ones_kept() {
        let folder = tempfile::tempdir().unwrap();
        let left = folder.path().join(".pellicle-left.partial");
        fs::write(&left, "half").unwrap();
        fs::write(folder.path().join(".pellicle-notes"), "mine").unwrap();
        write_whole(&folder.path().join("a.txt"), |file| {
            partial_file::sweep(folder.path());
            file.write_all(b"whole")
        })
        .unwrap();
        assert!(!left.exists());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_replaced_rather_than_followed_and_the_umask_applies() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let [other, path] = ["other", "a.txt"].map(|name| folder.path().join(name));
        fs::write(&other, "other").unwrap();
        symlink("other", &path).unwrap();
        write_bytes(&path, b"mine").unwrap();
        assert_eq!(fs::read_to_string(&other).unwrap(), "other");
        let mode = |path: &Path| fs::symlink_metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&path), mode(&other));
    }
}
