//! A section of the validation, which is one kind of evidence, and its comparisons.

use super::comparison::Comparison;
use super::run::{ValidationError, ValidationRun};

/// One kind of evidence.
#[derive(Debug)]
pub struct ValidationSection {
    /// Its name.
    pub name: &'static str,
    /// The source of the references.
    pub source: &'static str,
    /// The scale of the errors, and the cause of the tolerance.
    pub because: &'static str,
    /// Computes its comparisons in a run.
    pub rows: fn(ValidationRun) -> Result<Vec<Comparison>, ValidationError>,
}

/// The comparisons of a section.
#[derive(Debug, Clone)]
pub struct SectionResult {
    /// The section.
    pub section: &'static ValidationSection,
    /// The comparisons.
    pub rows: Vec<Comparison>,
}

impl ValidationSection {
    /// Computes the section. If that fails, its only row gives the reason and fails.
    #[must_use]
    pub fn compute(&'static self, run: ValidationRun) -> SectionResult {
        let failed = |error| vec![Comparison::failed(self.name.into(), &error)];
        SectionResult {
            section: self,
            rows: (self.rows)(run).unwrap_or_else(failed),
        }
    }
}
