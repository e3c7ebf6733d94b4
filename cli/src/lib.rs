//! The program `pellicle`: a case file in, a certified contact solution out.
//!
//! [`main`] runs the program from the command line to the exit code. The rest serves the Python package, the figures of
//! the paper and the tests: [fits](mod@fitted), the [results](mod@results) that a run leaves, and their numbers for
//! [drawing](mod@drawing).

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "a number read from a case must be the number written in it, to the last bit"
    )
)]

mod arena;
mod arguments;
mod cache;
mod case_folders;
mod command;
mod each;
mod evaluation;
mod failure;
mod fit_and_plan;
mod identification;
mod interrupt;
mod output;
mod picture;
mod planning;
mod program;
mod progress;
mod results_folder;
mod self_affine;
mod templates;
mod terminal;
mod threads;
mod withdrawn;

pub use failure::Failure;
pub use program::main;
pub use templates::Template;

/// Cases solved as the program solves them.
pub mod solved {
    pub use crate::cache::open as open_cache;
    pub use crate::output::report::of_run as report;
    pub use crate::output::stress::{FIELDS, FieldName, fields::StressFields};
}

/// What a study shares with the program: the cache of many cases, and the results folders of cases.
pub mod studied {
    pub use crate::cache::open_for_many as open_cache;
    pub use crate::case_folders::discard_cases;
}

/// Fits made as the program makes them.
pub mod fitted {
    pub use crate::each::EachResult;
    pub use crate::each::files::table as each_table;
    pub use crate::fit_and_plan::{Stage, fit, likelihood, plan};
    pub use crate::identification::fitted_file::FittedFile;
    pub use crate::identification::likelihood::FittedLikelihood;
    pub use crate::planning::files::table as plan_table;
    pub use crate::planning::result::PlanResult;
}

/// Unloadings evaluated as the program evaluates them.
pub mod evaluated {
    pub use crate::evaluation::Evaluation;
    pub use crate::evaluation::table::table;
    pub use crate::evaluation::text::text;
    pub use pellicle_identify::fit_file::evaluation::calibration_file::text as calibration_text;
}

/// The files of a run.
pub mod results {
    pub use crate::output::npz::{StoredFields, file as fields_file};
    pub use crate::output::results::read_summary;
    pub use crate::output::stress::npz::{file as stresses_file, read as read_stresses};
}

/// Lines of `solve --stream`, read as the program reads them.
pub mod streamed {
    pub use crate::command::solve::case;
}

/// Results as the plain numbers of their pictures, which `pellicle-plot` draws.
pub mod drawing {
    pub use crate::picture::{accuracy, extremes, subject};
}

/// Rough surfaces made of waves.
pub mod surfaces {
    pub use crate::self_affine::SelfAffine;
}

/// A recipe; its Rust example is a documentation test of this crate.
#[cfg(doctest)]
#[doc = include_str!("../../docs/recipes/programs.md")]
mod recipe {}
