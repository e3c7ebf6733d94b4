//! `T(t) = ∫ Φ(x/t) J0(x) dx` in 32 digits, for layers so soft that the terms of the sum are far larger than the sum.
//!
//! Measured on 32 coatings of χ = 0.02 to 1e-8 and Poisson's ratios of 0 to 0.5, with H/a = 0.02 to 1000 and offsets up
//! to 500: without these digits the coefficients lose 3e-16/Φ(0) of `Φ(0) k_Love`, which is 4e-14 at χ = 0.01, 3e-12 at
//! 1e-4 and 3e-10 at 1e-6, where incompressible coatings also lose 9e-11 of the largest coefficient. With them, the
//! error at the reference values at χ = 1e-6 is 1e-13.

mod bessel;
mod expansion;
mod hankel;
mod response;
mod stack;
mod twofold;

use pellicle_kernel::Foundation;

use crate::response::ResponseTable;
use hankel::PreciseRule;
use response::PreciseResponse;
use twofold::Twofold;

/// Below this Φ(0) the plain sum loses more than 2e-14 of `Φ(0) k_Love`.
const SOFT: f64 = 0.02;

/// `T` of a soft layer on a stiffer half-space.
#[derive(Debug)]
pub(crate) struct Precise {
    response: PreciseResponse,
}

impl Precise {
    /// The table for a foundation that needs it; `plain` is the one with 16 digits.
    pub(crate) fn for_soft(foundation: &Foundation, plain: &ResponseTable) -> Option<Self> {
        let limit = plain.limit();
        let soft = limit > 0.0 && limit < SOFT;
        soft.then(|| Self {
            response: PreciseResponse::new(foundation, [plain.reach(), plain.end()]),
        })
    }

    /// `T` at `ln t`.
    pub(crate) fn integral(&self, ln_t: f64) -> f64 {
        let t = Twofold::from(ln_t).exp();
        let smooth_below = self.response.reach() / 2.0 * t.rounded();
        let mut sum = Twofold::ZERO;
        for node in PreciseRule::shared(smooth_below).nodes(smooth_below) {
            let response = self
                .response
                .value(node.x / t, node.ln_x - Twofold::from(ln_t));
            sum = sum + response * node.weight;
        }
        sum.rounded()
    }

    /// The Taylor coefficients of s², s⁴, s⁶ and s⁸ in Φ at 0.
    pub(crate) fn even_taylor(&self) -> [f64; 4] {
        self.response.even_taylor()
    }
}
