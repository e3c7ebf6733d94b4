//! The tests of this package.

#![allow(
    clippy::unwrap_used,
    reason = "a helper of a test that cannot go on has failed"
)]

mod server;
