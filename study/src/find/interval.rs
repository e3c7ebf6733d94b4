//! The interval of the key in which the ± of the number straddles the limit.
//!
//! Its ends are two further crossings, those of number + error and of number − error, on straight lines between tried
//! cases. Where no tried case is near such a crossing, one more is proposed beyond where a line from the answer
//! reaches it.

use super::crossing::between;
use super::scale::Certified;

/// How far beyond the crossing, in distances from the answer, the proposed case is: so far that its band is clear of
/// the limit although the number is not a straight line.
const BEYOND: f64 = 1.2;

/// A case that is clear of the limit this many distances away is near enough to end the interval.
const NEAR: f64 = 1.5;

/// A direction along the key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Towards {
    /// Smaller values.
    Smaller,
    /// Larger values.
    Larger,
}

/// The certified cases of a search in the order of the key, and the two of them around the crossing.
#[derive(Debug, Clone)]
pub struct Bracketed {
    cases: Vec<Certified>,
    /// The place of the case before the crossing; the next is behind it.
    before: usize,
    /// The crossing.
    crossing: f64,
    /// Width of the final bracket.
    width: f64,
}

/// An end of the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// A crossing.
    At(f64),
    /// No case tried on this side is clear of the limit: the interval extends beyond the range.
    Beyond,
    /// The ± of a case is not resolved.
    Unresolved,
}

impl Bracketed {
    /// Orders the cases around the crossing of a bracket that ends at `keys`.
    #[must_use]
    pub fn new(mut cases: Vec<Certified>, keys: [f64; 2], crossing: f64, width: f64) -> Self {
        cases.sort_by(|a, b| a.key.total_cmp(&b.key));
        let first = keys[0].min(keys[1]);
        let before = cases.iter().rposition(|case| case.key <= first);
        Self {
            before: before.unwrap_or(0),
            cases,
            crossing,
            width,
        }
    }

    /// The number of changes of side among the cases; more than one if the number is not monotonic.
    #[must_use]
    pub fn changes(&self) -> usize {
        let pairs = self.cases.windows(2);
        pairs
            .filter(|pair| is_below(pair[0].number) != is_below(pair[1].number))
            .count()
    }

    /// The cases in one direction, the nearest first.
    fn cases_towards(&self, towards: Towards) -> Box<dyn Iterator<Item = &Certified> + '_> {
        match towards {
            Towards::Smaller => Box::new(self.cases.iter().take(self.before + 1).rev()),
            Towards::Larger => Box::new(self.cases.iter().skip(self.before + 1)),
        }
    }

    /// The end of the interval in one direction.
    #[must_use]
    pub fn end(&self, towards: Towards) -> End {
        let opposite = match towards {
            Towards::Smaller => Towards::Larger,
            Towards::Larger => Towards::Smaller,
        };
        let inner = self.cases_towards(opposite).next();
        let nearest = self.cases_towards(towards).next();
        let (Some(mut inner), Some(nearest)) = (inner, nearest) else {
            return End::Beyond;
        };
        let below = is_below(nearest.number);
        for case in self.cases_towards(towards) {
            let ends = (limiting(inner, below), limiting(case, below));
            let (Some(before), Some(here)) = ends else {
                return End::Unresolved;
            };
            if is_below(here) == below {
                // Between a number and an infinite one, as that of a critical force above all loads, is no line.
                if here.is_infinite() {
                    return End::At(case.key);
                }
                return End::At(between([inner.key, case.key], [before, here]));
            }
            inner = case;
        }
        End::Beyond
    }

    /// A value of the key to be tried, so that the end of the interval in this direction is near a tried case.
    #[must_use]
    pub fn proposed(&self, towards: Towards) -> Option<f64> {
        let nearest = self.cases_towards(towards).next()?;
        let below = is_below(nearest.number);
        let is_clear =
            |case: &&Certified| limiting(case, below).is_some_and(|end| is_below(end) == below);
        let clear = self.cases_towards(towards).find(is_clear)?;
        let [low, high] = nearest.band?;
        if clear.number.is_infinite() {
            return None;
        }
        let slope = (clear.number / (clear.key - self.crossing)).abs();
        let distance = 0.5 * (high - low) / slope;
        let is_near = (clear.key - self.crossing).abs() <= NEAR * distance + self.width;
        let sign = (clear.key - self.crossing).signum();
        let proposed = self.crossing + sign * BEYOND * distance;
        (!is_near && distance.is_finite()).then_some(proposed)
    }
}

/// Whether a number on its scale is below the limit: the sign of 0 is that of its side.
fn is_below(number: f64) -> bool {
    number.is_sign_negative()
}

/// The end of the band that is nearest to the limit for a case below or above it.
fn limiting(case: &Certified, is_below: bool) -> Option<f64> {
    case.band
        .map(|[low, high]| if is_below { high } else { low })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line through the limit at 2, with this error.
    fn line(key: f64, error: f64) -> Certified {
        let number = 3.0 * (key - 2.0);
        Certified {
            key,
            number,
            band: Some([number - error, number + error]),
        }
    }

    fn bracketed(keys: &[f64], error: f64) -> Bracketed {
        let cases = keys.iter().map(|key| line(*key, error)).collect();
        Bracketed::new(cases, [1.9999, 2.0001], 2.0, 1e-3)
    }

    #[test]
    fn the_ends_are_where_number_and_error_meet_the_limit() {
        let cases = bracketed(&[0.0, 1.9999, 2.0001, 5.0], 0.3);
        for (towards, wanted) in [(Towards::Smaller, 1.9), (Towards::Larger, 2.1)] {
            let End::At(end) = cases.end(towards) else {
                panic!("an end")
            };
            // A straight line of a constant error.
            assert!((end - wanted).abs() < 1e-12, "{end}");
        }
    }

    #[test]
    fn a_further_case_is_proposed_only_where_none_is_near() {
        let far = bracketed(&[0.0, 1.9999, 2.0001, 2.12], 0.3);
        assert!((far.proposed(Towards::Smaller).unwrap() - 1.88).abs() < 1e-12);
        assert_eq!(far.proposed(Towards::Larger), None);
        let exact = bracketed(&[0.0, 1.9999, 2.0001, 5.0], 1e-9);
        assert_eq!(exact.proposed(Towards::Smaller), None);
    }

    #[test]
    fn an_error_that_reaches_the_limit_everywhere_leaves_the_interval_open() {
        let cases = bracketed(&[0.0, 1.9999, 2.0001, 5.0], 7.0);
        assert_eq!(cases.end(Towards::Smaller), End::Beyond);
        assert!(matches!(cases.end(Towards::Larger), End::At(_)));
    }

    #[test]
    fn changes_of_side_are_counted() {
        let mut cases = bracketed(&[0.0, 1.9999, 2.0001, 5.0], 0.1);
        assert_eq!(cases.changes(), 1);
        cases.cases[0].number = 1.0;
        assert_eq!(cases.changes(), 2);
    }
}
