//! The threads of the computation.

use crate::failure::Failure;

/// Sets the number of threads for the rest of the run; one per core if none is given.
///
/// # Errors
///
/// [`Failure::Threads`] if they cannot be started.
pub fn set(threads: Option<u16>) -> Result<(), Failure> {
    let Some(threads) = threads else {
        return Ok(());
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
    Ok(pool.build_global()?)
}

/// Starts every thread of the current pool, so that the address space of each is reserved when this returns.
pub fn begin() {
    rayon::broadcast(|_| drop(std::hint::black_box(vec![0_u8; 64])));
}
