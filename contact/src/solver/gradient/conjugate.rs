//! Preconditioned conjugate gradients on a working set that stands still.
//!
//! On the set `I` and the pressures of one total, minimise the energy: `d ← z + β d` with the projected
//! preconditioned residual `z`, `α = r·z / d·(K + η)d`, `β` by Polak and Ribière, never negative. A step that
//! would pull is clipped at zero pressure; the set then changes and the directions are forgotten.

use super::{
    super::super::DiscreteProblem, iterate::State, preconditioner::Preconditioner,
    segment::Segment, vector::dot, working_set::WorkingSet,
};

/// Whether a step stayed inside the set it was made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// All pressures of the set stayed positive: the directions go on.
    Kept,
    /// Some would have pulled: the set is another one now, and the next step must not be conjugate.
    Left,
}

/// The conjugate directions' memory and buffers.
pub struct ConjugateDirections {
    /// Whether `direction` and `residual_before` belong to the present set.
    running: bool,
    direction: Vec<f64>,
    segment: Segment,
    preconditioned: Vec<f64>,
    residual_before: Vec<f64>,
    product_before: f64,
}

impl ConjugateDirections {
    pub fn new(elements: usize) -> Self {
        let field = || vec![0.0; elements];
        Self {
            running: false,
            direction: field(),
            segment: Segment::new(elements),
            preconditioned: field(),
            residual_before: field(),
            product_before: 0.0,
        }
    }

    /// Forgets the directions: the next step starts from the preconditioned residual.
    pub fn restart(&mut self) {
        self.running = false;
    }

    /// One step: one product, two where it is clipped.
    pub fn step(
        &mut self,
        problem: &mut DiscreteProblem,
        preconditioner: &mut Preconditioner,
        state: &mut State,
        set: &WorkingSet,
    ) -> Course {
        preconditioner.direction_into(state, set, &mut self.preconditioned);
        let product = self.residual_product(state);
        let beta = if self.running {
            ((product - self.product_with_residual_before()) / self.product_before).max(0.0)
        } else {
            0.0
        };
        for (d, z) in self.direction.iter_mut().zip(&self.preconditioned) {
            *d = z + beta * *d;
        }
        self.remember(state, set, product);
        let Segment { image, .. } = &mut self.segment;
        state.image_into(problem, &self.direction, image);
        // α = r·d / d·(K + η)d, with r·d = −d·∂E
        let alpha = -state.control.slope(&self.direction, &state.v) / dot(&self.direction, image);
        self.take(alpha, problem, state)
    }

    /// `r·z`, the residual being `r = D − v`; `z` sums to zero or `D` is prescribed.
    fn residual_product(&self, state: &State) -> f64 {
        -state.control.slope(&self.preconditioned, &state.v)
    }

    /// `z·r_before`.
    fn product_with_residual_before(&self) -> f64 {
        dot(&self.preconditioned, &self.residual_before)
    }

    fn remember(&mut self, state: &State, set: &WorkingSet, product: f64) {
        for ((r, v), member) in self
            .residual_before
            .iter_mut()
            .zip(&state.v)
            .zip(set.mask())
        {
            *r = if *member { state.penetration - v } else { 0.0 };
        }
        (self.product_before, self.running) = (product, true);
    }

    /// `p ← p + α d`; where that would pull, clipped, as far as the energy does not rise.
    fn take(&mut self, alpha: f64, problem: &mut DiscreteProblem, state: &mut State) -> Course {
        let pulls = |(p, d): (&f64, &f64)| p + alpha * d < 0.0;
        if !alpha.is_finite() {
            return Course::Left;
        }
        if !state.pressure.iter().zip(&self.direction).any(pulls) {
            state.advance(alpha, &self.direction, &self.segment.image);
            return Course::Kept;
        }
        self.segment.clip(state, alpha, &self.direction);
        let ceiling = state.energy();
        self.segment.take(problem, state, ceiling);
        Course::Left
    }
}
