//! Preconditioned conjugate gradients on an unchanged working set.
//!
//! The energy is minimised over pressures on the set `I` with a fixed total, along [conjugate
//! directions](Directions) of the projected preconditioned residual `z`, with `α = r·d / d·(K + η)d`.

use std::sync::Arc;

use crate::solver::gradient::conjugate_gradients::{Directions, SystemFields};
use crate::solver::gradient::preconditioner::{UniformAccuracy, residual_into};
use crate::solver::gradient::steps::segment::Segment;
use crate::solver::gradient::steps::{Context, outcome::StepOutcome};
use crate::vector::stretches::{SparseField, Stretches};

/// The memory and buffers of the conjugate directions.
pub struct ConjugateSteps {
    directions: Directions,
    preconditioned: SparseField,
    residual_before: SparseField,
}

/// The fields of a linear system, and two more for its preconditioner and for a direction taken beforehand.
pub type LentFields<'a> = (SystemFields<'a>, [&'a mut [f64]; 2]);

impl ConjugateSteps {
    pub fn new(elements: usize) -> Self {
        let field = || SparseField::new(elements);
        Self {
            directions: Directions::new(elements),
            preconditioned: field(),
            residual_before: field(),
        }
    }

    /// Discards the directions: the next step starts from the preconditioned residual.
    pub fn restart(&mut self) {
        self.directions.restart();
    }

    /// Lends the buffers for another use on some stretches and discards the directions.
    pub fn lend<'a>(&'a mut self, on: &Arc<Stretches>, segment: &'a mut Segment) -> LentFields<'a> {
        self.restart();
        self.directions.stay_on(on);
        let fields = SystemFields {
            residual: self.residual_before.on(on),
            directions: &mut self.directions,
            image: &mut segment.image,
        };
        (fields, [self.preconditioned.on(on), segment.step.on(on)])
    }

    /// Takes one step. If elements would pull, they are held at zero and the step is limited so that the energy does
    /// not rise: one product, or two in that case.
    pub fn step_within(&mut self, context: &mut Context<'_>) -> StepOutcome {
        self.aim(context);
        let alpha = self.reach(context);
        if !alpha.is_finite() {
            return StepOutcome::Cut;
        }
        let state = &*context.state;
        let pulls = |p: f64, d: f64| p + alpha * d < 0.0;
        if !(state.stretches()).any(&state.pressure, self.directions.last(), pulls) {
            self.advance(context, alpha);
            return StepOutcome::Free;
        }
        (context.segment).clip(context.state, alpha, self.directions.last());
        let ceiling = context.state.energy();
        context.take_segment(ceiling)
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

    /// The preconditioned residual `z` of the last direction: the preconditioner's estimate of the missing pressure.
    pub fn missing(&self) -> &[f64] {
        &self.preconditioned
    }

    /// Finds the next direction; returns `r·z`. No product.
    pub fn aim(&mut self, context: &mut Context<'_>) -> f64 {
        context.direction_into(UniformAccuracy::Exact, &mut self.preconditioned);
        let Context { state, set, .. } = context;
        // r·z, with r = D − v; z sums to zero, or D is prescribed.
        let on = state.stretches();
        let product = -state.control.slope(on, &self.preconditioned, &state.v);
        let directions = &mut self.directions;
        directions.stay_on(on);
        directions.turn_from(&self.residual_before, &self.preconditioned, product);
        directions.correct(|direction| state.deflate(direction));
        residual_into(state, set, &mut self.residual_before);
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
        let direction = self.directions.last();
        state.image_into(problem, direction, image);
        // α = r·d / d·(K + η)d, with r·d = −d·∂E
        let on = state.stretches();
        -state.control.slope(on, direction, &state.v) / on.dot(direction, image)
    }

    /// Advances by `alpha` along the direction whose image the segment holds.
    fn advance(&self, context: &mut Context<'_>, alpha: f64) {
        let Context {
            problem,
            state,
            segment,
            ..
        } = context;
        state.advance(problem, alpha, self.directions.last(), &segment.image);
    }
}
