//! The deformed layer along the axis, between the central element and its neighbour (Fig. 3).

use super::super::finding::percent;
use super::super::{ContactFields, Cylinders, Finding};

/// How near a boundary the largest displacement must be, as a share of the stretch it bounds. In a stretch of parabolic
/// displacement the outer tenths hold the outer third of its rise.
const NEAR: f64 = 0.1;

/// Displacements along x beside the axis, on one stretch between two boundaries of elements.
struct Stretch(Vec<f64>);

impl Stretch {
    /// The layer between the central element and its neighbour.
    fn between(fields: &ContactFields, lattice: Cylinders) -> Self {
        Self::of(fields, |x| {
            x > lattice.radius && x < lattice.period - lattice.radius
        })
    }

    /// The layer under the central element.
    fn under_central(fields: &ContactFields, lattice: Cylinders) -> Self {
        Self::of(fields, |x| x.abs() < lattice.radius)
    }

    /// The row of the grid beside the axis, where x belongs to the stretch.
    fn of(fields: &ContactFields, belongs: impl Fn(f64) -> bool) -> Self {
        let row = fields.elements / 2;
        let inside = (0..fields.elements).filter(|&i| belongs(fields.centre(i)));
        Self(
            inside
                .map(|i| fields.displacement[i * fields.elements + row])
                .collect(),
        )
    }

    /// First and last displacement; none on a stretch of fewer than three of the grid's elements.
    fn ends(&self) -> Option<[f64; 2]> {
        match self.0[..] {
            [first, _, .., last] if self.0.len() > 2 => Some([first, last]),
            _ => None,
        }
    }

    /// Largest departure from the straight line between the ends; positive if the layer rises above it.
    fn rise(&self) -> Option<f64> {
        let [first, last] = self.ends()?;
        let steps = (self.0.len() - 1) as f64;
        let rises = self
            .0
            .iter()
            .enumerate()
            .map(|(i, u)| first + (last - first) * i as f64 / steps - u);
        rises.max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The smallest and the largest displacement.
    fn extremes(&self) -> [f64; 2] {
        let lowest = self.0.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = self.0.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [lowest, largest]
    }

    /// Where the largest displacement is, as a share of the stretch: 0 at the first end, 1 at the last.
    fn largest_at(&self) -> Option<f64> {
        self.ends()?;
        let largest = (0..self.0.len()).max_by(|&a, &b| self.0[a].total_cmp(&self.0[b]))?;
        Some(largest as f64 / (self.0.len() - 1) as f64)
    }
}

/// Holds if the layer between the elements departs from a straight line by more than `threshold` of its displacement.
pub(in super::super) fn layer_is_curved(
    fields: &ContactFields,
    lattice: Cylinders,
    threshold: f64,
) -> Finding {
    let stretch = Stretch::between(fields, lattice);
    let (Some(rise), Some([first, last])) = (stretch.rise(), stretch.ends()) else {
        return Finding::nothing("three points between the elements");
    };
    let relative = rise / first.abs().max(last.abs());
    let side = if rise > 0.0 { "rises" } else { "sags" };
    Finding::new(
        relative.abs() > threshold,
        format!("{side} by {} of the displacement", percent(relative.abs())),
    )
}

/// Holds if the layer between the elements is displaced most near a boundary of an element, and beside both elements by
/// more than `threshold` of that farther than somewhere between them: a mere slope has one such end only.
pub(in super::super) fn largest_beside_elements(
    fields: &ContactFields,
    lattice: Cylinders,
    threshold: f64,
) -> Finding {
    near_the_ends(
        &Stretch::between(fields, lattice),
        threshold,
        "across the gap",
    )
}

/// The same for the layer under the central element.
pub(in super::super) fn largest_under_edges(
    fields: &ContactFields,
    lattice: Cylinders,
    threshold: f64,
) -> Finding {
    near_the_ends(
        &Stretch::under_central(fields, lattice),
        threshold,
        "across the element",
    )
}

fn near_the_ends(stretch: &Stretch, threshold: f64, place: &str) -> Finding {
    let (Some(at), Some(ends)) = (stretch.largest_at(), stretch.ends()) else {
        return Finding::nothing("three points on the stretch");
    };
    let [lowest, largest] = stretch.extremes();
    let above = ends.map(|end| (end - lowest) / largest);
    let near = at.min(1.0 - at) <= NEAR;
    Finding::new(
        near && above.into_iter().all(|above| above > threshold),
        format!(
            "largest at {} {place}; the ends {} and {} above the lowest",
            percent(at),
            percent(above[0]),
            percent(above[1])
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::super::super::made_up::{CYLINDERS, displaced};
    use super::*;

    #[test]
    fn a_layer_that_rises_between_elements_is_curved_and_lowest_beside_them() {
        let fields = displaced(|x| 1.0 - 0.1 * (std::f64::consts::TAU * x).cos().min(0.0).abs());
        assert!(layer_is_curved(&fields, CYLINDERS, 0.01).holds);
        assert!(largest_beside_elements(&fields, CYLINDERS, 0.01).holds);
    }

    #[test]
    fn a_plane_layer_is_not_curved_even_if_it_slopes() {
        let fields = displaced(|x| 1.0 - 0.2 * x);
        assert!(!layer_is_curved(&fields, CYLINDERS, 0.01).holds);
    }

    #[test]
    fn a_mere_slope_is_not_deepest_beside_both_elements() {
        assert!(!largest_beside_elements(&displaced(|x| 1.0 - 0.2 * x), CYLINDERS, 0.01).holds);
    }

    #[test]
    fn a_layer_deepest_in_mid_gap_is_not_deepest_beside_the_elements() {
        let fields = displaced(|x| 1.0 - (x - 0.5).powi(2));
        assert!(layer_is_curved(&fields, CYLINDERS, 0.01).holds, "it sags");
        assert!(!largest_beside_elements(&fields, CYLINDERS, 0.01).holds);
    }

    #[test]
    fn under_the_element_edge_and_middle_are_told_apart() {
        let dome = displaced(|x| 1.0 - x * x);
        assert!(!largest_under_edges(&dome, CYLINDERS, 0.01).holds);
        let dish = displaced(|x| 1.0 + x * x);
        assert!(largest_under_edges(&dish, CYLINDERS, 0.01).holds);
    }
}
