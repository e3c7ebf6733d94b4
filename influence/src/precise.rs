//! `T(t) = ∫ Φ(x/t) J0(x) dx` in 32 digits, where the terms of the sum are very much larger than the sum.

mod bessel;
mod response;
mod rule;

use pellicle_kernel::Foundation;

use crate::response::ResponseTable;
use crate::twofold::Twofold;
use response::PreciseResponse;
use rule::PreciseRule;

/// Below this Φ(0) the plain sum may not reach full accuracy.
const SOFT: f64 = 0.02;

/// Wavenumbers at which Φ is below this many Φ(0) do not need the precision.
const SMALL: f64 = 300.0;

/// The table may begin no higher than this share of the reach of Φ's Taylor series, for the largest radii to find all they need.
const LOWEST: f64 = 1.0 / 200.0;

/// Φ in 32 digits and in 16.
#[derive(Debug)]
pub(crate) struct Precise<'a> {
    precise: PreciseResponse,
    plain: &'a ResponseTable,
}

impl<'a> Precise<'a> {
    /// The table for a foundation that needs it: a soft layer on a stiffer half-space.
    pub(crate) fn for_soft(foundation: &Foundation, plain: &'a ResponseTable) -> Option<Self> {
        let limit = plain.limit();
        if limit == 0.0 || limit > SOFT {
            return None;
        }
        let mut start = LOWEST * plain.reach();
        while plain.value(start, start.ln()) > SMALL * limit {
            start /= 2.0;
        }
        let precise = PreciseResponse::new(foundation, [start, plain.end()]);
        Some(Self { precise, plain })
    }

    /// `T` at `ln t`: the largest part of the integral in 32 digits, the small wavenumbers, whose Φ is small, in 16.
    pub(crate) fn integral(&self, ln_t: f64) -> f64 {
        let rule = PreciseRule::shared();
        let t = ln_t.exp();
        let from = rule.panel_from(self.precise.start() * t);
        let low = |x: f64, ln_x: f64| self.plain.value(x / t, ln_x - ln_t);
        let mut sum = Twofold::from(rule.below(from, low));
        for node in rule.nodes(from) {
            sum = sum + self.precise.value(node.ln_x, ln_t) * node.weight;
        }
        sum.rounded()
    }
}
