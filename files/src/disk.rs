//! Every change of the disk that the program makes. The calls are those of `std::fs`, except that a test may
//! [refuse](crate::refusal) any of them.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::refusal::Verdict;

/// Asks for a change that a call elsewhere makes.
///
/// # Errors
///
/// The refusal of a test.
pub fn allowed(path: &Path) -> io::Result<()> {
    Verdict::at(path).allowed()
}

/// As [`fs::create_dir`].
///
/// # Errors
///
/// An error of the system.
pub fn create_dir(path: &Path) -> io::Result<()> {
    allowed(path)?;
    fs::create_dir(path)
}

/// As [`fs::create_dir_all`].
///
/// # Errors
///
/// An error of the system.
pub fn create_dir_all(path: &Path) -> io::Result<()> {
    allowed(path)?;
    fs::create_dir_all(path)
}

/// As [`fs::rename`].
///
/// # Errors
///
/// An error of the system.
pub fn rename(from: &Path, to: &Path) -> io::Result<()> {
    allowed(to)?;
    fs::rename(from, to)
}

/// As [`fs::hard_link`].
///
/// # Errors
///
/// An error of the system.
pub fn hard_link(original: &Path, link: &Path) -> io::Result<()> {
    allowed(link)?;
    fs::hard_link(original, link)
}

/// As [`fs::set_permissions`].
///
/// # Errors
///
/// An error of the system.
pub fn set_permissions(path: &Path, permissions: Permissions) -> io::Result<()> {
    allowed(path)?;
    fs::set_permissions(path, permissions)
}

/// As [`fs::remove_file`].
///
/// # Errors
///
/// An error of the system.
pub fn remove_file(path: &Path) -> io::Result<()> {
    allowed(path)?;
    fs::remove_file(path)
}

/// As [`fs::remove_dir`].
///
/// # Errors
///
/// An error of the system.
pub fn remove_dir(path: &Path) -> io::Result<()> {
    allowed(path)?;
    fs::remove_dir(path)
}

/// As [`fs::remove_dir_all`].
///
/// # Errors
///
/// An error of the system.
pub fn remove_dir_all(path: &Path) -> io::Result<()> {
    allowed(path)?;
    fs::remove_dir_all(path)
}

/// A file open for writing.
#[derive(Debug)]
pub struct DiskFile {
    file: File,
    path: PathBuf,
}

impl DiskFile {
    /// Creates a file where none exists, open for reading too.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn create_new(path: &Path) -> io::Result<Self> {
        allowed(path)?;
        let mut options = OpenOptions::new();
        Self::opened(path, options.read(true).write(true).create_new(true))
    }

    /// Opens an existing file for reading and writing.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn open(path: &Path) -> io::Result<Self> {
        Self::opened(path, OpenOptions::new().read(true).write(true))
    }

    /// Opens a file for reading and appending, and creates it if it is missing.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn append(path: &Path) -> io::Result<Self> {
        allowed(path)?;
        let mut options = OpenOptions::new();
        Self::opened(path, options.read(true).append(true).create(true))
    }

    fn opened(path: &Path, options: &OpenOptions) -> io::Result<Self> {
        Ok(Self {
            file: options.open(path)?,
            path: path.to_owned(),
        })
    }

    /// The file of the system, for reading and locking.
    #[must_use]
    pub fn as_file(&self) -> &File {
        &self.file
    }

    /// The file of the system alone.
    #[must_use]
    pub fn into_file(self) -> File {
        self.file
    }

    /// As [`File::set_len`].
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn set_len(&self, length: u64) -> io::Result<()> {
        allowed(&self.path)?;
        self.file.set_len(length)
    }

    /// As [`File::sync_all`].
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn sync_all(&self) -> io::Result<()> {
        allowed(&self.path)?;
        self.file.sync_all()
    }

    /// As [`File::sync_data`].
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn sync_data(&self) -> io::Result<()> {
        allowed(&self.path)?;
        self.file.sync_data()
    }

    /// As [`File::try_clone`].
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn try_clone(&self) -> io::Result<Self> {
        Ok(Self {
            file: self.file.try_clone()?,
            path: self.path.clone(),
        })
    }
}

impl Read for DiskFile {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.file.read(bytes)
    }
}

impl Write for DiskFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let verdict = Verdict::at(&self.path);
        if verdict == Verdict::Torn {
            self.file.write_all(&bytes[..bytes.len() / 2])?;
        }
        verdict.allowed()?;
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for DiskFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::refusal::Refusal;

    #[test]
    fn the_refused_write_reaches_the_disk_by_half_and_changes_elsewhere_are_free() {
        let [folder, other] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        let path = folder.path().canonicalize().unwrap().join("a");
        let refusal = Refusal::of(folder.path(), 2..4).unwrap();
        let mut file = DiskFile::create_new(&path).unwrap();
        file.write_all(b"1234").unwrap();
        for _ in 0..2 {
            assert!(file.write_all(b"5678").is_err());
        }
        assert_eq!(fs::read(&path).unwrap(), b"123456");
        file.write_all(b"9").unwrap();
        assert_eq!(refusal.changes(), 5);
        create_dir(&other.path().join("b")).unwrap();
        assert_eq!(refusal.changes(), 5);
        drop(refusal);
        remove_file(&path).unwrap();
    }
}
