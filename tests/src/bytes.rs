//! Damaged files before every reader of the program: each ends with a value, or with one sentence that says where the
//! fault is, in bounded time and without a panic.

pub mod mutation;
pub mod readers;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use tempfile::TempDir;

/// The most bytes of a sentence: room for the path of a file, and for the keys allowed in its place.
const LONGEST_SENTENCE: usize = 4000;

/// Time after which a reader hangs: thousands of times what the slowest takes, so that a busy machine does not matter.
const LONGEST_TIME: Duration = Duration::from_secs(20);

/// A reader of files.
#[derive(Debug, Clone, Copy)]
pub struct Reader {
    /// What it reads.
    pub name: &'static str,
    /// Writes what it needs into a folder.
    prepare: fn(&Path) -> SoundFile,
    /// Reads from the folder; an error is the sentence that the user sees.
    read: fn(&Path) -> Result<(), String>,
}

/// The file that is damaged, in the folder of a reader.
#[derive(Debug)]
struct SoundFile {
    path: PathBuf,
    /// What it may contain when it is not damaged.
    contents: Vec<Vec<u8>>,
}

/// A reader with a folder of its own.
#[derive(Debug)]
pub struct Bench {
    reader: Reader,
    folder: TempDir,
    file: SoundFile,
}

impl Bench {
    /// Prepares a reader.
    ///
    /// # Panics
    ///
    /// If it does not read its file when that is sound.
    #[must_use]
    pub fn new(reader: Reader) -> Self {
        let folder = tempfile::tempdir().expect("a folder for temporary files");
        let file = (reader.prepare)(folder.path());
        let bench = Self {
            reader,
            folder,
            file,
        };
        for content in bench.contents() {
            let read = bench.read(content);
            assert!(read.is_ok(), "{}, sound: {read:?}", reader.name);
        }
        bench
    }

    /// What the file may contain when it is not damaged.
    #[must_use]
    pub fn contents(&self) -> &[Vec<u8>] {
        &self.file.contents
    }

    /// Reads these bytes in the place of the file.
    ///
    /// # Errors
    ///
    /// The sentence of the reader.
    fn read(&self, bytes: &[u8]) -> Result<(), String> {
        // A new file: some file systems force one that is written over onto the disk.
        drop(fs::remove_file(&self.file.path));
        fs::write(&self.file.path, bytes).map_err(|cause| cause.to_string())?;
        (self.reader.read)(self.folder.path())
    }

    /// Reads these bytes in the place of the file, and returns whether they have a value.
    ///
    /// # Panics
    ///
    /// If the reader does, if it takes too long, or if its error is not one sentence that names the place.
    #[must_use]
    pub fn has_value(&self, bytes: &[u8]) -> bool {
        let start = Instant::now();
        let read = self.read(bytes);
        let time = start.elapsed();
        assert!(time < LONGEST_TIME, "{}: {time:?}", self.reader.name);
        let Err(sentence) = read else {
            return true;
        };
        let is_short = !sentence.is_empty() && sentence.len() < LONGEST_SENTENCE;
        // A tab is shown as it is; a line end would make two sentences of one.
        let is_one = is_short && !sentence.contains(|c: char| c.is_control() && c != '\t');
        assert!(is_one, "{}: {sentence:?}", self.reader.name);
        // The file itself, or one that it names.
        let name = self.file.path.file_name().unwrap_or_default();
        let places = [self.folder.path().as_os_str(), name].map(|place| place.to_string_lossy());
        let is_placed = places.iter().any(|place| sentence.contains(&**place));
        assert!(is_placed, "{}: no place in: {sentence}", self.reader.name);
        false
    }
}
