//! `[report]` of a fit file: the form of the result.

use std::ops::RangeInclusive;

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::declare::{self, Codec, Scope, Series, series};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::table_reader::TableReader;
use pellicle::input::value_reader::ValueReader;

use super::model::ModelParameters;
use crate::{FitOptions, Intervals};

/// The largest number of curves of a design: maximum forces times radii.
const MOST_OF_DESIGN: usize = 100;
/// The largest number of points of a curve of a design.
const MOST_POINTS: usize = 10_000;
/// The smallest number of points of a curve of a design.
const FEWEST_POINTS: usize = 3;

/// The table `[report]`: the intervals, the designs of a plan, and the points left out.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportTable {
    /// Level of the intervals.
    pub level: f64,
    /// The method that finds them.
    pub intervals: Intervals,
    /// Seed of simulated noise.
    pub seed: u64,
    /// Measurements for a plan to assess.
    pub design: Design,
    /// The treatment of points at which the model does not hold.
    pub outside: OutsidePoints,
}

/// The treatment of points at which the model does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutsidePoints {
    /// The points are left out of the fit.
    LeaveOut,
    /// The points are kept, and a warning gives their number.
    Keep,
}

/// Measurements to assess in advance: one curve for each radius and each maximum force.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Design {
    /// Maximum forces, N.
    pub forces: Vec<f64>,
    /// Radii of indenters, m.
    pub radii: Vec<f64>,
    /// Number of points of a curve.
    pub points: Option<usize>,
}

impl Default for ReportTable {
    fn default() -> Self {
        Self {
            level: 0.95,
            intervals: Intervals::Profile,
            seed: 1,
            design: Design::default(),
            outside: OutsidePoints::LeaveOut,
        }
    }
}

impl ReportTable {
    const INTERVALS: [(&'static str, Intervals); 2] =
        [("profile", Intervals::Profile), ("wald", Intervals::Wald)];
    const OUTSIDE: [(&'static str, OutsidePoints); 2] = [
        ("leave out", OutsidePoints::LeaveOut),
        ("keep", OutsidePoints::Keep),
    ];
    const SEEDS: RangeInclusive<usize> = 0..=usize::MAX;

    /// Its keys.
    #[must_use]
    pub fn shape() -> TableShape {
        let methods = Shape::words(&Self::INTERVALS);
        let outside = Shape::words(&Self::OUTSIDE);
        let design = Shape::Table(Design::shape());
        let optional = Field::optional;
        TableShape::of([
            optional("level", "level of the intervals", Shape::Number, "0.95"),
            optional("intervals", "how they are found", methods, "`\"profile\"`"),
            optional(
                "seed",
                "seed of simulated noise",
                Shape::Count(Self::SEEDS),
                "1",
            ),
            optional(
                "design",
                "curves that could be measured, for a plan",
                design,
                "those of the data",
            ),
            optional(
                "outside",
                "points at which the model does not hold",
                outside,
                "`\"leave out\"`",
            ),
        ])
    }

    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(table: &TableReader<'_>, parameters: &ModelParameters) -> Result<Self, Diagnosis> {
        const LEVEL: &str = "a number between 0.5 and 0.999, such as 0.95";
        table.only(&Self::shape().keys())?;
        let mut report = Self::default();
        if let Some(field) = table.optional("level") {
            report.level = field.number(LEVEL)?;
            if !(0.5..=0.999).contains(&report.level) {
                return Err(field.wanted(LEVEL));
            }
        }
        if let Some(field) = table.optional("intervals") {
            report.intervals = field.choice(&Self::INTERVALS)?;
        }
        if let Some(field) = table.optional("seed") {
            report.seed = field.count(Self::SEEDS, "")? as u64;
        }
        if let Some(field) = table.optional("outside") {
            report.outside = field.choice(&Self::OUTSIDE)?;
        }
        if let Some(field) = table.optional("design") {
            report.design = Design::read(&field, parameters)?;
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
    const POINTS: RangeInclusive<usize> = FEWEST_POINTS..=MOST_POINTS;

    /// Its keys.
    fn shape() -> TableShape {
        let optional = Field::optional;
        let [forces, radii] = [Self::forces(), Self::radii()].map(|of| of.shape());
        TableShape::of([
            optional("forces", "largest forces", forces, "those of the data"),
            optional("radii", "radii of the indenter", radii, "that of the model"),
            optional(
                "points",
                "points of a curve",
                Shape::Count(Self::POINTS),
                "as in the data",
            ),
        ])
    }

    fn forces() -> Series {
        series(declare::force().positive(), MOST_OF_DESIGN)
    }

    fn radii() -> Series {
        series(declare::length().positive(), MOST_OF_DESIGN)
    }

    fn read(field: &ValueReader<'_>, parameters: &ModelParameters) -> Result<Self, Diagnosis> {
        let table = field.clone().table()?;
        table.only(&Self::shape().keys())?;
        let list = |key, of: Series| {
            let field = table.optional(key);
            field.map_or(Ok(Vec::new()), |field| of.read(&field, &Scope::default()))
        };
        let points = table
            .optional("points")
            .map(|field| field.count(Self::POINTS, ", points of a curve"));
        let design = Self {
            forces: distinct(list("forces", Self::forces())?),
            radii: distinct(list("radii", Self::radii())?),
            points: points.transpose()?,
        };
        if let (Some(radii), None) = (table.optional("radii"), parameters.radius()) {
            return Err(radii.wanted("none: the indenter of the model has no radius"));
        }
        if design.forces.len().max(1) * design.radii.len().max(1) > MOST_OF_DESIGN {
            let wanted = format!("at most {MOST_OF_DESIGN} curves, forces times radii");
            return Err(field.wanted(wanted));
        }
        Ok(design)
    }
}

/// The values without duplicates, in their order.
fn distinct(values: Vec<f64>) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for value in values {
        if !found.contains(&value) {
            found.push(value);
        }
    }
    found
}
