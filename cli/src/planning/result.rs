//! `plan.json`: the expected results of designs, in SI units.

use pellicle::summary::PROGRAM;
use serde::Serialize;

use super::Planning;
use super::comparison;
use super::design::DesignResult;
use super::premises::{NoiseSource, Premises};
use crate::failure::Failure;
use crate::identification::findings::{NoiseResult, WarningResult};

/// Name of the file in a folder of results.
pub const FILE: &str = "plan.json";

/// Name and version of the layout.
pub const SCHEMA: &str = "pellicle-plan/1";

/// The result of a plan: the designs with their expected intervals.
#[derive(Debug, Clone, Serialize)]
pub struct PlanResult {
    /// Name and version of this layout.
    pub schema: &'static str,
    /// The program that wrote it.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// Title of the fit file.
    pub title: String,
    /// Level of the intervals.
    pub level: f64,
    /// The noise, given or assumed.
    pub noise: NoiseResult,
    /// The designs, best first.
    pub designs: Vec<DesignResult>,
    /// The work spent.
    pub work: PlanWork,
    /// Warnings for the reader.
    pub warnings: Vec<WarningResult>,
}

/// The work spent on a plan.
#[derive(Debug, Clone, Serialize)]
pub struct PlanWork {
    /// Number of curves solved.
    pub curves_solved: usize,
    /// Number of loads solved.
    pub loads_solved: usize,
    /// Time, s.
    pub seconds: f64,
}

impl PlanResult {
    /// Builds the result of a plan that took `seconds`.
    ///
    /// # Errors
    ///
    /// [`Failure`] if a number is not finite.
    pub fn new(of: &Planning<'_>, seconds: f64) -> Result<Self, Failure> {
        let designs = comparison::designs(of)?;
        let mut warnings = of.premises.warnings();
        warnings.extend(of.warnings.clone());
        Ok(Self {
            schema: SCHEMA,
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: of.premises.file.title.clone(),
            level: of.premises.file.report.level,
            noise: of.premises.noise_result(),
            designs,
            work: PlanWork {
                curves_solved: of.judged.len(),
                loads_solved: of.loads_solved,
                seconds,
            },
            warnings,
        })
    }
}

impl Premises<'_> {
    /// Returns the noise by channel.
    #[must_use]
    pub fn noise_result(&self) -> NoiseResult {
        let levels = &self.plan.noise;
        let correlation = levels.persistence * (1.0 - levels.white_fraction);
        NoiseResult::of(levels, self.observe, correlation)
    }

    /// Returns warnings about the assumptions of the plan.
    #[must_use]
    pub fn warnings(&self) -> Vec<WarningResult> {
        let what = self.observe.observed().name();
        let assumed = (self.noise == NoiseSource::Assumed).then(|| WarningResult {
            code: "assumed-noise".into(),
            message: format!(
                "the fit file gives no noise for the {what}; {} % of the {what} is assumed, \
                 independent from point to point",
                100.0 * self.plan.noise.relative
            ),
        });
        assumed.into_iter().collect()
    }
}
