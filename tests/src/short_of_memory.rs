//! The program `pellicle`, which is refused one allocation.
//!
//! ```text
//! pellicle-short-of-memory NUMBER BYTES COMMAND…
//! ```
//!
//! Of the allocations of at least so many bytes, that of this number is refused, the first being 0. If the command
//! ends, the number of these allocations is the last line on standard error.

#![expect(
    clippy::print_stderr,
    reason = "the number of allocations is its result"
)]

use std::process::ExitCode;

use pellicle_allocator::RefusingAllocator;

#[global_allocator]
static MEMORY: RefusingAllocator = RefusingAllocator::new();

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().collect();
    let numbers: Vec<u64> = arguments
        .drain(1..arguments.len().min(3))
        .filter_map(|number| number.parse().ok())
        .collect();
    let [number, bytes] = numbers[..] else {
        eprintln!("wanted the arguments NUMBER BYTES COMMAND…");
        return ExitCode::from(2);
    };
    MEMORY.refuse(number, usize::try_from(bytes).unwrap_or(usize::MAX));
    let ended = pellicle_cli::main(arguments);
    eprintln!("{}", MEMORY.counted());
    ended
}
