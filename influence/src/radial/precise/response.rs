//! Φ in 32 digits as a table over the wavenumber.

use pellicle_kernel::Foundation;

use super::expansion::{Cosines, Expansion};
use super::stack::Stack;
use super::twofold::Twofold;
use crate::numerics::chebyshev::taylor_weight;
use crate::numerics::rounding;

/// Width of a panel over ln s: half an octave, so that 26 terms give 24 digits where the nearest pole of Φ is at 45°.
const WIDTH: f64 = std::f64::consts::LN_2 / 2.0;

/// Φ(s), `s = k H`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PreciseResponse {
    /// Over 0 ≤ s ≤ `reach`.
    low: Expansion,
    reach: f64,
    /// Lower end of the panels as ln s, half the reach.
    start: f64,
    panels: Vec<Expansion>,
}

impl PreciseResponse {
    /// Tabulates Φ, which must be a low polynomial up to `reach` and 1 beyond `end`.
    pub(crate) fn new(foundation: &Foundation, [reach, end]: [f64; 2]) -> Self {
        let start = (reach / 2.0).ln();
        let count = rounding::ceil((end.ln() - start) / WIDTH);
        let cosines = Cosines::new();
        let stack = Stack::new(foundation);
        let low =
            |node: Twofold| stack.value((Twofold::ONE + node) * Twofold::from(reach).scaled(0.5));
        let panels = (0..count).map(|panel| {
            let centre = Twofold::from(centre(start, panel));
            cosines.expansion(|node| stack.value((centre + HALF_WIDTH * node).exp()))
        });
        Self {
            low: cosines.expansion(low),
            reach,
            start,
            panels: panels.collect(),
        }
    }

    /// The s up to which Φ is one polynomial.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Φ at s.
    #[inline]
    pub(crate) fn value(&self, s: Twofold, ln_s: Twofold) -> Twofold {
        let panel = (ln_s.rounded() - self.start) / WIDTH;
        if panel < 0.0 {
            return self
                .low
                .value(s.scaled(2.0) / Twofold::from(self.reach) - Twofold::ONE);
        }
        let panel = rounding::floor(panel);
        let Some(expansion) = self.panels.get(panel) else {
            return Twofold::ONE;
        };
        let position = (ln_s - Twofold::from(centre(self.start, panel))) / HALF_WIDTH;
        expansion.value(position)
    }

    /// The Taylor coefficients of s², s⁴, s⁶ and s⁸ at 0.
    pub(crate) fn even_taylor(&self) -> [f64; 4] {
        [2_i32, 4, 6, 8].map(|power| {
            let terms = self.low.coefficients().enumerate();
            let sum = terms.fold(Twofold::ZERO, |sum, (j, c)| {
                // Weights are ratios of integers far below 2^106; an error of 1e-16 of them is one of 1e-16 of a
                // term that hardly cancels.
                sum + c * Twofold::from(taylor_weight(j, power))
            });
            sum.rounded() / self.reach.powi(power)
        })
    }
}

/// Half of [`WIDTH`].
const HALF_WIDTH: Twofold = Twofold::from_head(WIDTH / 2.0);

/// Centre of a panel as ln s. It is computed only here, as fitting and evaluation must use the same point.
#[inline]
fn centre(start: f64, panel: usize) -> f64 {
    start + WIDTH * (panel as f64 + 0.5)
}
