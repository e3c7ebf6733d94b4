//! The cantilever of a curve whose file does not state it: a spring constant, and a sensitivity of a deflection in
//! volts, with which the curve can be that of a contact.
//!
//! The deflection is at most the approach, `d = F/k ≤ z`, so the slope of the force over the height is below k.

/// The spring constant where the slope allows it, N/m: of a soft cantilever.
const SPRING_CONSTANT: f64 = 0.1;
/// The sensitivity where the slope allows it, m/V.
const SENSITIVITY: f64 = 1e-7;
/// The spring constant is at least this many times the slope of the force: then the body is at least as soft.
const ABOVE_SLOPE: f64 = 2.0;

/// A spring constant for forces, N, over heights, m: the next power of ten that is large enough.
pub(super) fn spring_constant(heights: &[f64], forces: &[f64]) -> f64 {
    let least = ABOVE_SLOPE * slope(heights, forces);
    decade(|k| k >= least, SPRING_CONSTANT, 10.0)
}

/// A sensitivity for deflections, V, over heights, m: the next power of ten that is small enough.
pub(super) fn sensitivity(heights: &[f64], volts: &[f64]) -> f64 {
    let slope = slope(heights, volts);
    decade(|s| s * slope * ABOVE_SLOPE <= 1.0, SENSITIVITY, 0.1)
}

/// The first of some powers of ten, from a start on, that is good.
fn decade(is_good: impl Fn(f64) -> bool, start: f64, factor: f64) -> f64 {
    const MOST: usize = 12;
    let powers = std::iter::successors(Some(start), |last| Some(last * factor));
    powers
        .take(MOST)
        .find(|value| is_good(*value))
        .unwrap_or(start)
}

/// The slope of `y` over `x`, without its sign, over the points in the upper half of `y`: those in contact.
fn slope(x: &[f64], y: &[f64]) -> f64 {
    let valid = || {
        x.iter()
            .zip(y)
            .filter(|(x, y)| x.is_finite() && y.is_finite())
    };
    let lowest = valid().map(|(_, y)| *y).fold(f64::INFINITY, f64::min);
    let highest = valid().map(|(_, y)| *y).fold(f64::NEG_INFINITY, f64::max);
    let middle = 0.5 * (lowest + highest);
    let upper: Vec<_> = valid().filter(|(_, y)| **y > middle).collect();
    let count = upper.len() as f64;
    let (x0, y0) = upper.iter().fold((0.0, 0.0), |(a, b), (x, y)| {
        (a + *x / count, b + *y / count)
    });
    let (mut product, mut square) = (0.0, 0.0);
    for (x, y) in upper {
        product += (x - x0) * (y - y0);
        square += (x - x0).powi(2);
    }
    if square > 0.0 {
        (product / square).abs()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steep_force_needs_a_stiff_cantilever_and_a_steep_voltage_a_small_sensitivity() {
        let heights: Vec<f64> = (0..100).map(|i| 1e-8 * f64::from(i)).collect();
        let of = |slope: f64| -> Vec<f64> {
            heights
                .iter()
                .map(|z| slope * (z - 5e-7).max(0.0))
                .collect()
        };
        assert_eq!(spring_constant(&heights, &of(0.01)), 0.1);
        assert_eq!(spring_constant(&heights, &of(3.0)), 10.0);
        assert_eq!(sensitivity(&heights, &of(1e6)), 1e-7);
        // 1e-8, but for the rounding of a product with a tenth.
        assert!((sensitivity(&heights, &of(2e7)) / 1e-8 - 1.0).abs() < 1e-12);
    }
}
