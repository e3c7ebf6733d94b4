//! The part of a grid that a certificate looks at: all elements that may overlap.
//!
//! Where the initial gap alone is wider than the penetration and all by which the surface can rise beside the load,
//! nothing overlaps, whatever the displacement:
//!
//! ```text
//! g = K p + η p + g0 − D ≥ min(0, min k) Σ p + g0 − D,    min k over the offsets from there to the pressures
//! ```

use crate::{DiscreteProblem, grid::window::Window};

/// The part of the penetration expected by which the true one may be larger.
const LEEWAY: f64 = 1e-6;
/// A reach goes beyond the window by its side over this, at least: bulges are near the load, and need not be reckoned
/// with further away.
const RIM_PART: usize = 4;

/// The largest penetration (m) that a reach is to serve where this one is expected.
pub fn highest(expected: f64) -> f64 {
    expected + LEEWAY * expected.abs()
}

/// The window that holds a rim around another, and all elements that may overlap there under a penetration of no more
/// than `highest` (m): those whose initial gap is below it and by what pressures of this total can raise them.
pub fn around(problem: &DiscreteProblem, window: &Window, highest: f64, total: f64) -> Window {
    let everywhere = problem.everywhere();
    let rim = window.size() / RIM_PART;
    let width = highest - problem.least_displacement(total, rim + 1);
    // False where it is NaN.
    let is_bounded = width < f64::INFINITY;
    if window.is_whole() || !is_bounded {
        return everywhere;
    }
    let (gap, size, around) = (
        problem.initial_gap(),
        everywhere.size(),
        window.with_rim(rim),
    );
    everywhere.around(|[i, j]| gap[i * size + j] < width || around.place([i, j]).is_some())
}

/// The fields that a pressure is judged by, on the part of the grid that is looked at.
pub struct JudgedFields {
    pub(super) reach: Window,
    pub(super) displacement: Vec<f64>,
    pub(super) gap: Vec<f64>,
    pub(super) products: usize,
}

impl JudgedFields {
    /// Of nothing yet, on a grid.
    pub fn on(everywhere: Window) -> Self {
        Self {
            reach: everywhere,
            displacement: Vec::new(),
            gap: Vec::new(),
            products: 0,
        }
    }

    /// Products with `K` since this was asked last.
    pub fn take_products(&mut self) -> usize {
        std::mem::take(&mut self.products)
    }

    /// Makes room for a reach, with the initial gap in place of the gap.
    pub(super) fn take(&mut self, problem: &DiscreteProblem, reach: Window) {
        self.reach = reach;
        let elements = reach.elements();
        if self.displacement.len() != elements {
            // Memory that is first touched where it is written, by all threads.
            self.displacement = vec![0.0; elements];
        }
        self.gap = reach.cut(problem.initial_gap());
    }

    /// The part of the grid that was looked at.
    pub fn reach(&self) -> &Window {
        &self.reach
    }

    /// `K p` there, in m.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Whether an element of the grid overlaps.
    pub fn overlaps(&self, element: [usize; 2]) -> bool {
        let place = self.reach.place(element);
        place.is_some_and(|place| self.gap[place] < 0.0)
    }

    /// The gaps of a row of a window within the part that was looked at, in m.
    pub fn gaps_of_line(&self, window: &Window, line: usize) -> &[f64] {
        window.within(&self.reach).line(&self.gap, line)
    }

    /// `K p` of an element that was looked at, in m; NaN of another.
    pub fn displacement_of(&self, element: [usize; 2]) -> f64 {
        let place = self.reach.place(element);
        place.map_or(f64::NAN, |place| self.displacement[place])
    }

    /// The gap of an element of the grid that was looked at, in m.
    pub fn gap_of(&self, element: [usize; 2]) -> f64 {
        self.reach
            .place(element)
            .map_or(f64::INFINITY, |place| self.gap[place])
    }
}
