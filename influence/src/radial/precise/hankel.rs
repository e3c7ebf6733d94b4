//! The rule of [`crate::radial::hankel`] in 32 digits.

use std::sync::LazyLock;

use super::bessel::{erfc, j0};
use super::twofold::Twofold;
use crate::numerics::quadrature::{Node, legendre_of};
use crate::numerics::rounding;
use crate::radial::hankel::{DOUBLING_END, PANEL, TAPER_CENTRE, TAPER_WIDTH, head_end, panel_ends};

/// Doubling panels go down to 4 · 2⁻²⁰, for radii beyond the smallest wavelengths of Φ.
const OCTAVES: i32 = 20;

/// Used instead where the largest wavelength of Φ is far beyond these: panels down to 4 · 2⁻⁸⁰.
const DEEP_OCTAVES: i32 = 80;

/// One point of the rule.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreciseNode {
    pub x: Twofold,
    pub ln_x: Twofold,
    /// Gauss weight times `J0(x) w(x)`.
    pub weight: Twofold,
}

/// The rule: one panel from 0, then doubling panels, then panels of one period.
#[derive(Debug)]
pub(crate) struct PreciseRule {
    /// Entry j covers 0 to 4 · 2^(−j) at once.
    heads: Vec<Vec<PreciseNode>>,
    /// All the other panels, from small x to large.
    nodes: Vec<PreciseNode>,
}

static RULE: LazyLock<PreciseRule> = LazyLock::new(|| PreciseRule::new(OCTAVES));

static DEEP_RULE: LazyLock<PreciseRule> = LazyLock::new(|| PreciseRule::new(DEEP_OCTAVES));

impl PreciseRule {
    /// The rule for a function that is a low polynomial below `smooth_below`; built once.
    pub(crate) fn shared(smooth_below: f64) -> &'static Self {
        if smooth_below < head_end(OCTAVES) {
            &DEEP_RULE
        } else {
            &RULE
        }
    }

    fn new(octaves: i32) -> Self {
        let panels: Vec<[f64; 2]> = panel_ends(octaves).collect();
        let line: Vec<(Twofold, Twofold)> = legendre_of::<PANEL>().iter().map(refined).collect();
        Self {
            heads: (0..=octaves)
                .map(|octave| panel(&line, [0.0, head_end(octave)]))
                .collect(),
            nodes: panels.iter().flat_map(|ends| panel(&line, *ends)).collect(),
        }
    }

    /// The nodes of the rule for a function that is a low polynomial below `smooth_below`.
    pub(crate) fn nodes(&self, smooth_below: f64) -> impl Iterator<Item = &PreciseNode> {
        let octave = rounding::ceil((DOUBLING_END / smooth_below).log2());
        let octave = octave.min(self.heads.len() - 1);
        let from = (self.heads.len() - 1 - octave) * PANEL;
        self.heads[octave].iter().chain(&self.nodes[from..])
    }
}

/// Position and weight of a Gauss–Legendre node in 32 digits, by Newton's method from 16 digits.
fn refined(node: &Node) -> (Twofold, Twofold) {
    let mut x = Twofold::from(node.position);
    let mut slope = Twofold::ONE;
    for _ in 0..2 {
        let (value, derivative) = legendre_polynomial(x);
        x = x - value / derivative;
        slope = derivative;
    }
    // w = 2/((1−x²) P'²)
    (
        x,
        Twofold::from(2.0) / ((Twofold::ONE - x * x) * slope * slope),
    )
}

/// `P_n` and its derivative, n = [`PANEL`].
fn legendre_polynomial(x: Twofold) -> (Twofold, Twofold) {
    let (mut before, mut current) = (Twofold::ONE, x);
    for n in 2..=PANEL {
        let n = n as f64;
        // n P_n = (2n−1) x P_(n−1) − (n−1) P_(n−2)
        let next = x * current * Twofold::from(2.0 * n - 1.0) - before * Twofold::from(n - 1.0);
        (before, current) = (current, next / Twofold::from(n));
    }
    // P_n' = n (x P_n − P_(n−1))/(x²−1)
    let degree = Twofold::from(PANEL as f64);
    let derivative = degree * (x * current - before) / (x * x - Twofold::ONE);
    (current, derivative)
}

fn panel(line: &[(Twofold, Twofold)], [start, end]: [f64; 2]) -> Vec<PreciseNode> {
    let half_width = Twofold::from((end - start) / 2.0);
    let node = |(position, weight): &(Twofold, Twofold)| {
        let x = Twofold::from(start) + half_width * (Twofold::ONE + *position);
        let taper =
            erfc((x - Twofold::from(TAPER_CENTRE)) / Twofold::from(TAPER_WIDTH)).scaled(0.5);
        PreciseNode {
            x,
            ln_x: x.ln(),
            weight: half_width * *weight * j0(x) * taper,
        }
    };
    line.iter().map(node).collect()
}
