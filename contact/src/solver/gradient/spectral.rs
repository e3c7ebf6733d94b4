//! Spectral steps: one product each, for as long as the working set changes.
//!
//! `p' = max(p + α z, 0)` brought to the prescribed total, with `z` the preconditioned residual and the step
//! `α = s·y / (y·M⁻¹y)`, `s = Δp`, `y = Δv` of the step before (Barzilai and Borwein 1988, in the preconditioner's
//! metric).

use super::{
    super::super::DiscreteProblem,
    iterate::State,
    preconditioner::Preconditioner,
    projection::project,
    vector::{add_scaled, dot},
    working_set::WorkingSet,
};

/// Bounds of the step `α`; 1 is the preconditioner's own idea. Steps seen in practice lie between 0.02 and 3.
const STEP_BOUNDS: [f64; 2] = [0.02, 4.0];
/// A step may end above the energy before it, but not above the largest of this many energies
/// (Grippo, Lampariello and Lucidi 1986).
const ENERGY_WINDOW: usize = 4;

/// The spectral step's memory and buffers.
pub struct SpectralSteps {
    alpha: f64,
    energies: Vec<f64>,
    direction: Vec<f64>,
    step: Vec<f64>,
    image: Vec<f64>,
}

impl SpectralSteps {
    pub fn new(elements: usize) -> Self {
        let field = || vec![0.0; elements];
        Self {
            alpha: 1.0,
            energies: Vec::new(),
            direction: field(),
            step: field(),
            image: field(),
        }
    }

    /// One step of the state; one product, two more where it must fall back.
    pub fn step(
        &mut self,
        problem: &mut DiscreteProblem,
        preconditioner: &mut Preconditioner,
        state: &mut State,
        set: &WorkingSet,
    ) {
        self.remember_energy(state.energy());
        preconditioner.direction_into(state, set, &mut self.direction);
        self.clip_along_direction(state);
        if state.control.slope(&self.step, &state.v) >= 0.0 {
            self.project_plain_gradient(problem, state, set);
        }
        state.image_into(problem, &self.step, &mut self.image);
        let t = self.line_search(state);
        state.advance(t, &self.step, &self.image);
        state.pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        self.alpha = self.next_alpha(preconditioner, set);
    }

    fn remember_energy(&mut self, energy: f64) {
        if self.energies.len() == ENERGY_WINDOW {
            self.energies.remove(0);
        }
        self.energies.push(energy);
    }

    /// `s = max(p + α z, 0)` at the prescribed total, less `p`.
    fn clip_along_direction(&mut self, state: &State) {
        for ((s, z), p) in self
            .step
            .iter_mut()
            .zip(&self.direction)
            .zip(&state.pressure)
        {
            *s = (p + self.alpha * z).max(0.0);
        }
        state.control.rescale(&mut self.step);
        add_scaled(&mut self.step, -1.0, &state.pressure);
    }

    /// `s = Π(p + α r) − p`, which starts downhill for every `α > 0`; `α` minimises the energy along the plain
    /// residual `r` on the working set: one product.
    fn project_plain_gradient(
        &mut self,
        problem: &mut DiscreteProblem,
        state: &mut State,
        set: &WorkingSet,
    ) {
        for ((r, v), member) in self.direction.iter_mut().zip(&state.v).zip(set.mask()) {
            *r = if *member { state.penetration - v } else { 0.0 };
        }
        state.image_into(problem, &self.direction, &mut self.image);
        let alpha = dot(&self.direction, &self.direction) / dot(&self.direction, &self.image);
        for ((s, v), p) in self.step.iter_mut().zip(&state.v).zip(&state.pressure) {
            *s = p + alpha * (state.penetration - v);
        }
        project(state.control, &mut self.step);
        add_scaled(&mut self.step, -1.0, &state.pressure);
    }

    /// The part of the step to take: all of it unless the energy rises above the window's largest, then its
    /// minimum on the segment, `t = −s·∂E / (s·y)`.
    fn line_search(&self, state: &State) -> f64 {
        let slope = state.control.slope(&self.step, &state.v);
        let curvature = dot(&self.step, &self.image);
        let largest = self
            .energies
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        // E(p + s) = E(p) + s·∂E + ½ s·y
        let energy = self
            .energies
            .last()
            .map_or(0.0, |present| present + slope + curvature / 2.0);
        if energy <= largest {
            1.0
        } else {
            (-slope / curvature).clamp(0.0, 1.0)
        }
    }

    /// `α = s·y / (y·M⁻¹_I y)` within its bounds.
    fn next_alpha(&mut self, preconditioner: &mut Preconditioner, set: &WorkingSet) -> f64 {
        self.direction.copy_from_slice(&self.image);
        preconditioner.apply(set, &mut self.direction);
        let curvature = dot(&self.step, &self.image);
        let alpha = curvature / dot(&self.image, &self.direction);
        if alpha.is_finite() {
            alpha.clamp(STEP_BOUNDS[0], STEP_BOUNDS[1])
        } else {
            1.0
        }
    }
}
