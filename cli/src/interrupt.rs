//! Ctrl-C: the work stops within a second, finished results are written, and the exit code is 130.
//!
//! The first signal sets a flag that every observer of a solution checks. If no observer is called for a second
//! (coefficients of a large grid), the program ends itself, unless [`hold`] was called because finished results are
//! still to be written. A second signal ends the program at once and removes half-written files. Results that are not
//! written within [`GRACE`] of the first signal are left out. SIGTERM, which batch systems send before they kill a job,
//! counts as Ctrl-C. But while the cases of a study are solved, the first SIGTERM lets the running cases finish and
//! starts no others.

use std::process;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use pellicle_contact::Signal;
use pellicle_files::unfinished;
use pellicle_identify::StopFlag;

use crate::terminal;

/// The exit code that a shell reports for a program ended by SIGINT: 128 + 2.
pub const EXIT_CODE: u8 = 130;

/// Time for an observer to notice the request: a second, less the time to end.
const REACTION_TIME: Duration = Duration::from_millis(900);

/// Time for which large results are still written; the rest of the second is for the numbers, which are written last.
pub const GRACE: Duration = Duration::from_millis(100);

static REQUESTED: LazyLock<StopFlag> = LazyLock::new(StopFlag::default);
static OVERDUE: AtomicBool = AtomicBool::new(false);
static HELD: AtomicBool = AtomicBool::new(false);
/// Whether the first SIGTERM lets the running parts finish.
static LETS_CASES_FINISH: AtomicBool = AtomicBool::new(false);
static FINISHING: AtomicBool = AtomicBool::new(false);

/// Installs the handler. Without it, or where the system refuses it, Ctrl-C ends the program at once.
#[cfg(unix)]
pub fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    // If refused, the system's own handler stays, which ends the program.
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM, SIGHUP]) else {
        return;
    };
    thread::spawn(move || {
        for signal in signals.forever() {
            if signal == SIGTERM {
                terminated();
            } else {
                received();
            }
        }
    });
}

/// Installs the handler. Without it, or where the system refuses it, Ctrl-C ends the program at once.
#[cfg(not(unix))]
pub fn listen() {
    // If refused, the system's own handler stays, which ends the program.
    drop(ctrlc::set_handler(received));
}

/// Runs work of many parts. A SIGTERM meanwhile lets the running parts finish; [`is_finishing`] is true from then on.
pub fn finish_running_cases<T>(work: impl FnOnce() -> T) -> T {
    LETS_CASES_FINISH.store(true, Ordering::SeqCst);
    let done = work();
    LETS_CASES_FINISH.store(false, Ordering::SeqCst);
    done
}

/// Whether no more parts of the work may begin.
#[must_use]
pub fn is_finishing() -> bool {
    FINISHING.load(Ordering::SeqCst) || is_requested()
}

/// Whether the user has asked to stop.
#[must_use]
pub fn is_requested() -> bool {
    REQUESTED.is_raised()
}

/// The flag raised when the user asks to stop.
#[must_use]
pub fn flag() -> StopFlag {
    REQUESTED.clone()
}

/// The signal for an observer to return.
#[must_use]
pub fn signal() -> Signal {
    if is_requested() {
        Signal::Cancel
    } else {
        Signal::Continue
    }
}

/// Whether [`GRACE`] has passed since the user asked to stop.
#[must_use]
pub fn is_overdue() -> bool {
    OVERDUE.load(Ordering::Relaxed)
}

/// Declares that finished results are to be written before the program may end.
pub fn hold() {
    HELD.store(true, Ordering::SeqCst);
}

/// Handles a SIGTERM, on its own thread rather than in the signal handler.
#[cfg(unix)]
fn terminated() {
    if LETS_CASES_FINISH.load(Ordering::SeqCst) && !FINISHING.swap(true, Ordering::SeqCst) {
        terminal::report("finishing the running cases; a second signal stops them");
    } else {
        received();
    }
}

/// Handles a signal, on its own thread rather than in the signal handler.
fn received() {
    if !REQUESTED.raise() {
        end();
    }
    terminal::report("stopping; press Ctrl-C again to stop at once");
    thread::spawn(|| {
        thread::sleep(GRACE);
        OVERDUE.store(true, Ordering::Relaxed);
        thread::sleep(REACTION_TIME.saturating_sub(GRACE));
        if !HELD.load(Ordering::SeqCst) {
            end();
        }
    });
}

/// Ends the program and removes unfinished files.
fn end() -> ! {
    unfinished::remove_all();
    process::exit(EXIT_CODE.into())
}
