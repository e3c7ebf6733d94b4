//! Key and number as the search sees them: logarithms where all values are positive, because powers of a key, as
//! Hertz' pressure `p₀ ∝ Q^(1/3)`, are straight lines then.

use super::condition::Condition;
use super::tried::Tried;

/// The least ratio of a number to its limit that its logarithm distinguishes: a number of zero, as an area without
/// contact, is below any limit.
const LEAST_RATIO: f64 = 1e-30;

/// The scales of a search.
#[derive(Debug, Clone, Copy)]
pub struct Scales {
    is_key_logarithmic: bool,
    is_number_logarithmic: bool,
    limit: f64,
    /// The limit on the scale: a zero whose sign is that of the side on which it counts.
    zero: f64,
}

/// A certified case on the scales: 0 is the limit, and the sign of 0 the side on which it counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certified {
    /// The key.
    pub key: f64,
    /// The number.
    pub number: f64,
    /// The ends of number ± error; none if the error is not resolved.
    pub band: Option<[f64; 2]>,
}

impl Scales {
    /// Returns the scales for a range of the key, numbers at its ends, and their condition.
    #[must_use]
    pub fn new(range: [f64; 2], numbers: [f64; 2], condition: &Condition) -> Self {
        let limit = condition.limit;
        let is_limit_below = condition.comparison.counts_limit_below();
        let is_positive = |values: [f64; 2]| values.iter().all(|value| *value > 0.0);
        Self {
            is_key_logarithmic: is_positive(range),
            is_number_logarithmic: limit > 0.0 && is_positive(numbers),
            limit,
            zero: if is_limit_below { -0.0 } else { 0.0 },
        }
    }

    /// Whether equal lengths of the key are equal ratios.
    #[must_use]
    pub fn is_key_logarithmic(&self) -> bool {
        self.is_key_logarithmic
    }

    /// The key on its scale.
    #[must_use]
    pub fn key(&self, key: f64) -> f64 {
        if self.is_key_logarithmic {
            key.ln()
        } else {
            key
        }
    }

    /// The key at a place on its scale.
    #[must_use]
    pub fn key_at(&self, place: f64) -> f64 {
        if self.is_key_logarithmic {
            place.exp()
        } else {
            place
        }
    }

    fn number(&self, number: f64) -> f64 {
        let difference = if self.is_number_logarithmic {
            (number / self.limit).max(LEAST_RATIO).ln()
        } else {
            number - self.limit
        };
        if difference.abs() > 0.0 {
            difference
        } else {
            self.zero
        }
    }

    /// Whether a number on its scale is zero.
    #[must_use]
    pub fn is_zero(&self, number: f64) -> bool {
        number.to_bits() == self.number(0.0).to_bits()
    }

    /// A case on the scales; none if it is not certified.
    #[must_use]
    pub fn certified(&self, tried: &Tried) -> Option<Certified> {
        Some(Certified {
            key: self.key(tried.key),
            number: self.number(tried.certified()?),
            band: tried.band().map(|band| band.map(|end| self.number(end))),
        })
    }
}
