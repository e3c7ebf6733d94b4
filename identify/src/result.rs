//! The result of a fit, and correlations from a covariance.

use crate::{
    Departure, Goodness, KnownCombination, NoiseLevels, OddRepeats, Outlier, ProfilePoint, REFUSAL,
    Role, Verdict, distribution::student_quantile,
};

/// The verdict on a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitVerdict {
    /// The model follows the data.
    Fitted,
    /// The model does not follow the data, by the tests of [`Goodness`] or because of [outliers](Fit::outliers): the
    /// intervals cannot be trusted.
    Misfit,
    /// The search ended before the minimum.
    NotConverged,
    /// The search found the minimum, but the model holds at too few of the points for a fit of those alone. Never the
    /// verdict of [`identify`](crate::identify), to which a model holds everywhere.
    OutsideModel,
}

impl FitVerdict {
    /// The verdict on a fit whose search has converged or not; outliers are a misfit, whatever their probability.
    pub(crate) fn of(is_converged: bool, goodness: &Goodness, has_outliers: bool) -> Self {
        if !is_converged {
            Self::NotConverged
        } else if has_outliers || goodness.misfit_p < REFUSAL {
            Self::Misfit
        } else {
            Self::Fitted
        }
    }
}

/// How far a fit got that was ended by its model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stopped {
    /// Not as far as the best fit: the values are the best so far, and have no intervals.
    Search,
    /// As far as the best fit, but not the profiles of these unknowns, by their index: these have only the interval
    /// from the covariance.
    Profiles(Vec<usize>),
}

/// The estimate of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Name of the unknown.
    pub name: String,
    /// Whether it is an answer or a nuisance.
    pub role: Role,
    /// Its value in the best fit.
    pub value: f64,
    /// The interval; `None` on an open side.
    pub interval: [Option<f64>; 2],
    /// The interval from the covariance alone; `None` if there is no covariance.
    pub wald: Option<[f64; 2]>,
    /// Degrees of freedom behind the intervals, infinite if the noise is known.
    pub degrees_of_freedom: f64,
    /// How well the data determine it.
    pub verdict: Verdict,
    /// The reason for the verdict, in a sentence.
    pub why: String,
    /// The combination that is known if the unknown is not identifiable.
    pub known_combination: Option<KnownCombination>,
    /// Its profile, in the order of its values. If there is a known combination, its profile with the others held.
    /// Empty without profiles.
    pub profile: Vec<ProfilePoint>,
    /// Its scatter between curves, if they are repeats and it is an answer.
    pub between_curves: Option<BetweenCurves>,
}

impl Estimate {
    /// The `Δχ²` at which an interval of this level ends: the squared quantile of Student's distribution.
    #[must_use]
    pub fn threshold(&self, level: f64) -> f64 {
        student_quantile(level, self.degrees_of_freedom).powi(2)
    }
}

/// The scatter of a parameter between repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct BetweenCurves {
    /// Standard deviation of the parameter between curves, in its unit.
    pub standard_deviation: f64,
    /// The parameter of each curve alone, with the index of the curve. Noise adds to their scatter.
    pub values: Vec<(usize, f64)>,
}

/// The estimated coefficient of a linear nuisance.
#[derive(Debug, Clone, PartialEq)]
pub struct Coefficient {
    /// Name of the nuisance, with the index of its curve if it has one.
    pub name: String,
    /// Index of its curve, if it belongs to only one.
    pub curve: Option<usize>,
    /// Its value in the best fit.
    pub value: f64,
    /// Its interval from the covariance; infinite if other nuisances and unknowns can replace it.
    pub interval: [f64; 2],
}

/// The points of all curves in the best fit.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedPoints {
    /// Observable of the model, with nuisances added; for repeats, with the parameters of each curve.
    pub model: Vec<f64>,
    /// Observed minus model.
    pub residual: Vec<f64>,
    /// Residuals whitened by the covariance of the noise; zero in curves left out.
    pub whitened: Vec<f64>,
}

/// The cost of a fit, in predictions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FitWork {
    /// Total number of predictions of all curves.
    pub curves_solved: usize,
    /// Predictions up to the best fit.
    pub search: usize,
}

/// A warning about a fit that its verdict does not carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitWarning {
    /// Another start led to a different, worse minimum.
    SeveralMinima,
    /// Near the best fit the predictions scatter about their linearisation, so the best fit is known only to a fraction
    /// of a standard error.
    Jitter,
    /// The best fit lies at a bound of this unknown, by its index.
    AtBound(usize),
    /// A profile of this unknown, by its index, found a better fit than the search, and the fit continued from there.
    BetterFitFound(usize),
}

/// A repeat that was left out because its residuals are larger than those of the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exclusion {
    /// Index of the curve, from 0.
    pub curve: usize,
    /// Ratio of its residuals to those of the median curve.
    pub roughness: f64,
}

/// The best fit, and what the data determine.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The verdict on the fit.
    pub verdict: FitVerdict,
    /// How far it got, if its model ended it.
    pub stopped: Option<Stopped>,
    /// The unknowns and nonlinear nuisances, in the order of the problem.
    pub estimates: Vec<Estimate>,
    /// The linear nuisances.
    pub coefficients: Vec<Coefficient>,
    /// Covariance of the unknowns in their coordinates, `ln θ` or `θ` itself; for those not identifiable, infinite
    /// variances and zero covariances.
    pub covariance: Vec<Vec<f64>>,
    /// Correlation of the unknowns.
    pub correlation: Vec<Vec<f64>>,
    /// The noise, as given and as estimated.
    pub noise: NoiseLevels,
    /// How well the model follows the data.
    pub goodness: Goodness,
    /// Points far from their neighbours, in the fit.
    pub outliers: Vec<Outlier>,
    /// The part of the residuals that repeats have in common, if independent curves would not leave it; of curves that
    /// do not scatter, a smooth part of the residuals that only long correlation of the noise explains.
    pub departure: Option<Departure>,
    /// The curves that were left out, where they are repeats.
    pub excluded: Vec<Exclusion>,
    /// The repeats in the fit whose parameters lie far from those of the others.
    pub odd: Option<OddRepeats>,
    /// The points.
    pub points: FittedPoints,
    /// Its cost.
    pub work: FitWork,
    /// Warnings for the reader.
    pub warnings: Vec<FitWarning>,
}

/// `ρ_ij = C_ij/√(C_ii C_jj)`; zero where a variance is infinite.
pub(crate) fn correlation(covariance: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let entry = |i: usize, j: usize| {
        if i == j {
            return 1.0;
        }
        covariance[i][j] / (covariance[i][i].sqrt() * covariance[j][j].sqrt())
    };
    (0..covariance.len())
        .map(|i| (0..covariance.len()).map(|j| entry(i, j)).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_infinite_variance_gives_zero_correlation() {
        let c = correlation(&[
            vec![4.0, 3.0, 0.0],
            vec![3.0, 9.0, 0.0],
            vec![0.0, 0.0, f64::INFINITY],
        ]);
        assert_eq!(c, [[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
}
