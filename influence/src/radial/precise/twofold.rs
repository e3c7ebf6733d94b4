//! Numbers of 32 decimal digits: the unevaluated sum of two `f64` (Dekker 1971, *A floating-point technique for
//! extending the available precision*, Numer. Math. 18, 224–242).
//!

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `head + tail`, with `|tail|` at most half a unit in the last place of `head`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Twofold {
    head: f64,
    tail: f64,
}

/// π and ln 2 to 32 digits.
pub(crate) const PI: Twofold = Twofold {
    head: std::f64::consts::PI,
    tail: 1.224_646_799_147_353_2e-16,
};
const LN_2: Twofold = Twofold {
    head: std::f64::consts::LN_2,
    tail: 2.319_046_813_846_299_6e-17,
};

impl Twofold {
    pub(crate) const ZERO: Self = Self {
        head: 0.0,
        tail: 0.0,
    };
    pub(crate) const ONE: Self = Self {
        head: 1.0,
        tail: 0.0,
    };

    /// A number with no digits beyond its 16th.
    pub(crate) const fn from_head(head: f64) -> Self {
        Self { head, tail: 0.0 }
    }

    /// The nearest `f64`.
    #[inline]
    pub(crate) fn rounded(self) -> f64 {
        self.head
    }

    /// Exact product with a power of two.
    #[inline]
    pub(crate) fn scaled(self, power_of_two: f64) -> Self {
        Self {
            head: self.head * power_of_two,
            tail: self.tail * power_of_two,
        }
    }

    /// 2 to the integer power nearest to `exponent`.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "exponents of f64 are small; larger ones saturate"
    )]
    pub(crate) fn power_of_two(exponent: f64) -> f64 {
        2_f64.powi(exponent.round() as i32)
    }

    /// `a + b` for `|a| ≥ |b|`.
    #[inline]
    fn joined(a: f64, b: f64) -> Self {
        let head = a + b;
        Self {
            head,
            tail: b - (head - a),
        }
    }

    pub(crate) fn exp(self) -> Self {
        // e^x = 2^n (e^r)^256, r = (x − n ln 2)/256
        const HALVINGS: i32 = 8;
        let n = (self.head / LN_2.head).round();
        if n < -1000.0 {
            return Self::ZERO;
        }
        let r = (self - LN_2 * Self::from(n)).scaled(0.5_f64.powi(HALVINGS));
        // e^r − 1 by its series; |r| < 1.4e-3, 10 terms leave 1e-36.
        let mut less_one = Self::ZERO;
        for divisor in (1..=10_u8).rev() {
            less_one = (less_one + Self::ONE) * r / Self::from(f64::from(divisor));
        }
        // (1 + y)² − 1 = 2y + y²
        for _ in 0..HALVINGS {
            less_one = less_one.scaled(2.0) + less_one * less_one;
        }
        (less_one + Self::ONE).scaled(Self::power_of_two(n))
    }

    pub(crate) fn ln(self) -> Self {
        // One step of Newton's method: y + x e^(−y) − 1
        let y = Self::from(self.head.ln());
        y + (self * (-y).exp() - Self::ONE)
    }

    /// `cos(π numerator/denominator)`.
    pub(crate) fn cos_pi(numerator: usize, denominator: usize) -> Self {
        let turn = numerator % (2 * denominator);
        let turn = turn.min(2 * denominator - turn);
        let angle = PI * Self::from(turn as f64) / Self::from(denominator as f64);
        let square = -(angle * angle);
        // 1 − x²/2! + x⁴/4! …; x ≤ π, 20 terms leave 1e-28.
        let mut sum = Self::ZERO;
        for term in (1..=20_u8).rev() {
            let double = f64::from(2 * term);
            sum = (sum + Self::ONE) * square / Self::from(double * (double - 1.0));
        }
        sum + Self::ONE
    }
}

impl From<f64> for Twofold {
    #[inline]
    fn from(head: f64) -> Self {
        Self::from_head(head)
    }
}

impl Neg for Twofold {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.scaled(-1.0)
    }
}

impl Add for Twofold {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let head = self.head + other.head;
        let shadow = head - self.head;
        let lost = (self.head - (head - shadow)) + (other.head - shadow);
        Self::joined(head, lost + (self.tail + other.tail))
    }
}

impl Sub for Twofold {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Twofold {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let head = self.head * other.head;
        let lost = product_error(self.head, other.head, head);
        let cross = self.head * other.tail + self.tail * other.head;
        Self::joined(head, lost + cross)
    }
}

impl Div for Twofold {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.head / other.head;
        let rest = self - other * Self::from(first);
        Self::joined(first, rest.head / other.head)
    }
}

/// `a b − product` exactly, where `product` is the rounded `a b` (Dekker's splitting; not all hardware has
/// a fused multiply-add).
#[inline]
fn product_error(a: f64, b: f64, product: f64) -> f64 {
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// Upper and lower half of the digits.
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let scaled = SPLITTER * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::Twofold;

    fn distance(a: Twofold, b: Twofold) -> f64 {
        (a - b).rounded().abs()
    }

    #[test]
    fn a_third_times_three_is_one_to_32_digits() {
        let third = Twofold::ONE / Twofold::from(3.0);
        assert!(distance(third * Twofold::from(3.0), Twofold::ONE) < 1e-31);
    }

    #[test]
    fn exponential_and_logarithm_are_inverse() {
        for x in [-40.0, -1.3, -1e-5, 0.7, 3.0] {
            let x = Twofold::from(x) / Twofold::from(3.0);
            assert!(distance(x.exp().ln(), x) < 1e-29, "{x:?}");
        }
    }

    #[test]
    fn the_exponential_of_one_has_its_known_digits() {
        // e = 2.71828182845904523536028747135266249775724…
        let e = Twofold::ONE.exp();
        assert!((e.tail - 1.445_646_891_729_250_2e-16).abs() < 1e-29);
    }

    #[test]
    fn cosines_of_fractions_of_a_turn_are_exact_to_28_digits() {
        assert!(distance(Twofold::cos_pi(1, 3), Twofold::from(0.5)) < 1e-28);
        assert!(distance(Twofold::cos_pi(5, 3), Twofold::from(0.5)) < 1e-28);
        assert!(Twofold::cos_pi(1, 2).rounded().abs() < 1e-28);
    }
}
