//! Spectral steps, one product each, used as long as the working set changes.
//!
//! `p' = max(p + α z, 0)` scaled to the preserved total, with `z = M⁻¹(λ − v)` the preconditioned residual and the step
//! `α = s·y / (y·M⁻¹y)`, `s = Δp`, `y = Δv` of the previous step (Barzilai and Borwein 1988, in the preconditioner's
//! metric). `M⁻¹y` is not computed but obtained from the two residuals: `M⁻¹Δv = M⁻¹1 Δλ − Δz`, up to the
//! single precision of the sparse factor if the set is the same.

use crate::solver::gradient::preconditioner::{UniformAccuracy, residual_into};
use crate::solver::gradient::steps::projection::project;
use crate::solver::gradient::steps::segment::Segment;
use crate::solver::gradient::steps::{Context, outcome::StepOutcome};
use crate::vector::stretches::SparseField;

/// Bounds of the step length `α`; 1 is the preconditioner's own step. Steps in practice lie between 0.02 and 3.
const STEP_BOUNDS: [f64; 2] = [0.02, 4.0];
/// A step may raise the energy, but not above the largest of this many previous energies (Grippo, Lampariello and
/// Lucidi 1986).
const ENERGY_WINDOW: usize = 4;

/// The memory and buffers of the spectral steps.
pub struct SpectralSteps {
    energies: Vec<f64>,
    direction: SparseField,
    /// `λ` of the previous direction; none after a step of another kind.
    before: Option<f64>,
    direction_before: SparseField,
}

impl SpectralSteps {
    pub fn new(elements: usize) -> Self {
        Self {
            energies: Vec::with_capacity(ENERGY_WINDOW),
            direction: SparseField::new(elements),
            before: None,
            direction_before: SparseField::new(elements),
        }
    }

    /// Discards the previous steps and energies.
    pub fn restart(&mut self) {
        self.forget_direction();
        self.energies.clear();
    }

    /// Discards the previous direction, after a step of another kind.
    pub fn forget_direction(&mut self) {
        self.before = None;
    }

    /// Takes one step along the context's segment, which holds the previous step: one product, two if it falls back to
    /// the plain gradient.
    pub fn step(&mut self, context: &mut Context<'_>) -> StepOutcome {
        self.remember_energy(context.state.energy());
        std::mem::swap(&mut self.direction, &mut self.direction_before);
        let level = context.direction_into(UniformAccuracy::Restricted, &mut self.direction);
        let alpha = self.alpha(level, context.preconditioner.uniform(), context.segment);
        self.before = Some(level);
        context.segment.clip(context.state, alpha, &self.direction);
        let downhill = context.segment.slope(context.state) < 0.0;
        if !downhill {
            self.project_plain_gradient(context);
        }
        let ceiling = self
            .energies
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        let outcome = context.take_segment(ceiling);
        if downhill { outcome } else { StepOutcome::Cut }
    }

    fn remember_energy(&mut self, energy: f64) {
        if self.energies.len() == ENERGY_WINDOW {
            self.energies.remove(0);
        }
        self.energies.push(energy);
    }

    /// `s = Π(p + α r) − p` on the working set, which starts downhill for every `α > 0`; `α` minimises the energy along
    /// the plain residual `r`. One product.
    fn project_plain_gradient(&mut self, context: &mut Context<'_>) {
        let Context {
            problem,
            state,
            set,
            segment: Segment { step, image },
            ..
        } = context;
        residual_into(state, set, &mut self.direction);
        state.image_into(problem, &self.direction, image);
        let alpha = self.direction.dot(&self.direction) / self.direction.dot(image);
        let alpha = if alpha.is_finite() { alpha } else { 0.0 };
        let members = || set.mask().iter().enumerate().filter(|(_, member)| **member);
        let ahead = members().map(|(e, _)| state.pressure[e] + alpha * self.direction[e]);
        let mut ahead: Vec<f64> = ahead.collect();
        project(state.control, &mut ahead);
        step.each(|s| *s = 0.0);
        let step = step.on(set.stretches());
        for ((e, _), p) in members().zip(ahead) {
            step[e] = p - state.pressure[e];
        }
    }

    /// `α = s·y / (y·M⁻¹_I y)` within its bounds, from `λ` and `M⁻¹_I 1`; 1 at first.
    fn alpha(&self, level: f64, uniform: &SparseField, segment: &Segment) -> f64 {
        let Some(before) = self.before else {
            return 1.0;
        };
        let y = &segment.image;
        let metric = (level - before) * uniform.dot(y) + self.direction_before.dot(y)
            - self.direction.dot(y);
        let alpha = segment.curvature() / metric;
        if alpha > 0.0 && alpha.is_finite() {
            alpha.clamp(STEP_BOUNDS[0], STEP_BOUNDS[1])
        } else {
            1.0
        }
    }
}
