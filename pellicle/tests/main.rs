//! The documents of the crate.

mod documents;
mod periodic;
