//! The state of the iteration: a pressure, its displacement and its residual.
//!
//! Every step preserves the total pressure, once there is one. Under a prescribed total, `D` follows as `Σ p v / Σ p`.
//! Under a prescribed penetration the whole pressure is scaled after each step until that mean is `D`, which takes no
//! product since `(K + η) p = v − g0` is known:
//!
//! ```text
//! p ← c p,    v ← g0 + c (v − g0),    c = p·(D − g0) / p·(v − g0)
//! ```
//!
//! So both kinds of load take the same steps. A residual that is uniform over the contact, for which preconditioners
//! are least accurate, never occurs.

mod residual;

use std::sync::Arc;

use crate::problem::gap_scale::GapScale;
use crate::solver::gradient::load_control::LoadControl;
use crate::{
    DiscreteProblem,
    vector::{add_scaled, each, stretches::Stretches, sum, update, update_with},
};

/// The pressure is not scaled by more than this without a product, because the rounding error of `v − g0` would grow
/// with it.
const LARGEST_GROWTH: f64 = 10.0;

/// A pressure that satisfies the load control, with its `v = (K + η) p + g0` and penetration `D`, all in the units of
/// the problem's scale.
///
/// The pressure is ≥ 0, except in the inner steps of Newton's method. Elements beyond the edge of the indenter never
/// carry pressure; their `v` lacks a gap and is meaningless.
pub struct State {
    pub control: LoadControl,
    pub pressure: Vec<f64>,
    pub v: Vec<f64>,
    /// `D`.
    pub penetration: f64,
    /// `g0` of the linear problem; 0 on elements that cannot touch.
    pub initial_gap: Vec<f64>,
    /// The elements under the indenter.
    can_touch: Vec<bool>,
    /// Where elements may press: the pressure and all steps are 0 elsewhere.
    stretches: Arc<Stretches>,
    everywhere: Arc<Stretches>,
    keeps_total: bool,
    gap_scale: GapScale,
    /// `g0` of a periodic cell itself, where that of the linear problem differs; empty elsewhere.
    own_gap: Vec<f64>,
    /// `Σ p` of the elements held at a hardness, which are excluded from the problem while they are held.
    held_total: f64,
    applications: usize,
}

impl State {
    /// Creates a state with zero pressure, in the units of the problem's scale.
    pub fn new(problem: &DiscreteProblem) -> Self {
        let elements = problem.elements();
        let everywhere = Arc::new(Stretches::all(elements));
        let mut state = Self {
            control: LoadControl::Penetration(0.0),
            pressure: vec![0.0; elements],
            v: vec![0.0; elements],
            penetration: 0.0,
            initial_gap: vec![0.0; elements],
            can_touch: vec![false; elements],
            stretches: everywhere.clone(),
            everywhere,
            keeps_total: false,
            gap_scale: (problem.gap_scale()).scaled(1.0 / problem.scale().compliance),
            own_gap: Vec::new(),
            held_total: 0.0,
            applications: 0,
        };
        state.read_problem(problem);
        state
    }

    /// Reads the problem's gap and which of its elements can touch.
    fn read_problem(&mut self, problem: &DiscreteProblem) {
        self.read_gap(problem);
        let gaps = self.can_touch.iter_mut().zip(problem.initial_gap());
        gaps.for_each(|(can_touch, g0)| *can_touch = g0.is_finite());
        self.held_total = problem.held_total() / problem.scale().pressure();
        self.read_own_gap(problem);
    }

    /// Reads the gap of a cell on nonlinear springs or with a hardness, from which its deformation is measured.
    fn read_own_gap(&mut self, problem: &DiscreteProblem) {
        let differs = problem.has_hardness() || !problem.spring_law().is_linear();
        if self.gap_scale == GapScale::Penetration || !differs {
            return;
        }
        let per_length = 1.0 / problem.scale().length;
        let gaps = problem.own_gap().iter();
        self.own_gap = gaps
            .map(|g0| if g0.is_finite() { g0 * per_length } else { 0.0 })
            .collect();
    }

    /// Reads the problem's own initial gap.
    fn read_gap(&mut self, problem: &DiscreteProblem) {
        let per_length = 1.0 / problem.scale().length;
        update(&mut self.initial_gap, problem.initial_gap(), |to, g0| {
            *to = if g0.is_finite() { g0 * per_length } else { 0.0 };
        });
    }

    /// Starts from a pressure (Pa), or from a uniform one on all elements that can touch if it is zero under a force:
    /// one product.
    pub fn start(&mut self, problem: &mut DiscreteProblem, control: LoadControl, start: &[f64]) {
        (self.control, self.applications) = (control, 0);
        self.press_anywhere();
        if problem.has_hardness() {
            // The held elements may have changed.
            self.read_problem(problem);
        }
        let per_pressure = 1.0 / problem.scale().pressure();
        let (pressure, can_touch) = (&mut self.pressure, &self.can_touch);
        update_with(pressure, start, can_touch, |to, p, can_touch| {
            *to = if *can_touch {
                p.max(0.0) * per_pressure
            } else {
                0.0
            };
        });
        if matches!(control, LoadControl::Total(_)) && sum(pressure) == 0.0 {
            update(pressure, can_touch, |p, can_touch| {
                *p = f64::from(u8::from(*can_touch));
            });
        }
        control.rescale(pressure);
        problem.linearise_springs(&self.pressure);
        self.take_gap(problem);
        self.refresh(problem);
    }

    /// Reads the initial gap of the linear problem, which includes the offset of linearised springs.
    fn take_gap(&mut self, problem: &DiscreteProblem) {
        let Some(tangents) = problem.springs().tangents() else {
            return;
        };
        self.read_gap(problem);
        tangents.add_offset(problem.relief_compliance(), &mut self.initial_gap);
    }

    /// Continues with springs linearised at its pressure, for which its `v` is already right: no product, unless it is
    /// far from balanced.
    pub fn begin_on_tangents(&mut self, problem: &mut DiscreteProblem) {
        self.take_gap(problem);
        self.balance(problem);
    }

    pub fn elements(&self) -> usize {
        self.pressure.len()
    }

    /// Where elements may press.
    pub fn stretches(&self) -> &Arc<Stretches> {
        &self.stretches
    }

    /// Restricts the pressure, which must be 0 elsewhere, and the next steps to some stretches.
    pub fn press_on(&mut self, stretches: &Arc<Stretches>) {
        self.stretches = stretches.clone();
    }

    /// Allows pressure everywhere.
    pub fn press_anywhere(&mut self) {
        self.stretches = self.everywhere.clone();
    }

    /// For each element, whether the indenter is above it.
    pub fn can_touch(&self) -> &[bool] {
        &self.can_touch
    }

    /// Products with `K` so far.
    pub fn applications(&self) -> usize {
        self.applications
    }

    /// Recomputes `v = (K + η) p + g0` and balances; returns the growth as [`Self::advance`] does. One product.
    pub fn refresh(&mut self, problem: &mut DiscreteProblem) -> f64 {
        problem.deform_to_scale(&self.pressure, &mut self.v);
        self.applications += 1;
        // Scaled before the gap is added: the deformation by a far too small pressure would be lost in the gap.
        let growth = self.growth(|state| state.along_pressure(&state.v));
        if growth != 0.0 {
            (self.stretches).each(&mut self.pressure, |p| *p *= 1.0 + growth);
            each(&mut self.v, |v| *v *= 1.0 + growth);
        }
        add_scaled(&mut self.v, 1.0, &self.initial_gap);
        self.penetration = self.penetration_of(&self.v);
        growth
    }

    /// Writes `(K + η) d` into `image`: one product.
    pub fn image_into(
        &mut self,
        problem: &mut DiscreteProblem,
        direction: &[f64],
        image: &mut [f64],
    ) {
        problem.deform_to_scale(direction, image);
        self.applications += 1;
    }

    /// `p·x`.
    fn along_pressure(&self, x: &[f64]) -> f64 {
        self.stretches.dot(&self.pressure, x)
    }

    /// `D = Σ p v / Σ p` for another `v` at its pressure, the multiplier of the total; or the prescribed penetration.
    pub fn penetration_of(&self, v: &[f64]) -> f64 {
        match self.control {
            LoadControl::Total(_) => self.along_pressure(v) / self.total(),
            LoadControl::Penetration(penetration) => penetration,
        }
    }

    /// `Σ p`.
    fn total(&self) -> f64 {
        self.stretches.sum(&self.pressure)
    }

    /// Computes `μ = c − 1` from the `work` `p·(K + η) p`; 0 under a prescribed total.
    ///
    /// If no scaling of the pressure gives the penetration, it is left unchanged and its total is not preserved: there
    /// may be no contact.
    fn growth(&mut self, work: impl FnOnce(&Self) -> f64) -> f64 {
        self.keeps_total = true;
        let LoadControl::Penetration(penetration) = self.control else {
            return 0.0;
        };
        // c = p·(D − g0) / p·(K + η) p
        let reach = penetration * self.total() - self.along_pressure(&self.initial_gap);
        let scale = reach / work(self);
        self.keeps_total = scale > 0.0 && scale.is_finite();
        if self.keeps_total { scale - 1.0 } else { 0.0 }
    }

    /// `p·(K + η) p = p·(v − g0)`.
    fn work(&self) -> f64 {
        self.along_pressure(&self.v) - self.along_pressure(&self.initial_gap)
    }

    /// Makes `D` equal to the mean of `v`, by changing `D` or by scaling the pressure; returns the relative growth `μ`
    /// of the pressure. One product if that is large, else none.
    pub fn balance(&mut self, problem: &mut DiscreteProblem) -> f64 {
        let growth = self.growth(Self::work);
        if growth != 0.0 {
            (self.stretches).each(&mut self.pressure, |p| *p *= 1.0 + growth);
        }
        if growth.abs() > LARGEST_GROWTH {
            return (1.0 + growth) * (1.0 + self.refresh(problem)) - 1.0;
        }
        if growth != 0.0 {
            update(&mut self.v, &self.initial_gap, |v, g0| {
                *v += growth * (*v - g0);
            });
        }
        self.penetration = self.penetration_of(&self.v);
        growth
    }

    /// Restores an earlier pressure with its `v` and penetration. Whether steps preserve its total is determined again,
    /// since there may be no pressure left to scale.
    pub fn go_back(&mut self, pressure: &[f64], v: &[f64], penetration: f64) {
        self.pressure.copy_from_slice(pressure);
        self.v.copy_from_slice(v);
        self.penetration = penetration;
        self.growth(Self::work);
    }

    /// Makes a direction conjugate to the pressure if the pressure is scaled, so that a step along it preserves the
    /// scale: `d ← d − (d·(v − g0) / p·(v − g0)) p`.
    pub fn deflate(&self, direction: &mut [f64]) {
        if self.keeps_total && matches!(self.control, LoadControl::Penetration(_)) {
            let on = &self.stretches;
            let along = on.dot(direction, &self.v) - on.dot(direction, &self.initial_gap);
            on.add_scaled(direction, -(along / self.work()), &self.pressure);
        }
    }

    /// Whether steps preserve the total of the pressure.
    pub fn keeps_total(&self) -> bool {
        self.keeps_total
    }

    /// Scales a pressure ≥ 0 to the total that steps preserve.
    pub fn rescale(&self, pressure: &mut [f64]) {
        let total = match self.control {
            LoadControl::Total(total) => total,
            LoadControl::Penetration(_) if self.keeps_total => self.total(),
            LoadControl::Penetration(_) => return,
        };
        let factor = total / self.stretches.sum(pressure);
        self.stretches.each(pressure, |p| *p *= factor);
    }

    /// Updates `p ← p + t s`, `v ← v + t y` with `y = (K + η) s`, and balances; returns the relative growth of the
    /// pressure by balancing. No product, unless that is large.
    pub fn advance(
        &mut self,
        problem: &mut DiscreteProblem,
        t: f64,
        step: &[f64],
        image: &[f64],
    ) -> f64 {
        (self.stretches).add_scaled(&mut self.pressure, t, step);
        add_scaled(&mut self.v, t, image);
        self.balance(problem)
    }

    /// Updates `p ← max(p, 0)`, scaled to the prescribed total or balanced: one product.
    pub fn clip(&mut self, problem: &mut DiscreteProblem) {
        each(&mut self.pressure, |p| *p = p.max(0.0));
        self.control.rescale(&mut self.pressure);
        self.refresh(problem);
    }

    pub fn energy(&self) -> f64 {
        let fields = [&self.v[..], &self.initial_gap];
        self.control.energy(&self.stretches, &self.pressure, fields)
    }

    /// Sets a uniform pressure on these elements if no element presses.
    pub fn press_somewhere(&mut self, mask: &[bool]) {
        if !self.pressure.iter().any(|p| *p > 0.0) {
            update(&mut self.pressure, mask, |p, is_pressed| {
                *p = f64::from(u8::from(*is_pressed));
            });
        }
    }
}

#[cfg(test)]
mod tests;
