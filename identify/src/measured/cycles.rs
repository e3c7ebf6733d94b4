//! The cycles of loading and unloading of a curve, by its forces.

/// The standard deviation of a normal distribution over the median of its absolute values.
pub(crate) const NORMAL_OVER_MEDIAN: f64 = 1.4826;
/// A force has fallen or risen if it differs from an earlier one by this part of the largest, and by so many standard
/// deviations.
const CHANGE_PART: f64 = 0.05;
const CHANGE_DEVIATIONS: f64 = 8.0;
/// A force is as large as another within so many standard deviations.
const SAME_DEVIATIONS: f64 = 4.0;
/// A hold at the largest force stays within this part of it, if that is more. At the end of a loading
const HOLD_WIDTH: f64 = 5e-4;
/// it has so many points,
const FEWEST_HELD: usize = 10;
/// and over as many before it the force has risen by so many times that width.
const HOLD_RATIO: f64 = 3.0;
/// Its level is the median of so many points before the largest force.
const LEVEL_POINTS: usize = 8;

/// The places of the largest force of each cycle, in their order.
pub(crate) fn peaks(force: &[f64]) -> Vec<usize> {
    let smooth = medians(force);
    let largest = smooth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let change = (CHANGE_PART * largest).max(CHANGE_DEVIATIONS * scatter(force));
    let mut peaks = Vec::new();
    let (mut is_rising, mut turn) = (true, 0);
    for (at, value) in smooth.iter().enumerate() {
        let back = value - smooth[turn];
        let back = if is_rising { -back } else { back };
        if back <= 0.0 {
            turn = at;
        } else if back > change {
            peaks.extend(is_rising.then_some(turn));
            is_rising = !is_rising;
            turn = at;
        }
    }
    // A curve may end before it falls.
    peaks.extend((is_rising && smooth.get(turn) == Some(&largest)).then_some(turn));
    peaks
}

/// The place at which a loading of these forces, the last of which is the largest, ends: where a hold at the largest
/// force begins, if there is one. There the forces, but for their noise, no longer rise as before.
pub(crate) fn end_of_loading(force: &[f64]) -> usize {
    let Some(last) = force.len().checked_sub(1) else {
        return 0;
    };
    let width = hold_width(force, force[last]);
    let smooth = medians(force);
    let level = median(&force[last.saturating_sub(LEVEL_POINTS)..]);
    let first = smooth.iter().position(|value| *value >= level - width);
    let first = first.unwrap_or(last);
    let held = last - first;
    let before = first.checked_sub(held).map_or(0.0, |at| smooth[at]);
    let is_held = held >= FEWEST_HELD && smooth[first] - before > HOLD_RATIO * width;
    if is_held { first } else { last }
}

/// The width of the forces of a hold at the largest of these, N.
pub(crate) fn hold_width(force: &[f64], largest: f64) -> f64 {
    (HOLD_WIDTH * largest).max(SAME_DEVIATIONS * scatter(force))
}

/// Whether each force is the largest so far, but for its noise: the body has not yet been unloaded from it.
pub(crate) fn is_first_loading(force: &[f64]) -> Vec<bool> {
    let width = SAME_DEVIATIONS * scatter(force);
    let mut largest = f64::NEG_INFINITY;
    let is_new = |(value, smooth): (&f64, f64)| {
        largest = largest.max(smooth);
        *value >= largest - width
    };
    force.iter().zip(medians(force)).map(is_new).collect()
}

/// The standard deviation of white noise on smooth values, from their second differences, whose variance is 6 times its
/// own.
pub(crate) fn scatter(values: &[f64]) -> f64 {
    let bends = values.windows(3).map(|v| (v[0] - 2.0 * v[1] + v[2]).abs());
    let bends: Vec<f64> = bends.collect();
    let found = NORMAL_OVER_MEDIAN * median(&bends) / 6.0_f64.sqrt();
    if found.is_finite() { found } else { 0.0 }
}

/// The median of some values.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The median of each value with its neighbours: single spikes do not count.
pub(crate) fn medians(values: &[f64]) -> Vec<f64> {
    let middle = |at: usize| match (at.checked_sub(1), values.get(at + 1)) {
        (Some(before), Some(after)) => median(&[values[before], values[at], *after]),
        _ => values[at],
    };
    (0..values.len()).map(middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cycles up to these forces, each unloaded to a fifth, with a ripple.
    fn cycles(tops: &[f64]) -> Vec<f64> {
        let mut force = Vec::new();
        let mut last: f64 = 0.0;
        for top in tops {
            for end in [*top, 0.2 * top] {
                force.extend((0..50).map(|i| last + (end - last) * f64::from(i) / 50.0));
                last = end;
            }
        }
        let ripple = |(i, force): (usize, f64)| force + 1e-3 * (2.4 * i as f64).sin();
        force.into_iter().enumerate().map(ripple).collect()
    }

    #[test]
    fn a_loading_ends_where_its_hold_begins_and_not_before_if_it_has_none() {
        let noise = |i: usize| 1e-3 * ((2.4 * i as f64).sin() + (5.1 * i as f64).cos());
        let ramp = |i: usize| (i.min(200) as f64 / 200.0).powf(1.5) + noise(i);
        let held: Vec<f64> = (0..300).map(ramp).collect();
        let end = end_of_loading(&held);
        assert!((194..=200).contains(&end), "{end}");
        assert_eq!(end_of_loading(&held[..200]), 199);
    }

    #[test]
    fn each_cycle_has_a_peak_and_what_is_loaded_again_is_no_first_loading() {
        let force = cycles(&[1.0, 2.0, 5.0]);
        let peaks = peaks(&force);
        assert_eq!(peaks.len(), 3, "{peaks:?}");
        for (peak, place) in peaks.iter().zip([50, 150, 250]) {
            assert!(peak.abs_diff(place) <= 2, "{peaks:?}");
        }
        let is_first = is_first_loading(&force);
        // Loaded again from 0.2 at 100 to 1 near 122, then further.
        assert!(is_first[10..49].iter().all(|first| *first));
        assert!(is_first[60..118].iter().all(|first| !first));
        assert!(is_first[126..149].iter().all(|first| *first));
        assert_eq!(super::peaks(&force[..40]).len(), 1);
    }
}
