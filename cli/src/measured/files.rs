//! The files that match a name or a pattern.

use std::path::{Path, PathBuf};

use glob::{MatchOptions, Pattern};

/// `*` and `?` match part of one name, but neither a folder separator nor the leading dot of a hidden file.
const OPTIONS: MatchOptions = MatchOptions {
    case_sensitive: true,
    require_literal_separator: true,
    require_literal_leading_dot: true,
};

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
    let found = glob::glob_with(&whole.to_string_lossy(), OPTIONS);
    let paths = found.into_iter().flatten().flatten();
    let mut files: Vec<_> = paths.filter(|path| path.is_file()).collect();
    files.sort();
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pattern_matches_its_files_in_order() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("[a] b");
        std::fs::create_dir(&inside).unwrap();
        for name in [
            "t2.csv", "t10.csv", "t1.csv", ".t3.csv", "[x].csv", "t1.txt",
        ] {
            std::fs::write(inside.join(name), "1").unwrap();
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
