//! The guide, whose example in Rust is a documentation test of this crate.
#![doc = include_str!("../../docs/guide.md")]
