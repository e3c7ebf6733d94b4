//! Ctrl-C: work under way stops within a second, what is finished is written, and the exit code is 130.
//!
//! The first signal sets a flag that every observer of a solution looks at. Where no observer is asked for a second (coefficients of a large
//! grid), the program ends itself, unless it has said with [`hold`] that something finished is still to be written. A second signal ends it
//! at once, and what was half written with it. While results are written, what is not done within [`GRACE`] of the first signal is left
//! out. SIGTERM, which batch systems send before they kill, counts as Ctrl-C.

use std::fs;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pellicle_contact::Signal;

use crate::terminal;

/// What a shell reports of a program that SIGINT ended: 128 + 2.
pub const EXIT_CODE: u8 = 130;

/// How long an observer has to notice: a second, less what it takes to end.
const PATIENCE: Duration = Duration::from_millis(900);

/// How long results go on being written: the rest of the second is for the numbers, which come last.
pub const GRACE: Duration = Duration::from_millis(400);

/// How often a folder is removed in which others may still be writing.
const ATTEMPTS: usize = 20;

static REQUESTED: AtomicBool = AtomicBool::new(false);
static OVERDUE: AtomicBool = AtomicBool::new(false);
static HALF_WRITTEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
static HELD: AtomicBool = AtomicBool::new(false);

/// Begins to listen. Without it, or where the system refuses a handler, Ctrl-C ends the program as it ends any.
pub fn listen() {
    // A refusal leaves the system's own behaviour, which is to end at once.
    drop(ctrlc::set_handler(received));
}

/// Whether the user has asked to stop.
#[must_use]
pub fn is_requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// The answer of an observer that has nothing else to say.
#[must_use]
pub fn signal() -> Signal {
    if is_requested() {
        Signal::Cancel
    } else {
        Signal::Continue
    }
}

/// Whether the user asked to stop so long ago that whatever can be left out is to be left out now.
#[must_use]
pub fn is_overdue() -> bool {
    OVERDUE.load(Ordering::Relaxed)
}

/// A folder that a second signal removes before it ends the program; until this is dropped.
#[derive(Debug)]
pub struct HalfWritten(PathBuf);

impl HalfWritten {
    /// Says that this folder is half written.
    #[must_use]
    pub fn at(folder: &Path) -> Self {
        half_written(|folders| folders.push(folder.to_owned()));
        Self(folder.to_owned())
    }
}

impl Drop for HalfWritten {
    fn drop(&mut self) {
        half_written(|folders| folders.retain(|folder| *folder != self.0));
    }
}

fn half_written(change: impl FnOnce(&mut Vec<PathBuf>)) {
    change(&mut HALF_WRITTEN.lock().unwrap_or_else(PoisonError::into_inner));
}

/// Says that something finished is to be written before the program may end.
pub fn hold() {
    HELD.store(true, Ordering::SeqCst);
}

/// One signal; runs on a thread of its own, not in the signal handler.
fn received() {
    if REQUESTED.swap(true, Ordering::SeqCst) {
        end();
    }
    terminal::tell("stopping; once more to stop at once");
    thread::spawn(|| {
        thread::sleep(GRACE);
        OVERDUE.store(true, Ordering::Relaxed);
        thread::sleep(PATIENCE.saturating_sub(GRACE));
        if !HELD.load(Ordering::SeqCst) {
            end();
        }
    });
}

fn end() -> ! {
    half_written(|folders| folders.iter().for_each(|folder| remove(folder)));
    process::exit(EXIT_CODE.into())
}

/// Removes a folder in which other threads may still be writing.
fn remove(folder: &Path) {
    for _ in 0..ATTEMPTS {
        if fs::remove_dir_all(folder).is_ok() || !folder.exists() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_removed_under_the_hands_of_those_who_write_in_it() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("a");
        fs::create_dir(&folder).unwrap();
        thread::scope(|scope| {
            scope.spawn(|| {
                let file = |i: usize| folder.join(i.to_string());
                let written = (0..100_000).take_while(|i| fs::write(file(*i), "a").is_ok());
                assert!(written.count() < 100_000);
            });
            while !folder.join("20").exists() {
                thread::yield_now();
            }
            remove(&folder);
        });
        assert!(!folder.exists());
    }
}
