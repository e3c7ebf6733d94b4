//! The parts of the surface in contact: the cylinders alone, or the layer between them too.

use super::cases::{Coating, PaperCase, only_step};
use super::fields::SolvedFields;
use super::numbers::assert_reads;

/// Below a twentieth, a picture of the contact would look closed.
const OPEN: f64 = 0.05;
/// A thousandth of the contact is too small to be visible on any grid that the paper can have used.
const SEEN: f64 = 1e-3;
/// The outer tenth of the contact's radius is its rim, where a larger load adds contact only on the cylinders.
const RIM: f64 = 0.9;

/// Fraction without pressure of the layer between the cylinders, inside the circle around the contact.
fn open_share(case: PaperCase, step: usize, elements: usize) -> f64 {
    let fields = SolvedFields::of(case, step, elements);
    let reach = fields.farthest(fields.contact());
    let inside = |&index: &usize| !fields.is_on_relief(index) && fields.radius(index) <= reach;
    let between: Vec<usize> = (0..fields.pressure.len()).filter(inside).collect();
    let is_open = |index: &&usize| fields.pressure[**index] <= 0.0;
    between.iter().filter(is_open).count() as f64 / between.len() as f64
}

/// Fraction of the contact area that lies between the cylinders.
pub fn share_between(case: PaperCase, elements: usize) -> f64 {
    let summary = only_step(case, elements).summary;
    summary.contact_area_between / summary.contact_area
}

#[test]
fn contact_is_incomplete_under_the_small_loads() {
    for (case, found) in [
        (PaperCase::Fig2a, ["100 %", "100 %"]),
        (PaperCase::Fig2b, ["98.8 %", "98.8 %"]),
    ] {
        for (elements, written) in [512, 1024].into_iter().zip(found) {
            let open = open_share(case, 0, elements);
            assert_reads(open, written);
            assert!(open > OPEN, "{case:?}");
        }
    }
}

#[test]
fn by_the_labels_of_figure_3_contact_on_the_stiff_coating_is_incomplete_too() {
    for (step, found) in [["64.2 %", "68.2 %"], ["37.4 %", "41.1 %"]]
        .into_iter()
        .enumerate()
    {
        for (elements, written) in [512, 1024].into_iter().zip(found) {
            let open = open_share(PaperCase::Labels(Coating::Stiff), step, elements);
            assert_reads(open, written);
            assert!(open > OPEN, "step {step}");
        }
    }
}

#[test]
fn only_the_elements_touch_the_indenter_in_2a() {
    for elements in [512, 1024, 2048] {
        let share = share_between(PaperCase::Fig2a, elements);
        assert_reads(share, "0 %");
        assert!(share <= SEEN);
    }
}

#[test]
fn in_2b_the_layer_between_the_elements_touches_the_indenter_too() {
    for (elements, written) in [(512, "1.12 %"), (1024, "1.08 %"), (2048, "1.10 %")] {
        let share = share_between(PaperCase::Fig2b, elements);
        assert_reads(share, written);
        assert!(share > SEEN);
    }
}

#[test]
fn under_six_times_the_load_the_layer_between_the_elements_is_touched_near_the_axis() {
    for (case, found) in [
        (
            PaperCase::Fig2c,
            [("9.90 %", "42.2 %"), ("9.95 %", "42.3 %")],
        ),
        (
            PaperCase::Fig2d,
            [("18.9 %", "84.1 %"), ("17.9 %", "84.1 %")],
        ),
    ] {
        for (elements, (share, reach)) in [512, 1024].into_iter().zip(found) {
            let fields = SolvedFields::of(case, 0, elements);
            let between = || {
                fields
                    .contact()
                    .filter(|&index| !fields.is_on_relief(index))
            };
            let found = between().count() as f64 / fields.contact().count() as f64;
            assert_reads(found, share);
            let relative = fields.farthest(between()) / fields.farthest(fields.contact());
            assert_reads(relative, reach);
            assert!(found > 0.0 && relative < RIM, "{case:?}");
        }
    }
}
