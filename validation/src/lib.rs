//! `pellicle validate`: comparison of the program's results with known values.
//!
//! A [`ValidationSection`] is one kind of evidence, in its own file, with the source of its references and the cause of
//! its tolerances. Each of its rows is a [`Comparison`]. Everything goes through the same
//! crates as `pellicle run`.

#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "the largest of some numbers is one of them, to the last bit"
    )
)]

mod anchors;
mod axisymmetric;
mod certificate;
mod closed_forms;
mod coefficients;
mod comparison;
mod compliance;
pub mod data;
pub mod discrete;
pub mod film_formulas;
mod grid_error;
pub mod independent;
mod limits;
mod products;
mod report;
pub mod run;
mod section;
pub mod stress;

pub use comparison::{ComparedValue, Comparison, RowVerdict};
pub use report::ValidationReport;
pub use run::{ValidationError, ValidationRun};
pub use section::{SectionResult, ValidationSection, heading, section_text};

/// All sections, from the kernel up.
pub static SECTIONS: [ValidationSection; 14] = [
    compliance::SECTION,
    coefficients::SECTION,
    products::SECTION,
    closed_forms::SECTION,
    axisymmetric::SECTION,
    discrete::SECTION,
    limits::SECTION,
    certificate::SECTION,
    grid_error::SECTION,
    anchors::SECTION,
    stress::published::SECTION,
    stress::hertz::SECTION,
    stress::limits::SECTION,
    stress::balance::SECTION,
];

/// The README of the crate; its example is a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
