//! The lock in a claimed folder, whose text says whether the process made the folder.

use std::io;
use std::path::Path;
use std::process;

use pellicle_files::lock::Lock;

/// Name of the lock in a claimed folder.
pub(super) const LOCK: &str = ".pellicle-lock";

/// Takes the lock of a folder; none if another process holds it.
pub(super) fn take_lock(path: &Path, is_made: bool) -> io::Result<Option<Lock>> {
    let made = if is_made { MADE } else { "" };
    let text = format!(
        "pellicle (process {}) is working in this folder. If it was killed, the next run removes what it left.\n{made}",
        process::id()
    );
    Lock::take(&path.join(LOCK), &text)
}

/// Last line of the lock file if the process made the folder.
pub(super) const MADE: &str = "It has made this folder.\n";

/// Whether the text of a lock says that its process made the folder.
pub(super) fn says_made(text: &str) -> bool {
    text.ends_with(MADE)
}
