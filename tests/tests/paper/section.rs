//! The deformed layer along the axis, between the central cylinder and its neighbour (Fig. 3).

use super::cases::{Coating, PERIOD, PaperCase, RADIUS};
use super::fields::SolvedFields;
use super::numbers::assert_reads;

/// One part in a hundred of the displacement is about the width of a line in a printed figure.
const SEEN: f64 = 0.01;
/// How near a boundary the largest displacement must be, as a fraction of the stretch: for a parabolic displacement,
/// the outer tenths contain the outer third of its rise.
const NEAR: f64 = 0.1;

/// Displacements in the row beside the axis, for x in the stretch.
fn stretch(
    case: PaperCase,
    step: usize,
    elements: usize,
    belongs: impl Fn(f64) -> bool,
) -> Vec<f64> {
    let fields = SolvedFields::of(case, step, elements);
    let inside = (0..elements).filter(|&i| belongs(fields.geometry.grid.centre(i)));
    inside
        .map(|i| fields.displacement[i * elements + elements / 2])
        .collect()
}

/// The layer between the central cylinder and its neighbour.
fn gap(case: PaperCase, step: usize, elements: usize) -> Vec<f64> {
    stretch(case, step, elements, |x| x > RADIUS && x < PERIOD - RADIUS)
}

/// The position of the largest displacement, from 0 at the first end to 1 at the last, and the height of each end above
/// the lowest point, over the largest displacement.
fn deepest(stretch: &[f64]) -> (f64, [f64; 2]) {
    let by_depth = |a: &usize, b: &usize| stretch[*a].total_cmp(&stretch[*b]);
    let largest = (0..stretch.len()).max_by(by_depth).expect("elements on it");
    let lowest = stretch.iter().copied().fold(f64::INFINITY, f64::min);
    let last = stretch.len() - 1;
    let above = [stretch[0], stretch[last]].map(|end| (end - lowest) / stretch[largest]);
    (largest as f64 / last as f64, above)
}

/// Largest deviation from the straight line between the ends, over the larger of their displacements; positive if the
/// layer rises above it.
fn rise(stretch: &[f64]) -> f64 {
    let [first, last] = [stretch[0], stretch[stretch.len() - 1]];
    let steps = (stretch.len() - 1) as f64;
    let rises =
        (stretch.iter().enumerate()).map(|(i, u)| first + (last - first) * i as f64 / steps - u);
    let largest = rises.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    largest.expect("elements on it") / first.max(last)
}

#[test]
fn under_incomplete_contact_the_layer_between_the_elements_is_curved() {
    let labels = PaperCase::Labels(Coating::Soft);
    for (case, step, found) in [
        (PaperCase::Fig2a, 0, ["6.66 %", "7.79 %"]),
        (PaperCase::Fig2b, 0, ["5.25 %", "5.94 %"]),
        (labels, 0, ["7.14 %", "8.35 %"]),
        (labels, 1, ["7.51 %", "8.77 %"]),
    ] {
        for (elements, written) in [512, 1024].into_iter().zip(found) {
            let rise = rise(&gap(case, step, elements));
            assert_reads(rise, written);
            assert!(rise > SEEN, "{case:?}");
        }
    }
}

/// A mere slope has only one such end.
#[test]
fn the_layer_between_the_elements_is_displaced_most_beside_them() {
    for (case, step, found) in [
        (
            PaperCase::Fig2a,
            0,
            [["11.5 %", "3.24 %"], ["12.7 %", "4.24 %"]],
        ),
        (
            PaperCase::Fig2b,
            0,
            [["6.24 %", "4.38 %"], ["6.95 %", "5.04 %"]],
        ),
        (
            PaperCase::Labels(Coating::Soft),
            1,
            [["14.5 %", "2.92 %"], ["15.9 %", "4.01 %"]],
        ),
    ] {
        for (elements, written) in [512, 1024].into_iter().zip(found) {
            let (at, above) = deepest(&gap(case, step, elements));
            assert_reads(at, "0 %");
            for (end, written) in above.into_iter().zip(written) {
                assert_reads(end, written);
                assert!(end > SEEN, "{case:?}");
            }
        }
    }
}

/// Another reading of the same sentence, which does not hold.
#[test]
fn the_layer_under_the_central_element_is_displaced_most_in_its_middle_and_not_at_its_edge() {
    for case in [PaperCase::Fig2a, PaperCase::Fig2b] {
        for elements in [512, 1024] {
            let under = stretch(case, 0, elements, |x| x.abs() < RADIUS);
            let (at, above) = deepest(&under);
            // An even number of elements has two in the middle.
            let from_middle = (at - 0.5).abs() * (under.len() - 1) as f64;
            assert!(
                from_middle <= 0.5 + f64::EPSILON * under.len() as f64,
                "{at}"
            );
            assert!(at.min(1.0 - at) > NEAR, "{case:?}");
            above.into_iter().for_each(|end| assert_reads(end, "0 %"));
        }
    }
}
