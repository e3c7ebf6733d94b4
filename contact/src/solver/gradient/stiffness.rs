//! The contact stiffness `dQ/dD`: how the force grows with the penetration while the set of elements in contact stays.
//!
//! Differentiating `(K + η) p + g0 = D` on the contact `I` gives `(K + η)_II q = 1` for `q = dp/dD`, and `dQ/dD = 4a² Σ q`. Conjugate
//! gradients from zero raise `Σ q = qᵀ (K + η) q` at each step by `α r·z` to its largest value, so the error of the sum is the square
//! of that of the solution.

use super::{preconditioner::Preconditioner, working_set::WorkingSet};
use crate::{
    DiscreteProblem,
    vector::{add_scaled, dot, update},
};

/// The last step's part of the sum at which to stop; what is left is a hundredth of it or less.
const SMALLEST_GAIN: f64 = 1e-7;
/// Steps after which the stiffness is held not to be found.
const MOST_STEPS: usize = 300;

/// The buffers of the linear system, none before the first.
#[derive(Default)]
pub struct StiffnessSystem {
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    preconditioned: Vec<f64>,
}

impl StiffnessSystem {
    /// `Σ q`, in Pa/m, on a set that is not empty, and the products that it took; none if the system does not converge.
    pub fn pressure_sum_per_penetration(
        &mut self,
        problem: &mut DiscreteProblem,
        preconditioner: &mut Preconditioner,
        set: &WorkingSet,
    ) -> (Option<f64>, usize) {
        let Self {
            residual,
            direction,
            image,
            preconditioned: z,
        } = self;
        for field in [&mut *residual, direction, image, z] {
            field.resize(problem.elements(), 0.0);
        }
        update(residual, set.mask(), |r, member| {
            *r = f64::from(u8::from(*member));
        });
        direction.fill(0.0);
        let (mut total, mut product_before) = (0.0, f64::INFINITY);
        for step in 1..=MOST_STEPS {
            z.copy_from_slice(residual);
            preconditioner.apply(set, z);
            let product = dot(residual, z);
            let beta = product / product_before;
            update(direction, z, |d, z| *d = z + beta * *d);
            problem.deform_into(direction, image);
            update(image, set.mask(), |y, member| {
                if !member {
                    *y = 0.0;
                }
            });
            // α = r·z / d·(K + η)d;  Σq grows by α r·d = α r·z
            let alpha = product / dot(direction, image);
            let gain = alpha * product;
            if !gain.is_finite() {
                return (None, step);
            }
            total += gain;
            if gain <= SMALLEST_GAIN * total {
                return (Some(total), step);
            }
            add_scaled(residual, -alpha, image);
            product_before = product;
        }
        (None, MOST_STEPS)
    }
}
