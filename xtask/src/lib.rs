//! The chores of the workspace, as functions: [`tidy`] checks the house rules on a [`Tree`] of files, [`compare`] runs
//! Pellicle beside its rivals.
//!
//! The binary `xtask` only parses its command line and prints what these functions return, so that the test
//! `tests/workspace.rs` checks the real workspace by the same path as `cargo xtask tidy`.

mod arguments;
mod claims;
mod compare;
mod error;
mod figures;
mod manifest;
mod markdown;
mod paper;
mod tidy;
mod tree;
mod violation;

pub use arguments::{Arguments, Command};
pub use claims::{
    Checker, Claim, ClaimsArguments, ClaimsError, ClaimsFile, ClaimsReport, Contradiction,
    Evaluation, Finding, Refinement, Source, Verdict, claims,
};
pub use compare::{
    Case, Certificate, CompareArguments, Measurement, Outcome, PellicleArguments, Problem, Report,
    Rival, Row, Solved, compare, run_pellicle,
};
pub use error::XtaskError;
pub use figures::{Figure, FiguresArguments, Quality, draw_figure, figures};
pub use paper::{Keep, PaperCase, PaperRun, Program, Request, Runner};
pub use tidy::tidy;
pub use tree::{File, Tree};
pub use violation::Violation;
