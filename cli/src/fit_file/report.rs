//! `[report]` of a fit file: how the result is told.

use pellicle_identify::{FitOptions, Intervals};

use crate::case::diagnosis::Diagnosis;
use crate::case::dimension::Dimension;
use crate::case::quantity_list::QuantityList;
use crate::case::table_reader::TableReader;
use crate::case::value_reader::Sign;

/// The most samples of a posterior.
const MOST_SAMPLES: usize = 1_000_000;
/// The most loads and radii of a design.
const MOST_OF_DESIGN: usize = 100;

/// How the result is told.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportTable {
    /// Level of the intervals.
    pub level: f64,
    /// How they are found.
    pub intervals: Intervals,
    /// Samples of the posterior; 0 for none.
    pub posterior: usize,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Measurements to judge in advance.
    pub design: Design,
    /// What is done with points at which the model does not hold.
    pub outside: OutsidePoints,
}

/// What is done with points at which the model does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutsidePoints {
    /// The fit is made without them.
    LeaveOut,
    /// They stay, and are told.
    Keep,
}

/// Measurements to judge in advance: each radius with each range of forces up to one of these.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Design {
    /// Largest forces, N.
    pub forces: Vec<f64>,
    /// Radii of indenters, m.
    pub radii: Vec<f64>,
}

impl Default for ReportTable {
    fn default() -> Self {
        Self {
            level: 0.95,
            intervals: Intervals::Profile,
            posterior: 0,
            seed: 1,
            design: Design::default(),
            outside: OutsidePoints::LeaveOut,
        }
    }
}

impl ReportTable {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        const LEVEL: &str = "a number between 0.5 and 0.999, such as 0.95";
        table.only(&[
            "level",
            "intervals",
            "posterior",
            "seed",
            "design",
            "outside",
        ])?;
        let mut report = Self::default();
        if let Some(field) = table.optional("level") {
            report.level = field.number(LEVEL)?;
            if !(0.5..=0.999).contains(&report.level) {
                return Err(field.wanted(LEVEL));
            }
        }
        if let Some(field) = table.optional("intervals") {
            let choices = [("profile", Intervals::Profile), ("wald", Intervals::Wald)];
            report.intervals = field.choice(&choices)?;
        }
        if let Some(field) = table.optional("posterior") {
            report.posterior = field.count(0..=MOST_SAMPLES, "")?;
        }
        if let Some(field) = table.optional("seed") {
            report.seed = field.count(0..=usize::MAX, "")? as u64;
        }
        if let Some(field) = table.optional("outside") {
            let choices = [
                ("leave out", OutsidePoints::LeaveOut),
                ("keep", OutsidePoints::Keep),
            ];
            report.outside = field.choice(&choices)?;
        }
        if let Some(field) = table.optional("design") {
            report.design = Design::read(&field.table()?)?;
        }
        Ok(report)
    }

    /// The options of a fit.
    #[must_use]
    pub fn options(&self) -> FitOptions {
        FitOptions {
            level: self.level,
            intervals: self.intervals,
            ..FitOptions::default()
        }
    }
}

impl Design {
    /// Whether nothing is to be judged.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.forces.is_empty() && self.radii.is_empty()
    }

    fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&["forces", "radii"])?;
        let list = |key, dimension| {
            let list = QuantityList {
                dimension,
                sign: Sign::Positive,
                most: MOST_OF_DESIGN,
            };
            let field = table.optional(key);
            field.map_or(Ok(Vec::new()), |field| list.read(&field))
        };
        Ok(Self {
            forces: list("forces", Dimension::Force)?,
            radii: list("radii", Dimension::Length)?,
        })
    }
}
