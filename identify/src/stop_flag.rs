//! A request by the user to end the work.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A request to end the work; all clones share the same flag.
#[derive(Debug, Clone, Default)]
pub struct StopFlag(Arc<AtomicBool>);

impl StopFlag {
    /// Asks the work to end. Returns whether this is the first request.
    #[must_use = "the work may have been stopped already"]
    pub fn raise(&self) -> bool {
        !self.0.swap(true, Ordering::SeqCst)
    }

    /// Whether the work should end.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
