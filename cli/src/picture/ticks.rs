//! Where the ticks of an axis stand.

/// The multiples of 1, 2 or 5 times a power of ten between two ends, about `count` of them.
#[must_use]
pub fn linear(from: f64, to: f64, count: usize) -> Vec<f64> {
    let (low, high) = (from.min(to), from.max(to));
    let length = high - low;
    if length <= 0.0 || !length.is_finite() {
        return Vec::new();
    }
    let step = round_step(length / count.max(1) as f64);
    // The slack keeps an end that is a multiple but for its last bits.
    let slack = 1e-9 * length;
    let first = ((low - slack) / step).ceil();
    (0..=2 * count + 2)
        .map(|i| (first + i as f64) * step)
        .take_while(|tick| *tick <= high + slack)
        .collect()
}

/// The smallest of 1, 2, 5 times a power of ten that is no smaller than this.
fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let fits = |digit: &f64| digit * power >= step * (1.0 - 1e-9);
    [1.0, 2.0, 5.0].into_iter().find(fits).unwrap_or(10.0) * power
}

/// The powers of ten between two positive ends, and 2 and 5 times them where there are few.
#[must_use]
pub fn logarithmic(from: f64, to: f64) -> Vec<f64> {
    let digits: &[f64] = if to / from > 1e4 {
        &[1.0]
    } else {
        &[1.0, 2.0, 5.0]
    };
    let (first, last) = (from.log10().floor(), to.log10().ceil());
    let mut ticks = Vec::new();
    let mut power = first;
    while power <= last {
        ticks.extend(digits.iter().map(|digit| digit * 10_f64.powf(power)));
        power += 1.0;
    }
    ticks.retain(|tick| (from..=to).contains(tick));
    ticks
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_axis() {
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
    fn an_axis_that_runs_down_has_the_same_ticks() {
        assert_eq!(linear(10.0, 0.0, 5), linear(0.0, 10.0, 5));
    }

    #[test]
    fn an_axis_without_length_has_none() {
        for (from, to) in [(1.0, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
            assert!(linear(from, to, 5).is_empty());
        }
    }

    #[test]
    fn a_logarithmic_axis_has_ticks_at_powers_of_ten() {
        assert_eq!(logarithmic(0.5, 12.0), [0.5, 1.0, 2.0, 5.0, 10.0]);
        assert_eq!(logarithmic(0.9, 2e4), [1.0, 10.0, 100.0, 1000.0, 10_000.0]);
    }
}
