//! `pellicle validate`: what the program computes beside what is known otherwise.
//!
//! A [`Section`] is one kind of evidence, one file here, with the source of its references and the cause of its
//! tolerances; a [`Row`] is one comparison. Everything goes through the same crates as `pellicle run`.

mod certificate;
mod closed_forms;
mod coefficients;
mod compliance;
pub mod data;
pub mod discrete;
mod grid_error;
mod layered;
mod limits;
mod products;
mod report;
mod row;
mod scene;
mod table;

pub use report::Report;
pub use row::{Row, Value, Verdict};
pub use scene::{Scene, Trouble};
pub use table::{heading, section_text};

/// One kind of evidence.
#[derive(Debug, Clone)]
pub struct Section {
    /// Its name.
    pub name: &'static str,
    /// Where the references come from.
    pub source: &'static str,
    /// What errors are relative to, and why they may be as large as the tolerance.
    pub because: &'static str,
    /// The comparisons.
    pub rows: Vec<Row>,
}

/// A section that is still to be computed.
#[derive(Debug)]
pub struct Plan {
    /// Name of the section.
    pub name: &'static str,
    source: &'static str,
    because: &'static str,
    rows: fn(Scene) -> Result<Vec<Row>, Trouble>,
}

/// All sections, from the kernel up.
pub const PLANS: [Plan; 9] = [
    compliance::PLAN,
    coefficients::PLAN,
    products::PLAN,
    closed_forms::PLAN,
    layered::PLAN,
    discrete::PLAN,
    limits::PLAN,
    certificate::PLAN,
    grid_error::PLAN,
];

impl Plan {
    /// Computes the section. What cannot be computed is a row that fails.
    #[must_use]
    pub fn carry_out(&self, scene: Scene) -> Section {
        let rows = (self.rows)(scene)
            .unwrap_or_else(|trouble| vec![Row::failed(self.name.into(), &trouble)]);
        Section {
            name: self.name,
            source: self.source,
            because: self.because,
            rows,
        }
    }
}
