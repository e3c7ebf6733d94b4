//! Hankel transforms `∫₀^∞ F(x) J0(x) dx` of a slowly varying F.
//!
//! A smooth taper, `w(x) = ½ erfc((x − X)/L)`, cuts the integral off. The remainder, `∫ (1−w) F J0`, is the
//! component of a smooth function at the wavenumber 1 of the Bessel function: it falls like `exp(−L²/4)` times the
//! bound of F near the real axis. Unlike extrapolation over the zeros of the Bessel function, this needs no
//! alternating partial sums.

use std::sync::LazyLock;

use crate::numerics::quadrature::{Node, legendre_of};
use crate::numerics::rounding;
use crate::numerics::rounding::Sum;

/// L: `exp(−L²/4)` = 4e-19.
pub(crate) const TAPER_WIDTH: f64 = 13.0;

/// X: `1 − w(0)` = ½ erfc(X/L) = 2e-19.
pub(crate) const TAPER_CENTRE: f64 = 82.0;

/// Beyond this x the taper is below 2e-19.
pub(crate) const END: f64 = 164.0;

/// Up to this x the panels double in width, so that F may have detail at any scale towards 0.
pub(crate) const DOUBLING_END: f64 = 4.0;

/// Doubling panels go down to 4 · 2⁻⁸⁰, so that the smallest radius of a table still reaches the smallest
/// wavenumber of its foundation.
const OCTAVES: i32 = 80;

/// Width of the panels beyond it: about one period of the Bessel function.
pub(crate) const STRIDE: f64 = 5.0;

/// One point of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HankelNode {
    pub x: f64,
    /// ln x.
    pub ln_x: f64,
    /// Gauss weight times `J0(x) w(x)`.
    pub weight: f64,
}

/// Nodes of one panel.
pub(crate) const PANEL: usize = 16;

/// End of a doubling panel: `4 · 2^(−octave)`.
pub(crate) fn head_end(octave: i32) -> f64 {
    DOUBLING_END * 0.5_f64.powi(octave)
}

/// The ends of all panels from small x to large: `octaves` doubling ones, then those of one period.
pub(crate) fn panel_ends(octaves: i32) -> impl Iterator<Item = [f64; 2]> {
    let doubling = (0..octaves)
        .rev()
        .map(|octave| [head_end(octave + 1), head_end(octave)]);
    let strides = rounding::ceil((END - DOUBLING_END) / STRIDE);
    let uniform = (0..strides).map(|stride| {
        let start = DOUBLING_END + STRIDE * stride as f64;
        [start, start + STRIDE]
    });
    doubling.chain(uniform)
}

/// The rule: one panel from 0, as wide as F is smooth there, then doubling panels, then panels of one period.
#[derive(Clone, Debug)]
pub(crate) struct HankelRule {
    /// Entry j covers 0 to 4 · 2^(−j) at once.
    heads: Vec<Vec<HankelNode>>,
    /// All the other panels, from small x to large.
    nodes: Vec<HankelNode>,
    /// Sum of the weights from each of `nodes` on; the last entry is 0.
    rest: Vec<f64>,
}

static RULE: LazyLock<HankelRule> = LazyLock::new(HankelRule::new);

impl HankelRule {
    /// The rule, built once.
    pub(crate) fn shared() -> &'static Self {
        &RULE
    }

    fn new() -> Self {
        let line = legendre_of::<PANEL>();
        let nodes: Vec<HankelNode> = panel_ends(OCTAVES)
            .flat_map(|ends| panel(&line, ends))
            .collect();
        Self {
            heads: (0..=OCTAVES)
                .map(|octave| panel(&line, [0.0, head_end(octave)]))
                .collect(),
            rest: sums_to_the_end(&nodes),
            nodes,
        }
    }

    /// `∫₀^∞ F(x) J0(x) dx` and an estimate of its rounding error, for an F that is a low polynomial below
    /// `smooth_below` and 1 beyond `one_beyond`.
    pub(crate) fn integrate(
        &self,
        function: impl Fn(&HankelNode) -> f64,
        smooth_below: f64,
        one_beyond: f64,
    ) -> RoundedSum {
        let octave = rounding::ceil((DOUBLING_END / smooth_below).log2());
        let octave = octave.min(self.heads.len() - 1);
        let from = (self.heads.len() - 1 - octave) * PANEL;
        let to = self
            .nodes
            .partition_point(|node| node.x < one_beyond)
            .max(from);
        let mut sum = Sum::default();
        let mut squares = 0.0;
        for node in self.heads[octave].iter().chain(&self.nodes[from..to]) {
            let term = function(node) * node.weight;
            sum.add(term);
            squares += term * term;
        }
        sum.add(self.rest[to]);
        RoundedSum {
            value: sum.value(),
            squares,
        }
    }
}

/// A sum of independently rounded terms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RoundedSum {
    pub value: f64,
    squares: f64,
}

impl RoundedSum {
    /// A sum that was rounded once.
    pub(crate) fn exact(value: f64) -> Self {
        let squares = value * value;
        Self { value, squares }
    }

    /// Expected size of the rounding error, with an error of about ε in every term.
    pub(crate) fn rounding(&self) -> f64 {
        f64::EPSILON * self.squares.sqrt()
    }
}

/// The Gauss nodes between two ends, with the Bessel function and the taper in their weights.
fn panel(line: &[Node], [start, end]: [f64; 2]) -> Vec<HankelNode> {
    let half_width = (end - start) / 2.0;
    let node = |node: &Node| {
        let x = start + half_width * (1.0 + node.position);
        HankelNode {
            x,
            ln_x: x.ln(),
            weight: half_width * node.weight * libm::j0(x) * taper(x),
        }
    };
    line.iter().map(node).collect()
}

/// `w(x) = ½ erfc((x − X)/L)`.
fn taper(x: f64) -> f64 {
    libm::erfc((x - TAPER_CENTRE) / TAPER_WIDTH) / 2.0
}

fn sums_to_the_end(nodes: &[HankelNode]) -> Vec<f64> {
    let mut sum = Sum::default();
    let mut sums = vec![0.0];
    for node in nodes.iter().rev() {
        sum.add(node.weight);
        sums.push(sum.value());
    }
    sums.reverse();
    sums
}

#[cfg(test)]
mod tests {
    use super::HankelRule;

    /// `∫ e^{−bx} J0(x) dx = 1/√(1+b²)`.
    #[test]
    fn the_transform_of_an_exponential_is_exact_to_rounding() {
        for b in [1e-6, 1e-3, 0.1, 1.0, 10.0, 1e4] {
            let rule = HankelRule::shared();
            let found = rule.integrate(|node| (-b * node.x).exp(), 0.5 / b, f64::INFINITY);
            let expected = 1.0 / 1_f64.hypot(b);
            // Rounding of some 600 terms, the largest of them about 1.
            assert!(
                (found.value - expected).abs() < 1e-15,
                "b = {b}: {:e}",
                found.value - expected
            );
        }
    }

    /// `∫ J0(x) dx = 1`, all of it from the sums of weights.
    #[test]
    fn the_summed_weights_integrate_the_constant_part() {
        let found = HankelRule::shared().integrate(|_| 1.0, 1e-8, 1e-6);
        assert!((found.value - 1.0).abs() < 1e-15);
    }
}
