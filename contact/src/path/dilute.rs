//! Dilute contact: where few elements of a level may touch, the level is solved only on these candidates.
//!
//! Their products are [accurate to about 1e-9](pellicle_influence::ScatteredOperator) and cost a small fraction of one
//! on the whole grid. Other elements can overlap only where the initial gap is less than the penetration; one such
//! product shows which of these few do, and they are added:
//!
//! ```text
//! candidates ← candidates ∪ {K̃ p + g0 < D}, and those around
//! ```
//!
//! where `K̃` is the product among scattered elements. Its error is computed, not neglected: one product on the whole
//! grid judges the pressure, as the certificate always does. If the certificate is satisfied, that is the only such
//! product. Otherwise
//!
//! ```text
//! g0 ← g0 + (K − K̃) p on the candidates;    candidates ← candidates ∪ {g < 0 anywhere}, and those around
//! ```
//!
//! and the next pass is accurate to 1e-9 of the change since the last. If several passes do not satisfy the
//! certificate, the whole grid is solved as usual.

use std::sync::Arc;

use pellicle_influence::scattered_work;

use crate::{
    ContactError, DiscreteProblem, GradientSolver, Iterate, Load, Method, Solution, Solver,
    SolverOptions,
    grid::{
        candidates::{Candidates, elements_where},
        region::Region,
    },
    result::certificate::JudgedFields,
    solver::Watch,
};

/// Multiplications per element for a step on the whole grid: its product, the filter with its band, and the
/// sums.
const WHOLE_STEP: usize = 100;
/// Least ratio of the cost of a step on the whole grid to one on candidates.
const LEAST_GAIN: usize = 4;
/// Elements per side below which the cost of a level is negligible.
const SMALLEST_REGION: usize = 256;
/// Tolerance of the first pass, which finds the set among the candidates.
const FIRST_TOLERANCE: f64 = 1e-5;
/// Passes after which the whole grid is solved.
const MOST_PASSES: usize = 8;
/// Largest ratio of a body's compliances to its longest and its shortest wave, relative to a homogeneous body: under
/// stiff coatings systems are so ill-conditioned that products must be accurate to all digits.
const LARGEST_CONTRAST: f64 = 4.0;

/// A level's candidates on a region.
pub struct Dilute {
    region: Region,
    candidates: Arc<Candidates>,
    /// The problem on the candidates; its initial gap includes the error of its product for the last judged pressure.
    problem: DiscreteProblem,
    passes: usize,
}

impl Dilute {
    /// Chooses the candidates around a start on a region; none if this does not pay.
    pub fn around(
        whole: &DiscreteProblem,
        region: &Region,
        start: &[f64],
        options: &SolverOptions,
    ) -> Option<Self> {
        // Elements held at a hardness would need a separate operator.
        let is_for_candidates = !whole.has_hardness()
            && options.method == Method::Gradient
            && options.shortcuts.candidates
            && whole.takes_candidates()
            && region.size() >= SMALLEST_REGION
            && whole.stiffness_contrast() <= LARGEST_CONTRAST;
        if !is_for_candidates {
            return None;
        }
        let size = region.size();
        let pressing = elements_where(size, |[row, column]| start[row * size + column] > 0.0);
        let candidates = Candidates::around(size, &pressing);
        if candidates.len() == 0 || !is_worth_it(size, candidates.elements()) {
            return None;
        }
        let candidates = Arc::new(candidates);
        Some(Self {
            region: *region,
            problem: whole.among(region, &candidates)?,
            candidates,
            passes: 0,
        })
    }

    /// Solves on the candidates from a pressure on the region, adding candidates until no other element overlaps
    /// according to the products among scattered elements. The iterate's pressure covers the region; its products are
    /// those among scattered elements.
    pub fn solve(
        &mut self,
        whole: &DiscreteProblem,
        pressure: &[f64],
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let mut iterate = Iterate::of(self.candidates.gather(pressure));
        loop {
            self.passes += 1;
            let is_first = self.passes == 1;
            let tolerance = if is_first {
                options.tolerance.max(FIRST_TOLERANCE)
            } else {
                options.tolerance
            };
            let mut solver = GradientSolver::new(SolverOptions {
                tolerance,
                contact_stiffness: options.contact_stiffness && !is_first,
                ..options
            });
            let next = solver.solve(&mut self.problem, load, &iterate.pressure, watch)?;
            iterate = after(iterate, next);
            let found = self.overlapping(whole, &mut iterate, options.tolerance);
            let continues = is_first || !found.is_empty();
            let known = self.candidates.clone();
            if !continues || self.passes >= MOST_PASSES || !self.include(whole, &found) {
                iterate.pressure = known.scatter(&iterate.pressure);
                return Ok(iterate);
            }
            let places =
                (0..self.candidates.len()).map(|candidate| self.candidates.place(candidate));
            let pressures =
                places.map(|place| known.at(place).map_or(0.0, |c| iterate.pressure[c]));
            iterate.pressure = pressures.collect();
        }
    }

    /// Finds elements of the region that are not candidates and overlap by more than half the tolerance, by one product
    /// among all elements whose initial gap is less than the penetration; returns none if these are too many.
    fn overlapping(
        &mut self,
        whole: &DiscreteProblem,
        iterate: &mut Iterate,
        tolerance: f64,
    ) -> Vec<u32> {
        let (size, penetration) = (self.region.size(), iterate.penetration);
        let (region, known) = (self.region, self.candidates.clone());
        let initial_gap = initial_gaps(whole, &region);
        let unlisted = elements_where(size, |place| {
            initial_gap(place) < penetration && known.at(place).is_none()
        });
        let mut elements = [&unlisted, known.elements()].concat();
        elements.sort_unstable();
        if unlisted.is_empty() || !is_worth_it(size, &elements) {
            return Vec::new();
        }
        let place = |element: &u32| [*element as usize / size, *element as usize % size];
        let pressure = |element| {
            known
                .at(place(element))
                .map_or(0.0, |c| iterate.pressure[c])
        };
        let pressures: Vec<f64> = elements.iter().map(pressure).collect();
        let mut displacements = vec![0.0; elements.len()];
        let support = self.problem.support_mut();
        if !support.apply_among(&elements, &pressures, &mut displacements) {
            return Vec::new();
        }
        iterate.operator_applications += 1;
        let overlap = |element, displacement| {
            let gap = displacement + initial_gap(place(element)) - penetration;
            known.at(place(element)).is_none() && gap < -0.5 * tolerance * penetration
        };
        let displaced = elements.iter().zip(displacements);
        let overlapping = displaced.filter(|(element, u)| overlap(element, *u));
        overlapping.map(|(element, _)| *element).collect()
    }

    /// Adds elements and their neighbours to the candidates, keeping the known corrections of the gap. Returns false if
    /// this does not pay.
    fn include(&mut self, whole: &DiscreteProblem, elements: &[u32]) -> bool {
        if elements.is_empty() {
            return true;
        }
        let (region, known) = (self.region, self.candidates.clone());
        let candidates = Arc::new(known.with(elements));
        if !is_worth_it(candidates.size(), candidates.elements()) {
            return false;
        }
        let gaps = self.problem.initial_gap().to_vec();
        if !self.problem.move_to(&candidates, whole) {
            return false;
        }
        let initial_gap = initial_gaps(whole, &region);
        let places = (0..candidates.len()).map(|candidate| candidates.place(candidate));
        let gap = |place| match known.at(place) {
            Some(candidate) => gaps[candidate],
            None => initial_gap(place),
        };
        self.problem.take_initial_gap(places.map(gap).collect());
        self.candidates = candidates;
        true
    }

    /// Whether a judged solution is final.
    pub fn is_done(&self, solution: &Solution, options: &SolverOptions) -> bool {
        let has_stiffness = self.passes > 1 || !options.contact_stiffness;
        has_stiffness && solution.certificate.is_satisfied()
    }

    /// Adds overlapping elements to the candidates and corrects the gap for the product of a judged pressure. Returns
    /// false if another pass does not pay.
    pub fn correct(
        &mut self,
        whole: &DiscreteProblem,
        judged: &JudgedFields,
        pressure: &[f64],
    ) -> bool {
        let (region, known) = (self.region, self.candidates.clone());
        let initial_gap = initial_gaps(whole, &region);
        let overlapping = elements_where(region.size(), |place| {
            judged.gap_of(region.on_grid(place), initial_gap(place)) < 0.0
                && known.at(place).is_none()
        });
        if self.passes >= MOST_PASSES || !self.include(whole, &overlapping) {
            return false;
        }
        // g0 + (K − K̃) p
        let mut gaps = vec![0.0; self.candidates.len()];
        let pressure = self.candidates.gather(pressure);
        self.problem.displace(&pressure, &mut gaps);
        for (candidate, gap) in gaps.iter_mut().enumerate() {
            let place = self.candidates.place(candidate);
            let displacement = judged.displacement_of(region.on_grid(place));
            *gap = initial_gap(place) + (displacement - *gap);
        }
        self.problem.take_initial_gap(gaps);
        true
    }
}

/// Returns `g0` (m) by place in a region.
fn initial_gaps<'a>(
    whole: &'a DiscreteProblem,
    region: &Region,
) -> impl Fn([usize; 2]) -> f64 + use<'a> {
    let (gaps, region) = (whole.initial_gap(), *region);
    move |place| gaps[region.index_on_grid(place)]
}

/// Adds to an iterate the work of the one from which it started.
fn after(before: Iterate, iterate: Iterate) -> Iterate {
    let mut residuals = before.residuals;
    residuals.extend(iterate.residuals);
    Iterate {
        iterations: before.iterations + iterate.iterations,
        operator_applications: before.operator_applications + iterate.operator_applications,
        stiffness_applications: before.stiffness_applications + iterate.stiffness_applications,
        residuals,
        ..iterate
    }
}

/// Whether a step on some elements of a square of `size` × `size` is enough cheaper than one on the whole grid.
fn is_worth_it(size: usize, elements: &[u32]) -> bool {
    LEAST_GAIN * scattered_work(size, elements) <= WHOLE_STEP * size * size
}

#[cfg(test)]
mod tests;
