//! The preconditioner: an approximate inverse of the system on the working set.
//!
//! There are two, chosen by these rules:
//!
//! - The [restricted filter](self::restricted_filter), by FFT, where the body responds to short waves much as to long
//!   ones.
//! - The [factorised sparse approximate inverse](self::sparse_factor) of the restricted system itself under a coating
//!   so stiff that the contact breaks up into rings and edges ([`STIFF`]), or into the summits of a rough surface
//!   ([`STIFF_IF_ROUGH`]). The number of neighbours grows with the stiffness and the grid ([`neighbours`]).
//! - The filter, up to a stiffer coating, where a rough surface has springs that affect its shortest waves
//!   ([`STIFF_IF_SPRINGY`]): it treats uniform springs exactly, and the factor is worse with them than without.
//! - The factor also where springs stiffen, by orders of magnitude from the edge of the contact to its middle: for the
//!   load of the paper's Fig. 5 the filter takes three times the products, in the same time.
//! - The factor among the [candidates](crate::grid::candidates) of a dilute contact, where an FFT on the whole grid
//!   would cost more than everything else.

mod edge_band;
mod inverse;
mod restricted_filter;
mod sparse_factor;

use pellicle_influence::PeriodicSymbol;

use crate::solver::gradient::preconditioner::edge_band::ROOM;
use crate::solver::gradient::preconditioner::inverse::Inverse;
use crate::solver::gradient::preconditioner::restricted_filter::RestrictedFilter;
use crate::solver::gradient::preconditioner::sparse_factor::{
    SparseFactor, scattered::ScatteredFactor,
};
use crate::solver::gradient::state::State;
use crate::solver::gradient::working_set::WorkingSet;
use crate::{
    DiscreteProblem, Shortcuts,
    vector::{stretches::SparseField, sum},
};

/// Stiffness contrast above which a coating counts as stiff. Under a coating ten times as stiff as its base, the filter
/// takes as many products as the factor, in less time.
const STIFF: f64 = 20.0;
/// The same for a rough surface: under a coating of contrast 2.9 the filter takes 50 products at N = 1024, the factor
/// 31 in the same time; under one of 1.9 the filter takes 34, in half the time.
const STIFF_IF_ROUGH: f64 = 2.5;
/// The same with springs: under a coating of contrast 7 the filter takes 45 products, the factor 28 in less time; under
/// one of 6.6 the filter takes 39 instead of 36, in two thirds of the time.
const STIFF_IF_SPRINGY: f64 = 6.75;
/// Contrast above which Newton's method also comes first with the filter, for a relief of springs; with the factor it
/// always does. Pillars under a coating of 9 take a fifth fewer products than with the fast steps, a bare coating a
/// fifth more. With a threshold of 3, Fig. 2d would take 30 instead of 19 at N = 1024.
const STIFF_FOR_NEWTON: f64 = 7.0;
/// Contrast above which the filter applies its band twice: applied once, it takes 42 products for a rough film under a
/// coating of 5, twice up to 40. From 1.5 to 5 the work of rough films and coatings is the same within 5 %.
const PLATE: f64 = 2.5;
/// Mean compliance of springs above which they matter, in units of the elastic compliance of one element.
const SPRINGY: f64 = 0.05;
/// Stiffness contrast above which the factor needs more neighbours to stay below 40 products at N = 512.
const VERY_STIFF: f64 = 400.0;
/// `k` times the symbol at the shortest wave along one side, relative to the longest, on a homogeneous body: `2/π` and
/// its aliases.
const SHORTEST_RESPONSE: f64 = 1.166;
/// Neighbours of a tile in the sparse factor up to [`COARSE`] elements per side: 30 take an eighth more products in the
/// same time, 60 a tenth fewer in a third more time.
const NEIGHBOURS: u32 = 42;
/// The same under a very stiff coating.
const MORE_NEIGHBOURS: u32 = 60;
/// Elements per side above which neighbours grow with the grid: a factor of fixed neighbours loses accuracy with every
/// halving of the element.
const COARSE: usize = 512;
/// Exponent of the grid's size in the growth of neighbours: in proportion to the size, rough films take up to 41
/// products at N = 1024 instead of 35, in a sixth less time.
const GROWTH: f64 = 4.0 / 3.0;
/// The same up to [`STIFF_FOR_GROWTH`]: rough films under a coating ten times as stiff take up to 37 products, with
/// [`GROWTH`] 36 in a tenth more time, in proportion 41.
const SLOW_GROWTH: f64 = 1.15;
/// Contrast above which neighbours grow faster.
const STIFF_FOR_GROWTH: f64 = 9.4;
/// Most neighbours of a tile, beyond which time grows faster than products fall.
const MOST_NEIGHBOURS: u32 = 108;
/// Neighbours of a candidate in the factor among candidates: 20 take a third more products, 40 a sixth fewer at twice
/// the cost.
const NEIGHBOURS_OF_CANDIDATE: usize = 30;
/// Smallest side whose spectrum distinguishes stiff from soft.
const SMALLEST_SPECTRUM: usize = 8;

/// An approximate inverse and its result for a uniform residual.
pub struct Preconditioner {
    inverse: Inverse,
    /// Factor from the units of the problem's scale to those of the inverse; results are in the units of the scale.
    unit: f64,
    /// The inverse with which every load begins, if it has been replaced.
    usual: Option<Inverse>,
    uniform: UniformResponse,
    /// The revision of the set for which the inverse is prepared.
    adapted_to: Option<u64>,
    /// Neighbours of a tile or candidate in the sparse factor.
    neighbours: usize,
    /// Whether the coating is so stiff that Newton's method comes first.
    is_for_newton: bool,
    /// Whether it is a filter on a rough surface.
    is_on_islands: bool,
    shortcuts: Shortcuts,
}

/// `w = M⁻¹_I 1` on the set for which it was computed, restricted to each later set.
struct UniformResponse {
    values: SparseField,
    total: f64,
    /// The total on the set for which it was computed, and the revision of that set.
    exact_total: f64,
    exact_on: Option<u64>,
}

/// The accuracy of the uniform response that a direction needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UniformAccuracy {
    /// That of the current set. Restricted, it would cost Newton's method a sixth more products.
    Exact,
    /// Restricted from an earlier set, if that had at most twice its total: this saves steps that change the set an
    /// application of the inverse each and costs no product.
    Restricted,
}

impl Preconditioner {
    pub fn new(problem: &DiscreteProblem, shortcuts: Shortcuts) -> Self {
        let symbol = problem.support().symbol(0);
        let contrast = symbol.as_ref().map_or(1.0, stiffness_contrast);
        let is_stiff = contrast > stiff(problem);
        let has_springs = problem.springs().compliance().iter().any(|c| *c > 0.0);
        let neighbours = match symbol {
            Some(_) => neighbours(problem.region().grid_size(), contrast),
            None => NEIGHBOURS_OF_CANDIDATE,
        };
        let mut is_on_islands = false;
        let inverse = match symbol {
            None if !shortcuts.sparse_factor => Inverse::Identity,
            None => factor(problem, neighbours).unwrap_or(Inverse::Identity),
            Some(_)
                if shortcuts.sparse_factor && (is_stiff || !problem.spring_law().is_linear()) =>
            {
                factor(problem, neighbours).unwrap_or(Inverse::Identity)
            }
            Some(symbol) => {
                // Islands of a rough surface may end at the border of the domain.
                is_on_islands = contrast < STIFF_FOR_NEWTON && problem.is_rough();
                let wider = is_on_islands.then(|| problem.support().symbol(ROOM));
                let symbol = wider.flatten().unwrap_or(symbol);
                let mut filter = RestrictedFilter::new(symbol, &problem.region());
                filter.has_band = shortcuts.edge_band;
                filter.is_plate = contrast > PLATE;
                Inverse::Filter(Box::new(filter))
            }
        };
        let unit = match inverse {
            Inverse::Identity => 1.0,
            _ => problem.scale().compliance,
        };
        Self {
            inverse,
            unit,
            usual: None,
            uniform: UniformResponse {
                values: SparseField::new(problem.elements()),
                total: 0.0,
                exact_total: 0.0,
                exact_on: None,
            },
            adapted_to: None,
            neighbours,
            is_on_islands,
            is_for_newton: is_stiff || contrast > STIFF_FOR_NEWTON && has_springs,
            shortcuts,
        }
    }

    /// Whether Newton's method should come first: it finds the set in five to nine exchanges, where the fast steps take
    /// as many products for each halving of the set.
    pub fn is_for_newton(&self) -> bool {
        self.is_for_newton
    }

    /// Fast steps that are cut in succession where they creep along an edge of the contact. With a filter on the many
    /// edges of a rough surface one is cut where it was too long.
    pub fn most_cuts(&self) -> usize {
        if self.is_on_islands { 2 } else { 1 }
    }

    /// Whether the preconditioner knows the operator.
    pub fn knows_operator(&self) -> bool {
        !matches!(self.inverse, Inverse::Identity)
    }

    /// Prepares for Newton's method after `failures` failures on this load. A filter is replaced by the sparse factor
    /// after its first failure; the factor gets more neighbours with each failure. Returns false if the operator is
    /// unknown.
    pub fn prepare_for_newton(&mut self, problem: &DiscreteProblem, failures: usize) -> bool {
        match (self.usual.as_ref().unwrap_or(&self.inverse), failures) {
            (Inverse::Identity, _) => false,
            (Inverse::Filter(_), 0) => true,
            (Inverse::Filter(_), _) => self.turn_to_factor(problem, failures),
            (Inverse::Factor(_) | Inverse::Scattered(_), _) => {
                self.turn_to_factor(problem, 1 + failures)
            }
        }
    }

    /// Switches to the sparse factor, with `times` its usual neighbours; returns false if the operator is unknown.
    pub fn turn_to_factor(&mut self, problem: &DiscreteProblem, times: usize) -> bool {
        let is_on = self.shortcuts.sparse_factor;
        let inverse = is_on.then(|| factor(problem, times * self.neighbours));
        match inverse.flatten() {
            None => false,
            Some(inverse) => {
                let is_one = matches!(self.inverse, Inverse::Factor(_) | Inverse::Scattered(_));
                if times > 1 || !is_one {
                    let before = std::mem::replace(&mut self.inverse, inverse);
                    self.usual.get_or_insert(before);
                    self.adapted_to = None;
                }
                true
            }
        }
    }

    /// Begins a load, independently of the previous one.
    pub fn begin(&mut self) {
        if let Some(usual) = self.usual.take() {
            self.inverse = usual;
        }
        self.restart();
    }

    /// Discards what depends on earlier sets.
    pub fn restart(&mut self) {
        self.adapted_to = None;
    }

    /// Adapts to a new linearisation of the springs.
    pub fn follow_springs(&mut self, problem: &DiscreteProblem) {
        for inverse in self.usual.iter_mut().chain([&mut self.inverse]) {
            match inverse {
                Inverse::Identity => (),
                Inverse::Filter(filter) => filter.forget_compliance(),
                Inverse::Factor(factor) => factor.take_compliance(problem.springs().compliance()),
                Inverse::Scattered(factor) => {
                    factor.take_compliance(problem.springs().compliance());
                }
            }
        }
        self.restart();
    }

    /// Adapts to a set that has changed since the last direction.
    pub fn follow(&mut self, problem: &DiscreteProblem, set: &WorkingSet) {
        if self.adapted_to == Some(set.revision()) {
            return;
        }
        match &mut self.inverse {
            Inverse::Identity => (),
            Inverse::Filter(filter) => filter.update(set, problem.springs().compliance()),
            Inverse::Factor(factor) => factor.update(problem.support(), set),
            Inverse::Scattered(factor) => factor.update(set),
        }
        if self.adapted_to.is_none() {
            self.uniform.values.each(|w| *w = 0.0);
            self.uniform.exact_on = None;
        }
        self.adapted_to = Some(set.revision());
        self.uniform.values.restrict(set.mask());
        self.uniform.total = self.uniform.values.sum();
    }

    fn refresh(&mut self, problem: &DiscreteProblem, set: &WorkingSet, accuracy: UniformAccuracy) {
        self.follow(problem, set);
        let UniformResponse {
            total,
            exact_total,
            exact_on,
            ..
        } = self.uniform;
        let serves = match accuracy {
            UniformAccuracy::Exact => exact_on == Some(set.revision()),
            UniformAccuracy::Restricted => total > (exact_total / 2.0).max(0.0),
        };
        if !serves {
            let on = set.stretches();
            let uniform = &mut self.uniform;
            let values = uniform.values.on(on);
            on.each(values, |w| *w = 1.0);
            self.inverse.apply(set, self.unit, values);
            let total = uniform.values.sum();
            (uniform.total, uniform.exact_total) = (total, total);
            uniform.exact_on = Some(set.revision());
        }
    }

    /// `r ← M⁻¹_I r`, in place and in the units of the problem's scale; values of `r` outside the set are ignored.
    pub fn apply(&mut self, set: &WorkingSet, residual: &mut [f64]) {
        set.clear_outside(residual);
        self.inverse.apply(set, self.unit, residual);
    }

    /// Writes into `z` the preconditioned residual `M⁻¹_I (λ − v)`, with `λ` such that `z` preserves the total: the
    /// projection `z ← z − (Σz/Σw) w`. Returns `λ`, which is the penetration if there is no total to preserve.
    pub fn direction_into(
        &mut self,
        problem: &DiscreteProblem,
        state: &State,
        set: &WorkingSet,
        accuracy: UniformAccuracy,
        z: &mut SparseField,
    ) -> f64 {
        self.refresh(problem, set, accuracy);
        let on = set.stretches();
        let z = z.on(on);
        on.update(z, &state.v, |z, v| *z = state.penetration - v);
        self.inverse.apply(set, self.unit, z);
        if !state.keeps_total() {
            return state.penetration;
        }
        let shift = on.sum(z) / self.uniform.total;
        on.update(z, &self.uniform.values, |z, w| *z -= shift * w);
        state.penetration - shift
    }

    /// `w = M⁻¹_I 1` as used in the last direction.
    pub fn uniform(&self) -> &SparseField {
        &self.uniform.values
    }
}

/// Neighbours of a tile in the sparse factor on a grid of `size` elements per side.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "between the least and the most"
)]
fn neighbours(size: usize, contrast: f64) -> usize {
    let on_coarse = if contrast > VERY_STIFF {
        MORE_NEIGHBOURS
    } else {
        NEIGHBOURS
    };
    let growth = if contrast > STIFF_FOR_GROWTH {
        GROWTH
    } else {
        SLOW_GROWTH
    };
    let finer = size.max(COARSE) as f64 / COARSE as f64;
    let wanted = f64::from(on_coarse) * finer.powf(growth);
    wanted.min(f64::from(MOST_NEIGHBOURS)) as usize
}

/// Stiffness contrast above which the factor is better for a problem.
fn stiff(problem: &DiscreteProblem) -> f64 {
    match (problem.is_rough(), is_springy(problem)) {
        (false, _) => STIFF,
        (true, false) => STIFF_IF_ROUGH,
        (true, true) => STIFF_IF_SPRINGY,
    }
}

/// Whether the relief has springs that affect short waves.
fn is_springy(problem: &DiscreteProblem) -> bool {
    let Some(elasticity) = problem.elasticity() else {
        return false;
    };
    let mean = sum(problem.springs().compliance()) / problem.elements() as f64;
    mean > SPRINGY * elasticity.coefficient([0, 0])
}

fn factor(problem: &DiscreteProblem, neighbours: usize) -> Option<Inverse> {
    let elasticity = problem.elasticity()?.clone();
    let compliance = problem.springs().compliance();
    if let Some(candidates) = problem.support().candidates() {
        let factor = ScatteredFactor::new(elasticity, candidates.clone(), compliance, neighbours);
        return Some(Inverse::Scattered(Box::new(factor)));
    }
    let factor = SparseFactor::new(elasticity, &problem.region(), compliance, neighbours);
    Some(Inverse::Factor(Box::new(factor)))
}

/// The response to the longest wave over that to the shortest: the ratio of the compliances that they meet.
fn stiffness_contrast(symbol: &PeriodicSymbol) -> f64 {
    let [x, y] = symbol.lengths();
    let size = x.max(y);
    if size < SMALLEST_SPECTRUM {
        return 1.0;
    }
    let response = |frequency: usize| frequency as f64 * symbol.along_longer(frequency);
    response(1) * SHORTEST_RESPONSE / response(size / 2)
}

/// `r = D − v` on the set, 0 outside.
pub fn residual_into(state: &State, set: &WorkingSet, residual: &mut SparseField) {
    let on = set.stretches();
    on.update_with(residual.on(on), &state.v, set.mask(), |r, v, member| {
        *r = if *member { state.penetration - v } else { 0.0 };
    });
}

#[cfg(test)]
mod tests;
