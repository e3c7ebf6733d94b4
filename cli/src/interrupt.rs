//! Ctrl-C: work under way stops within a second, what is finished is written, and the exit code is 130.
//!
//! The first signal sets a flag that every observer of a solution looks at. Where no observer is asked for a second
//! (coefficients of a large grid), the program ends itself, unless it has said with [`hold`] that something finished is
//! still to be written. A second signal ends it at once, and what was half written with it. While results are written,
//! what is not done within [`GRACE`] of the first signal is left out. SIGTERM, which batch systems send before they
//! kill, counts as Ctrl-C.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use pellicle_contact::Signal;

use crate::output::unfinished;
use crate::terminal;

/// What a shell reports of a program that SIGINT ended: 128 + 2.
pub const EXIT_CODE: u8 = 130;

/// How long an observer has to notice: a second, less what it takes to end.
const PATIENCE: Duration = Duration::from_millis(900);

/// How long results go on being written: the rest of the second is for the numbers, which come last.
pub const GRACE: Duration = Duration::from_millis(100);

static REQUESTED: AtomicBool = AtomicBool::new(false);
static OVERDUE: AtomicBool = AtomicBool::new(false);
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

/// Ends the program; of what it has not finished nothing stays.
fn end() -> ! {
    unfinished::remove_all();
    process::exit(EXIT_CODE.into())
}
