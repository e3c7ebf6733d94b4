//! Dilute contact: where few elements of a level may touch, the level is solved on these candidates alone.
//!
//! Their products are [right to 1e-6](pellicle_influence::ScatteredOperator) and cost a small part of one on the whole
//! grid. What they lack is computed, not neglected: after each pass one product on the whole grid judges the pressure,
//! as the certificate does everywhere, and
//!
//! ```text
//! g0 ← g0 + (K − K̃) p on the candidates;    candidates ← candidates ∪ {g < 0 anywhere}, and those around
//! ```
//!
//! where `K̃` is the product among candidates. A solution of the next pass is exact to 1e-6 of the change since the last,
//! and ends where the certificate of the whole grid is satisfied. Should some passes not bring that about, the whole
//! grid is solved as any other.

use std::sync::Arc;

use pellicle_influence::{Sector, scattered_work};

use crate::{
    Boundary, ContactError, DiscreteProblem, GradientSolver, Iterate, Load, Method, Solution,
    Solver, SolverOptions,
    grid::{candidates::Candidates, window::Window},
    result::certificate::JudgedFields,
    solver::Watch,
};

/// Multiplications of a step on the whole grid, by element: its product, the filter twice, and the sums.
const WHOLE_STEP: usize = 100;
/// A step on candidates is to cost no more than the whole grid's over this.
const LEAST_GAIN: usize = 4;
/// Elements per side below which a level costs next to nothing.
const SMALLEST: usize = 256;
/// Tolerance of the first pass, which finds the set as far as the candidates hold it.
const FIRST_TOLERANCE: f64 = 1e-5;
/// Passes after which the whole grid is solved.
const MOST_PASSES: usize = 8;
/// How many times as compliant to its longest wave as to its shortest a body may be, all beyond what a homogeneous one
/// is: under stiff coats systems are so badly conditioned that no product may be wrong in any digit.
const LARGEST_CONTRAST: f64 = 4.0;

/// A level's candidates on a window.
pub struct Dilute {
    window: Window,
    candidates: Arc<Candidates>,
    /// The problem among them, with what its products lack of the last pressure judged in its initial gap.
    problem: DiscreteProblem,
    passes: usize,
}

impl Dilute {
    /// The candidates around a start on a window, if it is worth it.
    pub fn around(
        whole: &DiscreteProblem,
        window: &Window,
        start: &[f64],
        options: &SolverOptions,
    ) -> Option<Self> {
        // Elements at a hardness would make an operator of their own.
        let is_for_candidates = !whole.has_hardness()
            && options.method == Method::Gradient
            && window.sector() == Sector::Whole
            && whole.boundary() == Boundary::Free
            && window.size() >= SMALLEST
            && whole.stiffness_contrast() <= LARGEST_CONTRAST;
        if !is_for_candidates {
            return None;
        }
        let candidates = Candidates::around(window.size(), |element| start[element] > 0.0);
        if candidates.len() == 0 || !is_worth_it(&candidates) {
            return None;
        }
        let candidates = Arc::new(candidates);
        Some(Self {
            window: *window,
            problem: whole.among(window, &candidates)?,
            candidates,
            passes: 0,
        })
    }

    /// Solves among the candidates from a pressure on the window; the iterate's pressure is that on the window, its
    /// products are those among candidates.
    pub fn solve(
        &mut self,
        pressure: &[f64],
        load: Load,
        options: SolverOptions,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
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
        let start = self.candidates.gather(pressure);
        let iterate = solver.solve(&mut self.problem, load, &start, watch)?;
        Ok(Iterate {
            pressure: self.candidates.spread(&iterate.pressure),
            ..iterate
        })
    }

    /// Whether a judged solution is the last word.
    pub fn is_done(&self, solution: &Solution, options: &SolverOptions) -> bool {
        let has_stiffness = self.passes > 1 || !options.contact_stiffness;
        has_stiffness && solution.certificate.is_satisfied()
    }

    /// Takes in what overlaps and what products lack of a pressure that was judged; false where another pass is not
    /// worth it.
    pub fn learn(
        &mut self,
        whole: &DiscreteProblem,
        judged: &JudgedFields,
        pressure: &[f64],
    ) -> bool {
        let (window, size) = (self.window, self.window.size());
        let [above, left] = window.origin();
        let on_grid = |element: usize| [above + element / size, left + element % size];
        let known = self.candidates.clone();
        let candidates = known.with(|element| {
            let is_known = known.at([element / size, element % size]).is_some();
            !is_known && judged.overlaps(on_grid(element))
        });
        if self.passes >= MOST_PASSES || !is_worth_it(&candidates) {
            return false;
        }
        if candidates.len() > known.len() {
            let candidates = Arc::new(candidates);
            let Some(problem) = whole.among(&window, &candidates) else {
                return false;
            };
            (self.problem, self.candidates) = (problem, candidates);
        }
        // g0 + (K − K̃) p
        let mut gaps = vec![0.0; self.candidates.len()];
        let pressure = self.candidates.gather(pressure);
        self.problem.displace(&pressure, &mut gaps);
        for (gap, element) in gaps.iter_mut().zip(self.candidates.elements()) {
            let [i, j] = on_grid(*element as usize);
            *gap =
                whole.initial_gap()[i * whole.size() + j] + (judged.displacement_of([i, j]) - *gap);
        }
        self.problem.take_initial_gap(gaps);
        true
    }
}

/// Whether a step among candidates costs so much less than one on the whole grid.
fn is_worth_it(candidates: &Candidates) -> bool {
    let size = candidates.size();
    LEAST_GAIN * scattered_work(size, candidates.elements()) <= WHOLE_STEP * size * size
}
