//! Each curve of a fit file fitted alone: `pellicle identify --each`.

pub mod files;
pub mod position;
pub mod text;

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use pellicle::summary::PROGRAM;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::{IdentifyError, StopFlag};
use rayon::prelude::*;
use serde::Serialize;

use crate::failure::Failure;
use crate::fit_and_plan;
use crate::identification::findings::{EstimateResult, WarningResult};
use crate::identification::result::FitResult;

/// Name of the file in a folder of results.
pub const FILE: &str = "each.json";

/// Name and version of the layout.
pub const SCHEMA: &str = "pellicle-each/1";

/// The verdict of a curve that could not be read or fitted.
pub const FAILED: &str = "failed";

/// What every curve gives alone: `each.json`.
#[derive(Debug, Clone, Serialize)]
pub struct EachResult {
    /// Name and version of this layout.
    pub schema: &'static str,
    /// The program that wrote it.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// Title of the fit file.
    pub title: String,
    /// The curves, in the order of the tables and their files.
    pub curves: Vec<EachCurve>,
    /// Curves that were not begun because the user stopped.
    pub not_begun: usize,
}

/// What one curve gives.
#[derive(Debug, Clone, Serialize)]
pub struct EachCurve {
    /// Its file.
    pub file: String,
    /// Where it was measured, x and y: m if the file states it, otherwise the numbers in its name; null if unknown.
    pub position: Option<[f64; 2]>,
    /// `fitted`, `misfit`, `outside-model`, `not-converged` or `failed`.
    pub verdict: String,
    /// The unknowns; none if it failed.
    pub unknowns: Vec<EstimateResult>,
    /// Probability of a misfit at least as bad by chance.
    pub misfit_p: Option<f64>,
    /// Why there is no result, the likely cause of a misfit, or why an interval is open.
    pub cause: Option<String>,
    /// The warnings of its fit.
    pub warnings: Vec<WarningResult>,
}

impl EachResult {
    /// Fits every curve of a file; one that fails does not stop the others. `report` receives the number of curves
    /// done.
    #[must_use]
    pub fn new(file: &FitFile, stop: &StopFlag, report: &(dyn Fn(usize) + Sync)) -> Self {
        let tables = file.data.iter().enumerate();
        let places =
            tables.flat_map(|(table, data)| (0..data.files.len()).map(move |of| (table, of)));
        let places: Vec<(usize, usize)> = places.collect();
        let done = AtomicUsize::new(0);
        let one = |(table, of): &(usize, usize)| {
            let curve = EachCurve::new(file, (*table, *of), stop);
            report(1 + done.fetch_add(1, Ordering::Relaxed));
            curve
        };
        let found: Vec<Option<EachCurve>> = places.par_iter().map(one).collect();
        let not_begun = found.iter().filter(|curve| curve.is_none()).count();
        let mut curves: Vec<EachCurve> = found.into_iter().flatten().collect();
        position::place(&mut curves, file);
        Self {
            schema: SCHEMA,
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: file.title.clone(),
            curves,
            not_begun,
        }
    }

    /// Number of curves with this verdict.
    #[must_use]
    pub fn count(&self, verdict: &str) -> usize {
        self.curves
            .iter()
            .filter(|curve| curve.verdict == verdict)
            .count()
    }
}

impl EachCurve {
    /// Fits one curve; none if the user has stopped.
    fn new(file: &FitFile, (table, of): (usize, usize), stop: &StopFlag) -> Option<Self> {
        let alone = file.alone(table, of)?;
        let path = alone.data.first()?.files.first()?.clone();
        match fit_and_plan::fit(alone, Instant::now(), stop, &|_| ()) {
            Ok(fitted) if fitted.is_stopped() => None,
            Err(Failure::Identify(IdentifyError::Stopped { .. })) => None,
            Ok(fitted) => {
                let found = fitted.found;
                Some(Self {
                    file: path.display().to_string(),
                    position: None,
                    verdict: found.verdict.to_owned(),
                    cause: cause(&found),
                    misfit_p: Some(found.fit.misfit_p),
                    unknowns: found.unknowns,
                    warnings: found.warnings,
                })
            }
            Err(failure) => Some(Self::failed(&path, &failure)),
        }
    }

    fn failed(path: &Path, failure: &Failure) -> Self {
        let cause = failure.to_string();
        Self {
            file: path.display().to_string(),
            position: None,
            verdict: FAILED.into(),
            unknowns: Vec::new(),
            misfit_p: None,
            cause: Some(cause.split_whitespace().collect::<Vec<_>>().join(" ")),
            warnings: Vec::new(),
        }
    }
}

/// The cause of a verdict other than `fitted`: the likely one, or else the first warning; of a fitted curve, why an
/// interval is open.
fn cause(found: &FitResult) -> Option<String> {
    if found.verdict == "fitted" {
        let open = found.unknowns.iter().find(|of| !of.is_closed());
        return open.map(|of| format!("{}: {}", of.key, of.why));
    }
    let likely = (found.warnings.iter()).find(|warning| warning.code == "likely-cause");
    let cause = likely.or(found.warnings.first());
    cause.map(|warning| warning.message.clone())
}
