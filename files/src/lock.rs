//! A process's lock on a folder: a file locked by the system, which releases it when the process dies.

use std::fs::{self, File, Metadata, TryLockError};
use std::io::{self, ErrorKind, Read, Write};
use std::path::Path;

use crate::disk::DiskFile;
use crate::unfinished::Unfinished;

/// Attempts to take a lock whose file another process may remove meanwhile.
const ATTEMPTS: usize = 1000;

/// A lock, released and removed when it is dropped.
#[derive(Debug)]
pub struct Lock {
    // Removed before the file is closed and thereby unlocked.
    _unfinished: Unfinished,
    file: DiskFile,
    /// Text of the file that a dead process left.
    found: Option<String>,
}

impl Lock {
    /// Takes the lock and writes a text into its file; none if another process holds it. On a file system without
    /// locks, no process ever holds it.
    ///
    /// # Errors
    ///
    /// An error of the system if the file cannot be created or is not a file.
    pub fn take(path: &Path, text: &str) -> io::Result<Option<Self>> {
        for _ in 0..ATTEMPTS {
            let (file, is_new) = match open(path) {
                // Removed between the two attempts to open it.
                Err(error) if error.kind() == ErrorKind::NotFound && path_is_in_folder(path) => {
                    continue;
                }
                opened => opened?,
            };
            if matches!(file.as_file().try_lock(), Err(TryLockError::WouldBlock)) {
                return Ok(None);
            }
            if !is_at(file.as_file(), path) {
                continue;
            }
            let mut lock = Self {
                _unfinished: Unfinished::file(path),
                file,
                found: None,
            };
            lock.begin(is_new, text)?;
            return Ok(Some(lock));
        }
        Ok(None)
    }

    /// Whether a process holds the lock.
    #[must_use]
    pub fn is_held(path: &Path) -> bool {
        let file = File::open(path);
        file.is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }

    /// Text of the file that a dead process left; none if there was no such file.
    #[must_use]
    pub fn found(&self) -> Option<&str> {
        self.found.as_deref()
    }

    fn begin(&mut self, is_new: bool, text: &str) -> io::Result<()> {
        if is_new {
            return self.file.write_all(text.as_bytes());
        }
        let mut found = Vec::new();
        self.file.as_file().take(4096).read_to_end(&mut found)?;
        self.found = Some(String::from_utf8_lossy(&found).into_owned());
        Ok(())
    }
}

/// Opens or creates the file; returns whether it is new. A link is not followed.
fn open(path: &Path) -> io::Result<(DiskFile, bool)> {
    match DiskFile::create_new(path) {
        Ok(file) => Ok((file, true)),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            if !fs::symlink_metadata(path)?.is_file() {
                return Err(error);
            }
            Ok((DiskFile::open(path)?, false))
        }
        Err(error) => Err(error),
    }
}

fn path_is_in_folder(path: &Path) -> bool {
    path.parent().is_some_and(Path::is_dir)
}

/// Whether the open file is still the one at the path; another process removes it when it is done.
#[must_use]
pub fn is_at(file: &File, path: &Path) -> bool {
    let both = file
        .metadata()
        .and_then(|a| Ok((a, fs::symlink_metadata(path)?)));
    both.is_ok_and(|(a, b)| are_one(&a, &b))
}

#[cfg(unix)]
fn are_one(a: &Metadata, b: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

/// On this system an open file cannot be removed.
#[cfg(not(unix))]
fn are_one(_: &Metadata, b: &Metadata) -> bool {
    b.is_file()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_has_one_holder_and_leaves_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        let first = Lock::take(&path, "first").unwrap().unwrap();
        assert_eq!(first.found(), None);
        assert!(Lock::take(&path, "second").unwrap().is_none());
        drop(first);
        assert!(!path.exists());
        assert!(Lock::take(&path, "third").unwrap().is_some());
    }

    #[test]
    fn the_lock_of_a_dead_process_is_taken_over_and_a_link_is_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        fs::write(&path, "dead").unwrap();
        let lock = Lock::take(&path, "mine").unwrap().unwrap();
        assert_eq!(lock.found(), Some("dead"));
        drop(lock);
        #[cfg(unix)]
        {
            fs::write(folder.path().join("other"), "other").unwrap();
            std::os::unix::fs::symlink("other", &path).unwrap();
            assert!(Lock::take(&path, "mine").is_err());
        }
    }

    #[test]
    fn of_many_threads_exactly_one_obtains_the_lock() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        let held = std::sync::atomic::AtomicUsize::new(0);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Some(lock) = Lock::take(&path, "").unwrap() {
                            use std::sync::atomic::Ordering::SeqCst;
                            assert_eq!(held.fetch_add(1, SeqCst), 0);
                            held.fetch_sub(1, SeqCst);
                            drop(lock);
                        }
                    }
                });
            }
        });
        assert!(!path.exists());
    }
}
