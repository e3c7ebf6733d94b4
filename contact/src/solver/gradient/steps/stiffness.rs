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

use crate::solver::gradient::steps::{
    Context,
    conjugate::{ConjugateDirections, SystemFields},
};
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
    conjugate: &mut ConjugateDirections,
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
    let SystemFields {
        residual,
        direction,
        image,
        preconditioned: z,
        step: image_of_pressure,
    } = conjugate.system_fields(segment);
    preconditioner.follow(problem, set);
    let pressure = &state.pressure;
    let (v, initial_gap) = (&state.v, &state.initial_gap);
    update_with(image_of_pressure, v, initial_gap, |y, v, g0| *y = v - g0);
    set.clear_outside(image_of_pressure);
    // c = Σp / p·(K + η)p, which adds c Σp;  r = 1 − c (K + η)p
    let (pressure_sum, curvature) = (sum(pressure), dot(pressure, image_of_pressure));
    let part = pressure_sum / curvature;
    update_with(residual, image_of_pressure, set.mask(), |r, y, member| {
        *r = if *member { 1.0 - part * y } else { 0.0 };
    });
    if let Wanted::Field(field) = &mut wanted {
        update(field, pressure, |q, p| *q = part * p);
    }
    direction.fill(0.0);
    let (mut total, mut product_before) = (part * pressure_sum, f64::INFINITY);
    let mut alpha = f64::INFINITY;
    for steps in 0..MOST_STEPS {
        z.copy_from_slice(residual);
        preconditioner.apply(set, z);
        let product = dot(residual, z);
        if !product.is_finite() {
            return (None, steps);
        }
        if product.abs() <= ROUNDING * total {
            return (Some(total), steps);
        }
        let expected = alpha * product;
        if expected.abs() <= smallest_gain * total {
            return (Some(total + expected), steps);
        }
        // d = z + β d, conjugate to p
        let beta = product / product_before;
        let along = dot(z, image_of_pressure) / curvature;
        update_with(direction, z, pressure, |d, z, p| {
            *d = z - along * p + beta * *d;
        });
        problem.deform_to_scale(direction, image);
        set.clear_outside(image);
        // α = r·z / d·(K + η)d;  Σq grows by α r·d = α r·z
        alpha = product / dot(direction, image);
        total += alpha * product;
        if let Wanted::Field(field) = &mut wanted {
            add_scaled(field, alpha, direction);
        }
        add_scaled(residual, -alpha, image);
        product_before = product;
    }
    (None, MOST_STEPS)
}
