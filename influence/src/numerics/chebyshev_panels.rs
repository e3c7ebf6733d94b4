//! A function of the logarithm of a positive variable, as Chebyshev panels of adaptive width.

use std::f64::consts::LN_2;

use serde::{Deserialize, Serialize};

use crate::numerics::chebyshev::{ChebyshevTransform, nodes, sum, tail};
use crate::numerics::rounding;

/// Terms of a panel's expansion.
pub(crate) const TERMS: usize = 20;

/// Levels of halving below the widest panels, which are one octave.
const DEPTH: u32 = 4;

/// Number of narrowest panels per octave.
const FINEST: usize = 1 << DEPTH;

/// Width of the narrowest panels.
const CELL: f64 = LN_2 / FINEST as f64;

/// One expansion, over `|ln x − centre| ≤ half_width`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ChebyshevPanel {
    pub centre: f64,
    pub half_width: f64,
    pub coefficients: Vec<f64>,
}

impl ChebyshevPanel {
    /// Position of ln x in the panel, −1 … 1.
    #[inline]
    pub(crate) fn position(&self, ln_x: f64) -> f64 {
        (ln_x - self.centre) / self.half_width
    }

    /// The function at ln x.
    #[inline]
    pub(crate) fn value(&self, ln_x: f64) -> f64 {
        sum(&self.coefficients, self.position(ln_x))
    }

    /// Estimate of the error of the expansion.
    pub(crate) fn tail(&self) -> f64 {
        tail(&self.coefficients)
    }

    /// Bound on the function's absolute value in the panel.
    pub(crate) fn bound(&self) -> f64 {
        self.coefficients.iter().map(|c| c.abs()).sum()
    }

    /// The points, as ln x, at which a function is sampled for this panel.
    pub(crate) fn samples(&self) -> impl Iterator<Item = f64> {
        let (centre, half_width) = (self.centre, self.half_width);
        nodes(TERMS).map(move |node| centre + half_width * node)
    }
}

/// Adjacent panels, found in constant time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ChebyshevPanels {
    start: f64,
    end: f64,
    /// Index of the panel over each cell of the finest width.
    cells: Vec<usize>,
    all: Vec<ChebyshevPanel>,
}

impl ChebyshevPanels {
    /// Fits `function(ln x)` from `start` to at least `end` (both ln x), halving panels of width ln 2 until their tail
    /// is below `allowed(largest value in the panel, ln x of its centre)` or they have the smallest width.
    pub(crate) fn fit(
        [start, end]: [f64; 2],
        function: impl Fn(f64) -> f64,
        allowed: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let count = rounding::ceil((end - start) / LN_2).max(1);
        let mut fitted = Self {
            start,
            end: start + count as f64 * LN_2,
            cells: Vec::new(),
            all: Vec::new(),
        };
        let transform = ChebyshevTransform::new(TERMS, TERMS);
        let total = count * FINEST;
        while fitted.cells.len() < total {
            let left = fitted.cells.len();
            // The widest panel that can begin here: the largest power of two that divides its position.
            let mut cells = FINEST.min(1 << left.trailing_zeros().min(DEPTH));
            let panel = loop {
                let (panel, largest) = fitted.panel(left, cells, &function, &transform);
                if cells == 1 || panel.tail() <= allowed(largest, panel.centre) {
                    break panel;
                }
                cells /= 2;
            };
            let index = fitted.all.len();
            fitted.cells.resize(left + cells, index);
            fitted.all.push(panel);
        }
        fitted
    }

    /// The panel of `cells` cells that begins at the cell `left`, and the largest value it was fitted to.
    fn panel(
        &self,
        left: usize,
        cells: usize,
        function: impl Fn(f64) -> f64,
        transform: &ChebyshevTransform,
    ) -> (ChebyshevPanel, f64) {
        let half_width = cells as f64 * CELL / 2.0;
        let mut panel = ChebyshevPanel {
            centre: self.start + left as f64 * CELL + half_width,
            half_width,
            coefficients: Vec::new(),
        };
        let values: Vec<f64> = panel.samples().map(function).collect();
        let largest = values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        panel.coefficients = transform.coefficients(&values);
        (panel, largest)
    }

    /// First and last ln x.
    pub(crate) fn range(&self) -> [f64; 2] {
        [self.start, self.end]
    }

    /// The panels from left to right.
    pub(crate) fn panels(&self) -> &[ChebyshevPanel] {
        &self.all
    }

    /// Index of the panel that contains ln x; outside the range, of the nearest one.
    #[inline]
    pub(crate) fn index(&self, ln_x: f64) -> usize {
        let cell = rounding::floor((ln_x - self.start) / CELL);
        self.cells[cell.min(self.cells.len() - 1)]
    }

    /// The function at ln x inside the range.
    #[inline]
    pub(crate) fn value(&self, ln_x: f64) -> f64 {
        self.all[self.index(ln_x)].value(ln_x)
    }
}

#[cfg(test)]
mod tests {
    use super::ChebyshevPanels;

    #[test]
    fn a_function_with_a_narrow_feature_is_approximated_everywhere() {
        let feature = |ln_x: f64| 1.0 / (1.0 + (20.0 * (ln_x - 1.0)).powi(2));
        let panels = ChebyshevPanels::fit([-3.0, 4.0], feature, |_, _| 1e-14);
        assert!(panels.panels().len() < 60);
        for i in 0..=700 {
            let ln_x = -3.0 + 0.01 * f64::from(i);
            // Ten times the allowed tail.
            assert!((panels.value(ln_x) - feature(ln_x)).abs() < 1e-13, "{ln_x}");
        }
    }
}
