//! The tests of this package.

mod server;
