//! The coefficients split into a near part and a smooth one, and the nodes from which the smooth one is interpolated.

use crate::coefficient_table::CoefficientTable;
use crate::error::InfluenceError;

/// Distances from `R`, in elements, at which the polynomial equals the coefficient: with seven, six elements apart, the
/// kink at `R` alone causes an error twenty times as large.
const FIT_OFFSETS: [isize; 11] = [-20, -16, -12, -8, -4, 0, 4, 8, 12, 16, 20];

/// `R`, in elements.
pub(super) const RADIUS: usize = 96;
/// `h`, in elements.
pub(super) const SPACING: usize = 6;
/// `q`: with 10 the error is five times as large.
pub(super) const ORDER: usize = 12;
/// Columns of the table of near coefficients.
pub(super) const NEAR_WIDTH: usize = 2 * RADIUS - 1;

/// Points in the outer half of the table from which coefficients are extrapolated beyond it along an axis.
const POINTS: usize = 8;

/// The first node of a line of elements and the Lagrange weights of its nodes, which start at the element `origin`.
pub(super) fn weights(line: usize, origin: isize, nodes: usize) -> (usize, [f64; ORDER]) {
    let from_origin = (line.cast_signed() - origin) as f64 / SPACING as f64;
    #[expect(clippy::cast_possible_truncation, reason = "a line of a grid")]
    let cell = from_origin.floor() as isize;
    let first = cell - (ORDER / 2 - 1).cast_signed();
    let first = first
        .clamp(0, (nodes - ORDER).cast_signed())
        .cast_unsigned();
    let place = from_origin - first as f64;
    let weight = |node: usize| lagrange(ORDER, node, place);
    (first, std::array::from_fn(weight))
}

/// Lagrange weight at `place` of one of the nodes 0, 1 … `nodes` − 1.
fn lagrange(nodes: usize, node: usize, place: f64) -> f64 {
    let others = (0..nodes).filter(|other| *other != node);
    let factors = others.map(|other| (place - other as f64) / (node as f64 - other as f64));
    factors.product()
}

/// The smooth part of the coefficients.
pub(super) struct Smooth<'a> {
    table: &'a CoefficientTable,
    /// `(r/R)²` and `k` where the polynomial equals the coefficient.
    fit_points: [[f64; 2]; FIT_OFFSETS.len()],
}

impl<'a> Smooth<'a> {
    pub fn new(table: &'a CoefficientTable) -> Self {
        let fit_points = FIT_OFFSETS.map(|more| {
            let distance = RADIUS.saturating_add_signed(more);
            [scaled([distance, 0]), table.coefficient([distance, 0])]
        });
        Self { table, fit_points }
    }

    /// `P(r²)`, by Lagrange's formula.
    fn polynomial(&self, offset: [usize; 2]) -> f64 {
        let s = scaled(offset);
        let term = |(which, [own, value]): (usize, &[f64; 2])| {
            let others = self.fit_points.iter().enumerate();
            let others = others.filter(|(other, _)| *other != which);
            let factors = others.map(|(_, [other, _])| (s - other) / (own - other));
            value * factors.product::<f64>()
        };
        self.fit_points.iter().enumerate().map(term).sum()
    }

    fn coefficient(&self, offset: [usize; 2]) -> f64 {
        if is_within(offset) {
            self.polynomial(offset)
        } else {
            self.beyond([offset[0].max(offset[1]), offset[0].min(offset[1])])
        }
    }

    /// The coefficient of an offset m ≥ n that may lie beyond the table, extrapolated by polynomials through points
    /// within it. Only nodes beside the elements have such offsets, and their weights are small.
    fn beyond(&self, [m, n]: [usize; 2]) -> f64 {
        let last = self.table.size() - 1;
        if m <= last {
            return self.table.coefficient([m, n]);
        }
        let spacing = last / (2 * POINTS);
        let place = (m - last) as f64 / -(spacing as f64);
        let term = |point: usize| {
            let within = last - spacing * point;
            let offset = [within.max(n), within.min(n)];
            lagrange(POINTS, point, place) * self.beyond(offset)
        };
        (0..POINTS).map(term).sum()
    }

    /// The coefficients among nodes.
    pub fn on_nodes(&self, nodes: usize) -> Result<CoefficientTable, InfluenceError> {
        let side = SPACING as f64 * self.table.element_side();
        CoefficientTable::from_fn(side, nodes, |offset| {
            self.coefficient(offset.map(|along| SPACING * along))
        })
    }

    /// The near part: coefficients minus polynomial at the offsets within the radius.
    pub fn near(&self) -> Vec<f64> {
        let mut near = vec![0.0; RADIUS * NEAR_WIDTH];
        for (m, row) in near.chunks_exact_mut(NEAR_WIDTH).enumerate() {
            for (place, value) in row.iter_mut().enumerate() {
                let offset = [m, place.abs_diff(RADIUS - 1)];
                if is_within(offset) {
                    *value = self.table.coefficient(offset) - self.polynomial(offset);
                }
            }
        }
        near
    }
}

/// `(r/R)²` of an offset.
fn scaled([m, n]: [usize; 2]) -> f64 {
    (m * m + n * n) as f64 / (RADIUS * RADIUS) as f64
}

fn is_within([m, n]: [usize; 2]) -> bool {
    m * m + n * n < RADIUS * RADIUS
}
