//! The system's allocator, counted, of which one allocation can be refused as if there were no memory left.
//!
//! It is apart from the tests that use it because an allocator cannot be written without `unsafe`, which all other
//! packages forbid.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ptr;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// An allocator that counts the allocations above a size, and refuses one of them.
#[derive(Debug)]
pub struct RefusingAllocator {
    counted: AtomicU64,
    refused: AtomicU64,
    least_bytes: AtomicUsize,
}

impl RefusingAllocator {
    /// An allocator that refuses none and counts none.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            counted: AtomicU64::new(0),
            refused: AtomicU64::new(u64::MAX),
            least_bytes: AtomicUsize::new(usize::MAX),
        }
    }

    /// Begins to count allocations of at least `least_bytes`, and refuses that of this number, the first being 0; a
    /// block that grows to this size counts as well.
    pub fn refuse(&self, number: u64, least_bytes: usize) {
        self.refused.store(number, Ordering::SeqCst);
        self.counted.store(0, Ordering::SeqCst);
        self.least_bytes.store(least_bytes, Ordering::SeqCst);
    }

    /// Number of allocations counted so far.
    pub fn counted(&self) -> u64 {
        self.counted.load(Ordering::SeqCst)
    }

    fn refuses(&self, bytes: usize) -> bool {
        bytes >= self.least_bytes.load(Ordering::Relaxed)
            && self.counted.fetch_add(1, Ordering::SeqCst) == self.refused.load(Ordering::Relaxed)
    }
}

impl Default for RefusingAllocator {
    fn default() -> Self {
        Self::new()
    }
}

#[expect(
    unsafe_code,
    reason = "each function is the system's or returns null, which is how an allocator refuses"
)]
// SAFETY: what the callers promise is passed on to the system's allocator, whose blocks these are.
unsafe impl GlobalAlloc for RefusingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if self.refuses(layout.size()) {
            return ptr::null_mut();
        }
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if self.refuses(layout.size()) {
            return ptr::null_mut();
        }
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if size > layout.size() && self.refuses(size) {
            return ptr::null_mut();
        }
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        unsafe { System.dealloc(block, layout) }
    }
}
