//! A step from one admissible pressure towards another, and the fraction of it to take.

use crate::solver::gradient::state::State;
use crate::solver::gradient::steps::outcome::StepOutcome;
use crate::{
    DiscreteProblem,
    vector::{stretches::SparseField, update_with},
};

/// A step `s` that satisfies the load control, with `p + s ≥ 0`, and its image `y = (K + η) s`. Every fraction
/// `t ∈ [0, 1]` of it leads to an admissible pressure, whose energy is known without a product:
/// `E(p + t s) = E(p) + t s·∂E + ½ t² s·y`.
pub struct Segment {
    pub step: SparseField,
    pub image: Vec<f64>,
}

impl Segment {
    pub fn new(elements: usize) -> Self {
        Self {
            step: SparseField::new(elements),
            image: vec![0.0; elements],
        }
    }

    /// `s = max(p + α d, 0)`, scaled to the total to be preserved, less `p`.
    pub fn clip(&mut self, state: &State, alpha: f64, direction: &[f64]) {
        let on = state.stretches();
        let step = self.step.on(on);
        on.update_with(step, direction, &state.pressure, |s, d, p| {
            *s = (p + alpha * d).max(0.0);
        });
        state.rescale(step);
        on.add_scaled(step, -1.0, &state.pressure);
    }

    /// `s·∂E`: negative where the step starts downhill.
    pub fn slope(&self, state: &State) -> f64 {
        state.control.slope(state.stretches(), &self.step, &state.v)
    }

    /// `s·y`.
    pub fn curvature(&self) -> f64 {
        self.step.dot(&self.image)
    }

    /// Takes the whole step, or only up to the minimum of the energy on the segment if the energy would rise above
    /// `ceiling`. One product.
    pub fn take(
        &mut self,
        problem: &mut DiscreteProblem,
        state: &mut State,
        ceiling: f64,
    ) -> StepOutcome {
        state.image_into(problem, &self.step, &mut self.image);
        let (slope, curvature) = (self.slope(state), self.curvature());
        let whole = state.energy() + slope + curvature / 2.0 <= ceiling;
        // t = −s·∂E / (s·y)
        let part = if whole {
            1.0
        } else {
            (-slope / curvature).clamp(0.0, 1.0)
        };
        // A zero step has no curvature; none of it is taken.
        let part = if part.is_finite() { part } else { 0.0 };
        let growth = state.advance(problem, part, &self.step, &self.image);
        if growth != 0.0 {
            self.count_growth(state, part, growth);
        }
        let on = state.stretches().clone();
        on.each(&mut state.pressure, |p| *p = p.max(0.0));
        if whole {
            StepOutcome::Clipped
        } else {
            StepOutcome::Cut
        }
    }

    /// Replaces the step and its image by the part taken, including the growth by balancing: `s ← t s + μ/(1 + μ) p`,
    /// `y ← t y + μ/(1 + μ) (v − g0)`.
    fn count_growth(&mut self, state: &State, part: f64, growth: f64) {
        let ratio = growth / (1.0 + growth);
        let on = state.stretches();
        on.update(self.step.on(on), &state.pressure, |s, p| {
            *s = part * *s + ratio * p;
        });
        update_with(&mut self.image, &state.v, &state.initial_gap, |y, v, g0| {
            *y = part * *y + ratio * (v - g0);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Load,
        solver::{
            gradient::{load_control::LoadControl, tests::begun},
            tests::{RIGID, SIZE, paraboloid, problem},
        },
    };

    #[test]
    fn a_step_is_taken_whole_if_it_ends_below_the_ceiling_and_cut_otherwise() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let direction: Vec<f64> = (0..SIZE * SIZE).map(|e| (e as f64).cos()).collect();
        for load in [Load::Force(1e-2), Load::Penetration(0.02)] {
            for (above, wanted) in [(1e-9, StepOutcome::Clipped), (-1e-9, StepOutcome::Cut)] {
                let control = LoadControl::of(&problem, load);
                let start: Vec<f64> = direction.iter().map(|d| 1.0 + d).collect();
                let (mut state, _) = begun(&mut problem, control, &start);
                let mut segment = Segment::new(SIZE * SIZE);
                segment.clip(&state, 0.5, &direction);
                state.image_into(&mut problem, &segment.step, &mut segment.image);
                // E + s·∂E + ½ s·y
                let end = state.energy() + segment.slope(&state) + segment.curvature() / 2.0;
                let ceiling = end + above * end.abs();
                let taken = segment.take(&mut problem, &mut state, ceiling);
                assert_eq!(taken, wanted, "{load:?}");
            }
        }
    }
}
