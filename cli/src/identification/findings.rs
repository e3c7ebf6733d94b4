//! The findings of fits and plans, in SI units: the parts of `fit.json` and `plan.json`.

use pellicle::input::document::Document;
use pellicle_identify::draft::{NOT_IN_THE_FILE, guesses};
use pellicle_identify::{KnownCombination, NoiseLevels, Observable, Reading};
use serde::Serialize;

/// An estimated parameter.
#[derive(Debug, Clone, Serialize)]
pub struct EstimateResult {
    /// Its key.
    pub key: String,
    /// Its SI unit.
    pub unit: String,
    /// Its value in the best fit.
    pub value: f64,
    /// The interval; null at an open end.
    pub interval: [Option<f64>; 2],
    /// Level of the interval.
    pub level: f64,
    /// The interval from the covariance alone.
    pub wald: [Option<f64>; 2],
    /// Its verdict: how well the data determine it.
    pub verdict: String,
    /// The reason for the verdict, in a sentence.
    pub why: String,
    /// Its standard deviation between repeats; missing without repeats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scatter: Option<f64>,
    /// The product of powers that the data determine instead, if any.
    pub known_combination: Option<CombinationResult>,
}

impl EstimateResult {
    /// Whether its interval closes on both sides, so that its value is one and no bound.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.interval.iter().all(Option::is_some)
    }
}

/// A product of powers that the data determine.
#[derive(Debug, Clone, Serialize)]
pub struct CombinationResult {
    /// The product, such as `foundation.substrate.young_modulus * indenter.radius^0.5`.
    pub expression: String,
    /// Its value in SI units.
    pub value: f64,
    /// Its interval; null at an open end.
    pub interval: [Option<f64>; 2],
}

impl From<&KnownCombination> for CombinationResult {
    fn from(known: &KnownCombination) -> Self {
        Self {
            expression: known.expression.clone(),
            value: known.value,
            interval: known.interval,
        }
    }
}

/// Points left out for one reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExcludedResult {
    /// The reason.
    pub reason: String,
    /// Their number.
    pub count: usize,
}

/// The noise.
#[derive(Debug, Clone, Serialize)]
pub struct NoiseResult {
    /// Standard deviation of the depth, m; null if the depth was not measured.
    pub depth: Option<f64>,
    /// Standard deviation of the force, N; null if the force was not measured.
    pub force: Option<f64>,
    /// Standard deviation of the stiffness, N/m; null if the stiffness was not measured.
    pub stiffness: Option<f64>,
    /// Standard deviation relative to the observed value; of unloadings whose noise is not stated, beside the standard
    /// uncertainty of each contact.
    pub relative: f64,
    /// Correlation between successive points.
    pub correlation: f64,
}

impl NoiseResult {
    /// The noise of both quantities of an observable.
    #[must_use]
    pub fn of(levels: &NoiseLevels, observable: Observable, correlation: f64) -> Self {
        let of = |reading: Reading| match reading {
            _ if reading == observable.observed() => Some(levels.observed),
            _ if reading == observable.abscissa() => Some(levels.abscissa),
            _ => None,
        };
        Self {
            depth: of(Reading::Depth),
            force: of(Reading::Force),
            stiffness: of(Reading::Stiffness),
            relative: levels.relative,
            correlation,
        }
    }
}

/// A point far from its neighbours.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OutlierResult {
    /// Its file.
    pub file: String,
    /// Its row in the table of the file, from 1.
    pub row: usize,
    /// Its abscissa, N or m.
    pub abscissa: f64,
    /// The value observed there, m or N.
    pub observed: f64,
    /// The value that its neighbours lead to expect.
    pub expected: f64,
    /// The difference in standard deviations of such differences.
    pub deviations: f64,
}

/// A smooth part of the residuals that independent repeats, or short-lived noise of one curve, would not leave.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DepartureResult {
    /// Number of curves that share it.
    pub curves: usize,
    /// The abscissae between which it keeps its sign, N or m.
    pub range: [f64; 2],
    /// Its largest value, observed minus model, m or N.
    pub largest: f64,
    /// Probability of as much by chance.
    pub p: f64,
}

/// A warning for the reader.
#[derive(Debug, Clone, Serialize)]
pub struct WarningResult {
    /// A word for programs.
    pub code: String,
    /// A sentence for human readers.
    pub message: String,
}

impl WarningResult {
    /// The warning of the numbers that a draft has guessed and the file still marks so; none without them.
    #[must_use]
    pub fn of_guesses(document: &Document) -> Option<Self> {
        let guesses = guesses(document);
        (!guesses.is_empty()).then(|| Self {
            code: "guesses".into(),
            message: format!(
                "found \"{NOT_IN_THE_FILE}\" beside {}: these are guesses of the draft, which no ± and no interval knows \
                 of; put yours and remove the words",
                guesses.join(", ")
            ),
        })
    }
}
