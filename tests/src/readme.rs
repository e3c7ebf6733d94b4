//! The workspace's README, whose example is a documentation test of this crate.
#![doc = include_str!("../../README.md")]
