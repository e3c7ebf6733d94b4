//! Files that are there whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Bytes that are handed to the system at once: a curve's folder takes 4,000 calls instead of 30,000.
const BUFFER: usize = 1 << 17;

/// Writes a file under a temporary name beside it and renames it when it is complete and on the disk.
///
/// # Errors
///
/// [`Failure::Write`] if any of that fails; nothing is left behind then.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), Failure> {
    let partial = partial(path);
    let written = File::create(&partial).and_then(|file| {
        let mut file = BufWriter::with_capacity(BUFFER, file);
        write(&mut file)?;
        file.into_inner()?.sync_all()
    });
    finish(path, &partial, written)
}

/// Lets a library write a file by its path, under a temporary name with the same extension, and renames it.
///
/// # Errors
///
/// [`Failure::Write`] if any of that fails; nothing is left behind then.
pub fn create_whole(
    path: &Path,
    create: impl FnOnce(&Path) -> io::Result<()>,
) -> Result<(), Failure> {
    let partial = partial(path);
    let written = create(&partial);
    finish(path, &partial, written)
}

fn finish(path: &Path, partial: &Path, written: io::Result<()>) -> Result<(), Failure> {
    written
        .and_then(|()| fs::rename(partial, path))
        .map_err(|cause| {
            // Best effort: the error to tell is the first one.
            drop(fs::remove_file(partial));
            let path = path.to_owned();
            Failure::Write { path, cause }
        })
}

/// `.partial-name` beside `name`: hidden, and of the same extension.
fn partial(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".partial-{name}"))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    #[test]
    fn a_file_appears_when_it_is_complete() {
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
    fn a_file_that_fails_leaves_the_old_one_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let full = |_: &mut BufWriter<File>| Err(io::Error::from(io::ErrorKind::StorageFull));
        assert!(write_whole(&path, full).is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
