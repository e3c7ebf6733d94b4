//! The program `pellicle`: a case file in, a certified contact solution out.
//!
//! [`main`] runs the program from the command line to the exit code. The rest serves the figures of the paper and the
//! tests: a [`Case`] as read from its file, the [results](mod@results) that a run leaves, the tools for
//! [drawing](mod@drawing) them, and the [evidence](mod@evidence) that the program is right.

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "a number read from a case must be the number written in it, to the last bit"
    )
)]

mod arguments;
mod cache;
mod case;
mod case_solution;
mod command;
mod display;
mod failure;
mod fit_and_plan;
mod fit_file;
mod forecast;
mod identification;
mod input;
mod interrupt;
mod map;
mod measured;
mod memory;
mod output;
mod picture;
mod planning;
mod program;
mod progress;
mod self_affine;
mod sensitivities;
mod source_file;
mod stress_search;
mod study;
mod templates;
mod terminal;
mod threads;
mod unfinished;
mod validation;

pub use case::Case;
pub use display::{DisplayUnit, Unit, quantity};
pub use failure::Failure;
pub use input::{
    diagnosis::{Diagnosis, Fault},
    span::Source,
    units::Units,
};
pub use program::main;
pub use templates::Template;

/// Cases solved as the program solves them.
pub mod solved {
    pub use crate::cache::open as open_cache;
    pub use crate::case::foundation::FoundationCase;
    pub use crate::case::grid::BoundaryCase;
    pub use crate::case::map_sources::MapSources;
    pub use crate::case::stress::StressCase;
    pub use crate::case_solution::{Resources, SolvedCase, solve};
    pub use crate::map::MapError;
    pub use crate::memory::MemoryBudget;
    pub use crate::output::curve::csv as curve;
    pub use crate::output::folder::Completeness;
    pub use crate::output::json;
    pub use crate::output::stress::{FIELDS, FieldName, fields::StressFields};
    pub use crate::source_file::read as read_source;
    pub use crate::stress_search::StressSearch;
}

/// Studies planned, solved case by case, and kept in a table, as the program does.
pub mod studied {
    pub use crate::cache::open_for_many as open_cache;
    pub use crate::study::Study;
    pub use crate::study::case_solver::{CaseResult, CaseSolver};
    pub use crate::study::case_status::{CaseStatus, Tally};
    pub use crate::study::folder::StudyFolder;
    pub use crate::study::identity::StudyIdentity;
    pub use crate::study::kept_file::KeptFields;
    pub use crate::study::kept_record::{FieldKeeper, RecordInMemory};
    pub use crate::study::plan::StudyPlan;
    pub use crate::study::report::write as write_report;
    pub use crate::study::results_table::ResultsTable;
    pub use crate::study::shard::Shard;
    pub use crate::study::study_file::read;
}

/// Fits made as the program makes them.
pub mod fitted {
    pub use crate::fit_and_plan::{Stage, fit, plan};
    pub use crate::fit_file::{FitFile, FitSources, Measurements};
    pub use crate::identification::fitted_file::FittedFile;
    pub use crate::measured::sources::MeasurementSources;
    pub use crate::planning::files::table as plan_table;
    pub use crate::planning::result::PlanResult;
}

/// The files of a run, and the way they are written: whole or not at all.
pub mod results {
    pub use crate::output::fields::Fields;
    pub use crate::output::file::write_whole;
    pub use crate::output::npz::{StoredFields, file as fields_file};
    pub use crate::output::results::read_summary;
    pub use crate::output::stress::npz::{file as stresses_file, read as read_stresses};
    pub use crate::output::stress::view::{StressSection, StressView, SurfaceLine};
    pub use crate::output::summary::{FILE as SUMMARY_FILE, RunSummary, StepSummary};
}

/// The pictures of a solution, and their parts.
pub mod drawing {
    pub use crate::picture::coarse_field::CoarseField;
    pub use crate::picture::colour_map::ColourScale;
    pub use crate::picture::colours::Colour;
    pub use crate::picture::crop::Crop;
    pub use crate::picture::panel::{Axis, Panel};
    pub use crate::picture::panel_3d::Panel3d;
    pub use crate::picture::projection::Projection;
    pub use crate::picture::style::Style;
    pub use crate::picture::subject::Subject;
    pub use crate::picture::svg::{Anchor, Dash, Rect, Stroke, Svg};
    pub use crate::picture::{
        accuracy, colour_bar, colours, heading, labels, pressure_map, render, section,
        stress_section,
    };
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

/// The rows of the validation, and the published numbers behind them.
pub mod evidence {
    pub use crate::validation::{
        SECTIONS, ValidationError, ValidationRun, data, film_formulas, independent, run, stress,
    };
}

/// The guide; its Rust example is a documentation test of this crate.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guide.md")]
mod guide {}
