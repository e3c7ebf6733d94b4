//! Where on the elements the pressure is largest.

use std::collections::BTreeMap;

use super::super::finding::{percent, significant};
use super::super::{ContactFields, Cylinders, Finding};

/// The edge of an element: from here to its boundary, in radii. A tenth of the radius is three of the grid's elements at
/// N = 512 in Fig. 2(a), so a stair in the sampled circle does not put a peak beside it.
const EDGE: f64 = 0.9;
/// The middle of an element, in radii.
const MIDDLE: f64 = 0.25;

/// One cylinder of the relief under its pressure.
#[derive(Debug, Clone, Copy, Default)]
struct Loaded {
    /// The grid's elements on it, and those of them in contact.
    sampled: usize,
    touching: usize,
    /// The largest pressure, and its distance from the cylinder's axis in radii.
    peak: f64,
    peak_at: f64,
    /// Sums and numbers of the grid's elements in its middle and at its edge.
    middle: (f64, usize),
    edge: (f64, usize),
}

impl Loaded {
    fn take(&mut self, pressure: f64, distance: f64) {
        self.sampled += 1;
        self.touching += usize::from(pressure > 0.0);
        if pressure > self.peak {
            (self.peak, self.peak_at) = (pressure, distance);
        }
        for (band, belongs) in [
            (&mut self.middle, distance < MIDDLE),
            (&mut self.edge, distance >= EDGE),
        ] {
            if belongs {
                *band = (band.0 + pressure, band.1 + 1);
            }
        }
    }

    /// Whether all of it is in contact.
    fn is_full(&self) -> bool {
        self.sampled > 0 && self.touching == self.sampled
    }
}

fn mean((sum, count): (f64, usize)) -> f64 {
    sum / count.max(1) as f64
}

fn cylinders(fields: &ContactFields, cylinders: Cylinders) -> BTreeMap<[i64; 2], Loaded> {
    let mut loaded: BTreeMap<_, Loaded> = BTreeMap::new();
    for index in (0..fields.relief.len()).filter(|&index| fields.relief[index]) {
        let point = fields.point(index);
        let one = loaded.entry(cylinders.nearest(point)).or_default();
        one.take(fields.pressure[index], cylinders.relative_distance(point));
    }
    loaded
}

/// Holds if at least `threshold` of the elements that are wholly in contact carry their largest pressure at their edge.
pub(in super::super) fn peaks_at_edges(
    fields: &ContactFields,
    lattice: Cylinders,
    threshold: f64,
) -> Finding {
    let loaded = cylinders(fields, lattice);
    let full: Vec<&Loaded> = loaded.values().filter(|one| one.is_full()).collect();
    if full.is_empty() {
        return Finding::nothing("element wholly in contact");
    }
    let at_edge = full.iter().filter(|one| one.peak_at >= EDGE).count();
    let largest = full
        .iter()
        .map(|one| one.peak / mean(one.middle))
        .fold(0.0, f64::max);
    Finding::new(
        at_edge as f64 >= threshold * full.len() as f64,
        format!(
            "{at_edge} of {}, up to {} times the pressure in the middle",
            full.len(),
            significant(largest, 3)
        ),
    )
}

/// Holds if the one grid element of largest pressure lies at the edge of the central element.
pub(in super::super) fn largest_at_central_edge(point: [f64; 2], lattice: Cylinders) -> Finding {
    let [x, y] = point;
    let central = lattice.nearest(point) == [0, 0];
    let relative = lattice.relative_distance(point);
    let holds = central && (EDGE..=1.0).contains(&relative);
    let radii = x.hypot(y) / lattice.radius;
    Finding::new(
        holds,
        format!("at {} radii from the axis", significant(radii, 3)),
    )
}

/// Holds if the mean pressure over the edge is largest at the central element, by more than `threshold` of it.
pub(in super::super) fn mean_edge_is_largest_at_centre(
    fields: &ContactFields,
    lattice: Cylinders,
    threshold: f64,
) -> Finding {
    let mut loaded = cylinders(fields, lattice);
    let Some(central) = loaded.remove(&[0, 0]).filter(|one| one.touching > 0) else {
        return Finding::nothing("pressure on the central element");
    };
    let others = loaded
        .values()
        .map(|one| mean(one.edge))
        .fold(0.0, f64::max);
    let lead = 1.0 - others / mean(central.edge);
    Finding::new(
        lead > threshold,
        format!(
            "central {}, by {}",
            significant(mean(central.edge), 3),
            percent(lead)
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::super::super::made_up::{CYLINDERS, pressed};
    use super::*;

    /// A dish on every element, less pressure the farther from the axis.
    fn dishes() -> ContactFields {
        pressed(|radius, relative| {
            f64::from(relative < 1.0) * (1.0 + relative.powi(4)) * (5.0 - radius)
        })
    }

    /// Where the largest pressure is.
    fn peak(fields: &ContactFields) -> [f64; 2] {
        let pressure = |&index: &usize| fields.pressure[index];
        let largest = fields
            .contact()
            .max_by(|a, b| pressure(a).total_cmp(&pressure(b)));
        fields.point(largest.unwrap())
    }

    #[test]
    fn dishes_peak_at_their_edges_and_most_at_the_central_one() {
        let fields = dishes();
        assert!(peaks_at_edges(&fields, CYLINDERS, 1.0).holds);
        assert!(mean_edge_is_largest_at_centre(&fields, CYLINDERS, 0.0).holds);
        assert!(largest_at_central_edge(peak(&fields), CYLINDERS).holds);
    }

    #[test]
    fn domes_do_not_peak_at_their_edges() {
        let fields = pressed(|_, relative| (1.0 - relative * relative).max(0.0));
        assert!(!peaks_at_edges(&fields, CYLINDERS, 1.0).holds);
        assert!(!largest_at_central_edge(peak(&fields), CYLINDERS).holds);
    }

    #[test]
    fn a_peak_at_another_element_is_not_at_the_central_one() {
        assert!(!largest_at_central_edge([1.2, 0.0], CYLINDERS).holds);
        let outward =
            pressed(|radius, relative| f64::from(relative < 1.0) * (1.0 + relative + radius));
        assert!(!mean_edge_is_largest_at_centre(&outward, CYLINDERS, 0.0).holds);
    }

    #[test]
    fn an_element_partly_in_contact_is_not_judged() {
        let fields = pressed(|radius, relative| f64::from(relative < 1.0 && radius < 0.1));
        assert!(!peaks_at_edges(&fields, CYLINDERS, 1.0).holds);
    }
}
