//! One comparison with its verdict.

use pellicle_contact::Certificate;
use serde::Serialize;

use crate::run::ValidationError;

/// One line of the table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Comparison {
    /// The quantity compared.
    pub check: String,
    /// The known value.
    pub reference: ComparedValue,
    /// The computed value.
    pub computed: ComparedValue,
    /// Dimensionless difference of the two; `null` in JSON if it is NaN.
    pub error: f64,
    /// The largest error that passes; for a negative control, the certificate's tolerance, which the error must exceed.
    pub tolerance: f64,
    /// Whether the row passes.
    pub verdict: RowVerdict,
}

/// A number, or a word if a judgement is compared.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ComparedValue {
    /// A number.
    Number(f64),
    /// A word.
    Word(String),
}

/// Verdict on a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RowVerdict {
    /// The row passes.
    Pass,
    /// The row fails.
    Fail,
}

impl RowVerdict {
    fn of(passes: bool) -> Self {
        if passes { Self::Pass } else { Self::Fail }
    }
}

impl Comparison {
    /// Compares two numbers by their relative error.
    #[must_use]
    pub fn relative(check: String, reference: f64, computed: f64, tolerance: f64) -> Self {
        let error = (computed / reference - 1.0).abs();
        Self::compare(check, [reference, computed], error, tolerance)
    }

    /// Compares two numbers with a given error.
    #[must_use]
    pub fn compare(
        check: String,
        [reference, computed]: [f64; 2],
        error: f64,
        tolerance: f64,
    ) -> Self {
        Self {
            check,
            reference: ComparedValue::Number(reference),
            computed: ComparedValue::Number(computed),
            error,
            tolerance,
            verdict: RowVerdict::of(error <= tolerance),
        }
    }

    /// Returns the worst of many comparisons, each given by reference, computed number and error.
    #[must_use]
    pub fn worst(
        check: String,
        comparisons: impl Iterator<Item = ([f64; 2], f64)>,
        tolerance: f64,
    ) -> Self {
        let none = ([f64::NAN; 2], f64::NEG_INFINITY);
        // NaN is worse than any number.
        let (numbers, error) = comparisons.fold(none, |worst, next| {
            let is_worse = !worst.1.is_nan() && (next.1.is_nan() || next.1 > worst.1);
            if is_worse { next } else { worst }
        });
        let error = if error == f64::NEG_INFINITY {
            f64::NAN
        } else {
            error
        };
        Self::compare(check, numbers, error, tolerance)
    }

    /// Checks that the certificate rejects a pressure.
    #[must_use]
    pub fn refused(check: String, certificate: &Certificate) -> Self {
        Self::judged(check, "refused", certificate)
    }

    /// Checks that the certificate accepts a pressure.
    #[must_use]
    pub fn accepted(check: String, certificate: &Certificate) -> Self {
        Self::judged(check, "accepted", certificate)
    }

    fn judged(check: String, wanted: &str, certificate: &Certificate) -> Self {
        let found = if certificate.is_satisfied() {
            "accepted"
        } else {
            "refused"
        };
        Self {
            error: certificate.worst(),
            tolerance: certificate.tolerance,
            ..Self::words(check, wanted, found)
        }
    }

    /// Compares two words, which must be equal.
    #[must_use]
    pub fn words(check: String, wanted: &str, found: &str) -> Self {
        let same = wanted == found;
        Self {
            check,
            reference: ComparedValue::Word(wanted.into()),
            computed: ComparedValue::Word(found.into()),
            error: if same { 0.0 } else { 1.0 },
            tolerance: 0.0,
            verdict: RowVerdict::of(same),
        }
    }

    /// Makes the row of a comparison that could not be computed.
    #[must_use]
    pub fn failed(check: String, error: &ValidationError) -> Self {
        Self {
            computed: ComparedValue::Word(error.to_string()),
            ..Self::compare(check, [f64::NAN; 2], f64::NAN, 0.0)
        }
    }

    /// Whether the row passes.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.verdict == RowVerdict::Pass
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_above_the_tolerance_and_nan_fail() {
        let row = |computed| Comparison::relative("x".into(), 2.0, computed, 1e-3);
        assert!(row(2.001).passes());
        assert!(!row(2.003).passes());
        assert!(!row(f64::NAN).passes());
        assert!(!Comparison::compare("x".into(), [0.0; 2], f64::NAN, f64::INFINITY).passes());
    }

    #[test]
    fn the_worst_of_no_rows_fails_and_nan_is_the_worst() {
        let worst = |errors: &[f64]| {
            let comparisons = errors.iter().map(|error| ([1.0, 2.0], *error));
            Comparison::worst("x".into(), comparisons, 0.5)
        };
        assert!(worst(&[0.1, 0.4, 0.2]).passes());
        assert_eq!(worst(&[0.1, 0.4, 0.2]).error, 0.4);
        assert!(!worst(&[0.1, 0.6]).passes());
        assert!(!worst(&[0.1, f64::NAN, 0.2]).passes());
        assert!(!worst(&[]).passes());
    }

    #[test]
    fn a_negative_control_fails_where_the_certificate_accepts() {
        let certificate = |overlap| Certificate {
            complementarity: 0.0,
            gap_in_contact: 0.0,
            overlap,
            load: 0.0,
            min_pressure: 0.0,
            gap_at_limit: None,
            over_limit: None,
            tolerance: 1e-8,
        };
        assert!(Comparison::refused("x".into(), &certificate(1e-7)).passes());
        assert!(!Comparison::refused("x".into(), &certificate(1e-9)).passes());
        assert!(Comparison::accepted("x".into(), &certificate(1e-9)).passes());
        assert!(!Comparison::accepted("x".into(), &certificate(1e-7)).passes());
    }
}
