//! A folder of files, one for each value of any type that serde can write.
//!
//! A file holds the BLAKE3 hash of its key and its payload, then the payload in postcard's format, which keeps every
//! bit of an `f64`. It is written under a temporary name and renamed, so that a reader sees all of it or nothing,
//! whatever other threads and processes do at the same time.

use std::fs::{self, DirEntry, File, Metadata};
use std::io::{self, BufReader, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use blake3::{Hash, Hasher, OUT_LEN};
use pellicle_files::whole::Existing;
use pellicle_files::{disk, partial};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::report::{CacheWarning, Usage};

/// Suffix of the names of complete files.
const EXTENSION: &str = ".pellicle";

/// Bytes read and hashed at a time: BLAKE3 is half as fast on blocks of a few thousand.
const BUFFER: usize = 1 << 18;

/// Bytes of the widest number.
const WIDEST: usize = 8;

/// Bytes that a file may have in addition to those of its numbers.
const OVERHEAD: usize = 1 << 10;

/// The files of one folder, by key.
#[derive(Debug)]
pub(super) struct Disk {
    path: PathBuf,
    /// Set by the first write that fails; nothing is written after that.
    refused: AtomicBool,
    /// Bytes that may still be written.
    allowance: AtomicU64,
}

impl Disk {
    /// A folder to which at most so many bytes are written.
    pub(super) fn new(path: PathBuf, allowance: u64) -> Self {
        Self {
            path,
            refused: AtomicBool::new(false),
            allowance: AtomicU64::new(allowance),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The value of a key, of at most `bytes` bytes; `None` if there is no file.
    pub(super) fn read<T: DeserializeOwned>(
        &self,
        key: &Hash,
        bytes: usize,
    ) -> Result<Option<T>, CacheWarning> {
        let path = self.file(key);
        match read(&path, key, bytes + OVERHEAD) {
            Ok(value) => Ok(Some(value)),
            Err(error) => match error.kind() {
                // If there is a file in the folder's place, writing will report it.
                ErrorKind::NotFound | ErrorKind::NotADirectory => Ok(None),
                ErrorKind::InvalidData | ErrorKind::UnexpectedEof => {
                    Err(CacheWarning::Damaged { path })
                }
                kind => Err(CacheWarning::Unreadable { path, kind }),
            },
        }
    }

    /// Keeps a value, unless an earlier write failed or the allowance does not suffice.
    pub(super) fn write<T: Serialize>(&self, key: &Hash, value: &T) -> Result<(), CacheWarning> {
        if self.refused.load(Ordering::Relaxed) {
            return Ok(());
        }
        self.write_whole(key, value).map_err(|error| {
            self.refused.store(true, Ordering::Relaxed);
            CacheWarning::Folder {
                path: self.path.clone(),
                kind: error.kind(),
            }
        })
    }

    /// Does not wait for the disk: the checksum reveals a file truncated by a power failure.
    fn write_whole<T: Serialize>(&self, key: &Hash, value: &T) -> io::Result<()> {
        let payload = postcard::to_stdvec(value).map_err(io::Error::other)?;
        let left = |allowance: u64| allowance.checked_sub((OUT_LEN + payload.len()) as u64);
        let allowed = (self.allowance).fetch_update(Ordering::Relaxed, Ordering::Relaxed, left);
        if allowed.is_err() {
            return Ok(());
        }
        let checksum = checksum_of(key).update(&payload).finalize();
        disk::create_dir_all(&self.path)?;
        let path = self.file(key);
        let mut file = partial::begin(&path)?;
        file.write_all(checksum.as_bytes())?;
        file.write_all(&payload)?;
        // Another process may have cleared the cache in the meantime.
        unless_missing(file.place(&path, Existing::Replace)).map(drop)
    }

    /// The number and the size of the cache's own files.
    pub(super) fn usage(&self) -> io::Result<Usage> {
        let mut usage = Usage::default();
        for (_, metadata) in self.own_files()? {
            usage.add(metadata.len());
        }
        Ok(usage)
    }

    /// Removes the cache's own files and returns their number and size.
    pub(super) fn clear(&self) -> io::Result<Usage> {
        let mut usage = Usage::default();
        for (path, metadata) in self.own_files()? {
            if unless_missing(disk::remove_file(&path))?.is_some() {
                usage.add(metadata.len());
            }
        }
        Ok(usage)
    }

    fn own_files(&self) -> io::Result<Vec<(PathBuf, Metadata)>> {
        let Some(entries) = unless_missing(fs::read_dir(&self.path))? else {
            return Ok(Vec::new());
        };
        let mut own = Vec::new();
        for entry in entries {
            let entry = entry?;
            if !is_own(&entry) {
                continue;
            }
            if let Some(metadata) = unless_missing(entry.metadata())?.filter(Metadata::is_file) {
                own.push((entry.path(), metadata));
            }
        }
        Ok(own)
    }

    fn file(&self, key: &Hash) -> PathBuf {
        self.path.join(format!("{}{EXTENSION}", key.to_hex()))
    }
}

/// The value in a file of at most `longest` bytes. The file is never held in memory as a whole.
fn read<T: DeserializeOwned>(path: &Path, key: &Hash, longest: usize) -> io::Result<T> {
    let metadata = fs::metadata(path)?;
    // A pipe would never end.
    if !metadata.is_file() || metadata.len() > longest as u64 {
        return Err(ErrorKind::InvalidData.into());
    }
    let mut file = File::open(path)?;
    let mut checksum = [0; OUT_LEN];
    file.read_exact(&mut checksum)?;
    let hashed = Hashed {
        source: file,
        hasher: checksum_of(key),
    };
    let mut payload = BufReader::with_capacity(BUFFER, hashed);
    let mut number = [0; WIDEST];
    let value = postcard::from_io((&mut payload, &mut number)).map(|(value, _)| value);
    // The decoder stops at the first invalid byte.
    io::copy(&mut payload, &mut io::sink())?;
    let is_whole = payload.get_ref().hasher.finalize() == checksum;
    match value {
        Ok(value) if is_whole => Ok(value),
        _ => Err(ErrorKind::InvalidData.into()),
    }
}

/// The start of a checksum. It includes the key, so that a file under another file's name is detected.
fn checksum_of(key: &Hash) -> Hasher {
    let mut hasher = Hasher::new();
    hasher.update(key.as_bytes());
    hasher
}

/// A reader that hashes its bytes as they are read.
struct Hashed<R> {
    source: R,
    hasher: Hasher,
}

impl<R: Read> Read for Hashed<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(bytes)?;
        self.hasher.update(&bytes[..count]);
        Ok(count)
    }
}

fn unless_missing<T>(result: io::Result<T>) -> io::Result<Option<T>> {
    match result {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        result => result.map(Some),
    }
}

/// Whether a file has one of the cache's names.
fn is_own(entry: &DirEntry) -> bool {
    let name = entry.file_name();
    let Some(name) = name.to_str() else {
        return false;
    };
    let is_key = |stem: &str| {
        let digit = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
        stem.len() == 2 * OUT_LEN && stem.bytes().all(digit)
    };
    name.strip_suffix(EXTENSION).is_some_and(is_key) || partial::is_partial(name)
}

#[cfg(test)]
mod tests {
    use super::{BUFFER, CacheWarning, Disk, Hash};

    fn key() -> Hash {
        blake3::hash(b"a")
    }

    fn bits(values: &[f64]) -> Vec<u64> {
        values.iter().map(|value| value.to_bits()).collect()
    }

    /// A folder with one value, of several buffers.
    fn filled() -> (tempfile::TempDir, Disk, Vec<f64>) {
        let folder = tempfile::tempdir().unwrap();
        let disk = Disk::new(folder.path().to_owned(), u64::MAX);
        let mut values = vec![-0.0, f64::MIN_POSITIVE / 8.0, 0.1, -f64::MAX, f64::INFINITY];
        values.extend((0..BUFFER / 4).map(|i| 1.0 / (i + 3) as f64));
        disk.write(&key(), &values).unwrap();
        (folder, disk, values)
    }

    #[test]
    fn values_are_read_back_to_the_bit() {
        let (_folder, disk, values) = filled();
        let found: Vec<f64> = disk.read(&key(), 8 * values.len()).unwrap().unwrap();
        assert_eq!(bits(&found), bits(&values));
        let nothing: Option<Vec<f64>> = disk.read(&blake3::hash(b"b"), 0).unwrap();
        assert_eq!(nothing, None);
    }

    #[test]
    fn a_file_too_long_for_its_value_is_refused() {
        let (_folder, disk, values) = filled();
        let found = disk.read::<Vec<f64>>(&key(), 4 * values.len());
        assert!(matches!(found, Err(CacheWarning::Damaged { .. })));
    }

    #[test]
    fn no_more_is_written_than_allowed() {
        let folder = tempfile::tempdir().unwrap();
        let disk = Disk::new(folder.path().to_owned(), 2000);
        for number in 0..9_u8 {
            disk.write(&blake3::hash(&[number]), &vec![1.0; 100])
                .unwrap();
        }
        // 800 bytes of numbers, 32 of a checksum and a few of a length each.
        let usage = disk.usage().unwrap();
        assert_eq!((usage.files, usage.bytes / 100), (2, 16));
    }

    #[test]
    fn a_payload_of_another_type_is_refused() {
        let (_folder, disk, values) = filled();
        let found = disk.read::<(bool, bool, Vec<f64>)>(&key(), 8 * values.len());
        assert!(matches!(found, Err(CacheWarning::Damaged { .. })));
    }
}
