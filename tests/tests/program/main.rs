//! The command line across the crates: its numbers are those of the libraries, its validation passes and detects
//! errors. The behaviour of the program by itself is tested in `cli/tests/program`.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod library;
mod runner;
mod validate;
