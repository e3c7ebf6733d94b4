//! The files of the workspace, read once. A rule is a function of their text, so its test needs no files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::XtaskError;

/// Folders without sources: build output and results of runs.
const OUTPUT: [&str; 2] = ["target", "results"];
/// Hidden folders that are part of the workspace; all others belong to tools.
const HIDDEN_SOURCE: [&str; 3] = [".ci", ".cargo", ".github"];

/// Every file of the workspace, in the order of the paths.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    /// The text at each path from the root, with `/` between folders; `None` if it is not UTF-8, like a picture.
    files: BTreeMap<String, Option<String>>,
}

impl Tree {
    /// Reads the workspace at `root`, except build output, results and folders of tools, like `.git`.
    ///
    /// # Errors
    /// [`XtaskError::NotAWorkspace`] if `root` holds no `Cargo.toml`; [`XtaskError::Read`] if something cannot be read.
    pub fn read(root: &Path) -> Result<Self, XtaskError> {
        if !root.join("Cargo.toml").is_file() {
            return Err(XtaskError::NotAWorkspace { root: root.into() });
        }
        let mut files = BTreeMap::new();
        read_folder(root, "", &mut files)?;
        Ok(Self { files })
    }

    /// A tree from `(path, text)` pairs.
    #[must_use]
    pub fn of(files: &[(&str, &str)]) -> Self {
        let owned = |(path, text): &(&str, &str)| ((*path).to_owned(), Some((*text).to_owned()));
        let files = files.iter().map(owned).collect();
        Self { files }
    }

    /// Every text file as `(path, text)`.
    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        let files = self.files.iter();
        files.filter_map(|(path, text)| Some((path.as_str(), text.as_deref()?)))
    }

    /// Every text file whose path ends in `suffix`, as `(path, text)`.
    pub fn texts_ending(&self, suffix: &str) -> impl Iterator<Item = (&str, &str)> {
        self.texts().filter(move |(path, _)| path.ends_with(suffix))
    }

    /// The text of the file at `path`, if there is one.
    #[must_use]
    pub fn text(&self, path: &str) -> Option<&str> {
        self.files.get(path)?.as_deref()
    }

    /// The paths of all files and of all folders that contain one; the root is the empty path.
    #[must_use]
    pub fn paths(&self) -> BTreeSet<&str> {
        let with_folders = |file| std::iter::successors(Some(file), |&path| parent(path));
        let files = self.files.keys().map(String::as_str);
        files.flat_map(with_folders).collect()
    }

    /// The paths of the files in a folder, without those of folders in it.
    #[must_use]
    pub fn files_in(&self, folder: &str) -> Vec<String> {
        let files = self.files.keys();
        let inside = files.filter(|file| parent(file) == Some(folder));
        inside.cloned().collect()
    }
}

/// The folder that contains `path`; `None` for the root.
fn parent(path: &str) -> Option<&str> {
    if path.is_empty() {
        return None;
    }
    Some(path.rsplit_once('/').map_or("", |(folder, _)| folder))
}

fn read_folder(
    folder: &Path,
    prefix: &str,
    files: &mut BTreeMap<String, Option<String>>,
) -> Result<(), XtaskError> {
    for entry in fs::read_dir(folder).map_err(|e| unreadable(folder, e))? {
        let entry = entry.map_err(|e| unreadable(folder, e))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let on_disk = entry.path();
        if is_skipped(&name) {
            continue;
        }
        if on_disk.is_dir() {
            read_folder(&on_disk, &format!("{prefix}{name}/"), files)?;
        } else {
            let bytes = fs::read(&on_disk).map_err(|e| unreadable(&on_disk, e))?;
            files.insert(format!("{prefix}{name}"), String::from_utf8(bytes).ok());
        }
    }
    Ok(())
}

fn is_skipped(name: &str) -> bool {
    let belongs_to_tools = name.starts_with('.') && !HIDDEN_SOURCE.contains(&name);
    OUTPUT.contains(&name) || belongs_to_tools
}

fn unreadable(path: &Path, cause: std::io::Error) -> XtaskError {
    XtaskError::Read {
        path: path.into(),
        cause,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reading_skips_output_and_tools_and_keeps_binary_files() {
        let root = tempfile::tempdir().unwrap();
        for (path, bytes) in [
            ("Cargo.toml", b"[workspace]".as_slice()),
            ("docs/picture.png", &[0x89, 0xff]),
            (".ci/run", b"cargo fmt"),
            (".git/config", b"[core]"),
            ("target/debug/output.rs", b"generated"),
        ] {
            let path = root.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        let tree = Tree::read(root.path()).unwrap();
        let paths: Vec<_> = tree.paths().into_iter().collect();
        let expected = [
            "",
            ".ci",
            ".ci/run",
            "Cargo.toml",
            "docs",
            "docs/picture.png",
        ];
        assert_eq!(paths, expected);
        assert_eq!(tree.text("docs/picture.png"), None);
    }

    #[test]
    fn a_folder_without_a_manifest_is_refused() {
        let root = tempfile::tempdir().unwrap();
        let error = Tree::read(root.path()).unwrap_err();
        assert!(matches!(error, XtaskError::NotAWorkspace { .. }));
    }
}
