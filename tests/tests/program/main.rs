//! Through the command line, across the crates: the program's numbers are those of the library, its validation passes
//! and sees what is wrong, its exit codes say what happened. What the program alone promises is in the tests of `cli`.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod cases;
mod library;
mod runner;
mod validate;
