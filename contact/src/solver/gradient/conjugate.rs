//! Preconditioned conjugate gradients on a working set that stands still.
//!
//! On the set `I` and the pressures of one total, minimise the energy: `d ← z + β d` with the projected
//! preconditioned residual `z`, `α = r·z / d·(K + η)d`, `β` by Polak and Ribière, never negative. A step that
//! would pull is clipped at zero pressure; the set then changes and the directions are forgotten.

use super::{
    super::super::DiscreteProblem,
    iterate::State,
    preconditioner::Preconditioner,
    vector::{add_scaled, dot},
    working_set::WorkingSet,
};

/// The conjugate directions' memory and buffers.
pub struct ConjugateDirections {
    /// Whether `direction` and `residual_before` belong to the present set.
    running: bool,
    direction: Vec<f64>,
    image: Vec<f64>,
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
            image: field(),
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
    ) {
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
        state.image_into(problem, &self.direction, &mut self.image);
        // α = r·d / d·(K + η)d, with r·d = −s·∂E
        let alpha =
            -state.control.slope(&self.direction, &state.v) / dot(&self.direction, &self.image);
        self.take(alpha, problem, state);
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

    /// `p ← p + α d`, clipped at zero; without clipping `v` follows from the known image.
    fn take(&mut self, alpha: f64, problem: &mut DiscreteProblem, state: &mut State) {
        let pulls = state
            .pressure
            .iter()
            .zip(&self.direction)
            .any(|(p, d)| p + alpha * d < 0.0);
        if !pulls {
            state.advance(alpha, &self.direction, &self.image);
            return;
        }
        add_scaled(&mut state.pressure, alpha, &self.direction);
        state.pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        state.control.rescale(&mut state.pressure);
        state.refresh(problem);
        self.restart();
    }
}
