//! `T(t) = ∫ Φ(x/t) J0(x) dx` in 32 digits, where the terms of the sum are very much larger than the sum.

mod bessel;
mod expansion;
mod response;
mod rule;
mod stack;

use pellicle_kernel::Foundation;

use crate::response::ResponseTable;
use crate::twofold::Twofold;
use response::PreciseResponse;
use rule::PreciseRule;

/// Below this Φ(0) the plain sum may not reach full accuracy.
const SOFT: f64 = 0.02;

/// `T` of a soft layer on a stiffer half-space.
#[derive(Debug)]
pub(crate) struct Precise {
    response: PreciseResponse,
}

impl Precise {
    /// The table for a foundation that needs it; `plain` is the one in 16 digits.
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
