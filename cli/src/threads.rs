//! How many threads the program computes on.

use crate::failure::Failure;

/// Sets the number for the rest of the run; one a core if none is given.
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

/// Lets every thread of the present pool begin: the address space that the system sets aside for each is taken when
/// this returns.
pub fn begin() {
    rayon::broadcast(|_| drop(std::hint::black_box(vec![0_u8; 64])));
}
