//! Observed orders of convergence.

/// Elements per side of the convergence studies; many, because single errors scatter with how the grid meets the
/// contact's edge.
pub const GRIDS: [usize; 9] = [64, 80, 104, 128, 160, 208, 256, 320, 416];

/// The order `o` of `error ∝ elements⁻ᵒ`: minus the slope of ln error over ln elements, by least squares.
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
    use super::{GRIDS, observed_order};

    #[test]
    fn a_power_law_shows_its_exponent() {
        let errors = GRIDS.map(|elements| (elements, 3.0 * (elements as f64).powf(-1.5)));
        assert!((observed_order(&errors) - 1.5).abs() < 1e-13);
    }
}
