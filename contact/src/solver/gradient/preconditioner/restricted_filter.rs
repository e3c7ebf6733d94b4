//! The inverse of the system on a working set, derived from that on the whole periodic grid.
//!
//! `F = F⁻¹ 1/(K̂ + η̄) F` by FFT, with `K̂` the symbol of `K` and `η̄` the mean compliance of the relief over the set;
//! restricted to the set, with a [band](super::edge_band) of elements just outside it in which the result is forced to
//! vanish. (The symbol is positive; the spectrum of the padded operator is not if a coating is stiff, and must not be
//! inverted.)
//!
//! With `X` for the band's approximate inverse of `F_EE`, the preconditioner is `F_II − F_IE X F_EI`, of which the
//! first term and `F_EI` take one application of `F`, and `F_IE` is the stencil of the band. Under a stiff coating
//! neighbouring coefficients of `F` nearly cancel, as for a plate, and an error of a tenth in `X` or `F_IE` makes this
//! negative for uniform residuals. There the band is applied a second time, to the remainder of the first:
//!
//! ```text
//! M⁻¹ = (1 − F_IE X) F (1 − X F_EI),
//! ```
//!
//! which is never negative for any linear `X`, at the cost of two more applications of `F`.
//!
//! The periodic grid is wider than a region to whose border the contact may extend: then the band lies beyond that
//! border as well, and opposite borders are no neighbours. With a fifth of a rough square in contact this saves a sixth
//! of the products.
//!
//! Where compliances `η` differ, as between elements on and beside a relief, the filter is right for short waves on one
//! kind of element and wrong on the other. With `κ = 1/F(0) − η̄`, the body's own compliance for one element, the
//! filter is scaled on both sides by a power of the ratio:
//!
//! ```text
//! M⁻¹ = S F S,    S = ((κ + η̄)/(κ + η))^¼
//! ```
//!
//! The exponent ½ would be right for short waves but is wrong for long ones; half of it takes a fifth fewer products
//! than none.

use pellicle_influence::{PeriodicFilter, PeriodicSymbol, SectorGrid};

use crate::grid::region::Region;
use crate::solver::gradient::preconditioner::edge_band::EdgeBand;
use crate::solver::gradient::working_set::WorkingSet;
use crate::vector::update;

/// Ratio of successive mean compliances for which filters are built.
const MEAN_RATIO: f64 = 1.1;

/// The restricted inverse on one grid.
pub struct RestrictedFilter {
    filter: PeriodicFilter,
    /// Rows, and elements per row, of the region.
    lengths: [usize; 2],
    /// The grid of the filter, which may be wider.
    wide: SectorGrid,
    /// Rows and columns of it before the region.
    before: [usize; 2],
    /// Response to the shortest wave: the unit of mean compliances.
    shortest: f64,
    /// `η̄` for which the filter is built; NaN before the first.
    mean_compliance: f64,
    /// `S` of each element; empty without springs, where it is 1.
    flank: Vec<f64>,
    band: EdgeBand,
    /// Whether there is a band at all.
    pub has_band: bool,
    /// Whether the band is applied twice, as under a stiff coating.
    pub is_plate: bool,
    /// The set on the wide grid, and with its band.
    set: Vec<bool>,
    both: Vec<bool>,
    /// Two fields on the wide grid, 0 between applications; the second is for a plate.
    field: Vec<f64>,
    filtered: Vec<f64>,
}

impl RestrictedFilter {
    /// Creates a filter for a region that the symbol's grid covers. It may be wider, so that the band of a contact that
    /// reaches the region's border lies on it, and opposite borders are not neighbours.
    pub fn new(symbol: PeriodicSymbol, region: &Region) -> Self {
        let shape = region.shape();
        let [rows, columns] = shape.whole_lengths();
        let wide = if symbol.lengths() == [rows, columns] {
            shape
        } else {
            shape.for_square(symbol.lengths()[0])
        };
        let (lengths, parts) = (shape.lengths(), shape.parts());
        let before = [0, 1].map(|axis: usize| {
            let beyond = wide.lengths()[axis] - lengths[axis];
            if parts[axis] == 1 { beyond / 2 } else { 0 }
        });
        Self {
            shortest: symbol.shortest(),
            filter: PeriodicFilter::new(symbol, wide),
            lengths,
            wide,
            before,
            mean_compliance: f64::NAN,
            flank: Vec::new(),
            band: EdgeBand::new(wide),
            has_band: true,
            is_plate: false,
            set: vec![false; wide.elements()],
            both: vec![false; wide.elements()],
            field: vec![0.0; wide.elements()],
            filtered: Vec::new(),
        }
    }

    /// Adapts to a set.
    pub fn update(&mut self, set: &WorkingSet, relief_compliance: &[f64]) {
        let mean = rounded(mean_over(set, relief_compliance) / self.shortest) * self.shortest;
        if mean.total_cmp(&self.mean_compliance).is_ne() {
            self.tune(mean, relief_compliance);
        }
        let [_, size] = self.lengths;
        for (i, row) in set.mask().chunks_exact(size).enumerate() {
            let first = self.on_wide([i, 0]);
            self.set[first..first + size].copy_from_slice(row);
        }
        if self.has_band {
            self.band.surround(&self.set);
        }
        self.both.copy_from_slice(&self.set);
        self.band.mark(&mut self.both);
    }

    /// The index on the wide grid of an element of the region.
    fn on_wide(&self, [i, j]: [usize; 2]) -> usize {
        (self.before[0] + i) * self.wide.size() + self.before[1] + j
    }

    /// Discards the compliances for which the filter is tuned.
    pub fn forget_compliance(&mut self) {
        self.mean_compliance = f64::NAN;
    }

    fn tune(&mut self, mean: f64, relief_compliance: &[f64]) {
        self.mean_compliance = mean;
        let multiplier = |symbol: f64| 1.0 / (symbol + mean);
        self.filter.multiply_by(multiplier);
        let coefficients = self.filter.answers(multiplier);
        self.band.take_coefficients(&coefficients);
        let both = 1.0 / coefficients[0][0];
        let own = both - mean;
        let has_springs = relief_compliance.iter().any(|eta| *eta > 0.0);
        self.flank.clear();
        if has_springs {
            self.flank.resize(relief_compliance.len(), 0.0);
            update(&mut self.flank, relief_compliance, |s, eta| {
                *s = (both / (own + eta)).sqrt().sqrt();
            });
        }
    }

    /// `r ← M⁻¹_I r`, in place, for an `r` that is 0 outside the set.
    pub fn apply(&mut self, set: &WorkingSet, residual: &mut [f64]) {
        self.flank(set, residual);
        let [_, size] = self.lengths;
        for (at, range) in set.stretches().in_rows(size) {
            let first = self.on_wide(at);
            self.field[first..first + range.len()].copy_from_slice(&residual[range]);
        }
        if self.band.is_empty() {
            self.filter.apply(&self.set, &mut self.field);
        } else if self.is_plate {
            self.filter_thrice(set);
        } else {
            self.filter.apply(&self.both, &mut self.field);
            self.band.settle(&mut self.field);
        }
        self.band.clear(&mut self.field);
        for (at, range) in set.stretches().in_rows(size) {
            let first = self.on_wide(at);
            let values = &mut self.field[first..first + range.len()];
            residual[range].copy_from_slice(values);
            values.fill(0.0);
        }
        self.flank(set, residual);
    }

    /// Applies the filter with the band, and once more to what makes the result vanish on the band.
    fn filter_thrice(&mut self, set: &WorkingSet) {
        self.filtered.resize(self.field.len(), 0.0);
        let (field, filtered) = (&mut self.field, &mut self.filtered);
        (self.filter).apply_into(field, self.band.mask(), filtered);
        self.band.balance(filtered, field);
        self.filter.apply(&self.both, field);
        self.band.clear(filtered);
        self.band.balance(field, filtered);
        self.filter.apply(&self.set, filtered);
        for (at, range) in set.stretches().in_rows(self.lengths[1]) {
            let first = self.on_wide(at);
            let within = first..first + range.len();
            let sums = self.field[within.clone()].iter_mut();
            let others = self.filtered[within].iter_mut();
            (sums.zip(others)).for_each(|(sum, value)| *sum += std::mem::take(value));
        }
        self.band.clear(&mut self.filtered);
    }

    /// `r ← S r` on the set.
    fn flank(&self, set: &WorkingSet, field: &mut [f64]) {
        if !self.flank.is_empty() {
            (set.stretches()).update(field, &self.flank, |value, s| *value *= s);
        }
    }
}

/// The nearest power of [`MEAN_RATIO`]; 0 for values negligible beside the body's own compliance of 1.
fn rounded(mean: f64) -> f64 {
    if mean < f64::EPSILON {
        0.0
    } else {
        MEAN_RATIO.powf((mean.ln() / MEAN_RATIO.ln()).round())
    }
}

/// The mean of a field over the set; 0 for an empty one.
fn mean_over(set: &WorkingSet, field: &[f64]) -> f64 {
    let sums = set.stretches().by_parts(|ranges| {
        let elements = ranges.iter().cloned().flatten();
        let members = elements.filter(|element| set.mask()[*element]);
        members.map(|element| field[element]).sum::<f64>()
    });
    sums.iter().sum::<f64>() / set.len().max(1) as f64
}

#[cfg(test)]
mod tests;
