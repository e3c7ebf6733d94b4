//! Nodes and weights of the Gauss–Legendre rule, from the `gauss-quad` crate.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

/// One point of a rule on [−1, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Position in (−1, 1).
    pub position: f64,
    /// Weight; the weights of a rule add up to 2.
    pub weight: f64,
}

/// The rule of `points` points, exact for polynomials of degree 2 · `points` − 1.
pub(crate) fn legendre(points: NonZeroUsize) -> Vec<Node> {
    GaussLegendre::new(points)
        .into_iter()
        .map(|(position, weight)| Node { position, weight })
        .collect()
}

/// `legendre` for a number of points written in the source.
pub(crate) fn legendre_of<const POINTS: usize>() -> Vec<Node> {
    const { assert!(POINTS > 0) };
    NonZeroUsize::new(POINTS).map_or_else(Vec::new, legendre)
}

#[cfg(test)]
mod tests {
    use super::legendre_of;

    #[test]
    fn twenty_points_integrate_the_38th_power_exactly() {
        let integral: f64 = legendre_of::<20>()
            .iter()
            .map(|node| node.weight * node.position.powi(38))
            .sum();
        // Rounding of 20 terms of at most 1e-2.
        assert!((integral - 2.0 / 39.0).abs() < 1e-16);
    }
}
