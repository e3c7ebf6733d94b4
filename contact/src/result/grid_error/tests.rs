//! Intervals for sequences with known limit and order.

use approx::assert_relative_eq;

use super::*;

fn levels(values: &[f64]) -> Vec<LevelValues> {
    (0..values.len())
        .map(|l| LevelValues {
            elements: 32 << l,
            penetration: values[l],
            force: values[l],
            contact_area: values[l],
            edge_uncertainty: 0.0,
            max_pressure: values[l],
            averaged_pressure: None,
            peak_place: PeakPlace::Inside,
            meets_outline: false,
        })
        .collect()
}

fn penetration(values: &[f64]) -> ErrorEstimate {
    GridError::new(levels(values), 0.0).penetration.unwrap()
}

#[test]
fn values_of_a_level_missing_from_a_file_are_nan() {
    let written = serde_json::to_string(&levels(&[2.0])[0]).unwrap();
    let read: LevelValues = serde_json::from_str(&written).unwrap();
    assert_eq!(
        (read.elements, read.penetration, read.max_pressure),
        (32, 2.0, 2.0)
    );
    assert!(read.force.is_nan() && read.edge_uncertainty.is_nan());
}

#[test]
fn at_second_order_the_interval_is_the_safety_factor_times_the_error() {
    // 1 + 4⁻ˡ: the error of the last is its distance from 1
    let found = penetration(&[2.0, 1.25, 1.0625]);
    assert_relative_eq!(found.estimate, 3.0 * 0.0625, max_relative = 1e-12);
    assert_relative_eq!(found.order.unwrap(), 2.0, max_relative = 1e-12);
    assert!(found.resolved);
}

#[test]
fn a_positive_number_with_an_interval_around_zero_is_not_resolved() {
    // 1 + 30 · 4⁻ˡ: 2.875 ± 5.6
    let found = GridError::new(levels(&[31.0, 8.5, 2.875]), 0.0);
    let [area, force] = [found.contact_area, found.force].map(Option::unwrap);
    assert!(area.order.is_some_and(|order| order > 1.9));
    assert!(!area.resolved && !force.resolved && found.penetration.unwrap().resolved);
}

#[test]
fn the_accuracy_of_the_solution_is_added_to_the_estimate() {
    let values = [2.0, 1.25, 1.0625];
    let found = GridError::new(levels(&values), 0.01).penetration.unwrap();
    let wanted = penetration(&values).estimate + 0.01 * 1.0625;
    assert_relative_eq!(found.estimate, wanted, max_relative = 1e-12);
}

#[test]
fn a_change_that_vanishes_by_chance_does_not_imply_a_vanishing_error() {
    // The previous change, at second order: 3 · 0.6 · 0.4/3/4.
    let found = penetration(&[1.0, 1.4, 1.4]);
    assert_relative_eq!(found.estimate, 1.8 * 0.4 / 12.0, max_relative = 1e-12);
}

#[test]
fn changes_of_opposite_sign_do_not_cancel() {
    let oscillating = penetration(&[1.0, 1.4, 1.3]);
    let falling = penetration(&[1.8, 1.4, 1.3]);
    assert_relative_eq!(oscillating.estimate, falling.estimate, max_relative = 1e-12);
}

#[test]
fn a_value_that_grows_with_the_grid_is_not_resolved() {
    assert!(!penetration(&[1.0, 1.4, 2.0]).resolved);
}

#[test]
fn a_peak_at_an_edge_is_not_resolved_even_if_its_changes_shrink() {
    let mut shrinking = levels(&[2.0, 1.25, 1.0625, 1.015_625]);
    assert!(
        GridError::new(shrinking.clone(), 0.0)
            .max_pressure
            .unwrap()
            .resolved
    );
    for level in &mut shrinking {
        level.peak_place = PeakPlace::Outline;
    }
    assert!(
        !GridError::new(shrinking, 0.0)
            .max_pressure
            .unwrap()
            .resolved
    );
}

#[test]
fn a_staircase_counts_as_first_order() {
    let mut staircase = levels(&[2.0, 1.25, 1.0625]);
    staircase[2].meets_outline = true;
    let found = GridError::new(staircase, 0.0).penetration.unwrap();
    let ratio = 2_f64.powf(1.2);
    assert_relative_eq!(
        found.estimate,
        2.5 * 0.6 * 0.75 / (ratio - 1.0) / ratio,
        max_relative = 1e-12
    );
}

#[test]
fn other_errors_of_the_values_are_added_and_a_prescribed_value_has_none() {
    let mut found = levels(&[2.0, 1.25, 1.0625]);
    found[2].edge_uncertainty = 0.5;
    let found = GridError::new(found, 1e-3);
    let besides = 1e-3 * 1.0625;
    assert_relative_eq!(found.penetration.unwrap().estimate, 0.1875 + besides);
    assert_relative_eq!(found.contact_area.unwrap().estimate, 0.6875 + besides);
    let settled = GridError::new(levels(&[2.0, 2.0, 2.0]), 1e-3);
    let wanted = ErrorEstimate {
        estimate: 0.0,
        order: None,
        resolved: true,
    };
    assert_eq!(settled.penetration, Some(wanted));
}

#[test]
fn a_level_without_a_value_gives_no_error_estimate() {
    let error = GridError::new(levels(&[2.0, f64::NAN, 1.25, 1.0625]), 0.0);
    assert!(error.penetration.is_none(), "{error:?}");
}

#[test]
fn one_level_gives_no_estimate_and_two_resolve_nothing() {
    assert!(GridError::new(levels(&[1.0]), 0.0).penetration.is_none());
    assert!(!penetration(&[1.0, 1.1]).resolved);
}

#[test]
fn derived_values_have_the_same_interval_and_each_its_own_accuracy() {
    let values = [(32, 2.0), (64, 1.25), (128, 1.0625)];
    let of = |outline, edge, accuracy| ErrorEstimate::of_values(&values, outline, edge, accuracy);
    let smooth = of(false, false, 0.0).unwrap();
    assert_eq!(smooth, penetration(&[2.0, 1.25, 1.0625]));
    let besides = of(false, false, 0.01).unwrap();
    assert_relative_eq!(besides.estimate, smooth.estimate + 0.01 * 1.0625);
    assert!(besides.resolved);
    // A staircase converges more slowly, and an edge not at all.
    let staircase = of(true, false, 0.0).unwrap();
    let edge = of(false, true, 0.0).unwrap();
    assert!(staircase.resolved && staircase.estimate > smooth.estimate);
    assert!(!edge.resolved);
    let ratio = 2_f64.sqrt();
    // √h: the previous change has weight 0.6 and is a further factor of √2 away.
    assert_relative_eq!(
        edge.estimate,
        0.6 * 0.75 / (ratio - 1.0) / ratio,
        max_relative = 1e-12
    );
    assert!(ErrorEstimate::of_values(&values[..1], false, false, 0.0).is_none());
    // A number that grows is not resolved away from an edge either.
    let growing = [(32, 1.0), (64, 1.4), (128, 2.0)];
    assert!(
        !ErrorEstimate::of_values(&growing, false, false, 0.0)
            .unwrap()
            .resolved
    );
}

#[test]
fn changes_that_hardly_shrink_are_resolved_if_small_relative_to_the_value() {
    // Orders of 0.4 and 0.7 in the side, compared with half of the lowest accepted order, 0.65.
    let with = |order: f64, offset: f64| {
        let ratio = 2_f64.powf(-order);
        penetration(&[offset, offset + 1.0, offset + 1.0 + ratio])
    };
    assert_relative_eq!(with(0.4, 0.0).order.unwrap(), 0.4, max_relative = 1e-9);
    assert!(!with(0.4, 0.0).resolved && with(0.7, 0.0).resolved);
    // The interval, about 3 · 0.76/1.46, is a twentieth of 31.
    assert!(with(0.4, 40.0).resolved && !with(0.4, 20.0).resolved);
}

#[test]
fn nothing_is_resolved_on_elements_longer_than_a_fifth_of_the_shortest_wave_but_what_is_prescribed()
{
    let settled = ErrorEstimate {
        estimate: 0.0,
        order: None,
        resolved: true,
    };
    let found = ErrorEstimate {
        estimate: 0.1,
        ..settled
    };
    let error = || GridError {
        penetration: Some(settled),
        force: Some(found),
        contact_area: Some(found),
        max_pressure: Some(found),
        ..GridError::default()
    };
    for (elements, resolved) in [(Some(4.99), false), (Some(5.0), true), (None, true)] {
        let with = error().with_elements_per_wave(elements);
        assert_eq!(with.resolves_waves(), resolved);
        let numbers = [
            with.penetration,
            with.force,
            with.contact_area,
            with.max_pressure,
        ];
        let numbers = numbers.map(|error| error.unwrap().resolved);
        assert_eq!(numbers, [true, resolved, resolved, resolved]);
    }
}
