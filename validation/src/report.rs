//! The validation as JSON.

use serde::Serialize;

use crate::comparison::Comparison;
use crate::run::ValidationRun;
use crate::section::SectionResult;

/// All comparisons.
#[derive(Debug, Serialize)]
pub struct ValidationReport<'a> {
    /// Version of this layout.
    schema: u32,
    program: &'static str,
    version: &'static str,
    /// Relative error of every coefficient: 0 except for the test hook.
    perturbation: f64,
    verdict: &'static str,
    passed: usize,
    failed: usize,
    seconds: f64,
    threads: usize,
    sections: Vec<SectionReport<'a>>,
}

#[derive(Debug, Serialize)]
struct SectionReport<'a> {
    name: &'static str,
    reference: &'static str,
    error: &'static str,
    rows: &'a [Comparison],
}

impl<'a> ValidationReport<'a> {
    /// Builds the report of these sections, computed in `seconds`.
    #[must_use]
    pub fn new(run: ValidationRun, sections: &'a [SectionResult], seconds: f64) -> Self {
        let rows = || sections.iter().flat_map(|section| &section.rows);
        let passed = rows().filter(|row| row.passes()).count();
        let failed = rows().count() - passed;
        Self {
            schema: 1,
            program: "pellicle",
            version: env!("CARGO_PKG_VERSION"),
            perturbation: run.perturbation,
            verdict: if failed == 0 { "pass" } else { "fail" },
            passed,
            failed,
            seconds,
            threads: rayon::current_num_threads(),
            sections: sections.iter().map(SectionReport::new).collect(),
        }
    }
}

impl ValidationReport<'_> {
    /// Whether every row passes.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.failed == 0
    }

    /// Writes the number of rows that pass, and the sections with rows that fail.
    #[must_use]
    pub fn conclusion(&self) -> String {
        let (seconds, rows) = (self.seconds, self.passed + self.failed);
        if self.passes() {
            return format!("\nall {rows} rows pass, {seconds:.1} s\n");
        }
        let sections: String = self.sections.iter().filter_map(failures).collect();
        let failed = self.failed;
        format!("\n{failed} of {rows} rows FAIL, {seconds:.1} s:\n{sections}")
    }
}

/// Writes the number of rows of a section that fail, if any.
fn failures(section: &SectionReport<'_>) -> Option<String> {
    let failed = section.rows.iter().filter(|row| !row.passes()).count();
    let (name, rows) = (section.name, section.rows.len());
    (failed > 0).then(|| format!("  {failed:>3} of {rows:>2}  {name}\n"))
}

impl<'a> SectionReport<'a> {
    fn new(section: &'a SectionResult) -> Self {
        Self {
            name: section.section.name,
            reference: section.section.source,
            error: section.section.because,
            rows: &section.rows,
        }
    }
}
