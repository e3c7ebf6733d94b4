//! A smooth part of the residuals that the noise should not be asked to explain: where it is, and how large.

use crate::outlier::median;

/// Highest degree of the polynomials used to find a smooth misfit. A wrong indenter shape or a missing layer bends a
/// curve once or twice.
pub(crate) const HIGHEST_DEGREE: u8 = 4;
/// The same for what repeats have in common: they tell a bend of a small part of the curve from noise.
pub(crate) const HIGHEST_COMMON_DEGREE: u8 = 8;
/// Number of parts of a range of abscissae, of equal ratio, in which residuals are averaged.
const PARTS: usize = 24;

/// A smooth deviation of the measurements from the best fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// Number of curves that share it.
    pub curves: usize,
    /// The abscissae between which it keeps its sign, about its largest value.
    pub range: [f64; 2],
    /// Its largest value, observed minus model, positive where the measurements lie above the model.
    pub largest: f64,
    /// Probability that independent curves, or short-lived noise of a single one, leave as much.
    pub probability: f64,
}

/// The curve times Chebyshev polynomials in `ln` of the abscissa, of all degrees up to the given one, for points of
/// these abscissae and values. The polynomials are those of the given range of abscissae.
pub(crate) fn smooth_columns(
    abscissa: &[f64],
    value: &[f64],
    range: [f64; 2],
    degree: u8,
) -> Vec<Vec<f64>> {
    let [low, high] = range.map(f64::ln);
    let column = |degree: u8| {
        let pairs = abscissa.iter().zip(value);
        let of_point = |(q, value): (&f64, &f64)| {
            let position = ((2.0 * q.ln() - low - high) / (high - low)).clamp(-1.0, 1.0);
            // T_n(x) = cos(n arccos x)
            value * (f64::from(degree) * position.acos()).cos()
        };
        pairs.map(of_point).collect()
    };
    (0..=degree).map(column).collect()
}

/// The smallest and largest of some abscissae.
pub(crate) fn range(abscissa: impl Iterator<Item = f64>) -> [f64; 2] {
    abscissa.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], q| {
        [low.min(q), high.max(q)]
    })
}

/// The largest deviation of the mean over curves, each given by its abscissae and residuals: the abscissae between
/// which it keeps its sign, and its value. `None` without points.
pub(crate) fn largest_deviation(curves: &[(&[f64], &[f64])]) -> Option<([f64; 2], f64)> {
    let all = range(
        curves
            .iter()
            .flat_map(|(abscissa, _)| abscissa.iter().copied()),
    );
    let means: Vec<([f64; 2], f64)> = (0..PARTS)
        .filter_map(|part| mean(curves, all, part))
        .collect();
    let size = |place: &usize| means[*place].1.abs();
    let top = (0..means.len()).max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let is_same = |place: usize| means[place].1 * means[top].1 > 0.0;
    let first = (0..top).rev().take_while(|place| is_same(*place)).last();
    let last = (top..means.len())
        .take_while(|place| is_same(*place))
        .last();
    let [low, high] = [first.unwrap_or(top), last.unwrap_or(top)];
    Some(([means[low].0[0], means[high].0[1]], means[top].1))
}

/// The abscissae of one part of the range, and the mean over the curves of the median residual of each there.
fn mean(
    curves: &[(&[f64], &[f64])],
    [low, high]: [f64; 2],
    part: usize,
) -> Option<([f64; 2], f64)> {
    let place = |q: f64| {
        let place = PARTS as f64 * (q / low).ln() / (high / low).ln();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a number from 0 to the number of parts"
        )]
        let place = place.max(0.0) as usize;
        place.min(PARTS - 1)
    };
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    let mut medians = Vec::new();
    for (abscissa, residual) in curves {
        let inside: Vec<(f64, f64)> = (abscissa.iter().copied())
            .zip(residual.iter().copied())
            .filter(|(q, _)| place(*q) == part)
            .collect();
        if inside.is_empty() {
            continue;
        }
        let [from, to] = range(inside.iter().map(|(q, _)| *q));
        ends = [ends[0].min(from), ends[1].max(to)];
        medians.push(median(inside.into_iter().map(|(_, r)| r).collect()));
    }
    let count = medians.len() as f64;
    (count > 0.0).then(|| (ends, medians.iter().sum::<f64>() / count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_and_size_of_a_hump_are_found() {
        // sin(π x) over three half waves of heights 1, −3 and 1, in x = ln q from 0 to 3.
        let q: Vec<f64> = (0..=600).map(|i| (f64::from(i) / 200.0).exp()).collect();
        let residual: Vec<f64> = (q.iter())
            .map(|q| {
                let wave = (std::f64::consts::PI * q.ln()).sin();
                if wave < 0.0 { 3.0 * wave } else { wave }
            })
            .collect();
        let ([from, to], largest) = largest_deviation(&[(&q, &residual)]).unwrap();
        // The parts are 1/8 wide in ln q.
        assert!(
            (from.ln() - 1.0).abs() < 0.13 && (to.ln() - 2.0).abs() < 0.13,
            "{from} {to}"
        );
        // The median over a part at the top of a half wave.
        assert!((largest + 3.0).abs() < 0.1, "{largest}");
    }

    #[test]
    fn opposite_deviations_of_two_curves_cancel() {
        let q: Vec<f64> = (1..=100).map(f64::from).collect();
        let up = vec![1.0; 100];
        let down = vec![-1.0; 100];
        let (_, largest) = largest_deviation(&[(&q, &up), (&q, &down)]).unwrap();
        assert_eq!(largest, 0.0);
    }
}
