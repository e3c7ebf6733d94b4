//! A results folder: there whole or not at all, and never in the place of another without being told.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::summary;
use crate::failure::Failure;

/// What to do with a results folder that is already there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Leave it alone.
    Keep,
    /// Replace it when the new one is complete.
    Replace,
}

/// A place where a results folder may be put.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folder {
    path: PathBuf,
    existing: Existing,
}

impl Folder {
    /// Checks, before any long work, that a results folder can be put here.
    ///
    /// # Errors
    ///
    /// [`Failure::Exists`] if one is there and is to be kept, [`Failure::NoResults`] if something else is there, which
    /// is never replaced, [`Failure::Write`] if nothing can be written here.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, Failure> {
        match (state(path), existing) {
            (State::Foreign, _) => {
                return Err(Failure::NoResults {
                    path: path.to_owned(),
                });
            }
            (State::Results, Existing::Keep) => {
                return Err(Failure::Exists {
                    path: path.to_owned(),
                });
            }
            _ => {}
        }
        let folder = Self {
            path: path.to_owned(),
            existing,
        };
        // A folder made and removed shows that one can be made later.
        folder.scratch()?;
        Ok(folder)
    }

    /// The place for a case of this name unless another is given: `results/name`, or `results/name-2` and so on where
    /// that is taken and to be kept.
    ///
    /// # Errors
    ///
    /// Those of [`Folder::claim`].
    pub fn claim_default(name: &str, existing: Existing) -> Result<Self, Failure> {
        let results = Path::new("results");
        let first = results.join(name);
        let free = |path: &PathBuf| state(path) == State::Free;
        let numbered = || {
            (2..=9999)
                .map(|i| results.join(format!("{name}-{i}")))
                .find(free)
        };
        let path = match existing {
            Existing::Keep if !free(&first) => numbered().unwrap_or(first),
            _ => first,
        };
        Self::claim(&path, existing)
    }

    /// Where it will be.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Fills a hidden folder beside the place, then moves it there.
    ///
    /// # Errors
    ///
    /// What `fill` returns, or [`Failure::Write`]; nothing is left behind then.
    pub fn write(&self, fill: impl FnOnce(&Path) -> Result<(), Failure>) -> Result<(), Failure> {
        let scratch = self.scratch()?;
        fill(scratch.path())?;
        let moved = match (state(&self.path), self.existing) {
            (State::Free, _) => move_to(scratch, &self.path),
            (State::Results, Existing::Replace) => self.replace(scratch),
            _ => {
                return Err(Failure::Exists {
                    path: self.path.clone(),
                });
            }
        };
        moved.map_err(|cause| self.failed(cause))
    }

    /// The old folder steps aside and is removed once the new one is in its place.
    fn replace(&self, scratch: TempDir) -> io::Result<()> {
        let aside = hidden_beside(&self.path)?;
        let old = aside.path().join("old");
        fs::rename(&self.path, &old)?;
        move_to(scratch, &self.path).inspect_err(|_| {
            // Best effort: the error to tell is the first one.
            drop(fs::rename(&old, &self.path));
        })
    }

    fn scratch(&self) -> Result<TempDir, Failure> {
        hidden_beside(&self.path).map_err(|cause| self.failed(cause))
    }

    fn failed(&self, cause: io::Error) -> Failure {
        let path = self.path.clone();
        Failure::Write { path, cause }
    }
}

/// What is at a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// Nothing, or an empty folder.
    Free,
    /// A results folder.
    Results,
    /// Something that this program did not write.
    Foreign,
}

fn state(path: &Path) -> State {
    let is_empty = || fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none());
    match path.symlink_metadata() {
        Err(_) => State::Free,
        Ok(_) if path.join(summary::FILE).is_file() => State::Results,
        Ok(_) if is_empty() => State::Free,
        Ok(_) => State::Foreign,
    }
}

/// A hidden folder on the same file system, removed when dropped.
fn hidden_beside(path: &Path) -> io::Result<TempDir> {
    let parent = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent)?;
    tempfile::Builder::new()
        .prefix(".pellicle-")
        .tempdir_in(parent)
}

fn move_to(scratch: TempDir, path: &Path) -> io::Result<()> {
    if path.is_dir() {
        fs::remove_dir(path)?;
    }
    fs::rename(scratch.path(), path)?;
    // What it would remove is elsewhere now.
    drop(scratch.keep());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fill(text: &'static str) -> impl FnOnce(&Path) -> Result<(), Failure> {
        move |folder| {
            fs::write(folder.join(summary::FILE), text).unwrap();
            Ok(())
        }
    }

    fn entries(folder: &TempDir) -> usize {
        fs::read_dir(folder.path()).unwrap().count()
    }

    #[test]
    fn results_are_kept_unless_they_may_be_replaced() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("a");
        Folder::claim(&path, Existing::Keep)
            .unwrap()
            .write(fill("1"))
            .unwrap();
        let kept = Folder::claim(&path, Existing::Keep);
        assert!(matches!(kept, Err(Failure::Exists { .. })));
        Folder::claim(&path, Existing::Replace)
            .unwrap()
            .write(fill("2"))
            .unwrap();
        assert_eq!(fs::read_to_string(path.join(summary::FILE)).unwrap(), "2");
        assert_eq!(entries(&parent), 1);
    }

    #[test]
    fn nothing_appears_before_the_folder_is_complete_or_if_it_fails() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("deep").join("a");
        let folder = Folder::claim(&path, Existing::Keep).unwrap();
        let failed = folder.write(|scratch| {
            assert!(!path.exists());
            fs::write(scratch.join("half"), "").unwrap();
            Err(Failure::NoResults { path: path.clone() })
        });
        assert!(failed.is_err());
        assert_eq!(fs::read_dir(parent.path().join("deep")).unwrap().count(), 0);
    }

    #[test]
    fn an_empty_folder_is_used_and_a_foreign_one_never_replaced() {
        let path = tempfile::tempdir().unwrap();
        Folder::claim(path.path(), Existing::Keep).unwrap();
        fs::write(path.path().join("thesis.tex"), "").unwrap();
        for existing in [Existing::Keep, Existing::Replace] {
            let claimed = Folder::claim(path.path(), existing);
            assert!(matches!(claimed, Err(Failure::NoResults { .. })));
        }
    }
}
