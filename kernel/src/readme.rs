//! The examples of the README, compiled and run with the documentation's.

#[doc = include_str!("../README.md")]
struct Readme;
