//! The verdict on one unknown, as a word and a sentence.

use std::fmt;

use crate::{Coordinate, Unknown, profile::Open};

/// An interval that closes within this factor on both sides makes an unknown identified.
pub const IDENTIFIED_WITHIN: f64 = 1.2;
/// If an unknown's standard deviation is above this fraction of its prior's, the data add nothing.
pub const PRIOR_DRIVEN_ABOVE: f64 = 0.9;

/// How well the data determine one unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The interval closes on both sides within a factor 1.2.
    Identified,
    /// It closes on both sides, but farther out.
    Weak,
    /// It closes on one side.
    OneSided,
    /// These data allow every value between the bounds.
    NotIdentified,
    /// No data can determine it: another value, with others changed too, gives the same curves.
    NotIdentifiable,
    /// The interval is that of the prior.
    PriorDriven,
}

impl fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::Identified => "identified",
            Self::Weak => "weak",
            Self::OneSided => "one-sided",
            Self::NotIdentified => "not-identified",
            Self::NotIdentifiable => "not-identifiable",
            Self::PriorDriven => "prior-driven",
        })
    }
}

/// The two ends of an interval in the coordinate of the unknown, or the reason why a side is open.
pub(crate) type Ends = [Result<f64, Open>; 2];

/// The ends of `x ± half`, open where they exceed the bounds.
pub(crate) fn wald_ends(unknown: &Unknown, position: f64, half: f64) -> Ends {
    let [low, high] = unknown.bounds();
    let (down, up) = (position - half, position + half);
    let closed = |inside: bool, end: f64| if inside { Ok(end) } else { Err(Open::Bound) };
    [closed(down >= low, down), closed(up <= high, up)]
}

/// The verdict on an identifiable unknown, and the reason.
pub(crate) fn judge(
    unknown: &Unknown,
    position: f64,
    ends: &Ends,
    standard_error: f64,
) -> (Verdict, String) {
    if let Some(part) = part_of_prior(unknown, position, standard_error)
        && part > PRIOR_DRIVEN_ABOVE
    {
        let why = format!(
            "Its standard deviation is {:.0} % of the prior's: the data add almost nothing.",
            100.0 * part
        );
        return (Verdict::PriorDriven, why);
    }
    match ends {
        [Ok(low), Ok(high)] => closed(unknown, position, *low, *high),
        [Ok(_), Err(open)] => (Verdict::OneSided, one_sided("above", "below", "up", *open)),
        [Err(open), Ok(_)] => (
            Verdict::OneSided,
            one_sided("below", "above", "down", *open),
        ),
        [Err(_), Err(_)] => (
            Verdict::NotIdentified,
            "Every value between the bounds fits these data within the level.".to_owned(),
        ),
    }
}

/// The standard deviation as a fraction of the prior's.
fn part_of_prior(unknown: &Unknown, position: f64, standard_error: f64) -> Option<f64> {
    let value = unknown.value(position);
    let prior = unknown.prior()?;
    Some(standard_error * prior.deviation_slope(value) * unknown.value_slope(value))
}

fn closed(unknown: &Unknown, position: f64, low: f64, high: f64) -> (Verdict, String) {
    let factor = factor(unknown, position, low, high);
    if factor <= IDENTIFIED_WITHIN {
        let why = format!(
            "The interval closes on both sides, within {:.2} %.",
            100.0 * (factor - 1.0)
        );
        return (Verdict::Identified, why);
    }
    let why = if factor.is_finite() {
        format!("The interval closes on both sides, but only within a factor {factor:.3}.")
    } else {
        "The interval closes on both sides, but is wide compared with the value.".to_owned()
    };
    (Verdict::Weak, why)
}

/// The factor within which the interval closes: `max(high/θ, θ/low)`, or `1 + max|θ − end|/|θ|` for a parameter of
/// either sign.
fn factor(unknown: &Unknown, position: f64, low: f64, high: f64) -> f64 {
    match unknown.coordinate() {
        Coordinate::Logarithmic => (high - position).max(position - low).exp(),
        Coordinate::Linear => 1.0 + (high - position).max(position - low) / position.abs(),
    }
}

fn one_sided(open: &str, closed: &str, way: &str, cause: Open) -> String {
    let end = match cause {
        Open::Bound => "the bound fits these data within the level",
        Open::Model => "where the model ends fits these data within the level",
    };
    format!("The interval closes {closed} the value but not {open} it: every value {way} to {end}.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prior;

    #[test]
    fn the_interval_decides_the_verdict() {
        let unknown = Unknown::positive("E", [1.0, 100.0]).unwrap();
        let x = 10.0_f64.ln();
        let verdict = |ends: Ends| judge(&unknown, x, &ends, 0.1).0;
        assert_eq!(verdict([Ok(x - 0.15), Ok(x + 0.18)]), Verdict::Identified);
        assert_eq!(verdict([Ok(x - 0.15), Ok(x + 0.19)]), Verdict::Weak);
        assert_eq!(verdict([Ok(x - 0.15), Err(Open::Bound)]), Verdict::OneSided);
        assert_eq!(
            verdict([Err(Open::Bound), Err(Open::Bound)]),
            Verdict::NotIdentified
        );
    }

    #[test]
    fn data_that_do_not_narrow_the_prior_make_an_unknown_prior_driven() {
        let prior = Prior::Lognormal {
            median: 10.0,
            factor: 1.1,
        };
        let unknown = Unknown::positive("R", [1.0, 100.0])
            .unwrap()
            .with_prior(prior)
            .unwrap();
        let x = 10.0_f64.ln();
        let ends: Ends = [Ok(x - 0.1), Ok(x + 0.1)];
        assert_eq!(
            judge(&unknown, x, &ends, 0.95 * 1.1_f64.ln()).0,
            Verdict::PriorDriven
        );
        assert_eq!(
            judge(&unknown, x, &ends, 0.85 * 1.1_f64.ln()).0,
            Verdict::Identified
        );
    }
}
