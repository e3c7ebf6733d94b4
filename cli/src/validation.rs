//! `pellicle validate`: the program's numbers compared with known ones.
//!
//! A [`ValidationSection`] is one kind of evidence, one file here, with the source of its references and the cause of
//! its tolerances; each of its rows is a [`Comparison`]. Everything goes through the same crates as `pellicle run`.

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
pub mod stress;
mod table;

pub use comparison::{ComparedValue, Comparison, Verdict};
pub use report::ValidationReport;
pub use run::{ValidationError, ValidationRun};
pub use table::{heading, section_text};

/// One kind of evidence.
#[derive(Debug)]
pub struct ValidationSection {
    /// Its name.
    pub name: &'static str,
    /// Where the references come from.
    pub source: &'static str,
    /// The scale of the errors, and the cause of the tolerance.
    pub because: &'static str,
    rows: fn(ValidationRun) -> Result<Vec<Comparison>, ValidationError>,
}

/// The comparisons of a section.
#[derive(Debug, Clone)]
pub struct SectionResult {
    /// The section.
    pub section: &'static ValidationSection,
    /// The comparisons.
    pub rows: Vec<Comparison>,
}

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

impl ValidationSection {
    /// Computes the section. If that fails, its one row says why, and fails.
    #[must_use]
    pub fn compute(&'static self, run: ValidationRun) -> SectionResult {
        let failed = |error| vec![Comparison::failed(self.name.into(), &error)];
        SectionResult {
            section: self,
            rows: (self.rows)(run).unwrap_or_else(failed),
        }
    }
}
