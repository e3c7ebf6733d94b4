//! Files that are written completely or not at all. A file has its own random name until it is complete; no existing
//! file is opened.

use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use crate::FileError;
use crate::partial::{self, PartialFile};

/// Bytes written per system call: the folder of a curve takes 4,000 calls instead of 30,000.
pub const BUFFER: usize = 1 << 17;

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
/// [`FileError::Write`] if any of that fails; nothing is left behind then.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut PartialFile) -> io::Result<()>,
) -> Result<(), FileError> {
    let durably = |file: &mut PartialFile| {
        write(file)?;
        file.flush()?;
        file.get_ref().as_file().sync_all()
    };
    put(path, Existing::Replace, durably).map_err(|cause| FileError::write(path, cause))
}

/// Writes bytes likewise, but without forcing them onto the disk: they can be produced again.
///
/// # Errors
///
/// [`FileError::Write`] if any of that fails; nothing is left behind then.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let written = put(path, Existing::Replace, |file| file.write_all(bytes));
    written.map_err(|cause| FileError::write(path, cause))
}

/// Writes a file likewise that must not exist yet.
///
/// # Errors
///
/// [`FileError::Exists`] if something of that name exists, [`FileError::Write`] if it cannot be written.
pub fn write_new(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let written = put(path, Existing::Keep, |file| file.write_all(bytes));
    written.map_err(|cause| match cause.kind() {
        ErrorKind::AlreadyExists => FileError::Exists {
            path: path.to_owned(),
        },
        _ => FileError::write(path, cause),
    })
}

fn put(
    path: &Path,
    existing: Existing,
    write: impl FnOnce(&mut PartialFile) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = BufWriter::with_capacity(BUFFER, partial::begin(path)?);
    write(&mut file)?;
    file.into_inner()?.place(path, existing)
}

#[cfg(test)]
mod tests {
    use std::fs;

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
    fn a_new_file_never_replaces_an_existing_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_new(&path, b"mine").unwrap();
        let again = write_new(&path, b"other");
        assert!(matches!(again, Err(FileError::Exists { .. })));
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    }

    #[test]
    fn partial_files_of_dead_processes_are_removed_and_those_of_live_ones_kept() {
        let folder = tempfile::tempdir().unwrap();
        let left = folder.path().join(".pellicle-left.partial");
        fs::write(&left, "half").unwrap();
        fs::write(folder.path().join(".pellicle-notes"), "mine").unwrap();
        write_whole(&folder.path().join("a.txt"), |file| {
            partial::sweep(folder.path());
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
