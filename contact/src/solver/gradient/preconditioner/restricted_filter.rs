//! The inverse of the system on a working set, derived from that on the whole periodic grid.
//!
//! `F = F⁻¹ 1/(K̂ + η̄) F` by FFT, with `K̂` the symbol of `K` and `η̄` the mean compliance of the relief over the set;
//! restricted to the set, with a [band](super::edge_band) of elements just outside it in which the result is forced to
//! vanish. (The symbol is positive; the spectrum of the padded operator is not if a coating is stiff, and must not be
//! inverted.)
//!
//! With `X` for the band's approximate inverse of `F_EE`, the preconditioner is `F_II − F_IE X F_EI`. Under a stiff
//! coating neighbouring coefficients of `F` nearly cancel, as for a plate, and an error of a tenth in `X` makes this
//! negative for uniform residuals. There the band is applied a second time, to the remainder of the first:
//!
//! ```text
//! M⁻¹ = (1 − F_IE X) F (1 − X F_EI),
//! ```
//!
//! which is never negative for any linear `X`, at the cost of one more application of `F`.
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

use pellicle_influence::{PeriodicFilter, PeriodicSymbol};

use crate::grid::region::Region;
use crate::solver::gradient::preconditioner::edge_band::{EdgeBand, Stencil};
use crate::solver::gradient::working_set::WorkingSet;
use crate::vector::update;

/// Ratio of successive mean compliances for which filters are built.
const MEAN_RATIO: f64 = 1.1;

/// Sum of the coefficients of `F` within the band's reach, in units of the first, below which the body counts as a
/// plate: 0.11 on a homogeneous body, more under soft coatings.
const PLATE: f64 = 0.08;

/// The restricted inverse on one grid.
pub struct RestrictedFilter {
    filter: PeriodicFilter,
    /// Response to the shortest wave: the unit of mean compliances.
    shortest: f64,
    /// `η̄` for which the filter is built; NaN before the first.
    mean_compliance: f64,
    /// `S` of each element; empty without springs, where it is 1.
    flank: Vec<f64>,
    band: EdgeBand,
    /// Whether there is a band at all.
    pub has_band: bool,
    /// Whether the band is applied twice.
    is_plate: bool,
    /// The set and its band.
    both: Vec<bool>,
    /// 0 outside the band between applications.
    filtered: Vec<f64>,
}

impl RestrictedFilter {
    /// Creates a filter for a region that the symbol's grid covers.
    pub fn new(symbol: PeriodicSymbol, region: &Region) -> Self {
        let elements = region.elements();
        Self {
            shortest: symbol.shortest(),
            filter: PeriodicFilter::new(symbol, region.shape()),
            mean_compliance: f64::NAN,
            flank: Vec::new(),
            band: EdgeBand::new(region),
            has_band: true,
            is_plate: false,
            both: Vec::new(),
            filtered: vec![0.0; elements],
        }
    }

    /// Adapts to a set.
    pub fn update(&mut self, set: &WorkingSet, relief_compliance: &[f64]) {
        let mean = rounded(mean_over(set, relief_compliance) / self.shortest) * self.shortest;
        if mean.total_cmp(&self.mean_compliance).is_ne() {
            self.tune(mean, relief_compliance);
        }
        self.band.clear(&mut self.filtered);
        if self.has_band {
            self.band.surround(set);
        }
        self.both.clear();
        if self.is_plate {
            let masks = set.mask().iter().zip(self.band.mask());
            self.both
                .extend(masks.map(|(member, is_of_band)| member | is_of_band));
        }
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
        self.is_plate = sum_over_reach(&coefficients) < PLATE * coefficients[0][0];
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
        if self.band.is_empty() {
            self.filter.apply(set.mask(), residual);
        } else {
            let wanted = self.band.mask();
            self.filter.apply_into(residual, wanted, &mut self.filtered);
            self.band.balance(&self.filtered, residual);
            if self.is_plate {
                self.filter_twice(set, residual);
            } else {
                self.filter.apply(set.mask(), residual);
            }
            self.band.clear(residual);
        }
        self.flank(set, residual);
    }

    /// Applies the filter, and once more to what makes the result vanish on the band.
    fn filter_twice(&mut self, set: &WorkingSet, residual: &mut [f64]) {
        let filtered = &mut self.filtered;
        self.filter.apply(&self.both, residual);
        self.band.clear(filtered);
        self.band.balance(residual, filtered);
        self.filter.apply(set.mask(), filtered);
        let on = set.stretches();
        on.add_scaled(residual, 1.0, filtered);
        on.each(filtered, |value| *value = 0.0);
        self.band.clear(filtered);
    }

    /// `r ← S r` on the set.
    fn flank(&self, set: &WorkingSet, field: &mut [f64]) {
        if !self.flank.is_empty() {
            (set.stretches()).update(field, &self.flank, |value, s| *value *= s);
        }
    }
}

/// The sum of all coefficients within reach, including mirror images.
fn sum_over_reach(coefficients: &Stencil) -> f64 {
    let images = |offset: usize| if offset == 0 { 1.0 } else { 2.0 };
    let rows = coefficients.iter().enumerate().map(|(i, row)| {
        let terms = row.iter().enumerate().map(|(j, f)| images(j) * f);
        images(i) * terms.sum::<f64>()
    });
    rows.sum()
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
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{
        CoefficientTable, ElasticOperator, RadialTables, Sector, SectorGrid, SurfaceElasticity,
        love,
    };
    use pellicle_kernel::{Foundation, Material};

    use super::{EdgeBand, RestrictedFilter};
    use crate::solver::gradient::load_control::LoadControl;
    use crate::{
        DiscreteProblem,
        grid::region::Region,
        problem::support::choice::under,
        solver::gradient::{tests::begun, working_set::WorkingSet},
        vector::{add_scaled, dot},
    };

    const SIZE: usize = 48;

    fn surface() -> Arc<SurfaceElasticity> {
        let steel = Material::new(210e9, 0.3).unwrap();
        let table =
            CoefficientTable::from_fn(1e-6, SIZE, |offset| love::coefficient(&steel, 1e-6, offset));
        let foundation = Foundation::half_space(steel);
        Arc::new(SurfaceElasticity::new(Arc::new(table.unwrap()), foundation))
    }

    /// Pillars within a disc, with this period and radius in elements.
    fn set_of_pillars(surface: &Arc<SurfaceElasticity>, period: f64, radius: f64) -> WorkingSet {
        let inside = |e: usize| {
            let [x, y] = [e / SIZE, e % SIZE].map(|i| i as f64 - 23.5);
            let [px, py] = [x, y].map(|along| along.rem_euclid(period) - period / 2.0);
            x.hypot(y) < 19.0 && px.hypot(py) < radius
        };
        let pressure: Vec<f64> = (0..SIZE * SIZE)
            .map(|e| f64::from(u8::from(inside(e))))
            .collect();
        let gap = vec![1.0; SIZE * SIZE];
        let eta = vec![0.0; SIZE * SIZE];
        let problem = DiscreteProblem::elastic(surface.clone(), SIZE, eta, gap, 1e-12);
        let control = LoadControl::Penetration(0.0);
        begun(&mut problem.unwrap(), control, &pressure).1
    }

    /// The filter on the whole grid without springs, adapted to a set.
    fn filter_on(surface: &SurfaceElasticity, set: &WorkingSet) -> RestrictedFilter {
        let mut filter = RestrictedFilter::new(surface.symbol(SIZE), &Region::whole(SIZE));
        filter.update(set, &vec![0.0; SIZE * SIZE]);
        filter
    }

    /// The relative error of the pressure that the filter recovers from `K p` on the set.
    fn miss(filter: &mut RestrictedFilter, surface: &SurfaceElasticity, set: &WorkingSet) -> f64 {
        let mut pressure: Vec<f64> = (0..SIZE * SIZE).map(|e| (e as f64).sin()).collect();
        set.clear_outside(&mut pressure);
        let mut recovered = vec![0.0; SIZE * SIZE];
        surface.operator(SIZE).apply_into(&pressure, &mut recovered);
        set.clear_outside(&mut recovered);
        filter.apply(set, &mut recovered);
        add_scaled(&mut recovered, -1.0, &pressure);
        (dot(&recovered, &recovered) / dot(&pressure, &pressure)).sqrt()
    }

    /// The filter's result for a mirrored field on pillars on both axes, on a sector.
    fn filtered_mirror(surface: &Arc<SurfaceElasticity>, sector: SectorGrid) -> Vec<f64> {
        let cut = |field: Vec<f64>| sector.cut(&field);
        let along = |i: usize| (i as f64 - 23.5).abs();
        let mirrored = |of: &dyn Fn(f64, f64) -> f64| {
            let places = (0..SIZE * SIZE).map(|e| [along(e / SIZE), along(e % SIZE)]);
            cut(places.map(|[x, y]| of(x, y)).collect())
        };
        let pillars = mirrored(&|x, y| {
            let [px, py] = [x, y].map(|along| (along + 4.5).rem_euclid(9.0) - 4.5);
            f64::from(u8::from(x.hypot(y) < 18.0 && px.hypot(py) < 3.5))
        });
        let mut field = mirrored(&|x, y| (0.3 * x).cos() + (0.9 * y).sin());
        let zeros = vec![0.0; pillars.len()];
        let gap = vec![1.0; pillars.len()];
        let support = under(surface.clone(), Region::all_of(sector));
        let problem = DiscreteProblem::on(support, zeros.clone(), gap, 1e-12);
        let set = begun(
            &mut problem.unwrap(),
            LoadControl::Penetration(0.0),
            &pillars,
        )
        .1;
        let mut filter = RestrictedFilter::new(surface.symbol(SIZE), &Region::all_of(sector));
        filter.update(&set, &zeros);
        assert!(!filter.band.is_empty());
        set.clear_outside(&mut field);
        filter.apply(&set, &mut field);
        field
    }

    #[test]
    fn on_a_quadrant_filter_and_band_include_the_images_beyond_the_axes() {
        let surface = surface();
        let sector = SectorGrid::of_square(Sector::Quadrant, SIZE);
        let whole = sector.cut(&filtered_mirror(&surface, SectorGrid::whole(SIZE)));
        let quadrant = filtered_mirror(&surface, sector);
        let largest = whole.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
        for (one, other) in quadrant.iter().zip(&whole) {
            // Single precision, with some sums.
            assert!((one - other).abs() < 1e-4 * largest, "{one} {other}");
        }
    }

    /// A coating two and a half elements thick, ten times as stiff as its base.
    fn plate() -> Arc<SurfaceElasticity> {
        let [coating, base] = [1e9, 1e8].map(|modulus| Material::new(modulus, 0.3).unwrap());
        let foundation = Foundation::coated(2.5e-6, coating, base).unwrap();
        let tables = RadialTables::build(&foundation).unwrap();
        let table = CoefficientTable::assemble(&tables, 1e-6, SIZE).unwrap();
        Arc::new(SurfaceElasticity::new(Arc::new(table), foundation))
    }

    #[test]
    fn under_a_stiff_coating_the_filter_with_the_band_is_positive() {
        let surface = plate();
        let set = set_of_pillars(&surface, 7.0, 2.2);
        let mut filter = filter_on(&surface, &set);
        assert!(filter.is_plate);
        let work = |filter: &mut RestrictedFilter, wavenumber: f64| {
            let wave = |e: usize| (wavenumber * (e / SIZE) as f64).cos();
            let mut residual: Vec<f64> = (0..SIZE * SIZE).map(wave).collect();
            set.clear_outside(&mut residual);
            let mut filtered = residual.clone();
            filter.apply(&set, &mut filtered);
            dot(&residual, &filtered) / dot(&residual, &residual)
        };
        let waves = (0..16).map(|k| 0.2 * f64::from(k));
        for wavenumber in waves {
            let twice = work(&mut filter, wavenumber);
            assert!(twice > 0.0, "{wavenumber}: {twice}");
        }
        filter.is_plate = false;
        assert!(work(&mut filter, 0.0) < 0.0, "once is not enough");
    }

    #[test]
    fn with_the_band_the_filter_nearly_inverts_the_system_on_separate_pillars() {
        let surface = surface();
        let set = set_of_pillars(&surface, 9.0, 3.5);
        let mut filter = filter_on(&surface, &set);
        let with_band = miss(&mut filter, &surface, &set);
        filter.band = EdgeBand::new(&Region::whole(SIZE));
        let without = miss(&mut filter, &surface, &set);
        assert!(
            with_band < 0.03 && without > 0.08,
            "{with_band} and {without}"
        );
    }
}
