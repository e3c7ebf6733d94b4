//! Interpolation on [0, 1] by the polynomial through the roots of a Chebyshev polynomial.

use super::chebyshev;

/// The nodes in descending order.
pub(crate) fn nodes<const COUNT: usize>() -> [f64; COUNT] {
    let mut nodes = chebyshev::nodes(COUNT);
    std::array::from_fn(|_| 0.5 + 0.5 * nodes.next().unwrap_or_default())
}

/// Lagrange weights of the nodes at `place`.
pub(crate) fn weights<const COUNT: usize>(place: f64) -> [f64; COUNT] {
    let nodes = nodes::<COUNT>();
    std::array::from_fn(|i| {
        let others = nodes.iter().enumerate().filter(|(other, _)| *other != i);
        others
            .map(|(_, node)| (place - node) / (nodes[i] - node))
            .product()
    })
}

#[cfg(test)]
mod tests {
    use super::{nodes, weights};

    #[test]
    fn polynomials_with_fewer_terms_than_nodes_are_reproduced() {
        let cubic = |x: f64| 2.0 - x + 3.0 * x.powi(3);
        for place in [0.0, 0.17, 0.5, 1.0] {
            let terms = nodes::<4>().map(cubic).into_iter().zip(weights::<4>(place));
            let found: f64 = terms.map(|(value, weight)| value * weight).sum();
            assert!((found - cubic(place)).abs() < 1e-14, "{place}: {found}");
        }
    }
}
