//! The part of a grid that a certificate examines: all elements that may overlap.
//!
//! An element cannot overlap, whatever the displacement, if its initial gap is wider than the penetration plus the
//! largest possible rise of the surface beside the load:
//!
//! ```text
//! g = K p + η p + g0 − D ≥ min(0, min k) Σ p + g0 − D,    min k over the offsets from there to the pressures
//! ```

use crate::{DiscreteProblem, grid::region::Region};

/// Margin for the true penetration above the expected one, relative to the latter.
const LEEWAY: f64 = 1e-6;
/// A reach extends beyond the region by at least the region's side over this number: bulges are near the load and do
/// not matter farther away.
const RIM_PART: usize = 4;

/// Returns the largest penetration (m) that a reach must cover, given the expected one.
pub fn highest(expected: f64) -> f64 {
    expected + LEEWAY * expected.abs()
}

/// Returns the region that holds `region` with a rim, and all elements that may overlap under a penetration of at most
/// `highest` (m): those whose initial gap is less than `highest` plus the largest rise under pressures of this `total`.
pub fn around(problem: &DiscreteProblem, region: &Region, highest: f64, total: f64) -> Region {
    let everywhere = problem.region();
    let rim = region.size() / RIM_PART;
    let width = highest - problem.least_displacement(total, rim + 1);
    // False for NaN.
    let is_bounded = width < f64::INFINITY;
    if region.is_whole() || !is_bounded {
        return everywhere;
    }
    let (gap, size, around) = (
        problem.initial_gap(),
        everywhere.size(),
        region.with_rim(rim),
    );
    everywhere.around(|[i, j]| gap[i * size + j] < width || around.place([i, j]).is_some())
}

/// The displacement by which a pressure is judged, on the reach, the examined part of the grid.
pub struct JudgedFields {
    pub(super) reach: Region,
    pub(super) displacement: Vec<f64>,
    /// `D`, in m.
    pub(super) penetration: f64,
    pub(super) products: usize,
}

impl JudgedFields {
    /// Empty fields on a grid.
    pub fn on(everywhere: Region) -> Self {
        Self {
            reach: everywhere,
            displacement: Vec::new(),
            penetration: 0.0,
            products: 0,
        }
    }

    /// Returns the products with `K` since the last call.
    pub fn take_products(&mut self) -> usize {
        std::mem::take(&mut self.products)
    }

    /// Makes room for a reach.
    pub(super) fn take(&mut self, reach: Region) {
        self.reach = reach;
        let elements = reach.elements();
        if self.displacement.len() != elements {
            // This memory is first touched where it is written, by all threads.
            self.displacement = vec![0.0; elements];
        }
    }

    /// The examined part of the grid.
    pub fn reach(&self) -> &Region {
        &self.reach
    }

    /// `K p` on the reach, in m.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Takes `K p` on the reach, in m, and leaves it empty here.
    pub fn take_displacement(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.displacement)
    }

    /// The gap (m) of an element without pressure, given its initial gap; infinite outside the reach.
    pub fn gap_of(&self, element: [usize; 2], initial_gap: f64) -> f64 {
        self.reach.place(element).map_or(f64::INFINITY, |place| {
            self.displacement[place] + initial_gap - self.penetration
        })
    }

    /// The gaps (m), by column, of a row of a region within the reach, given their initial gaps.
    pub fn gaps_of_line<'a>(
        &'a self,
        region: &Region,
        line: usize,
        initial_gap: &'a [f64],
    ) -> impl Fn(usize) -> f64 + use<'a> {
        let displacement = region.within(&self.reach).line(&self.displacement, line);
        let penetration = self.penetration;
        move |column| displacement[column] + initial_gap[column] - penetration
    }

    /// `K p` of an element, in m; NaN outside the reach.
    pub fn displacement_of(&self, element: [usize; 2]) -> f64 {
        let place = self.reach.place(element);
        place.map_or(f64::NAN, |place| self.displacement[place])
    }
}
