//! The response Φ of a foundation as a table over the wavenumber, so that the thousands of values in a radial table
//! cost as little for 200 layers as for one.

use pellicle_kernel::{Base, Foundation};

use crate::numerics::chebyshev::{ChebyshevTransform, nodes, sum, tail, taylor};
use crate::numerics::chebyshev_panels::ChebyshevPanels;

/// Beyond this wavenumber, in units of 1/thickness of the top layer, `|Φ−1|` is below 4s² e^{−2s} = 3e-18.
pub(crate) const NEGLIGIBLE_BEYOND: f64 = 24.0;

/// Terms of the polynomial for Φ at small wavenumbers.
const LOW_TERMS: usize = 16;

/// Number of samples for its fit: many, because rounding errors in Φ then average out.
const LOW_SAMPLES: usize = 400;

/// Halvings of the initial reach of the polynomial before giving up.
const HALVINGS: usize = 60;

/// Target accuracy of the expansions, relative to the largest Φ in a panel.
const TOLERANCE: f64 = 4e-16;

/// Φ(s) of one foundation; `s = k H` with H the total thickness of its layers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ResponseTable {
    /// Chebyshev coefficients of Φ over 0 ≤ s ≤ `reach`.
    low: Vec<f64>,
    reach: f64,
    panels: ChebyshevPanels,
    /// Φ = 1 beyond this s.
    end: f64,
    limit: f64,
    /// Requested relative accuracy of the expansions.
    tolerance: f64,
}

impl ResponseTable {
    pub(crate) fn new(foundation: &Foundation) -> Self {
        let response = |k: f64| foundation.response(k);
        let limit = match foundation.base() {
            Base::Rigid => 0.0,
            Base::HalfSpace(_) => foundation.response_at_zero(),
        };
        Self::of(foundation, response, limit, TOLERANCE)
    }

    /// A response as a function of the wavenumber, with this limit at 0 and this relative error, that tends to 1 as
    /// fast as the foundation's.
    pub(crate) fn of(
        foundation: &Foundation,
        response: impl Fn(f64) -> f64,
        limit: f64,
        tolerance: f64,
    ) -> Self {
        let thickness = foundation.thickness();
        let response = |s: f64| response(s / thickness);
        let top = foundation
            .layers()
            .first()
            .map_or(thickness, pellicle_kernel::Layer::thickness);
        let end = if thickness < f64::MAX / NEGLIGIBLE_BEYOND {
            NEGLIGIBLE_BEYOND * thickness / top
        } else {
            NEGLIGIBLE_BEYOND * (thickness / top)
        };
        let (low, reach) = low_polynomial(&response, limit, tolerance);
        let ends = [(reach / 2.0).ln(), end.ln()];
        let at = |ln_s: f64| response(ln_s.exp());
        let panels = ChebyshevPanels::fit(ends, at, |largest, _| tolerance * largest);
        Self {
            low,
            reach,
            panels,
            end,
            limit,
            tolerance,
        }
    }

    /// Φ(s).
    #[inline]
    pub(crate) fn value(&self, s: f64, ln_s: f64) -> f64 {
        if s < self.reach / 2.0 {
            sum(&self.low, 2.0 * s / self.reach - 1.0)
        } else if s < self.end {
            self.panels.value(ln_s)
        } else {
            1.0
        }
    }

    /// Φ(0), 0 on a rigid base.
    pub(crate) fn limit(&self) -> f64 {
        self.limit
    }

    /// Φ is a polynomial of low degree below half of this s.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Φ is 1 beyond this s.
    pub(crate) fn end(&self) -> f64 {
        self.end
    }

    /// Requested relative accuracy of the expansions.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Estimated error of the expansions, relative to the largest Φ in the panel.
    pub(crate) fn error(&self) -> f64 {
        let errors = self.panels.panels().iter().map(|p| p.tail() / p.bound());
        errors.fold(0.0, f64::max)
    }

    /// The Taylor coefficients of s², s⁴, s⁶ and s⁸ at 0.
    pub(crate) fn even_taylor(&self) -> [f64; 4] {
        [2, 4, 6, 8].map(|power| taylor(&self.low, power) / self.reach.powi(power))
    }
}

/// Chebyshev coefficients over `0 ≤ s ≤ reach`, and the largest reach for which they have converged.
fn low_polynomial(response: &impl Fn(f64) -> f64, limit: f64, tolerance: f64) -> (Vec<f64>, f64) {
    let transform = ChebyshevTransform::new(LOW_SAMPLES, LOW_TERMS);
    let fit = |reach: f64| -> Vec<f64> {
        // Only the limit itself is known without rounding; the fit is shifted to match it.
        let values = nodes(LOW_SAMPLES).map(|x| response(reach * (1.0 + x) / 2.0) - limit);
        let mut coefficients = transform.coefficients(&values.collect::<Vec<_>>());
        coefficients[0] -= sum(&coefficients, -1.0);
        coefficients
    };
    let mut reach = 1.0;
    let mut low = fit(reach);
    for _ in 0..HALVINGS {
        let largest = low.iter().fold(limit.abs(), |most, c| most.max(c.abs()));
        if tail(&low) <= tolerance * largest {
            break;
        }
        reach /= 2.0;
        low = fit(reach);
    }
    low[0] += limit;
    (low, reach)
}
