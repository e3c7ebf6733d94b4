//! The decay of waves of wavenumber `k` across a layer of thickness `H`, `s = k H`.
//!
//! All functions carry the factor `4θ`, `θ = e^{−2s}`, so nothing grows:
//!
//! ```text
//! 4θ sinh² s = e²               e  = 1 − θ
//! 4θ (sinh s cosh s − s) = q₁   q₁ = (1 − θ)(1 + θ) − 4θs
//! 4θ (sinh² s − s²) = q₂        q₂ = (1 − θ)² − 4θs²
//! ```
//!
//! For small `s` the differences are summed as series; for large `s` they are computed as written.

/// The functions of `s = k H` in the propagation through one layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Decay {
    /// `s = k H`
    pub(crate) s: f64,
    /// `4θ = 4 e^{−2s}`
    pub(crate) theta4: f64,
    /// `e = 1 − θ`
    pub(crate) e: f64,
    /// `q₁ = 2θ (sinh 2s − 2s)`
    pub(crate) q1: f64,
    /// `q₂ = 4θ (sinh² s − s²)`
    pub(crate) q2: f64,
}

/// Above this `s` every term with `θ` is below the smallest normal number: the layer acts as a half-space. 2 · 360 >
/// 708 = −ln(smallest normal), with room left for `s²`.
const DEEP: f64 = 360.0;

impl Decay {
    pub(crate) fn new(s: f64) -> Self {
        if s < 1.0 {
            Self::shallow(s)
        } else if s < DEEP {
            Self::thick(s)
        } else {
            Self::DEEP
        }
    }

    /// The limit `s → ∞`, as numbers: `θ = 0`, and `s` no longer matters.
    const DEEP: Self = Self {
        s: 0.0,
        theta4: 0.0,
        e: 1.0,
        q1: 1.0,
        q2: 1.0,
    };

    fn thick(s: f64) -> Self {
        let theta = (-2.0 * s).exp();
        let theta4 = 4.0 * theta;
        let e = 1.0 - theta;
        Self {
            s,
            theta4,
            e,
            q1: e * (1.0 + theta) - theta4 * s,
            q2: e * e - theta4 * s * s,
        }
    }

    fn shallow(s: f64) -> Self {
        let e = -(-2.0 * s).exp_m1();
        let theta4 = 4.0 * (1.0 - e);
        let z = 4.0 * s * s;
        Self {
            s,
            theta4,
            e,
            // sinh 2s − 2s = (2s)³ Σ z^n / (2n+3)!
            q1: theta4 * s * z * horner(&SINH_TAIL, z),
            // sinh² s − s² = (cosh 2s − 1 − 2s²)/2 = z²/2 Σ z^n / (2n+4)!
            q2: theta4 * 0.5 * z * z * horner(&COSH_TAIL, z),
        }
    }
}

fn horner(coefficients: &[f64; TERMS], z: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * z + c)
}

/// With 12 terms the first omitted one is below 1e-17 of the sum at `z = 4`, the end of the range:
/// `4^12 · 3! / 27! = 9e-21`.
const TERMS: usize = 12;

/// `1 / (2n + 3)!`
const SINH_TAIL: [f64; TERMS] = inverse_factorials(3.0);

/// `1 / (2n + 4)!`
const COSH_TAIL: [f64; TERMS] = inverse_factorials(4.0);

/// `1 / (2n + first)!`
const fn inverse_factorials(first: f64) -> [f64; TERMS] {
    let mut values = [0.0; TERMS];
    let (mut last, mut factor, mut factorial) = (first, 1.0, 1.0);
    let mut n = 0;
    while n < TERMS {
        while factor < last {
            factor += 1.0;
            factorial *= factor;
        }
        values[n] = 1.0 / factorial;
        last += 2.0;
        n += 1;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_exponentials_agree_where_they_meet() {
        let (series, direct) = (Decay::shallow(1.0), Decay::thick(1.0));
        // Cancellation in the direct form loses a factor 4 at s = 1: 4 · 2.2e-16 · few.
        for (x, y) in [
            (series.theta4, direct.theta4),
            (series.e, direct.e),
            (series.q1, direct.q1),
            (series.q2, direct.q2),
        ] {
            assert!((x - y).abs() <= 2e-15 * y, "{x} {y}");
        }
    }

    #[test]
    fn thin_layers_keep_every_digit() {
        let s = 1e-8;
        let decay = Decay::new(s);
        // q₁ = 16 s³ / 3 · θ (1 + O(s²)), q₂ = 4 s⁴ / 3 · θ (1 + O(s²)); roundings only
        let theta = 1.0 - 2.0 * s + 2.0 * s * s;
        assert!((decay.q1 / (16.0 / 6.0 * s * s * s * theta) - 1.0).abs() < 2e-15);
        assert!((decay.q2 / (4.0 / 3.0 * s * s * s * s * theta) - 1.0).abs() < 2e-15);
    }

    #[test]
    fn thick_layers_reach_their_limit() {
        assert_eq!(Decay::new(1e300), Decay::DEEP);
        assert_eq!(Decay::new(f64::INFINITY), Decay::DEEP);
        assert!(Decay::new(359.9).theta4 < 1e-300);
    }
}
