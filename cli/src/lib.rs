//! The program `pellicle`: a case file in, a certified contact solution out.
//!
//! [`main`] runs the program from the command line to the exit code. The rest serves the Python package, the figures of
//! the paper and the tests: [studies](mod@studied), [fits](mod@fitted), the [results](mod@results) that a run leaves,
//! their numbers for [drawing](mod@drawing), and the [evidence](mod@evidence) that the program is right.

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
mod failure;
mod fit_and_plan;
mod fit_file;
mod identification;
mod interrupt;
mod measured;
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
    pub use crate::output::stress::{FIELDS, FieldName, fields::StressFields};
}

/// Studies planned, solved case by case, and kept in a table, as the program does.
pub mod studied {
    pub use crate::cache::open_for_many as open_cache;
    pub use crate::case_folders::discard_cases;
}

/// Fits made as the program makes them.
pub mod fitted {
    pub use crate::fit_and_plan::{Stage, fit, likelihood, plan};
    pub use crate::fit_file::{FitFile, FitSources, Measurements};
    pub use crate::identification::fitted_file::FittedFile;
    pub use crate::identification::likelihood::FittedLikelihood;
    pub use crate::measured::sources::MeasurementSources;
    pub use crate::planning::files::table as plan_table;
    pub use crate::planning::result::PlanResult;
}

/// The files of a run, and the way they are written: whole or not at all.
pub mod results {
    pub use crate::output::npz::{StoredFields, file as fields_file};
    pub use crate::output::results::read_summary;
    pub use crate::output::stress::npz::{file as stresses_file, read as read_stresses};
}

/// Results as the plain numbers of their pictures, which `pellicle-plot` draws.
pub mod drawing {
    pub use crate::picture::{accuracy, extremes, subject};
}

/// Measured indentation curves, read from the text files of instruments as a `[[data]]` table specifies.
pub mod measurements {
    pub use crate::measured::channel::Channel;
    pub use crate::measured::columns::{ColumnName, ColumnUnit, CurveColumns};
    pub use crate::measured::curve::{CurveWarning, MeasuredCurve};
    pub use crate::measured::curve_segment::{Branch, CurveSegment, SegmentEnd, Until};
    pub use crate::measured::data_table::{DataTable, Observe};
    pub use crate::measured::decode::TextEncoding;
    pub use crate::measured::depth_step::DepthStep;
    pub use crate::measured::error::CurveError;
    pub use crate::measured::exclusion::{ExcludedRows, ExclusionReason};
    pub use crate::measured::header::{HeaderField, HeaderUnit};
    pub use crate::measured::noise::{MeasuredNoise, NoiseCorrelation};
    pub use crate::measured::omitted::OmittedRows;
    pub use crate::measured::separator::{DecimalMark, Separator};
    pub use crate::measured::sources::files;
    pub use crate::measured::spring::{HeightDirection, SpringConstant, penetration};
    pub use crate::measured::text_options::TextOptions;
    pub use crate::measured::text_table::TextTable;
}

/// Rough surfaces made of waves.
pub mod surfaces {
    pub use crate::self_affine::SelfAffine;
}

/// The guide; its Rust example is a documentation test of this crate.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide.md")]
mod guide {}
