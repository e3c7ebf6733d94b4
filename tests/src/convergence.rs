//! Observed and required orders of convergence.

/// Elements per side of the convergence studies. There are many, because single errors scatter with the position of the
/// contact's edge on the grid.
pub const GRIDS: [usize; 9] = [64, 80, 104, 128, 160, 208, 256, 320, 416];

/// The reason why a sequence of errors does not converge as required.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoConvergence {
    /// The order is too low.
    Order {
        /// Observed order.
        found: f64,
        /// Smallest order that passes.
        wanted: f64,
    },
    /// The last error is too large, whatever the order.
    Error {
        /// Error on the finest grid.
        found: f64,
        /// Largest error that passes.
        wanted: f64,
    },
}

/// Requires errors, by elements per side, to have an order of at least `order` and a last error of at most `error`;
/// returns the order.
///
/// # Errors
/// [`NoConvergence`], also for NaN.
pub fn demand(errors: &[(usize, f64)], order: f64, error: f64) -> Result<f64, NoConvergence> {
    let found = observed_order(errors);
    if found.is_nan() || found < order {
        let wanted = order;
        return Err(NoConvergence::Order { found, wanted });
    }
    match errors.last() {
        Some((_, last)) if *last <= error => Ok(found),
        last => Err(NoConvergence::Error {
            found: last.map_or(f64::NAN, |last| last.1),
            wanted: error,
        }),
    }
}

/// The order `o` in `error ∝ elements⁻ᵒ`: minus the least-squares slope of ln error over ln elements.
#[must_use]
pub fn observed_order(errors: &[(usize, f64)]) -> f64 {
    let points = || {
        errors
            .iter()
            .map(|(elements, error)| ((*elements as f64).ln(), error.ln()))
    };
    let count = errors.len() as f64;
    let x_mean = points().map(|(x, _)| x).sum::<f64>() / count;
    let y_mean = points().map(|(_, y)| y).sum::<f64>() / count;
    let covariance: f64 = points().map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    let variance: f64 = points().map(|(x, _)| (x - x_mean).powi(2)).sum();
    -covariance / variance
}

#[cfg(test)]
mod tests {
    use super::{GRIDS, NoConvergence, demand, observed_order};

    /// `0.1 (N/64)⁻ᵒ` on all grids, plus a part that does not converge.
    fn errors(order: f64, rest: f64) -> [(usize, f64); 9] {
        GRIDS.map(|elements| (elements, 0.1 * (elements as f64 / 64.0).powf(-order) + rest))
    }

    #[test]
    fn a_power_law_shows_its_exponent() {
        assert!((observed_order(&errors(1.5, 0.0)) - 1.5).abs() < 1e-13);
    }

    #[test]
    fn second_order_passes_and_first_order_is_refused() {
        assert!(demand(&errors(2.0, 0.0), 1.7, 1.0).is_ok());
        let refused = demand(&errors(1.0, 0.0), 1.7, 1.0);
        assert!(
            matches!(refused, Err(NoConvergence::Order { found, .. }) if (found - 1.0).abs() < 1e-13)
        );
    }

    #[test]
    fn second_order_to_a_wrong_limit_is_refused() {
        // A tenth of the first error remains.
        let refused = demand(&errors(2.0, 0.01), 1.7, 1.0);
        assert!(
            matches!(refused, Err(NoConvergence::Order { .. })),
            "{refused:?}"
        );
    }

    #[test]
    fn a_large_error_is_refused_whatever_its_order() {
        let refused = demand(&errors(2.0, 0.0), 1.7, 1e-3);
        assert!(matches!(refused, Err(NoConvergence::Error { .. })));
    }

    #[test]
    fn nan_and_empty_errors_are_refused() {
        let mut broken = errors(2.0, 0.0);
        broken[4].1 = f64::NAN;
        assert!(demand(&broken, 1.7, 1.0).is_err());
        assert!(demand(&[], 1.7, 1.0).is_err());
    }
}
