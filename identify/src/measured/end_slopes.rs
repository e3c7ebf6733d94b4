//! The slopes of a curve at its ends: the contact is at the steeper one, though a baseline may reach larger forces.

/// The part of the range of lengths that is an end.
const END: f64 = 0.1;

/// How steeply the force rises outwards at the smallest and at the largest of some lengths, N/m.
pub(super) fn end_slopes(lengths: &[f64], forces: &[f64]) -> [f64; 2] {
    let low = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    let high = lengths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = END * (high - low);
    let points = || lengths.iter().copied().zip(forces.iter().copied());
    let end =
        |is_in: &dyn Fn(f64) -> bool| points().filter(|point| is_in(point.0)).collect::<Vec<_>>();
    [
        -slope(&end(&|length| length <= low + width)),
        slope(&end(&|length| length >= high - width)),
    ]
}

/// The slope of the least-squares line through some points; 0 if their lengths are equal.
fn slope(points: &[(f64, f64)]) -> f64 {
    let sum = |of: &dyn Fn((f64, f64)) -> f64| points.iter().copied().map(of).sum::<f64>();
    let count = points.len() as f64;
    let (x, y) = (sum(&|point| point.0) / count, sum(&|point| point.1) / count);
    let squares = sum(&|point| (point.0 - x).powi(2));
    let products = sum(&|point| (point.0 - x) * (point.1 - y));
    if squares > 0.0 {
        products / squares
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_a_bent_line_have_its_slopes() {
        let lengths: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
        let bent = |x: &f64| (2.0 - x).max(0.0) + 3.0 * (x - 6.0).max(0.0);
        let forces: Vec<f64> = lengths.iter().map(bent).collect();
        let [line, contact] = end_slopes(&lengths, &forces);
        assert!((line - 1.0).abs() < 1e-12 && (contact - 3.0).abs() < 1e-12);
        assert!(
            end_slopes(&[1.0; 3], &[1.0, 2.0, 3.0])
                .iter()
                .all(|slope| slope.abs() <= 0.0)
        );
    }
}
