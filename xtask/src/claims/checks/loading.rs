//! Penetration against load (Fig. 4).

use super::super::finding::{percent, significant};
use super::super::{Curve, Finding};

/// Holds if `D(Q)` departs from a straight line through the origin by more than `threshold` of its last value.
pub(in super::super) fn penetration_is_nonlinear(curve: &Curve, threshold: f64) -> Finding {
    let [q, d] = [&curve.force, &curve.penetration].map(|list| list[list.len() - 1]);
    let departures = curve
        .force
        .iter()
        .zip(&curve.penetration)
        .map(|(force, depth)| (depth / d - force / q).abs());
    let largest = departures.fold(0.0, f64::max);
    Finding::new(
        largest > threshold,
        format!("{} off a straight line", percent(largest)),
    )
}

/// Holds if no `∂D/∂Q` is above the smallest of the loads before by more than `threshold`, and the last is below the first
/// by more than that.
pub(in super::super) fn gradient_falls(curve: &Curve, threshold: f64) -> Finding {
    let mut lowest = f64::INFINITY;
    let mut rise = f64::NEG_INFINITY;
    for &gradient in &curve.gradient {
        rise = rise.max(gradient / lowest - 1.0);
        lowest = lowest.min(gradient);
    }
    let [first, last] = [curve.gradient[0], curve.gradient[curve.gradient.len() - 1]];
    let holds = rise <= threshold && last < (1.0 - threshold) * first;
    let way = if rise > 0.0 {
        format!("rising by {} on the way", percent(rise))
    } else {
        "never rising".to_owned()
    };
    Finding::new(
        holds,
        format!("falls to {} of the first, {way}", percent(last / first)),
    )
}

/// Holds if `∂D/∂Q` changes by less than `threshold` over the upper half of the loads.
pub(in super::super) fn gradient_becomes_constant(curve: &Curve, threshold: f64) -> Finding {
    let last = curve.gradient[curve.gradient.len() - 1];
    let half = curve.at(curve.last_force() / 2.0, &curve.gradient);
    // ∂D/∂Q ~ Q^m; m = −1/3 for a paraboloid on a half-space, 0 for a straight line.
    let exponent = (last / half).ln() / 2.0_f64.ln();
    Finding::new(
        (1.0 - last / half).abs() < threshold,
        format!(
            "changes by {} over the upper half of the loads, as Q^{}",
            percent((last / half - 1.0).abs()),
            significant(exponent, 2)
        ),
    )
}

/// Holds if the first curve is smaller in penetration than the second at their last load, and at none larger by more
/// than `threshold`.
pub(in super::super) fn first_penetrates_less(
    less: &Curve,
    more: &Curve,
    threshold: f64,
) -> Finding {
    let shortfalls: Vec<f64> = less
        .force
        .iter()
        .zip(&less.penetration)
        .map(|(&force, depth)| 1.0 - depth / more.at(force, &more.penetration))
        .collect();
    let smallest = shortfalls.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = shortfalls.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let last = shortfalls[shortfalls.len() - 1];
    Finding::new(
        smallest >= -threshold && last > threshold,
        format!(
            "smaller by {} to {}, by {} at the last load",
            percent(smallest),
            percent(largest),
            percent(last)
        ),
    )
}

/// Holds if the curves, each over its own last load and penetration, are never farther apart than `threshold`.
pub(in super::super) fn curves_are_similar(one: &Curve, other: &Curve, threshold: f64) -> Finding {
    let [d1, d2] = [one, other].map(|curve| curve.penetration[curve.penetration.len() - 1]);
    let scale = other.last_force() / one.last_force();
    let distances = one
        .force
        .iter()
        .zip(&one.penetration)
        .map(|(&force, depth)| {
            (depth / d1 - other.at(force * scale, &other.penetration) / d2).abs()
        });
    let largest = distances.fold(0.0, f64::max);
    Finding::new(
        largest < threshold,
        format!(
            "{} apart at most; the second is {} times as deep",
            percent(largest),
            significant(d2 / d1, 3)
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::super::super::made_up::power_law;
    use super::*;

    #[test]
    fn hertzian_curves_bend_and_their_gradient_falls_but_not_to_a_constant() {
        let hertz = power_law(1.0, 2.0 / 3.0);
        assert!(penetration_is_nonlinear(&hertz, 0.05).holds);
        assert!(gradient_falls(&hertz, 0.02).holds);
        let constant = gradient_becomes_constant(&hertz, 0.05);
        assert!(!constant.holds);
        // Exact but for the straight lines between the loads, of which one lies at the half.
        assert!(
            constant.measured.ends_with("Q^-0.33"),
            "{}",
            constant.measured
        );
    }

    #[test]
    fn a_straight_line_is_linear_and_its_gradient_constant() {
        let line = power_law(1.0, 1.0);
        assert!(!penetration_is_nonlinear(&line, 0.05).holds);
        assert!(gradient_becomes_constant(&line, 0.05).holds);
    }

    #[test]
    fn a_stiffening_then_softening_curve_does_not_fall() {
        let mut curve = power_law(1.0, 2.0 / 3.0);
        curve.gradient[5] *= 2.0;
        assert!(!gradient_falls(&curve, 0.02).holds);
        assert!(!gradient_falls(&power_law(1.0, 1.5), 0.02).holds);
        assert!(
            !gradient_falls(&power_law(1.0, 1.0), 0.02).holds,
            "a line's is constant"
        );
    }

    #[test]
    fn the_shallower_curve_may_be_deeper_at_no_load() {
        let [shallow, deep] = [1.0, 1.1].map(|scale| power_law(scale, 2.0 / 3.0));
        assert!(first_penetrates_less(&shallow, &deep, 1e-6).holds);
        assert!(!first_penetrates_less(&deep, &shallow, 1e-6).holds);
        assert!(
            !first_penetrates_less(&deep, &deep, 1e-6).holds,
            "the same is not less"
        );
        let mut touching = shallow.clone();
        touching.penetration[0] = deep.penetration[0];
        assert!(first_penetrates_less(&touching, &deep, 1e-6).holds);
        let mut crossing = shallow.clone();
        crossing.penetration[0] *= 2.0;
        assert!(!first_penetrates_less(&crossing, &deep, 1e-6).holds);
    }

    #[test]
    fn curves_of_one_shape_are_similar_and_of_two_are_not() {
        let [one, scaled, other] =
            [(1.0, 2.0 / 3.0), (7.0, 2.0 / 3.0), (1.0, 1.5)].map(|(s, m)| power_law(s, m));
        assert!(curves_are_similar(&one, &scaled, 0.1).holds);
        assert!(!curves_are_similar(&one, &other, 0.1).holds);
    }
}
