//! Every reader before thousands of damaged files: a value or one sentence with its place, no panic, and soon.

#![expect(
    clippy::print_stderr,
    reason = "`--nocapture` shows what a long run took"
)]

use std::env;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use pellicle_tests::bytes::mutation::Mutator;
use pellicle_tests::bytes::{Bench, Reader, readers};

/// The environment variable that gives another number of damaged files for each reader.
const VARIABLE: &str = "PELLICLE_DAMAGED_FILES";

/// Damaged files for each reader: half a second of processor time for each.
const FILES: u64 = 2000;

/// Number of bytes shown of a file before which a reader fails.
const SHOWN: usize = 2000;

#[test]
fn every_reader_answers_a_damaged_file_with_a_value_or_one_sentence_that_names_the_place() {
    let files = env::var(VARIABLE).ok().and_then(|files| files.parse().ok());
    let failed = |reader| fails(reader, files.unwrap_or(FILES));
    let failed: Vec<_> = readers::ALL.into_iter().filter_map(failed).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Lets a reader read damaged files; how it fails on the first on which it does.
fn fails(reader: Reader, files: u64) -> Option<String> {
    let (bench, start) = (Bench::new(reader), Instant::now());
    let mut read = 0;
    for seed in 0..files {
        let bytes = Mutator::new(seed).damaged(bench.contents());
        let Ok(has_value) = catch_unwind(AssertUnwindSafe(|| bench.has_value(&bytes))) else {
            let shown = bytes[..bytes.len().min(SHOWN)].escape_ascii();
            return Some(format!("{}, seed {seed}: {shown}", reader.name));
        };
        read += u64::from(has_value);
    }
    eprintln!(
        "{}: {read} of {files} have a value, {:?}",
        reader.name,
        start.elapsed()
    );
    // Neither are all files refused, nor is the damage without effect.
    let is_both = read > 0 && read < files;
    (!is_both).then(|| format!("{}: {read} of {files} have a value", reader.name))
}
