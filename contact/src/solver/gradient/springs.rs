//! Nonlinear springs: Newton's method around the linear problem, without additional products.
//!
//! The springs are linearised at the current pressure, which makes the problem linear, and linearised again as soon as
//! the residual by their law clearly exceeds that of the linear problem. `K p` is known from `v` at every iterate, so
//! only the exponentials of the springs are computed for this.
//!
//! **Why it ends.** The energy is convex, and the energy of the linear problem is its model at `p₀`, with the same
//! slope there. A solution of the model, or any pressure with a lower model energy, lies downhill from `p₀`. If the
//! energy itself is not lower there, it is lower at its minimum on the segment, which is also found without a product.

use crate::{
    DiscreteProblem,
    problem::tangents::Tangents,
    solver::gradient::state::State,
    vector::{add_scaled, dot, stretches::Stretches, update},
};

/// The springs are linearised again once the residual of the linear problem is this fraction of the residual by the
/// law.
const LINEAR_ENOUGH: f64 = 0.3;
/// The fields of a solution on nonlinear springs.
pub struct Springs {
    /// `v` by the law at the pressure `p₀` of the linearisation.
    v_before: Vec<f64>,
    /// `v` by the law at the current pressure.
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
        let penetration = state.penetration_of(&self.v_by_law);
        state.residual_of(&self.v_by_law, penetration).0
    }

    /// Whether the residual by the law clearly exceeds that of the linear problem.
    pub fn need_linearising(linear: f64, by_law: f64) -> bool {
        by_law.is_finite() && linear <= LINEAR_ENOUGH * by_law
    }

    /// Linearises the springs again at the current pressure, or at the minimum of the energy on the segment to it.
    pub fn linearise(&mut self, problem: &mut DiscreteProblem, state: &mut State) {
        if let Some(tangents) = problem.springs().tangents() {
            let part = self.part(problem, tangents, state);
            if part < 1.0 {
                // Elements that pressed at the linearisation press again.
                state.press_anywhere();
                update(&mut state.pressure, tangents.at(), |p, at| {
                    *p = at + part * (*p - at);
                });
                update(&mut state.v, &self.v_before, |v, before| {
                    *v = before + part * (*v - before);
                });
            }
        }
        self.linearise_here(problem, state);
    }

    /// Linearises the springs at the current pressure.
    pub fn linearise_here(&mut self, problem: &mut DiscreteProblem, state: &mut State) {
        self.follow_law(problem, state);
        self.v_before.copy_from_slice(&self.v_by_law);
        problem.linearise_springs(&state.pressure);
        state.v.copy_from_slice(&self.v_by_law);
        state.begin_on_tangents(problem);
    }

    /// Computes `v` by the law.
    fn follow_law(&mut self, problem: &DiscreteProblem, state: &State) {
        self.v_by_law.copy_from_slice(&state.v);
        if let Some(tangents) = problem.springs().tangents() {
            let (rest, pressure) = (problem.relief_compliance(), &state.pressure);
            tangents.add_beyond(rest, pressure, &mut self.beyond, &mut self.v_by_law);
        }
    }

    /// The fraction of the segment from `p₀` to the current pressure at which the energy is least.
    fn part(&mut self, problem: &DiscreteProblem, tangents: &Tangents, state: &State) -> f64 {
        // s = p − p₀,  y = v − v₀ = (K + η_t) s
        let step = &mut self.beyond;
        step.copy_from_slice(&state.pressure);
        add_scaled(step, -1.0, tangents.at());
        let everywhere = Stretches::all(step.len());
        let slope = (state.control).slope(&everywhere, step, &self.v_before);
        let curvature = dot(step, &state.v) - dot(step, &self.v_before);
        let rest = problem.relief_compliance();
        tangents.part_downhill(rest, &state.pressure, [slope, curvature])
    }
}

#[cfg(test)]
mod tests {
    use pellicle_texture::SpringLaw;

    use super::*;
    use crate::{
        Load,
        solver::{
            gradient::load_control::LoadControl,
            tests::{SIZE, problem},
        },
    };

    /// Height and compliance at rest of springs whose modulus is 1; the body is nearly rigid in comparison.
    const HEIGHT: f64 = 1e4;
    const ELEMENTS: usize = SIZE * SIZE;

    fn stiffening() -> DiscreteProblem {
        let problem = problem([1.0, 0.1], |x, y| x * y, |_, _| HEIGHT);
        problem.with_spring_law(SpringLaw::logarithmic(1.0).unwrap())
    }

    /// `∫ v dp − D Σ p` by the law at a pressure, in the units of the problem's scale; and `v`.
    fn energy(problem: &mut DiscreteProblem, depth: f64, pressure: &[f64]) -> (f64, Vec<f64>) {
        let scale = problem.scale();
        let unit = scale.pressure();
        let in_pascal: Vec<f64> = pressure.iter().map(|p| unit * p).collect();
        let mut v = vec![0.0; pressure.len()];
        problem.displace(&in_pascal, &mut v);
        let mut energy = 0.0;
        for (e, p) in in_pascal.iter().enumerate() {
            let g0 = problem.initial_gap()[e];
            // ∫ h (1 − exp(−p)) dp
            energy += 0.5 * p * v[e] + HEIGHT * (p + (-p).exp_m1()) + (g0 - depth) * p;
            v[e] = (v[e] - HEIGHT * (-p).exp_m1() + g0) / scale.length;
        }
        (energy / (unit * scale.length), v)
    }

    #[test]
    fn springs_are_linearised_if_the_residual_by_their_law_is_three_times_the_linear_one() {
        for (linear, by_law, wanted) in [
            (0.29, 1.0, true),
            (0.31, 1.0, false),
            (2.9e-9, 1e-8, true),
            (3.1e-9, 1e-8, false),
            (0.0, f64::INFINITY, false),
            (0.0, f64::NAN, false),
        ] {
            assert_eq!(
                Springs::need_linearising(linear, by_law),
                wanted,
                "{linear} {by_law}"
            );
        }
    }

    #[test]
    fn a_step_towards_too_low_a_pressure_ends_at_the_minimum_of_the_energy() {
        // The solution is 3 on every spring, from w* = D. From 6 the tangents, which are very stiff, lead to hardly any
        // pressure, where the energy is higher.
        let mut problem = stiffening();
        let depth = HEIGHT * (1.0 - (-3.0_f64).exp());
        let scale = problem.scale();
        let per_unit = 1.0 / scale.pressure();
        let field = |of: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..ELEMENTS).map(|e| per_unit * of(e as f64)).collect()
        };
        let from = field(&|e| 6.0 + 0.3 * e.sin());
        let to = field(&|e| 0.3 + 0.2 * e.cos());
        let (before, v_before) = energy(&mut problem, depth, &from);
        let mut springs = Springs::of(&problem).unwrap();
        let mut state = State::new(&problem);
        state.control = LoadControl::of(&problem, Load::Penetration(depth));
        problem.linearise_springs(&from);
        springs.v_before.copy_from_slice(&v_before);
        // By the tangents v is linear on the segment.
        let step: Vec<f64> = to.iter().zip(&from).map(|(to, from)| to - from).collect();
        let mut image = vec![0.0; ELEMENTS];
        let in_pascal: Vec<f64> = step.iter().map(|s| s / per_unit).collect();
        problem.displace(&in_pascal, &mut image);
        let tangents = problem.springs().compliance().to_vec();
        for e in 0..ELEMENTS {
            let y = (image[e] + tangents[e] * in_pascal[e]) / scale.length;
            state.v[e] = v_before[e] + y;
        }
        state.pressure.copy_from_slice(&to);

        springs.linearise(&mut problem, &mut state);
        let reached = problem.springs().tangents().unwrap().at().to_vec();
        let part = (reached[0] - from[0]) / step[0];
        assert!(part > 0.1 && part < 0.9, "{part}");
        for e in 0..ELEMENTS {
            assert!((reached[e] - from[e] - part * step[e]).abs() < 1e-12 * from[e]);
        }
        let mut along = |part: f64| {
            let on_way: Vec<f64> = from.iter().zip(&step).map(|(p, s)| p + part * s).collect();
            energy(&mut problem, depth, &on_way)
        };
        let (there, v) = along(part);
        assert!(there < before);
        // The minimum on the segment, to a thousandth of its length.
        assert!(there <= along(part - 0.01).0 && there <= along(part + 0.01).0);
        // v is the law's at the pressure reached.
        for (found, wanted) in springs.v_before.iter().zip(&v) {
            assert!(
                (found - wanted).abs() < 1e-10 * v[0].abs(),
                "{found} {wanted}"
            );
        }
    }

    #[test]
    fn the_residual_by_the_law_vanishes_at_the_solution() {
        // A flat indenter practically on springs alone: p = −ln(1 − D/h).
        let height = 1e9;
        let mut problem = problem([1.0, 0.1], |_, _| 0.0, |_, _| height)
            .with_spring_law(SpringLaw::logarithmic(1.0).unwrap());
        let pressure = 1.7_f64;
        let depth = -height * (-pressure).exp_m1();
        let control = LoadControl::of(&problem, Load::Penetration(depth));
        let mut state = State::new(&problem);
        state.start(&mut problem, control, &vec![pressure; ELEMENTS]);
        let mut springs = Springs::of(&problem).unwrap();
        // The springs are linearised at the start, where the law agrees with its tangents.
        springs.linearise_here(&mut problem, &mut state);
        let by_law = springs.residual(&problem, &state);
        assert!(by_law < 1e-6, "{by_law:e}");
        // A tenth more pressure shortens the springs by h (e^−p − e^−1.1p), relative to the depth.
        state.pressure.iter_mut().for_each(|p| *p *= 1.1);
        let own = problem.springs().compliance()[0] / problem.scale().compliance;
        let at = state.pressure[0];
        state.v.iter_mut().for_each(|v| *v += own * (at - at / 1.1));
        let wanted = height * ((-pressure).exp() - (-1.1 * pressure).exp()) / depth;
        let found = springs.residual(&problem, &state);
        assert!((found / wanted - 1.0).abs() < 1e-5, "{found} {wanted}");
    }
}
