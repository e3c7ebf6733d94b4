//! Preconditioned conjugate gradients on an unchanged working set.
//!
//! The energy is minimised over pressures on the set `I` with a fixed total: `d ← z + β d` with the projected
//! preconditioned residual `z`, `α = r·z / d·(K + η)d`, `β` by Polak and Ribière, never negative.

use rayon::prelude::*;

use crate::solver::gradient::preconditioner::{UniformAccuracy, residual_into};
use crate::solver::gradient::steps::Context;
use crate::solver::gradient::steps::segment::{Part, Segment};
use crate::vector::{dot, update};

/// Fewest elements per thread.
const MIN_PART: usize = 1 << 12;

/// The result of a step that keeps pressures non-negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// All pressures on the set stayed positive: the directions continue.
    Kept,
    /// Some pressures would have become negative and were held at zero: the set has changed, and the next step must not
    /// be conjugate.
    Left(Part),
}

/// The memory and buffers of the conjugate directions.
pub struct ConjugateDirections {
    /// Whether `direction` and `residual_before` belong to the current set.
    running: bool,
    direction: Vec<f64>,
    preconditioned: Vec<f64>,
    residual_before: Vec<f64>,
    product_before: f64,
}

/// Fields for the solution of a linear system.
pub struct SystemFields<'a> {
    pub residual: &'a mut [f64],
    pub direction: &'a mut [f64],
    pub image: &'a mut [f64],
    pub preconditioned: &'a mut [f64],
    pub step: &'a mut [f64],
}

impl ConjugateDirections {
    pub fn new(elements: usize) -> Self {
        let field = || vec![0.0; elements];
        Self {
            running: false,
            direction: field(),
            preconditioned: field(),
            residual_before: field(),
            product_before: 0.0,
        }
    }

    /// Discards the directions: the next step starts from the preconditioned residual.
    pub fn restart(&mut self) {
        self.running = false;
    }

    /// Lends the buffers for another use and discards the directions.
    pub fn system_fields<'a>(&'a mut self, segment: &'a mut Segment) -> SystemFields<'a> {
        self.restart();
        SystemFields {
            residual: &mut self.residual_before,
            direction: &mut self.direction,
            image: &mut segment.image,
            preconditioned: &mut self.preconditioned,
            step: &mut segment.step,
        }
    }

    /// Takes one step. If elements would pull, they are held at zero and the step is limited so that the energy does
    /// not rise: one product, or two in that case.
    pub fn step_within(&mut self, context: &mut Context<'_>) -> Course {
        self.aim(context);
        let alpha = self.reach(context);
        if !alpha.is_finite() {
            return Course::Left(Part::Cut);
        }
        let pulls = |(p, d): (&f64, &f64)| p + alpha * d < 0.0;
        let steps = context.state.pressure.par_iter().zip(&self.direction);
        if !steps.with_min_len(MIN_PART).any(pulls) {
            self.advance(context, alpha);
            return Course::Kept;
        }
        context.segment.clip(context.state, alpha, &self.direction);
        let ceiling = context.state.energy();
        Course::Left(context.take_segment(ceiling))
    }

    /// Takes one step along the last direction [found](Self::aim), which may make pressures negative: one product.
    /// Returns false if the step is not finite.
    pub fn step_freely(&mut self, context: &mut Context<'_>) -> bool {
        let alpha = self.reach(context);
        if alpha.is_finite() {
            self.advance(context, alpha);
        }
        alpha.is_finite()
    }

    /// The last direction.
    pub fn direction(&self) -> &[f64] {
        &self.direction
    }

    /// The preconditioned residual `z` of the last direction: the preconditioner's estimate of the missing pressure.
    pub fn missing(&self) -> &[f64] {
        &self.preconditioned
    }

    /// Finds the next direction; returns `r·z`. No product.
    pub fn aim(&mut self, context: &mut Context<'_>) -> f64 {
        context.direction_into(UniformAccuracy::Exact, &mut self.preconditioned);
        let Context { state, set, .. } = context;
        // r·z, with r = D − v; z sums to zero, or D is prescribed.
        let product = -state.control.slope(&self.preconditioned, &state.v);
        let beta = if self.running {
            let before = dot(&self.preconditioned, &self.residual_before);
            ((product - before) / self.product_before).max(0.0)
        } else {
            0.0
        };
        if self.running {
            update(&mut self.direction, &self.preconditioned, |d, z| {
                *d = z + beta * *d;
            });
        } else {
            self.direction.copy_from_slice(&self.preconditioned);
        }
        state.deflate(&mut self.direction);
        residual_into(state, set, &mut self.residual_before);
        (self.product_before, self.running) = (product, true);
        product
    }

    /// Writes the image of the direction into the segment; returns the step length to the minimum along it. One
    /// product.
    fn reach(&self, context: &mut Context<'_>) -> f64 {
        let Context {
            problem,
            state,
            segment: Segment { image, .. },
            ..
        } = context;
        state.image_into(problem, &self.direction, image);
        // α = r·d / d·(K + η)d, with r·d = −d·∂E
        -state.control.slope(&self.direction, &state.v) / dot(&self.direction, image)
    }

    /// Advances by `alpha` along the direction whose image the segment holds.
    fn advance(&self, context: &mut Context<'_>, alpha: f64) {
        let Context {
            problem,
            state,
            segment,
            ..
        } = context;
        state.advance(problem, alpha, &self.direction, &segment.image);
    }
}
