//! Changes of the disk that a test refuses: one, as when the disk is full for a moment, or all from one on, as when the
//! process dies there. Nothing else in the program begins a refusal.

use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Number of refusals in effect: without any, a change costs one load more.
static COUNT: AtomicUsize = AtomicUsize::new(0);

/// The refusals in effect.
static ALL: Mutex<Vec<Watched>> = Mutex::new(Vec::new());

/// A folder whose changes are counted.
#[derive(Debug)]
struct Watched {
    folder: PathBuf,
    /// Number of changes so far, refused or not.
    changes: usize,
    refused: Range<usize>,
}

/// The refusal of some changes in a folder, in effect until it is dropped. Refusals are of different folders.
#[derive(Debug)]
pub struct Refusal {
    folder: PathBuf,
}

impl Refusal {
    /// Refuses those changes of the disk in `folder` that have these numbers, counted from 0.
    ///
    /// # Errors
    ///
    /// An error of the system if there is no such folder.
    pub fn of(folder: &Path, refused: Range<usize>) -> io::Result<Self> {
        let folder = folder.canonicalize()?;
        all().push(Watched {
            folder: folder.clone(),
            changes: 0,
            refused,
        });
        COUNT.fetch_add(1, Ordering::SeqCst);
        Ok(Self { folder })
    }

    /// Number of changes so far, refused or not.
    #[must_use]
    pub fn changes(&self) -> usize {
        let all = all();
        let own = all.iter().find(|watched| watched.folder == self.folder);
        own.map_or(0, |watched| watched.changes)
    }
}

impl Drop for Refusal {
    fn drop(&mut self) {
        COUNT.fetch_sub(1, Ordering::SeqCst);
        all().retain(|watched| watched.folder != self.folder);
    }
}

/// What becomes of a change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    Allowed,
    /// The first one refused: of a write, half reaches the disk.
    Torn,
    Refused,
}

impl Verdict {
    /// The verdict on a change at a path.
    pub(crate) fn at(path: &Path) -> Self {
        if COUNT.load(Ordering::Relaxed) == 0 {
            return Self::Allowed;
        }
        let mut all = all();
        let watched = all.iter_mut().find(|one| path.starts_with(&one.folder));
        let Some(watched) = watched else {
            return Self::Allowed;
        };
        let number = watched.changes;
        watched.changes += 1;
        match &watched.refused {
            refused if !refused.contains(&number) => Self::Allowed,
            refused if refused.start == number => Self::Torn,
            _ => Self::Refused,
        }
    }

    pub(crate) fn allowed(self) -> io::Result<()> {
        match self {
            Self::Allowed => Ok(()),
            Self::Torn | Self::Refused => Err(ErrorKind::StorageFull.into()),
        }
    }
}

fn all() -> MutexGuard<'static, Vec<Watched>> {
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}
