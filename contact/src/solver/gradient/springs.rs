//! Springs of a law that is not linear: Newton's method around the linear problem, at no product of its own.
//!
//! The springs are straightened at the present pressure, which makes the problem linear, and straightened again as soon
//! as the law itself would have more to say than the linear problem's residual. `K p` is known from `v` at every
//! pressure met, so nothing but the springs' own exponentials is computed for it.
//!
//! **Why it ends.** The energy is convex, and the linear problem's is its model at `p₀`, with the same slope there. A
//! solution of the model, or any pressure of less energy by it, lies downhill from `p₀`: if the energy itself is not
//! lower there, then it is at its minimum on the way, which is found without a product as well.

use crate::{
    DiscreteProblem,
    problem::tangents::Tangents,
    solver::gradient::state::State,
    vector::{add_scaled, dot, update},
};

/// The springs are straightened again once the linear problem's residual is this part of that by the law itself.
const STRAIGHT_ENOUGH: f64 = 0.3;
/// Memory of a solution on springs that are not linear.
pub struct Springs {
    /// `v` by the law itself at the pressure `p₀` where they are straightened.
    v_before: Vec<f64>,
    /// `v` by the law itself at the present pressure.
    v_by_law: Vec<f64>,
    beyond: Vec<f64>,
}

impl Springs {
    /// None for linear springs.
    pub fn of(problem: &DiscreteProblem) -> Option<Self> {
        let field = || vec![0.0; problem.elements()];
        (!problem.spring_law().is_linear()).then(|| Self {
            v_before: field(),
            v_by_law: field(),
            beyond: field(),
        })
    }

    /// The [residual](State::residual) by the law itself.
    pub fn residual(&mut self, problem: &DiscreteProblem, state: &State) -> f64 {
        self.follow_law(problem, state);
        let penetration = (state.control).penetration(&state.pressure, &self.v_by_law);
        state.residual_of(&self.v_by_law, penetration).0
    }

    /// Whether the law itself has more to say than a residual of the linear problem.
    pub fn are_bent(linear: f64, by_law: f64) -> bool {
        by_law.is_finite() && linear <= STRAIGHT_ENOUGH * by_law
    }

    /// Straightens the springs anew at the present pressure, or at that of the least energy on the way to it.
    pub fn straighten(&mut self, problem: &mut DiscreteProblem, state: &mut State) {
        if let Some(tangents) = problem.tangents() {
            let part = self.part(problem, tangents, state);
            if part < 1.0 {
                update(&mut state.pressure, tangents.at(), |p, at| {
                    *p = at + part * (*p - at);
                });
                update(&mut state.v, &self.v_before, |v, before| {
                    *v = before + part * (*v - before);
                });
            }
        }
        self.straighten_here(problem, state);
    }

    /// Straightens the springs at the present pressure.
    pub fn straighten_here(&mut self, problem: &mut DiscreteProblem, state: &mut State) {
        self.follow_law(problem, state);
        self.v_before.copy_from_slice(&self.v_by_law);
        problem.straighten_springs(&state.pressure);
        state.v.copy_from_slice(&self.v_by_law);
        state.begin_on_tangents(problem);
    }

    /// Finds `v` by the law itself.
    fn follow_law(&mut self, problem: &DiscreteProblem, state: &State) {
        self.v_by_law.copy_from_slice(&state.v);
        if let Some(tangents) = problem.tangents() {
            let (rest, pressure) = (problem.relief_compliance(), &state.pressure);
            tangents.add_beyond(rest, pressure, &mut self.beyond, &mut self.v_by_law);
        }
    }

    /// The part of the way from `p₀` to the present pressure to go.
    fn part(&mut self, problem: &DiscreteProblem, tangents: &Tangents, state: &State) -> f64 {
        // s = p − p₀,  y = v − v₀ = (K + η_t) s
        let step = &mut self.beyond;
        step.copy_from_slice(&state.pressure);
        add_scaled(step, -1.0, tangents.at());
        let slope = state.control.slope(step, &self.v_before);
        let curvature = dot(step, &state.v) - dot(step, &self.v_before);
        let rest = problem.relief_compliance();
        tangents.part_downhill(rest, &state.pressure, [slope, curvature])
    }
}
