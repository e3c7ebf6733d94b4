//! The contact stiffness `dQ/dD`: the change of force with penetration for a fixed set of elements in contact.
//!
//! Differentiating `(K + η) p + g0 = D` on the contact `I` gives `(K + η)_II q = 1` for `q = dp/dD`, and
//! `dQ/dD = 4a² Σ q`. Each conjugate gradient step raises `Σ q = qᵀ (K + η) q` by `α r·z` towards its maximum, so the
//! error of the sum is the square of that of the solution.
//!
//! The pressure is a free first search direction, because its image `(K + η) p = v − g0` is known already. The
//! iteration starts from `q = c p`, with `c` chosen to maximise the sum, and keeps all later directions conjugate to
//! `p`. (Deflation; Nicolaides 1987.) This saves one product of four on a homogeneous body, and two of seven under a
//! stiff coating.

use crate::DiscreteProblem;
use crate::solver::gradient::conjugate_gradients::{LinearSystem, solve};
use crate::solver::gradient::preconditioner::Preconditioner;
use crate::solver::gradient::steps::{Context, conjugate::ConjugateSteps};
use crate::solver::gradient::working_set::WorkingSet;
use crate::vector::{add_scaled, dot, sum, update, update_with};

/// Relative gain of the sum by the next step, predicted with the last `α`, below which that step is replaced by its
/// estimate, which is right to a third.
const SMALLEST_GAIN: f64 = 1e-6;
/// The same if the field is wanted: its error is the square root of this.
const SMALLEST_GAIN_OF_FIELD: f64 = 1e-20;
/// Relative gain that is rounding: the pressure itself solves the system, as under a flat punch.
const ROUNDING: f64 = 1e-26;
/// Steps after which the stiffness counts as not found.
const MOST_STEPS: usize = 300;

/// The quantity to compute from `q`, with its accuracy.
pub enum Wanted<'a> {
    /// Its sum, to a relative accuracy of about 1e-7.
    Sum,
    /// Its values, to about 1e-9 of the largest, written here.
    Field(&'a mut [f64]),
}

/// Computes `Σ q`, in the units of the problem's scale, on the elements that press (the working set, which must not be
/// empty), and the products taken. The sum is none if the system does not converge.
pub fn pressure_sum_per_penetration(
    context: &mut Context<'_>,
    conjugate: &mut ConjugateSteps,
    mut wanted: Wanted<'_>,
) -> (Option<f64>, usize) {
    let smallest_gain = match wanted {
        Wanted::Sum => SMALLEST_GAIN,
        Wanted::Field(_) => SMALLEST_GAIN_OF_FIELD,
    };
    let Context {
        problem,
        state,
        set,
        preconditioner,
        segment,
    } = context;
    let (fields, [preconditioned, image_of_pressure]) = conjugate.lend(set.stretches(), segment);
    preconditioner.follow(problem, set);
    let pressure = &state.pressure;
    let (v, initial_gap) = (&state.v, &state.initial_gap);
    update_with(image_of_pressure, v, initial_gap, |y, v, g0| *y = v - g0);
    set.clear_outside(image_of_pressure);
    // c = Σp / p·(K + η)p, which adds c Σp;  r = 1 − c (K + η)p
    let (pressure_sum, curvature) = (sum(pressure), dot(pressure, image_of_pressure));
    let part = pressure_sum / curvature;
    update_with(
        fields.residual,
        image_of_pressure,
        set.mask(),
        |r, y, member| {
            *r = if *member { 1.0 - part * y } else { 0.0 };
        },
    );
    if let Wanted::Field(field) = &mut wanted {
        update(field, pressure, |q, p| *q = part * p);
    }
    let mut system = RateSystem {
        problem,
        set,
        preconditioner,
        preconditioned,
        pressure,
        image_of_pressure,
        curvature,
        smallest_gain,
        total: part * pressure_sum,
        alpha: f64::INFINITY,
        wanted,
        is_found: false,
    };
    let steps = solve(&mut system, fields, MOST_STEPS);
    let found = (steps.is_some() && system.is_found).then_some(system.total);
    (found, steps.unwrap_or(MOST_STEPS))
}

/// The system `(K + η)_II q = 1` from `q = c p`, and the sum of its solution.
struct RateSystem<'a> {
    problem: &'a mut DiscreteProblem,
    set: &'a WorkingSet,
    preconditioner: &'a mut Preconditioner,
    preconditioned: &'a mut [f64],
    pressure: &'a [f64],
    image_of_pressure: &'a [f64],
    /// `p·(K + η) p`.
    curvature: f64,
    smallest_gain: f64,
    /// `Σ q`.
    total: f64,
    /// The length of the last step.
    alpha: f64,
    wanted: Wanted<'a>,
    is_found: bool,
}

impl LinearSystem for RateSystem<'_> {
    fn precondition(&mut self, residual: &[f64]) -> f64 {
        self.preconditioned.copy_from_slice(residual);
        self.preconditioner.apply(self.set, self.preconditioned);
        dot(residual, self.preconditioned)
    }

    fn is_solved(&mut self, product: f64) -> bool {
        if !product.is_finite() {
            return true;
        }
        let is_rounding = product.abs() <= ROUNDING * self.total;
        let expected = if is_rounding {
            0.0
        } else {
            self.alpha * product
        };
        self.is_found = expected.abs() <= self.smallest_gain * self.total;
        if self.is_found {
            self.total += expected;
        }
        self.is_found
    }

    /// `z` conjugate to `p`.
    fn correction<'a>(&'a mut self, _: &'a [f64]) -> &'a [f64] {
        let along = dot(self.preconditioned, self.image_of_pressure) / self.curvature;
        add_scaled(self.preconditioned, -along, self.pressure);
        self.preconditioned
    }

    fn apply_into(&mut self, direction: &[f64], image: &mut [f64]) {
        self.problem.deform_to_scale(direction, image);
        self.set.clear_outside(image);
    }

    /// `Σ q` grows by `α r·d = α r·z`.
    fn take(&mut self, alpha: f64, direction: &[f64], product: f64) -> bool {
        self.alpha = alpha;
        self.total += alpha * product;
        if let Wanted::Field(field) = &mut self.wanted {
            add_scaled(field, alpha, direction);
        }
        true
    }
}
