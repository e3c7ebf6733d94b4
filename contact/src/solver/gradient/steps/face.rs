//! Descent from face to face: the fallback for Newton's method, which always descends and always ends.
//!
//! A face is a set of elements whose pressures are free. From an admissible pressure, conjugate gradients solve the
//! linear system on the face. Then there are three cases:
//!
//! - no element pulls: this is the minimum of the energy on the face, and elements that overlap are added;
//! - an element that had no pressure before pulls: it leaves the face, and the system is solved again from the same
//!   start;
//! - other elements pull: some of them lose their pressure and leave, as many at once as lower the energy more than
//!   stopping where the first element would pull; there the energy is certainly lower than before.
//!
//! The energy decreases from each admissible pressure to the next, so no face is solved twice, and there are finitely
//! many (Lawson and Hanson 1974; many elements at once as Portugal, Júdice and Vicente 1994). Where the contact under a
//! plate consists of a few elements among many with small overlaps, Newton's method jumps between disjoint sets; this
//! method does not.

use crate::solver::exchange::{Bound, Caution, ends};
use crate::solver::gradient::state::State;
use crate::solver::gradient::steps::Context;
use crate::solver::gradient::steps::conjugate::ConjugateSteps;
use crate::solver::gradient::steps::segment::Segment;
use crate::vector::{add_scaled, update, update_with};

/// Largest error of the energy of the solution on a face, relative to the initial one, as the preconditioner estimates
/// it: `r·z`.
const LARGEST_ENERGY_ERROR: f64 = 1e-2;
/// Most steps for one linear system; its approximate solution is then used, since each conjugate gradient step has
/// lowered the energy.
const MOST_STEPS: usize = 60;
/// Rounding error of a pressure that goes to zero, relative to its change.
const ROUNDING: f64 = 1e-13;

/// The state of the descent.
pub struct FaceDescent {
    conjugate: ConjugateSteps,
    /// The admissible pressure at which the current face was entered, with its `v` and energy.
    pressure: Vec<f64>,
    v: Vec<f64>,
    penetration: f64,
    energy: f64,
    /// `r·z` at the first step on the face; none before it.
    first: Option<f64>,
    steps: usize,
    /// Of elements that lose their pressure at once.
    caution: Caution,
}

/// Sets pressures to 0 that a step has made negative, or positive by rounding only.
fn cut_off(pressure: &mut [f64], step: &[f64]) {
    update(pressure, step, |p, s| {
        if *p <= -ROUNDING * s {
            *p = 0.0;
        }
    });
}

impl FaceDescent {
    pub fn new(elements: usize) -> Self {
        Self {
            conjugate: ConjugateSteps::new(elements),
            pressure: vec![0.0; elements],
            v: vec![0.0; elements],
            penetration: 0.0,
            energy: f64::INFINITY,
            first: None,
            steps: 0,
            caution: Caution::default(),
        }
    }

    /// Begins from an admissible pressure and its working set.
    pub fn begin(&mut self, state: &State) {
        self.pressure.copy_from_slice(&state.pressure);
        self.v.copy_from_slice(&state.v);
        (self.penetration, self.energy) = (state.penetration, state.energy());
        self.first = None;
    }

    /// Takes one step of the linear system on the current face, or leaves a solved face: one product at most.
    pub fn step(&mut self, context: &mut Context<'_>) {
        if self.first.is_none() {
            context.preconditioner.restart();
            self.conjugate.restart();
            self.steps = 0;
        }
        let missing = self.conjugate.aim(context);
        let first = *self.first.get_or_insert(missing);
        self.steps += 1;
        // Never at the first step: each face costs at least one product, so the bound on products ends an iteration
        // that rounding would keep going.
        let is_settled =
            self.steps > 1 && (missing <= LARGEST_ENERGY_ERROR * first || self.steps > MOST_STEPS);
        let moves = !is_settled && self.conjugate.step_freely(context);
        if !moves {
            self.leave_face(context);
        }
    }

    /// Goes from the solution on the face, or its approximation, to the next face.
    fn leave_face(&mut self, context: &mut Context<'_>) {
        let ends = ends([&self.pressure, &context.state.pressure], Bound::Zero);
        if ends.first().is_some_and(|first| *first > 0.0) {
            self.cut_segment(context, &ends);
        }
        let Context { state, set, .. } = context;
        match ends.first() {
            None => set.update(state),
            Some(first) if *first > 0.0 => set.keep_pressing(state),
            Some(_) => {
                let before = &self.pressure;
                set.keep(state, |element, p| p >= 0.0 || before[element] > 0.0);
                self.go_back(state);
            }
        }
        self.begin(state);
    }

    /// Advances until some of the pulling elements have no pressure, as many as recently lowered the energy more than
    /// stopping at the first. If that fails, it stops at the first. One product or none.
    fn cut_segment(&mut self, context: &mut Context<'_>, ends: &[f64]) {
        let Context {
            problem,
            state,
            segment,
            ..
        } = context;
        let Segment { step, image } = &mut **segment;
        let on = state.stretches();
        on.update_with(
            step.on(on),
            &state.pressure,
            &self.pressure,
            |s, p, before| {
                *s = p - before;
            },
        );
        update_with(image, &state.v, &self.v, |y, v, before| *y = v - before);
        // E(p + t s) = E(p) + t s·∂E + ½ t² s·y
        let slope = state.control.slope(on, &segment.step, &self.v);
        let curvature = segment.curvature();
        let straight = self.energy + ends[0] * (slope + ends[0] * curvature / 2.0);
        let mut caution = self.caution;
        let leaps = caution.leaps(ends.len(), 1, |at_once| {
            self.go_back(state);
            add_scaled(&mut state.pressure, ends[at_once - 1], &segment.step);
            cut_off(&mut state.pressure, &segment.step);
            state.clip(problem);
            state.energy() <= straight
        });
        self.caution = caution;
        if leaps {
            return;
        }
        self.go_back(state);
        state.advance(problem, ends[0], &segment.step, &segment.image);
        cut_off(&mut state.pressure, &segment.step);
    }

    /// Restores the state at which the face was entered.
    fn go_back(&self, state: &mut State) {
        state.go_back(&self.pressure, &self.v, self.penetration);
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
    fn negative_pressures_and_those_within_rounding_of_zero_become_zero() {
        let third = 1.0 / 3.0;
        // Negative, 0 up to rounding of the step, reduced, and unchanged.
        let mut pressure = [-0.25, 1e-16 * third, 0.5, 0.0];
        cut_off(&mut pressure, &[-1.0, -third, -1.0, 0.0]);
        assert_eq!(pressure, [0.0, 0.0, 0.5, 0.0]);
    }

    #[test]
    fn going_back_restores_the_state_at_which_the_face_was_entered() {
        let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
        let control = LoadControl::of(&problem, Load::Penetration(0.02));
        let start: Vec<f64> = (0..SIZE * SIZE).map(|e| 1.0 + (e as f64).sin()).collect();
        let (mut state, _) = begun(&mut problem, control, &start);
        let mut faces = FaceDescent::new(SIZE * SIZE);
        faces.begin(&state);
        let (pressure, v, energy) = (state.pressure.clone(), state.v.clone(), state.energy());
        assert_eq!(faces.energy, energy);
        state.pressure.fill(0.5);
        state.v.fill(0.1);
        faces.go_back(&mut state);
        assert_eq!((&state.pressure, &state.v), (&pressure, &v));
        assert!((state.energy() - energy).abs() <= 1e-12 * energy.abs());
    }
}
