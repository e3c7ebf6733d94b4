//! Chebyshev expansions in 32 digits.

use super::twofold::Twofold;

/// Number of terms with which an expansion is made.
const TERMS: usize = 26;

/// Coefficients below this fraction of the largest are summed in 16 digits: their rounding is 1e-24 of the whole.
const MINOR: f64 = 1e-8;

/// Coefficients below this fraction of the largest are dropped.
const NEGLIGIBLE: f64 = 1e-24;

/// `Σ c_j T_j(x)`, x in [−1, 1].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Expansion {
    major: Vec<Twofold>,
    minor: Vec<f64>,
}

impl Expansion {
    fn new(coefficients: &[Twofold]) -> Self {
        let size = |c: &Twofold| c.rounded().abs();
        let largest = coefficients.iter().map(size).fold(0.0, f64::max);
        let count_above = |share: f64| {
            let last = coefficients.iter().rposition(|c| size(c) > share * largest);
            last.map_or(1, |index| index + 1)
        };
        let (major, all) = (count_above(MINOR), count_above(NEGLIGIBLE));
        let minor = coefficients[major..all].iter();
        Self {
            major: coefficients[..major].to_vec(),
            minor: minor.map(|c| c.rounded()).collect(),
        }
    }

    /// The sum by Clenshaw's recurrence.
    #[inline]
    pub(crate) fn value(&self, x: Twofold) -> Twofold {
        let (mut near, mut far) = (0.0, 0.0);
        let twice = 2.0 * x.rounded();
        for c in self.minor.iter().rev() {
            (near, far) = (twice * near + (c - far), near);
        }
        let (mut near, mut far) = (Twofold::from(near), Twofold::from(far));
        let twice = x.scaled(2.0);
        for c in self.major[1..].iter().rev() {
            (near, far) = (twice * near + (*c - far), near);
        }
        self.major[0] + (x * near - far)
    }

    /// All coefficients.
    pub(crate) fn coefficients(&self) -> impl Iterator<Item = Twofold> {
        let minor = self.minor.iter().map(|c| Twofold::from(*c));
        self.major.iter().copied().chain(minor)
    }
}

/// `cos(π j (2i+1)/2n)`, from which nodes and expansions are computed.
pub(crate) struct Cosines {
    rows: Vec<[Twofold; TERMS]>,
}

impl Cosines {
    pub(crate) fn new() -> Self {
        let row = |j: usize| std::array::from_fn(|i| Twofold::cos_pi(j * (2 * i + 1), 2 * TERMS));
        Self {
            rows: (0..TERMS).map(row).collect(),
        }
    }

    /// The expansion of a function on [−1, 1].
    pub(crate) fn expansion(&self, function: impl Fn(Twofold) -> Twofold) -> Expansion {
        let values = self.rows[1].map(function);
        let coefficient = |(j, row): (usize, &[Twofold; TERMS])| {
            let terms = row.iter().zip(&values);
            let sum = terms.fold(Twofold::ZERO, |sum, (cosine, value)| sum + *cosine * *value);
            let scale = if j == 0 { 1.0 } else { 2.0 };
            sum.scaled(scale) / Twofold::from(TERMS as f64)
        };
        let coefficients: Vec<Twofold> = self.rows.iter().enumerate().map(coefficient).collect();
        Expansion::new(&coefficients)
    }
}

#[cfg(test)]
mod tests {
    use super::super::twofold::Twofold;
    use super::Cosines;

    #[test]
    fn an_exponential_is_approximated_to_24_digits() {
        let expansion = Cosines::new().expansion(Twofold::exp);
        for x in [-0.9, 0.0, 0.3, 1.0] {
            let x = Twofold::from(x);
            let error = (expansion.value(x) - x.exp()).rounded();
            assert!(error.abs() < 1e-22, "{x:?}: {error:e}");
        }
    }
}
