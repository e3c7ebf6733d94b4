//! `fit.json`: the result of a fit, in SI units.

mod notes;

use pellicle::summary::PROGRAM;
use pellicle_identify::fit_file::nuisance::{DEPTH_ZERO, FORCE_ZERO};
use pellicle_identify::{Correlation, Estimate, Fit, FitVerdict, NoiseLevels, Role, Verdict};
use serde::Serialize;

use super::curve_source::CurveSource;
use super::findings::{
    CombinationResult, DepartureResult, EstimateResult, ExcludedResult, NoiseResult, OutlierResult,
    WarningResult,
};
use super::taken_as_exact::ExactNumber;
use super::{Identification, zeros};
use crate::evaluation::result::Indentation;

/// Name of the file in a folder of results.
pub const FILE: &str = "fit.json";

/// Name and version of the layout.
pub const SCHEMA: &str = "pellicle-fit/1";

/// The result of a fit: `fit.json`.
#[derive(Debug, Clone, Serialize)]
pub struct FitResult {
    /// Name and version of this layout.
    pub schema: &'static str,
    /// The program that wrote it.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// Title of the fit file.
    pub title: String,
    /// `fitted`, `misfit`, `outside-model` or `not-converged`.
    pub verdict: &'static str,
    /// The unknowns.
    pub unknowns: Vec<EstimateResult>,
    /// The nuisances: parameters that were not known exactly.
    pub nuisances: Vec<EstimateResult>,
    /// Correlation of the unknowns, in their order.
    pub correlation: Vec<Vec<f64>>,
    /// Parameters that the models hold fixed, with the effect of an error in each on the unknowns; empty unless the
    /// verdict is `fitted`.
    pub taken_as_exact: Vec<ExactNumber>,
    /// The quality of the fit.
    pub fit: Quality,
    /// The work of the fit.
    pub work: WorkResult,
    /// The curves.
    pub curves: Vec<CurveResult>,
    /// The contacts of unloadings by Oliver and Pharr; missing in other fits.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub indentation: Vec<Indentation>,
    /// Warnings for the reader.
    pub warnings: Vec<WarningResult>,
}

/// The quality of a fit: how well the model follows the data.
#[derive(Debug, Clone, Serialize)]
pub struct Quality {
    /// Points fitted.
    pub points: usize,
    /// Points left out.
    pub excluded: Vec<ExcludedResult>,
    /// `χ²` over degrees of freedom.
    pub chi_squared_per_degree: f64,
    /// The noise, given or estimated.
    pub noise: NoiseResult,
    /// Probability of a misfit at least as bad by chance.
    pub misfit_p: f64,
    /// Probability of as few runs of one sign by chance.
    pub runs_p: f64,
    /// Durbin and Watson's `d`, 2 without correlation.
    pub durbin_watson: f64,
    /// Points far from their neighbours, in the fit.
    pub outliers: Vec<OutlierResult>,
    /// What the residuals of repeats have in common, or a smooth part of those of one curve that its noise has
    /// absorbed.
    pub departure: Option<DepartureResult>,
}

/// The work of a fit.
#[derive(Debug, Clone, Serialize)]
pub struct WorkResult {
    /// Predictions of all curves, derivatives included.
    pub curves_solved: usize,
    /// Loads solved.
    pub loads_solved: usize,
    /// Products with `K` on the finer of two grids of each load.
    pub operator_applications: usize,
    /// Time, s.
    pub seconds: f64,
}

/// One curve.
#[derive(Debug, Clone, Serialize)]
pub struct CurveResult {
    /// Its file.
    pub file: String,
    /// The zero of its depth, m: the reading where the contact begins; null if it is taken as exact.
    pub depth_zero: Option<f64>,
    /// The zero of its force, N: the reading without contact; null if it is taken as exact.
    pub force_zero: Option<f64>,
    /// The old name of `depth_zero`.
    pub shift: Option<f64>,
    /// The stretch before the contact; null if the file shows none.
    pub before_contact: Option<BeforeContactResult>,
    /// Points fitted.
    pub points: usize,
}

/// The stretch before the contact of a curve.
#[derive(Debug, Clone, Serialize)]
pub struct BeforeContactResult {
    /// Points of the line through its forces.
    pub points: usize,
    /// Force of the line where the contact begins, N, as recorded.
    pub force: f64,
    /// Its standard error, N.
    pub force_sd: f64,
    /// Slope of the line, N/m.
    pub slope: f64,
    /// Its standard error, N/m.
    pub slope_sd: f64,
    /// Standard deviation of single forces, N.
    pub noise: f64,
    /// Whether the line is subtracted from all forces.
    pub subtracted: bool,
    /// How far the lowest force of the file lies below the line, N.
    pub pull_off: f64,
}

impl FitResult {
    /// Assembles the result of a fit that took this many seconds.
    #[must_use]
    pub fn new(of: &Identification, fit: &Fit, seconds: f64) -> Self {
        let estimates = || fit.estimates.iter().enumerate();
        let with_role = |role: Role| {
            let chosen = estimates().filter(move |(_, estimate)| estimate.role == role);
            chosen.map(|(index, estimate)| of.estimate(index, estimate))
        };
        let coefficients = fit.coefficients.iter().filter(|one| one.curve.is_none());
        let common = coefficients.map(|one| of.coefficient(&one.name, one.value, one.interval));
        let mut warnings = of.warnings(fit);
        warnings.extend(of.curve_warnings(fit));
        warnings.extend(WarningResult::of_guesses(&of.file.document));
        warnings.extend(of.outlier_warnings(fit));
        warnings.extend(of.departure_warning(fit));
        warnings.extend(of.outside_warnings());
        warnings.extend(of.causes(fit));
        warnings.extend(of.sharp_tip(fit));
        warnings.extend(of.adhesion_law(fit));
        warnings.extend(of.evaluation_warnings());
        let (taken_as_exact, failure) = of.taken_as_exact(fit);
        warnings.extend(failure);
        let is_differentiated = !taken_as_exact.is_empty();
        let mut indentation = of.indentation();
        of.add_effective_indenters(fit, &mut indentation);
        Self {
            schema: SCHEMA,
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: of.file.title.clone(),
            verdict: verdict(fit.verdict),
            unknowns: with_role(Role::Sought).collect(),
            nuisances: with_role(Role::Nuisance).chain(common).collect(),
            correlation: fit.correlation.clone(),
            taken_as_exact,
            fit: of.quality(fit),
            work: WorkResult {
                curves_solved: of.spent.curves
                    + fit.work.curves_solved
                    + usize::from(is_differentiated),
                loads_solved: of.spent.loads + of.model.loads_solved(),
                operator_applications: of.spent.products + of.model.operator_applications(),
                seconds,
            },
            curves: of.curves(fit),
            indentation,
            warnings,
        }
    }
}

/// The word for the verdict.
#[must_use]
pub fn verdict(verdict: FitVerdict) -> &'static str {
    match verdict {
        FitVerdict::Fitted => "fitted",
        FitVerdict::Misfit => "misfit",
        FitVerdict::OutsideModel => "outside-model",
        FitVerdict::NotConverged => "not-converged",
    }
}

impl Identification {
    fn estimate(&self, index: usize, estimate: &Estimate) -> EstimateResult {
        let unit = self.file.unit(index);
        EstimateResult {
            key: estimate.name.clone(),
            unit: unit.into(),
            value: estimate.value,
            interval: estimate.interval,
            level: self.file.report.level,
            wald: estimate.wald.map_or([None, None], |ends| ends.map(Some)),
            verdict: estimate.verdict.to_string(),
            why: estimate.why.clone(),
            scatter: (estimate.between_curves.as_ref()).map(|of| of.standard_deviation),
            known_combination: estimate
                .known_combination
                .as_ref()
                .map(CombinationResult::from),
        }
    }

    /// Returns a linear nuisance shared by all curves.
    fn coefficient(&self, name: &str, value: f64, interval: [f64; 2]) -> EstimateResult {
        let ends = interval.map(|end| Some(end).filter(|end| end.is_finite()));
        let closes = ends.iter().all(Option::is_some);
        let unit = match name {
            "frame_compliance" => "m/N",
            _ => "1",
        };
        let verdict = if closes {
            Verdict::Weak
        } else {
            Verdict::NotIdentified
        };
        EstimateResult {
            key: name.to_owned(),
            unit: unit.into(),
            value,
            interval: ends,
            level: self.file.report.level,
            wald: ends,
            verdict: verdict.to_string(),
            why: "It enters linearly; its interval is that of the covariance.".into(),
            scatter: None,
            known_combination: None,
        }
    }

    fn quality(&self, fit: &Fit) -> Quality {
        let goodness = &fit.goodness;
        Quality {
            points: goodness.points,
            excluded: self.excluded(fit),
            chi_squared_per_degree: goodness.chi_squared_per_degree,
            noise: self.noise(&fit.noise),
            misfit_p: goodness.misfit_p,
            runs_p: goodness.runs_p,
            durbin_watson: goodness.durbin_watson,
            outliers: self.outliers(fit),
            departure: fit.departure.map(|of| DepartureResult {
                curves: of.curves,
                range: of.range,
                largest: of.largest,
                p: of.probability,
            }),
        }
    }

    fn noise(&self, levels: &NoiseLevels) -> NoiseResult {
        let observable = self.model.curves().first().map(|curve| curve.observable);
        let is_estimated = self.problem.noise().correlation == Correlation::Estimated;
        // Correlation of the sum of the persistent part and white noise.
        let correlation = if is_estimated {
            levels.persistence * (1.0 - levels.white_fraction)
        } else {
            0.0
        };
        NoiseResult::of(levels, observable.unwrap_or_default(), correlation)
    }

    fn curves(&self, fit: &Fit) -> Vec<CurveResult> {
        let before = |source: &CurveSource| {
            let of = source.measured.before_contact?;
            Some(BeforeContactResult {
                points: of.line.points,
                force: of.line.force,
                force_sd: of.line.force_sd,
                slope: of.line.slope,
                slope_sd: of.line.slope_sd,
                noise: of.line.noise,
                subtracted: of.is_subtracted,
                pull_off: of.pull_off,
            })
        };
        let sources = self.sources.iter().enumerate();
        sources
            .map(|(index, source)| CurveResult {
                file: source.measured.file.display().to_string(),
                depth_zero: zeros::of_fit(fit, DEPTH_ZERO, index),
                force_zero: zeros::of_fit(fit, FORCE_ZERO, index),
                shift: zeros::of_fit(fit, DEPTH_ZERO, index),
                before_contact: before(source),
                points: source.abscissa.len(),
            })
            .collect()
    }
}
