//! The ticks of an axis.

/// Returns the multiples of 1, 2 or 5 times a power of ten between two ends, about `count` of them.
#[must_use]
pub fn linear(from: f64, to: f64, count: usize) -> Vec<f64> {
    let (low, high) = (from.min(to), from.max(to));
    let length = high - low;
    if length <= 0.0 || !length.is_finite() {
        return Vec::new();
    }
    let step = round_step(length / count.max(1) as f64);
    // The slack keeps an end that is a multiple up to rounding.
    let slack = 1e-9 * length;
    let first = ((low - slack) / step).ceil();
    (0..=2 * count + 2)
        .map(|i| (first + i as f64) * step)
        .take_while(|tick| *tick <= high + slack)
        .collect()
}

/// Returns the smallest of 1, 2 and 5 times a power of ten not below this.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let fits = |digit: &f64| digit * power >= step * (1.0 - 1e-9);
    [1.0, 2.0, 5.0].into_iter().find(fits).unwrap_or(10.0) * power
}

/// Fewest and most ticks of a logarithmic axis: fewer do not show that it is logarithmic, more make labels overlap.
const MIN_TICKS: usize = 3;
const MAX_TICKS: usize = 10;

/// Digits of the ticks within a decade, from few to many.
const DIGITS: [&[f64]; 4] = [
    &[1.0],
    &[1.0, 2.0, 5.0],
    &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
    &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
];

/// Returns the round numbers between two positive ends: powers of ten, and numbers between them until there are at
/// least three. On a very short axis they are the ticks of a linear one. The result is empty if an end is not a
/// positive number.
#[must_use]
pub fn logarithmic(from: f64, to: f64) -> Vec<f64> {
    let (low, high) = (from.min(to), from.max(to));
    if !(low > 0.0 && high.is_finite() && low < high) {
        return Vec::new();
    }
    let few = DIGITS.iter().skip(usize::from(high / low < 1e4));
    let mut ticks = few
        .map(|digits| with_digits(digits, low, high))
        .find(|ticks| ticks.len() >= MIN_TICKS)
        .or_else(|| {
            (4..=12)
                .map(|count| linear(low, high, count))
                .find(|ticks| ticks.len() >= MIN_TICKS)
        })
        .unwrap_or_default();
    // Over very many decades, keep every second, every third and so on.
    let stride = ticks.len().div_ceil(MAX_TICKS);
    let mut index = 0..;
    ticks.retain(|_| index.next().is_none_or(|i: usize| i.is_multiple_of(stride)));
    ticks
}

/// Returns these digits times every power of ten, between two positive ends.
fn with_digits(digits: &[f64], low: f64, high: f64) -> Vec<f64> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the logarithm of an f64 is between -324 and 309"
    )]
    let [first, last] = [low.log10().floor() as i32, high.log10().ceil() as i32];
    let ticks = (first..=last).flat_map(|power| {
        let power = 10_f64.powi(power);
        digits.iter().map(move |digit| digit * power)
    });
    ticks.filter(|tick| (low..=high).contains(tick)).collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn ticks_are_round_numbers_within_the_axis() {
        assert_eq!(linear(0.0, 10.0, 5), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(linear(-3.0, 3.1, 6), [-2.0, 0.0, 2.0]);
        let ticks = linear(0.1, 0.4, 3);
        for (tick, wanted) in ticks.iter().zip([0.1, 0.2, 0.3, 0.4]) {
            // One rounding of the product.
            assert_relative_eq!(*tick, wanted, max_relative = 1e-15);
        }
        assert_eq!(ticks.len(), 4);
    }

    #[test]
    fn a_reversed_axis_has_the_same_ticks() {
        assert_eq!(linear(10.0, 0.0, 5), linear(0.0, 10.0, 5));
    }

    #[test]
    fn an_axis_of_zero_length_has_no_ticks() {
        for (from, to) in [(1.0, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            assert!(linear(from, to, 5).is_empty());
        }
    }

    #[test]
    fn a_logarithmic_axis_has_ticks_at_powers_of_ten() {
        assert_eq!(logarithmic(0.5, 12.0), [0.5, 1.0, 2.0, 5.0, 10.0]);
        assert_eq!(logarithmic(0.9, 2e4), [1.0, 10.0, 100.0, 1000.0, 10_000.0]);
    }

    #[test]
    fn a_logarithmic_axis_of_any_length_has_at_least_three_ticks_and_never_too_many() {
        for low in [1e-9, 0.37, 1.0, 2.1, 9.5, 4e7] {
            for ratio in [1.02, 1.3, 1.69, 2.0, 3.3, 10.0, 55.0, 1e3, 2e4, 1e9, 1e30] {
                let ticks = logarithmic(low, low * ratio);
                assert!(
                    (3..=MAX_TICKS + 2).contains(&ticks.len()),
                    "{low} {ratio}: {ticks:?}"
                );
                let within =
                    |tick: &f64| *tick >= low * 0.999_999 && *tick <= low * ratio * 1.000_001;
                assert!(ticks.iter().all(within), "{ticks:?}");
            }
        }
        assert!(logarithmic(0.0, 1.0).is_empty() && logarithmic(1.0, f64::INFINITY).is_empty());
    }
}
