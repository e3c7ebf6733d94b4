//! Who touches whom: the elements alone, or the layer between them too.

use super::super::contact_fields::farthest;
use super::super::finding::percent;
use super::super::{ContactFields, Finding};

/// Holds if more than `threshold` of the layer between the elements, inside the circle around the contact, is free.
pub(in super::super) fn gaps_stay_open(fields: &ContactFields, threshold: f64) -> Finding {
    let reach = fields.contact_radius();
    let inside = |&index: &usize| !fields.relief[index] && fields.radius(index) <= reach;
    let between: Vec<usize> = (0..fields.relief.len()).filter(inside).collect();
    if between.is_empty() {
        return Finding::nothing("layer between elements inside the contact");
    }
    let open = between
        .iter()
        .filter(|&&index| fields.pressure[index] <= 0.0)
        .count();
    let share = open as f64 / between.len() as f64;
    Finding::new(share > threshold, format!("{} open", percent(share)))
}

/// Holds if at most `threshold` of the contact area lies between the elements; `share` is the part that does.
pub(in super::super) fn only_elements_touch(share: f64, threshold: f64) -> Finding {
    Finding::new(share <= threshold, format!("{} between", percent(share)))
}

/// Holds if some contact lies between the elements, and all of that nearer the axis than `threshold` of the contact's
/// radius.
pub(in super::super) fn layer_touches_near_axis(fields: &ContactFields, threshold: f64) -> Finding {
    let share = share_between(fields);
    let reach = farthest(fields.contact_between().map(|index| fields.radius(index)));
    let relative = reach / fields.contact_radius();
    if share <= 0.0 {
        return Finding::new(false, "0 % between");
    }
    Finding::new(
        relative < threshold,
        format!(
            "{} between, up to {} of the contact's radius",
            percent(share),
            percent(relative)
        ),
    )
}

/// Share of the contact area that lies between the elements; 0 without contact.
fn share_between(fields: &ContactFields) -> f64 {
    let all = fields.contact().count();
    fields.contact_between().count() as f64 / all.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::super::super::made_up::pressed;
    use super::*;

    #[test]
    fn a_pressure_on_the_elements_alone_leaves_the_gaps_open() {
        let fields = pressed(|_, relative| f64::from(relative < 1.0));
        assert!(gaps_stay_open(&fields, 0.05).holds);
        assert!(only_elements_touch(share_between(&fields), 1e-3).holds);
        assert!(!layer_touches_near_axis(&fields, 0.9).holds);
    }

    #[test]
    fn a_pressure_everywhere_closes_the_gaps() {
        let fields = pressed(|_, _| 1.0);
        assert!(!gaps_stay_open(&fields, 0.05).holds);
        assert!(!only_elements_touch(share_between(&fields), 1e-3).holds);
        assert!(
            !layer_touches_near_axis(&fields, 0.9).holds,
            "it reaches the rim"
        );
    }

    #[test]
    fn contact_between_elements_near_the_axis_is_seen() {
        let fields = pressed(|radius, relative| f64::from(relative < 1.0 || radius < 1.0));
        assert!(layer_touches_near_axis(&fields, 0.9).holds);
        assert!(!only_elements_touch(share_between(&fields), 1e-3).holds);
        assert!(gaps_stay_open(&fields, 0.05).holds);
    }

    #[test]
    fn contact_between_elements_far_from_the_axis_only_is_not_near_it() {
        let fields = pressed(|radius, relative| f64::from(relative < 1.0 || radius > 1.5));
        assert!(!layer_touches_near_axis(&fields, 0.9).holds);
    }

    #[test]
    fn without_contact_nothing_holds() {
        let fields = pressed(|_, _| 0.0);
        assert!(!gaps_stay_open(&fields, 0.05).holds);
        assert!(!layer_touches_near_axis(&fields, 0.9).holds);
        // The summary's areas are then both nothing.
        assert!(!only_elements_touch(f64::NAN, 1e-3).holds);
    }
}
