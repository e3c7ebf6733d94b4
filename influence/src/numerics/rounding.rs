//! Saturating conversion of real numbers to integers, and sums whose rounding error does not grow with their length.

/// The largest integer not above x; 0 if x is negative or NaN.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates, as documented"
)]
#[inline]
pub(crate) fn floor(x: f64) -> usize {
    x as usize
}

/// The smallest integer not below x; 0 if x is negative or NaN.
pub(crate) fn ceil(x: f64) -> usize {
    floor(x.ceil())
}

/// A running sum that carries its rounding error along (Neumaier 1974, *Rundungsfehleranalyse einiger Verfahren zur
/// Summation endlicher Summen*, ZAMM 54, 39–51).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    /// Adds one term.
    #[inline]
    pub(crate) fn add(&mut self, term: f64) {
        let next = self.sum + term;
        // Both parts of the rounding error, whichever operand is larger (Knuth's TwoSum).
        let shadow = next - self.sum;
        self.lost += (self.sum - (next - shadow)) + (term - shadow);
        self.sum = next;
    }

    /// The sum so far.
    #[inline]
    pub(crate) fn value(self) -> f64 {
        self.sum + self.lost
    }
}

impl FromIterator<f64> for Sum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        let mut sum = Self::default();
        terms.into_iter().for_each(|term| sum.add(term));
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::{Sum, ceil, floor};

    #[test]
    fn negative_numbers_and_nan_become_zero() {
        assert_eq!([floor(3.9), floor(-1.0), floor(f64::NAN)], [3, 0, 0]);
        assert_eq!([ceil(3.1), ceil(4.0), ceil(-0.5)], [4, 4, 0]);
    }

    #[test]
    fn digits_lost_by_a_plain_sum_are_kept() {
        let terms = [1.0, 1e100, 1.0, -1e100];
        assert!((Sum::from_iter(terms).value() - 2.0).abs() < f64::EPSILON);
        assert!(terms.iter().sum::<f64>().abs() < f64::EPSILON);
    }
}
