//! The program `pellicle`: a case file in, a certified contact solution out.
//!
//! [`program::main`] goes from the command line to the exit code; [`case::Case`] is a case file as read; a command is a
//! function of its arguments in [`command`]; [`output`] and [`picture`] are what a run leaves behind; [`validation`] is
//! what the program has to show for itself.

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "a number read from a case must be the number written in it, to the last bit"
    )
)]

pub mod arguments;
pub mod cache;
pub mod case;
pub mod command;
pub mod display;
pub mod failure;
pub mod forecast;
pub mod interrupt;
pub mod map;
pub mod memory;
pub mod output;
pub mod picture;
pub mod program;
pub mod progress;
pub mod study;
pub mod templates;
pub mod terminal;
pub mod threads;
pub mod validation;

/// The guide, whose example in Rust is a documentation test of this crate.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide.md")]
mod guide {}
