//! `summary.json`: the numbers of a run, also the output of `run --json`.

pub mod adhesion;
pub mod area_law;
pub mod roughness;
pub mod schema;
mod step;
mod warning;
mod wear;

use std::time::Instant;

use pellicle_contact::{CriticalLoad, LoadingPath, Status, Step, UnresolvedStresses};
use pellicle_influence::{CacheWarning, Origin};
use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};
use serde_json::Value;

pub use self::adhesion::{AdhesionSummary, AdhesivePoint};
use self::area_law::AreaLaw;
use self::roughness::RoughnessSummary;
pub use self::step::{
    CertificateSummary, SensitivitySummary, StepSummary, StressSummary, WearSummary,
};
pub use self::warning::WarningSummary;
use crate::case::Case;
use crate::case::grid::BoundaryCase;
use crate::case::stress::StressCase;
use crate::case::unit_slip;
use crate::display::{Unit, quantity};
use crate::error::Error;
use crate::input::units::Units;
use crate::run::Stresses;

/// Name of the file in a results folder.
pub const FILE: &str = "summary.json";

/// Name and version of the layout.
pub const SCHEMA: &str = "pellicle-summary/1";

/// Name of the program in the file.
pub const PROGRAM: &str = "pellicle";

/// The numbers of a run, in SI units or the case's own, either as solved or as read back to redraw its pictures.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct RunSummary {
    /// Name and version of this layout.
    pub schema: String,
    /// The program that wrote it.
    pub program: String,
    /// Version of the program.
    pub version: String,
    /// Title of the case.
    pub title: String,
    /// The case as resolved, keys in the order of a case file.
    pub case: Value,
    /// The units of its numbers, as named in `curve.csv`.
    #[serde(skip)]
    pub units: Units,
    /// Status of the run: the worst of its steps; `certified` in a file older than this field.
    #[serde(default)]
    pub status: Status,
    /// The grid of the solution.
    pub grid: GridSummary,
    /// The roughness of its maps, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roughness: Option<RoughnessSummary>,
    /// The loading steps.
    pub steps: Vec<StepSummary>,
    /// The contact under the least force, with adhesion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pull_off: Option<AdhesivePoint>,
    /// More about adhesion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub adhesion: Option<AdhesionSummary>,
    /// The critical loads, if strengths are given and stresses requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub critical: Option<Vec<CriticalLoad>>,
    /// The time that the run took.
    pub timing: Timing,
    /// Warnings about the numbers.
    pub warnings: Vec<WarningSummary>,
}

/// The grid of a run, as written in a file.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GridSummary {
    /// The longer side of the domain, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub side: f64,
    /// Elements along the longer side.
    pub elements: usize,
    /// Elements along x and y; none if they are as many.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lengths: Option<[usize; 2]>,
    /// Side `2a` of an element, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub element_side: f64,
    /// The boundary condition.
    #[serde(default, skip_serializing_if = "BoundaryCase::is_free")]
    pub boundary: BoundaryCase,
}

impl GridSummary {
    /// Side of the domain along x, m.
    #[must_use]
    pub fn side_along_x(&self) -> f64 {
        match self.lengths {
            None => self.side,
            Some([x, _]) => x as f64 * self.element_side,
        }
    }

    /// Elements along x and y, in words.
    #[must_use]
    pub fn elements_in_words(&self) -> String {
        let [x, y] = self.lengths.unwrap_or([self.elements; 2]);
        format!("{x} × {y}")
    }

    /// The side of a square, or both sides of an oblong cell, in words.
    #[must_use]
    pub fn sides_in_words(&self, units: Units) -> String {
        let metres = |value| quantity(value, Unit::Metre, units);
        let Some(lengths) = self.lengths else {
            return format!("side {}", metres(self.side));
        };
        let [x, y] = lengths.map(|length| metres(length as f64 * self.element_side));
        format!("sides {x} and {y}")
    }
}

/// The time that a run took, and its threads.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Timing {
    /// Time for coefficients and geometry while nothing was being solved, s. The finest grid may be prepared during the
    /// solution of coarser ones.
    #[serde(deserialize_with = "nan_from_null")]
    pub coefficients_seconds: f64,
    /// Whether all coefficients worth keeping, the radial tables included, were read from the cache.
    pub coefficients_from_cache: bool,
    /// Time for the solution of all steps, s.
    #[serde(deserialize_with = "nan_from_null")]
    pub solve_seconds: f64,
    /// Time from the reading of the case, s.
    #[serde(deserialize_with = "nan_from_null")]
    pub total_seconds: f64,
    /// Number of threads.
    pub threads: usize,
}

/// The times of a run that the solver does not measure.
#[derive(Debug, Clone, Copy)]
pub struct Clock {
    /// The moment at which reading the case began.
    pub start: Instant,
    /// Time for the radial tables, s.
    pub tables_seconds: f64,
    /// Origin of the radial tables.
    pub tables_origin: Origin,
}

impl RunSummary {
    /// Creates the summary of a solved case; the side of the domain is filled in if the case left it open.
    ///
    /// # Errors
    ///
    /// [`Error::Json`] if the case has no JSON form.
    pub fn new(
        case: &Case,
        path: &LoadingPath,
        clock: Clock,
        cache_warnings: &[CacheWarning],
    ) -> Result<Self, Error> {
        let mut summary = Self::of_results(case, path, clock, cache_warnings);
        summary.add_case(case)?;
        Ok(summary)
    }

    /// Adds the case as resolved to a summary of its results.
    ///
    /// # Errors
    ///
    /// [`Error::Json`] if the case has no JSON form.
    pub fn add_case(&mut self, case: &Case) -> Result<(), Error> {
        let mut resolved = case.clone();
        resolved.grid.take_side(self.grid.side);
        self.ask_for_unit(case);
        self.case = serde_json::to_value(&resolved)?;
        Ok(())
    }

    /// Adds the unit that was probably meant to the warnings about numbers beyond the model.
    fn ask_for_unit(&mut self, case: &Case) {
        if self.status != Status::BeyondModel {
            return;
        }
        if let Some(question) = unit_slip::question(case) {
            let code = Status::BeyondModel.word();
            let beyond = self.warnings.iter_mut().filter(|of| of.code == code);
            beyond.for_each(|of| of.message = format!("{}: {question}", of.message));
        }
    }

    /// Creates the summary of a case's results, without the data known before the solution: a row of a study's table
    /// needs no more.
    #[must_use]
    pub fn of_results(
        case: &Case,
        path: &LoadingPath,
        clock: Clock,
        cache_warnings: &[CacheWarning],
    ) -> Self {
        let origin = clock.tables_origin.max(path.coefficients_origin);
        let warnings = case.warnings(path.grid.side()).into_iter();
        let warnings = warnings.map(WarningSummary::from);
        let warnings = warnings.chain(
            path.warnings
                .iter()
                .map(|warning| WarningSummary::of(case, warning)),
        );
        let cache_warnings = cache_warnings.iter().map(WarningSummary::from);
        let statuses = path.steps.iter().map(Step::status);
        let roughness = RoughnessSummary::of(case);
        let reference = area_law::reference_pressure(case, path, roughness.as_ref());
        let given = case.load.loads(case.grid.nominal_area());
        let unworn = case.wear.as_ref().map(|_| path.geometry());
        let steps = path.steps.iter().enumerate().map(|(index, step)| {
            let mut found = StepSummary {
                area_law: reference.and_then(|reference| AreaLaw::of(step, reference)),
                ..StepSummary::from(step)
            };
            if let (Some(of), Some(wear), Some(unworn)) = (&mut found.wear, &step.wear, &unworn) {
                of.section = wear::section(unworn, wear);
            }
            if let (Some(adhesion), Some(load)) = (&case.adhesion, given.get(index)) {
                adhesion::add_to(&mut found, adhesion, index, *load);
            }
            found
        });
        Self {
            schema: SCHEMA.into(),
            program: PROGRAM.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            title: case.title.clone(),
            case: Value::Null,
            units: case.units,
            status: statuses.max().unwrap_or_default(),
            grid: GridSummary {
                side: path.grid.side(),
                elements: path.grid.size(),
                lengths: (!path.grid.is_square()).then(|| path.grid.lengths()),
                element_side: path.grid.element_side(),
                boundary: case.grid.boundary,
            },
            steps: steps.collect(),
            pull_off: case
                .adhesion
                .as_ref()
                .map(|adhesion| adhesion.pull_off.into()),
            adhesion: case.adhesion.as_ref().map(AdhesionSummary::from),
            roughness,
            critical: None,
            timing: Timing {
                coefficients_seconds: clock.tables_seconds + path.coefficients_seconds,
                coefficients_from_cache: origin.is_cache(),
                solve_seconds: path.solve_seconds,
                total_seconds: clock.start.elapsed().as_secs_f64(),
                threads: rayon::current_num_threads(),
            },
            warnings: warnings.chain(cache_warnings).collect(),
        }
    }

    /// Adds the stresses that were found, and warnings about those that the grid does not resolve; a path on a single
    /// grid, which has no error bars, has its own.
    pub fn add_stresses(&mut self, stress: &StressCase, found: Stresses) {
        let of_steps = found.steps.iter().enumerate();
        let of_steps =
            of_steps.filter_map(|(step, extremes)| UnresolvedStresses::of_step(step, extremes));
        let critical = found.critical.as_deref().unwrap_or_default();
        let unresolved = of_steps.chain(UnresolvedStresses::of_critical(critical));
        let is_single = |step: &StepSummary| step.grid_error.levels.len() == 1;
        if !self.steps.iter().any(is_single) {
            self.warnings.extend(unresolved.map(WarningSummary::from));
        }
        for (step, extremes) in self.steps.iter_mut().zip(found.steps) {
            step.stress = Some(StressSummary {
                friction: stress.friction,
                direction_degrees: stress.direction_degrees(),
                extremes,
            });
        }
        self.critical = found.critical;
    }

    /// Adds the derivatives that were found.
    pub fn add_sensitivities(&mut self, found: Vec<Vec<SensitivitySummary>>) {
        for (step, found) in self.steps.iter_mut().zip(found) {
            step.sensitivities = Some(found);
        }
    }

    /// Parses the text of a `summary.json`, which does not name its units.
    ///
    /// # Errors
    ///
    /// An error of the reader if the text is not a summary.
    pub fn parse(text: &str, units: Units) -> Result<Self, serde_json::Error> {
        let summary = serde_json::from_str(text)?;
        Ok(Self { units, ..summary })
    }

    /// Whether every step is certified.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        self.status == Status::Certified
    }

    /// Whether the surface is a measured map, and whether the indenter is one.
    #[must_use]
    pub fn maps(&self) -> [bool; 2] {
        ["surface", "indenter"].map(|table| self.case[table]["file"].is_string())
    }

    /// Whether any step has results of rough contact.
    #[must_use]
    pub fn has_rough_contact(&self) -> bool {
        self.steps.iter().any(|step| step.rough_contact.is_some())
    }

    /// Whether a plane is pressed on the surface, so that there is no axis.
    #[must_use]
    pub fn presses_a_plane(&self) -> bool {
        self.case["indenter"]["kind"] == "flat"
    }

    /// Whether the indenter is rigid, as it is unless its modulus or its body is stated.
    #[must_use]
    pub fn has_rigid_indenter(&self) -> bool {
        let indenter = &self.case["indenter"];
        indenter["young_modulus"].is_null() && indenter["body"].is_null()
    }

    /// Whether the body shows between the tops of its relief, as between cylinders and in grooves with walls: elsewhere
    /// all of a contact is on the relief.
    #[must_use]
    pub fn has_gaps_in_relief(&self) -> bool {
        let surface = &self.case["surface"];
        surface["kind"] == "cylinders" || surface["profile"] == "rectangular"
    }

    /// The number of layers of the body inside which stresses are computed, each with an interface below.
    #[must_use]
    pub fn layers(&self) -> usize {
        let body = match self.case["stress"]["body"].as_str() {
            Some("indenter") => &self.case["indenter"]["body"],
            _ => &self.case["foundation"],
        };
        let layers = body["layer"].as_array();
        layers.map_or(0, Vec::len)
    }

    /// Height of the relief above the surface of the body, m, if it is uniform: that of cylinders or a film; 0 for a
    /// bare surface.
    #[must_use]
    pub fn relief_height(&self) -> Option<f64> {
        let surface = &self.case["surface"];
        match surface["kind"].as_str()? {
            "bare" => Some(0.0),
            "cylinders" => surface["height"].as_f64(),
            "film" => surface["thickness"].as_f64(),
            _ => None,
        }
    }
}
