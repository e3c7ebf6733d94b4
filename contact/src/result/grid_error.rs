//! The discretisation error of each number: an interval that contains the truth, from its changes between grids.
//!
//! Let a number with an error `c hᵒ` change by `Δ` from one grid to the next, `r` times as fine. The error on the finer
//! grid is then `|Δ|/(rᵒ − 1)` (Richardson), and that on the finest grid is `(h/h_l)ᵒ` times as large. Every grid thus
//! gives an estimate of the error on the finest grid,
//!
//! ```text
//! e_l = |Δ_l|/(r_lᵒ − 1) (h/h_l)ᵒ,        ± = F max(e_L, 0.6 e_(L−1), 0.6² e_(L−2))
//! ```
//!
//! and the largest of the last three counts, older ones with less weight. Neither an accidental agreement of two grids
//! nor a change of sign makes the error small. F is a safety factor, as in Roache's grid convergence index (J. Fluids
//! Eng. 116, 1994, 405–413); the order is the common slope of all changes, kept within theoretical bounds. The position
//! of the contact's edge within the grid is random, so the errors scatter around every power law. Factor, weights and
//! bounds were calibrated so that the interval contains the truth as often as `docs/grid-error.md` states.
//! `cargo run --release -p pellicle-tests --bin coverage` prints how often it does, and how much wider it is than the
//! error.

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use crate::{PeakPlace, result::map_resolution::FEWEST_ELEMENTS_PER_WAVE, result::not_stored};

/// The values on one grid level. Values that only the error estimate needs are not stored; read back, they are NaN,
/// false or inside.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LevelValues {
    /// Elements per side.
    pub elements: usize,
    /// Penetration, in m.
    #[serde(deserialize_with = "nan_from_null")]
    pub penetration: f64,
    /// Force, in N.
    #[serde(skip, default = "not_stored::nan")]
    pub force: f64,
    /// Contact area, in m².
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area: f64,
    /// Uncertainty of the area from the position of its edge within an element, in m².
    #[serde(skip, default = "not_stored::nan")]
    pub edge_uncertainty: f64,
    /// Largest pressure, in Pa.
    #[serde(deserialize_with = "nan_from_null")]
    pub max_pressure: f64,
    /// Largest pressure averaged over a disc, in Pa; none if no diameter is stated, or an element is wider.
    #[serde(skip)]
    pub averaged_pressure: Option<f64>,
    /// The place of the largest pressure.
    #[serde(skip)]
    pub peak_place: PeakPlace,
    /// Whether the contact meets an outline of the relief or the indenter's rim, which elements follow as a staircase.
    #[serde(skip)]
    pub meets_outline: bool,
}

/// The error of one number on the finest grid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Half-width of the interval around the number that contains the truth, in the unit of the number.
    #[serde(deserialize_with = "nan_from_null")]
    pub estimate: f64,
    /// Observed order of convergence in the element's side; none where the number does not change.
    pub order: Option<f64>,
    /// Whether the changes shrink from level to level or are small, so that the estimate is meaningful.
    pub resolved: bool,
}

/// The errors of a solution's numbers; none with a single level.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GridError {
    /// Error of the penetration, in m; 0 where it is prescribed.
    pub penetration: Option<ErrorEstimate>,
    /// Error of the force, in N; 0 where it is prescribed. None in results stored before this field existed.
    #[serde(default)]
    pub force: Option<ErrorEstimate>,
    /// Error of the contact area, in m².
    pub contact_area: Option<ErrorEstimate>,
    /// Error of the largest pressure, in Pa. Never resolved at an edge, where it grows with the grid.
    pub max_pressure: Option<ErrorEstimate>,
    /// Error of the largest averaged pressure, in Pa; none without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_averaged_pressure: Option<ErrorEstimate>,
    /// Elements to the shortest wave of the gap around the contact; none without a measured map. With
    /// [fewer](FEWEST_ELEMENTS_PER_WAVE) no number is resolved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elements_per_wave: Option<f64>,
    /// The values on each level, coarsest first.
    pub levels: Vec<LevelValues>,
}

/// A number of a solution that a grid may not resolve, the largest pressure apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GridNumber {
    /// The penetration.
    Penetration,
    /// The force.
    Force,
    /// The contact area.
    ContactArea,
    /// The largest averaged pressure.
    AveragedPressure,
}

impl GridNumber {
    /// Its name in a sentence.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Penetration => "the penetration",
            Self::Force => "the force",
            Self::ContactArea => "the contact area",
            Self::AveragedPressure => "the averaged pressure",
        }
    }
}

/// The numbers of a solution that are not resolved, the largest pressure apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnresolvedNumbers([Option<GridNumber>; 4]);

impl UnresolvedNumbers {
    /// Each of them.
    pub fn each(self) -> impl Iterator<Item = GridNumber> {
        self.0.into_iter().flatten()
    }
}

/// The convergence expected from theory.
#[derive(Clone, Copy)]
struct ExpectedConvergence {
    /// The range in which an observed order is accepted.
    lowest_order: f64,
    highest_order: f64,
    /// `F`.
    safety: f64,
}

/// Piecewise constant pressure under a smooth contact: second order.
const SMOOTH: ExpectedConvergence = ExpectedConvergence {
    lowest_order: 1.3,
    highest_order: 2.0,
    safety: 3.0,
};
/// Outlines that elements follow as a staircase: first order.
const STAIRCASE: ExpectedConvergence = ExpectedConvergence {
    lowest_order: 1.0,
    highest_order: 1.2,
    safety: 2.5,
};
/// The peak at an edge: the square-root singularity of a rigid edge, which has no finite limit.
const EDGE: ExpectedConvergence = ExpectedConvergence {
    lowest_order: 0.5,
    highest_order: 0.5,
    safety: 1.0,
};
/// Weight of a level's estimate relative to the next finer one's.
const WEIGHT_OF_OLDER: f64 = 0.6;
/// Number of estimates that count.
const ESTIMATES: usize = 3;
/// Number of changes from which the order is observed.
const CHANGES: usize = 4;
/// Below this part of the lowest accepted order the changes do not shrink fast enough to call a number resolved …
const LOWEST_RESOLVED: f64 = 0.5;
/// … unless its interval is at most this part of the number: small changes scatter and need not always shrink.
const NARROW: f64 = 0.05;

impl GridError {
    /// Estimates the errors from the values on all levels, coarsest first. `accuracy` is the relative error of each
    /// value from other causes: the solver's tolerance and the coefficients.
    #[must_use]
    pub fn new(levels: Vec<LevelValues>, accuracy: f64) -> Self {
        let [.., last] = levels.as_slice() else {
            return Self::default();
        };
        let used = &levels[levels.len().saturating_sub(ESTIMATES + 1)..];
        let convergence = if used.iter().any(|level| level.meets_outline) {
            STAIRCASE
        } else {
            SMOOTH
        };
        let is_edge_peak = used
            .iter()
            .rev()
            .take(2)
            .any(|level| level.peak_place != PeakPlace::Inside);
        let of = |value: fn(&LevelValues) -> Option<f64>,
                  convergence: ExpectedConvergence,
                  more: f64| {
            let values = levels.iter();
            let values = values.filter_map(|level| Some((level.elements, value(level)?)));
            let found = estimate(&values.collect::<Vec<_>>(), convergence)?;
            // A prescribed value has no error.
            let is_settled = found.estimate == 0.0;
            let besides = if is_settled {
                0.0
            } else {
                accuracy * value(last)?.abs()
            };
            let estimate = found.estimate + besides + more;
            Some(ErrorEstimate { estimate, ..found })
        };
        let peak = of(
            |level| Some(level.max_pressure),
            if is_edge_peak { EDGE } else { convergence },
            0.0,
        );
        Self {
            penetration: of(|level| Some(level.penetration), convergence, 0.0),
            force: of(|level| Some(level.force), convergence, 0.0)
                .map(|error| error.of_positive(last.force)),
            contact_area: of(
                |level| Some(level.contact_area),
                convergence,
                last.edge_uncertainty,
            )
            .map(|error| error.of_positive(last.contact_area)),
            max_pressure: peak.map(|peak| ErrorEstimate {
                resolved: peak.resolved && !is_edge_peak,
                ..peak
            }),
            // Bounded at an edge too.
            max_averaged_pressure: of(|level| level.averaged_pressure, convergence, 0.0),
            elements_per_wave: None,
            levels,
        }
    }

    /// The numbers that are not resolved, the largest pressure apart; none if all are.
    #[must_use]
    pub fn unresolved(&self) -> Option<UnresolvedNumbers> {
        let numbers = [
            (GridNumber::Penetration, self.penetration),
            (GridNumber::Force, self.force),
            (GridNumber::ContactArea, self.contact_area),
            (GridNumber::AveragedPressure, self.max_averaged_pressure),
        ];
        let is_not = |error: ErrorEstimate| !error.resolved && error.estimate > 0.0;
        let found = numbers.map(|(of, error)| error.is_some_and(is_not).then_some(of));
        found
            .iter()
            .any(Option::is_some)
            .then_some(UnresolvedNumbers(found))
    }

    /// Whether the elements are short enough for the waves of a measured map, so that changes between grids show the
    /// error.
    #[must_use]
    pub fn resolves_waves(&self) -> bool {
        (self.elements_per_wave).is_none_or(|elements| elements >= FEWEST_ELEMENTS_PER_WAVE)
    }

    /// The errors on a grid with this many elements to the shortest wave of the gap: with too few, nothing is resolved
    /// but what is prescribed.
    pub(crate) fn with_elements_per_wave(self, elements_per_wave: Option<f64>) -> Self {
        let found = Self {
            elements_per_wave,
            ..self
        };
        if found.resolves_waves() {
            return found;
        }
        let unresolved = |error: Option<ErrorEstimate>| {
            error.map(|error| ErrorEstimate {
                resolved: error.resolved && error.estimate == 0.0,
                ..error
            })
        };
        Self {
            penetration: unresolved(found.penetration),
            force: unresolved(found.force),
            contact_area: unresolved(found.contact_area),
            max_pressure: unresolved(found.max_pressure),
            max_averaged_pressure: unresolved(found.max_averaged_pressure),
            ..found
        }
    }
}

impl ErrorEstimate {
    /// The error of a number that is positive wherever there is contact: an interval around zero does not tell it from
    /// none. A penetration of a cell has no such zero.
    fn of_positive(self, value: f64) -> Self {
        Self {
            resolved: self.resolved && self.estimate <= value.abs(),
            ..self
        }
    }

    /// Estimates the error of the last value. `values` are pairs of elements per side and value, coarsest grid first;
    /// `accuracy` is the relative error of each value from other causes. None with a single grid; never resolved at an
    /// edge, where values grow with the grid.
    pub(crate) fn of_values(
        values: &[(usize, f64)],
        meets_outline: bool,
        is_at_edge: bool,
        accuracy: f64,
    ) -> Option<Self> {
        let convergence = if is_at_edge {
            EDGE
        } else if meets_outline {
            STAIRCASE
        } else {
            SMOOTH
        };
        let found = estimate(values, convergence)?;
        let (_, last) = values.last()?;
        Some(Self {
            estimate: found.estimate + accuracy * last.abs(),
            resolved: found.resolved && !is_at_edge,
            ..found
        })
    }
}

/// A change from one level to the next.
#[derive(Clone, Copy)]
struct LevelChange {
    /// `|Δ|`.
    size: f64,
    /// Elements per side of the finer level.
    elements: f64,
    /// Ratio of the finer to the coarser elements per side.
    ratio: f64,
}

/// Estimates the error of one number from pairs of elements per side and value; none with a single pair.
fn estimate(values: &[(usize, f64)], convergence: ExpectedConvergence) -> Option<ErrorEstimate> {
    let (finest, last) = *values.last()?;
    let finest = finest as f64;
    let change = |pair: &[(usize, f64)]| LevelChange {
        size: (pair[1].1 - pair[0].1).abs(),
        elements: pair[1].0 as f64,
        ratio: pair[1].0 as f64 / pair[0].0 as f64,
    };
    let changes: Vec<LevelChange> = values.windows(2).map(change).collect();
    if changes.is_empty() {
        return None;
    }
    let recent = &changes[changes.len().saturating_sub(CHANGES)..];
    if recent.iter().any(|change| !change.size.is_finite()) {
        // Without a number on one grid there is no estimate.
        return None;
    }
    let observed = order(recent);
    let ExpectedConvergence {
        lowest_order,
        highest_order,
        safety,
    } = convergence;
    let order_used = observed
        .unwrap_or(highest_order)
        .clamp(lowest_order, highest_order);
    let mut weight = 1.0;
    let mut largest = 0.0_f64;
    for LevelChange {
        size,
        elements,
        ratio,
    } in recent.iter().rev().take(ESTIMATES)
    {
        // e = |Δ|/(rᵒ − 1) (h/h_l)ᵒ
        let error = size / (ratio.powf(order_used) - 1.0) * (elements / finest).powf(order_used);
        largest = largest.max(weight * error);
        weight *= WEIGHT_OF_OLDER;
    }
    let half_width = safety * largest;
    let shrinks = observed.is_none_or(|order| order > LOWEST_RESOLVED * lowest_order);
    let is_narrow = half_width <= NARROW * last.abs();
    Some(ErrorEstimate {
        estimate: half_width,
        order: observed,
        // Two levels show a change, not how it shrinks.
        resolved: changes.len() > 1 && (shrinks || is_narrow),
    })
}

/// Minus the slope of ln |Δ| over ln N by least squares; none with fewer than two non-zero changes.
fn order(changes: &[LevelChange]) -> Option<f64> {
    let points: Vec<[f64; 2]> = changes
        .iter()
        .filter(|change| change.size > 0.0)
        .map(|change| [change.elements.ln(), change.size.ln()])
        .collect();
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let covariance: f64 = points
        .iter()
        .map(|point| (point[0] - x) * (point[1] - y))
        .sum();
    let variance: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    (variance > 0.0)
        .then(|| -covariance / variance)
        .filter(|order| order.is_finite())
}

#[cfg(test)]
mod tests;
