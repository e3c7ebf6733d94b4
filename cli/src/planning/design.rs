//! A design: the curves to measure, their expected results, and the comparison of two designs.

use std::cmp::Ordering;

use pellicle::display::significant;
use pellicle_identify::{IDENTIFIED_WITHIN, Verdict};
use serde::Serialize;

use super::candidate::CandidateCurve;
use crate::identification::findings::CombinationResult;
use crate::identification::names;

/// An interval at least this factor wide counts as lost, even if the bounds are wider.
const MANY: f64 = 1000.0;

/// A design: one curve or several.
#[derive(Debug, Clone, Serialize)]
pub struct DesignResult {
    /// The curves to measure.
    pub curves: Vec<CandidateCurve>,
    /// The unknowns.
    pub unknowns: Vec<ExpectedResult>,
    /// The nuisances: parameters that are not known exactly.
    pub nuisances: Vec<ExpectedResult>,
}

/// The expected result for a parameter.
#[derive(Debug, Clone, Serialize)]
pub struct ExpectedResult {
    /// Its key.
    pub key: String,
    /// Its SI unit.
    pub unit: String,
    /// The value assumed true.
    pub value: f64,
    /// Standard error of the logarithm, which is the relative error if small; null if nothing is determined.
    pub standard_error: Option<f64>,
    /// The factor within which the interval lies, ignoring the bounds.
    pub factor: Option<f64>,
    /// The interval; null on an open side.
    pub interval: [Option<f64>; 2],
    /// The expected verdict: how well the measurements determine it.
    pub verdict: String,
    /// The product of powers that is determined instead, if any.
    pub known_combination: Option<CombinationResult>,
}

/// Orders the better of two designs first: the one that loses fewer unknowns, then the one with the smaller worst
/// standard error.
#[must_use]
pub fn better(one: &DesignResult, other: &DesignResult) -> Ordering {
    let lost = one.lost().cmp(&other.lost());
    lost.then(one.worst().total_cmp(&other.worst()))
}

impl DesignResult {
    /// Number of unknowns that are not determined.
    #[must_use]
    pub fn lost(&self) -> usize {
        let unknowns = self.unknowns.iter();
        unknowns.filter(|of| of.is_lost()).count()
    }

    /// The largest standard error of the unknowns that are determined.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let determined = self.unknowns.iter().filter(|of| !of.is_lost());
        let errors = determined.filter_map(|of| of.standard_error);
        errors.fold(0.0, f64::max)
    }
}

impl ExpectedResult {
    /// Whether the measurements do not determine the parameter.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        let lost = [Verdict::NotIdentified, Verdict::NotIdentifiable];
        lost.iter()
            .any(|verdict| self.verdict == verdict.to_string())
    }

    /// Writes the interval relative to the value: `± 3.4 %`, `factor 2.1`, `lost` if every value between the bounds
    /// fits, `never` if no data can determine it.
    #[must_use]
    pub fn width(&self) -> String {
        if self.verdict == Verdict::NotIdentifiable.to_string() {
            return "never".into();
        }
        match self
            .factor
            .filter(|factor| *factor < MANY && !self.is_lost())
        {
            Some(factor) if factor <= IDENTIFIED_WITHIN => percents(factor),
            Some(factor) => format!("factor {}", significant(factor, 2)),
            None => "lost".into(),
        }
    }

    /// Describes the product determined in place of parameters that no data determine: `E (substrate) · R^0.5 ± 0.7 %`.
    #[must_use]
    pub fn instead(&self) -> Option<String> {
        let known = self.known_combination.as_ref()?;
        let product = names::combination(&known.expression);
        let factor = known.interval[1].map(|end| end / known.value);
        let width = match factor {
            Some(factor) if factor <= IDENTIFIED_WITHIN => percents(factor),
            Some(factor) => format!("within a factor {}", significant(factor, 2)),
            None => return None,
        };
        Some(format!("{product} {width}"))
    }
}

fn percents(factor: f64) -> String {
    format!("± {} %", significant(100.0 * (factor - 1.0), 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_percents_factors_or_a_word() {
        let of = |factor: Option<f64>, verdict: Verdict| {
            let of = ExpectedResult {
                key: "E".into(),
                unit: "Pa".into(),
                value: 1.0,
                standard_error: None,
                factor,
                interval: [None, None],
                verdict: verdict.to_string(),
                known_combination: None,
            };
            of.width()
        };
        assert_eq!(of(Some(1.0342), Verdict::Identified), "± 3.4 %");
        assert_eq!(of(Some(2.13), Verdict::Weak), "factor 2.1");
        // Between narrow bounds, even a narrow interval carries no information.
        assert_eq!(of(Some(1.1), Verdict::NotIdentified), "lost");
        assert_eq!(of(None, Verdict::NotIdentified), "lost");
        assert_eq!(of(None, Verdict::NotIdentifiable), "never");
    }
}
