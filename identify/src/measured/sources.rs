//! The sources of measurements: the files of a folder that match a name or a pattern, and texts that a caller
//! supplies with a fit.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glob::{MatchOptions, Pattern};

/// The largest file that is read, bytes.
const LARGEST_FILE: u64 = 512 << 20;

/// `*` and `?` match part of one name, but neither a folder separator nor the leading dot of a hidden file.
const GLOB: MatchOptions = MatchOptions {
    case_sensitive: true,
    require_literal_separator: true,
    require_literal_leading_dot: true,
};

/// The measurements that a fit file may name as `file`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeasurementSources {
    folder: PathBuf,
    texts: BTreeMap<PathBuf, Arc<str>>,
}

impl MeasurementSources {
    /// The files of a folder.
    #[must_use]
    pub fn in_folder(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            texts: BTreeMap::new(),
        }
    }

    /// Adds a text under this name, used instead of a file.
    #[must_use]
    pub fn with_text(mut self, name: &str, text: &str) -> Self {
        self.texts.insert(name.into(), text.into());
        self
    }

    /// Returns the measurements of a name or a pattern, in the order of their names: the text if there is one, or else
    /// files.
    #[must_use]
    pub fn of(&self, pattern: &str) -> Vec<PathBuf> {
        match self.texts.get_key_value(Path::new(pattern)) {
            Some((name, _)) => vec![name.clone()],
            None => files(&self.folder, pattern),
        }
    }

    /// Reads the content of a measurement.
    ///
    /// # Errors
    ///
    /// [`io::Error`] if a file cannot be read.
    pub fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        match self.texts.get(path) {
            Some(text) => Ok(Cow::Borrowed(text.as_bytes())),
            None => bytes(path).map(Cow::Owned),
        }
    }
}

fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    // Reading from a pipe might never end.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is not a regular file",
        ));
    }
    let mut bytes = Vec::new();
    let read = File::open(path)?
        .take(LARGEST_FILE + 1)
        .read_to_end(&mut bytes)?;
    if read as u64 > LARGEST_FILE {
        let message = format!("larger than {} MiB", LARGEST_FILE >> 20);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}

/// Returns the files in a folder that match a name or a pattern with `*` and `?`, in the order of their names.
#[must_use]
pub fn files(folder: &Path, pattern: &str) -> Vec<PathBuf> {
    let named = folder.join(pattern);
    if named.is_file() {
        return vec![named];
    }
    let wild = |c: char| match c {
        '*' | '?' => c.to_string(),
        c => Pattern::escape(&c.to_string()),
    };
    let escaped: String = pattern.chars().map(wild).collect();
    let folder = Pattern::escape(&folder.to_string_lossy());
    let whole = Path::new(&folder).join(escaped);
    let found = glob::glob_with(&whole.to_string_lossy(), GLOB);
    let paths = found.into_iter().flatten().flatten();
    let mut files: Vec<_> = paths.filter(|path| path.is_file()).collect();
    files.sort();
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_takes_precedence_over_a_file_of_the_same_name() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.csv", "b.csv"] {
            fs::write(folder.path().join(name), "file").unwrap();
        }
        let sources = MeasurementSources::in_folder(folder.path()).with_text("a.csv", "text");
        let content = |pattern: &str| -> Vec<Vec<u8>> {
            let read = |path: &PathBuf| sources.read(path).unwrap().into_owned();
            sources.of(pattern).iter().map(read).collect()
        };
        assert_eq!(content("a.csv"), [b"text"]);
        assert_eq!(content("b.csv"), [b"file"]);
        assert_eq!(content("*.csv"), [b"file", b"file"]);
        assert!(sources.read(Path::new("none")).is_err());
    }

    #[test]
    fn a_pattern_matches_its_files_in_order() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("[a] b");
        fs::create_dir(&inside).unwrap();
        for name in [
            "t2.csv", "t10.csv", "t1.csv", ".t3.csv", "[x].csv", "t1.txt",
        ] {
            fs::write(inside.join(name), "1").unwrap();
        }
        let names = |pattern: &str| -> Vec<String> {
            let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
            files(&inside, pattern).iter().map(name).collect()
        };
        assert_eq!(names("t*.csv"), ["t1.csv", "t10.csv", "t2.csv"]);
        assert_eq!(names("t?.csv"), ["t1.csv", "t2.csv"]);
        assert_eq!(names("[x].csv"), ["[x].csv"]);
        assert_eq!(names("[x].*"), ["[x].csv"]);
        assert!(names("*.hdf5").is_empty() && names("").is_empty());
        assert_eq!(files(folder.path(), "*/t1.txt").len(), 1);
    }
}
