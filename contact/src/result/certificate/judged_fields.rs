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

/// The displacement that a pressure is judged by, on the part of the grid that is looked at.
pub struct JudgedFields {
    pub(super) reach: Window,
    pub(super) displacement: Vec<f64>,
    /// `D`, in m.
    pub(super) penetration: f64,
    pub(super) products: usize,
}

impl JudgedFields {
    /// Of nothing yet, on a grid.
    pub fn on(everywhere: Window) -> Self {
        Self {
            reach: everywhere,
            displacement: Vec::new(),
            penetration: 0.0,
            products: 0,
        }
    }

    /// Products with `K` since this was asked last.
    pub fn take_products(&mut self) -> usize {
        std::mem::take(&mut self.products)
    }

    /// Makes room for a reach.
    pub(super) fn take(&mut self, reach: Window) {
        self.reach = reach;
        let elements = reach.elements();
        if self.displacement.len() != elements {
            // Memory that is first touched where it is written, by all threads.
            self.displacement = vec![0.0; elements];
        }
    }

    /// The part of the grid that was looked at.
    pub fn reach(&self) -> &Window {
        &self.reach
    }

    /// `K p` there, in m.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// The same with its memory, after which nothing is known here.
    pub fn take_displacement(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.displacement)
    }

    /// The gap (m) of an element that does not press, given its initial gap; infinite of one that was not looked at.
    pub fn gap_of(&self, element: [usize; 2], initial_gap: f64) -> f64 {
        self.reach.place(element).map_or(f64::INFINITY, |place| {
            self.displacement[place] + initial_gap - self.penetration
        })
    }

    /// The same of the columns of a row of a window within the part that was looked at, given their initial gaps.
    pub fn gaps_of_line<'a>(
        &'a self,
        window: &Window,
        line: usize,
        initial_gap: &'a [f64],
    ) -> impl Fn(usize) -> f64 + use<'a> {
        let displacement = window.within(&self.reach).line(&self.displacement, line);
        let penetration = self.penetration;
        move |column| displacement[column] + initial_gap[column] - penetration
    }

    /// `K p` of an element that was looked at, in m; NaN of another.
    pub fn displacement_of(&self, element: [usize; 2]) -> f64 {
        let place = self.reach.place(element);
        place.map_or(f64::NAN, |place| self.displacement[place])
    }
}
