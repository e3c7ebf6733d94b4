//! The state of the iteration: a pressure, its displacement, and its distance from a solution.
//!
//! Every step keeps the total of the pressure, once there is one. Under a prescribed total `D` follows, as
//! `Σ p v / Σ p`. Under a prescribed penetration the whole pressure is scaled after each step until that mean is `D`,
//! which takes no product since `(K + η) p = v − g0` is known:
//!
//! ```text
//! p ← c p,    v ← g0 + c (v − g0),    c = p·(D − g0) / p·(v − g0)
//! ```
//!
//! So both kinds of load take the same steps. A residual uniform over the contact, which preconditioners answer
//! worst, never comes up.

use crate::solver::gradient::load_control::LoadControl;
use crate::{
    DiscreteProblem,
    vector::{add_scaled, by_parts, dot, each, sum, update, update_with},
};

/// The pressure is not scaled by much more without a product: what rounding has left in `v − g0` would be scaled with
/// it.
const LARGEST_GROWTH: f64 = 10.0;

/// A pressure that keeps to the control, with `v = (K + η) p + g0` and the penetration `D` up to date, all in the units
/// of the problem's scale.
///
/// The pressure is ≥ 0, but for the inner steps of Newton's method. Elements beyond the indenter's end have none and
/// never will: their `v` is without a gap and means nothing.
pub struct State {
    pub control: LoadControl,
    pub pressure: Vec<f64>,
    pub v: Vec<f64>,
    /// `D`.
    pub penetration: f64,
    /// `g0` of the linear problem, 0 where nothing can touch.
    pub initial_gap: Vec<f64>,
    /// The elements of the problem: those under the indenter.
    can_touch: Vec<bool>,
    keeps_total: bool,
    /// How far a unit mean pressure would press a periodic cell in alone; 0 of a free surface.
    cell_response: f64,
    /// `Σ p` of the elements held at a hardness, which are none of the problem while they are.
    held_total: f64,
    applications: usize,
}

/// Extremes that the residual is made of.
#[derive(Clone, Copy, Default)]
struct ResidualExtremes {
    largest: f64,
    overlap: f64,
    pulls: bool,
    /// Of all pressures and `v`, to see whether one is no number.
    sum: f64,
}

impl State {
    /// Zero pressure, in the units of the problem's scale.
    pub fn new(problem: &DiscreteProblem) -> Self {
        let elements = problem.elements();
        let mut state = Self {
            control: LoadControl::Penetration(0.0),
            pressure: vec![0.0; elements],
            v: vec![0.0; elements],
            penetration: 0.0,
            initial_gap: vec![0.0; elements],
            can_touch: vec![false; elements],
            keeps_total: false,
            cell_response: problem.cell_response() / problem.scale().compliance,
            held_total: 0.0,
            applications: 0,
        };
        state.look_at(problem);
        state
    }

    /// Takes the problem's gap, and which of its elements can touch.
    fn look_at(&mut self, problem: &DiscreteProblem) {
        self.read_gap(problem);
        let gaps = self.can_touch.iter_mut().zip(problem.initial_gap());
        gaps.for_each(|(can_touch, g0)| *can_touch = g0.is_finite());
        self.held_total = problem.held_total() / problem.scale().pressure();
    }

    /// The problem's own initial gap.
    fn read_gap(&mut self, problem: &DiscreteProblem) {
        let per_length = 1.0 / problem.scale().length;
        update(&mut self.initial_gap, problem.initial_gap(), |to, g0| {
            *to = if g0.is_finite() { g0 * per_length } else { 0.0 };
        });
    }

    /// Starts from a pressure (Pa), or evenly over all that can touch where that is zero: one product.
    pub fn start(&mut self, problem: &mut DiscreteProblem, control: LoadControl, start: &[f64]) {
        (self.control, self.applications) = (control, 0);
        if problem.has_hardness() {
            // Elements held at it come and go.
            self.look_at(problem);
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
        problem.straighten_springs(&self.pressure);
        self.take_gap(problem);
        self.refresh(problem);
    }

    /// Takes the initial gap of the linear problem: of straightened springs with what they keep when let go.
    fn take_gap(&mut self, problem: &DiscreteProblem) {
        let Some(tangents) = problem.tangents() else {
            return;
        };
        self.read_gap(problem);
        tangents.add_offset(problem.relief_compliance(), &mut self.initial_gap);
    }

    /// Goes on with springs that have been straightened at its pressure, for which its `v` is right already: no
    /// product, but where that is far from balanced.
    pub fn begin_on_tangents(&mut self, problem: &mut DiscreteProblem) {
        self.take_gap(problem);
        self.balance(problem);
    }

    pub fn elements(&self) -> usize {
        self.pressure.len()
    }

    /// Of each element, whether the indenter is above it.
    pub fn can_touch(&self) -> &[bool] {
        &self.can_touch
    }

    /// Products with `K` so far.
    pub fn applications(&self) -> usize {
        self.applications
    }

    /// `v = (K + η) p + g0` afresh, and balanced; returns what [`Self::advance`] does. One product.
    pub fn refresh(&mut self, problem: &mut DiscreteProblem) -> f64 {
        problem.deform_to_scale(&self.pressure, &mut self.v);
        self.applications += 1;
        // Scaled before the gap is added, in which the deformation by a pressure far too small would be lost.
        let growth = self.growth(dot(&self.pressure, &self.v));
        if growth != 0.0 {
            for field in [&mut self.pressure, &mut self.v] {
                each(field, |value| *value *= 1.0 + growth);
            }
        }
        add_scaled(&mut self.v, 1.0, &self.initial_gap);
        self.penetration = self.control.penetration(&self.pressure, &self.v);
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

    /// `μ = c − 1` for the `work` `p·(K + η) p`; 0 under a prescribed total.
    ///
    /// A pressure that no scale would bring to the penetration is left as it is, and its total is not kept: there may
    /// be no contact.
    fn growth(&mut self, work: f64) -> f64 {
        self.keeps_total = true;
        let LoadControl::Penetration(penetration) = self.control else {
            return 0.0;
        };
        // c = p·(D − g0) / p·(K + η) p
        let reach = penetration * sum(&self.pressure) - dot(&self.pressure, &self.initial_gap);
        let scale = reach / work;
        self.keeps_total = scale > 0.0 && scale.is_finite();
        if self.keeps_total { scale - 1.0 } else { 0.0 }
    }

    /// Brings `D` and the mean of `v` together, by `D` or by the scale of the pressure; returns the part `μ` that it
    /// has grown by. One product where that is much, else none.
    pub fn balance(&mut self, problem: &mut DiscreteProblem) -> f64 {
        let gap_sum = dot(&self.pressure, &self.initial_gap);
        let growth = self.growth(dot(&self.pressure, &self.v) - gap_sum);
        if growth != 0.0 {
            each(&mut self.pressure, |p| *p *= 1.0 + growth);
        }
        if growth.abs() > LARGEST_GROWTH {
            return (1.0 + growth) * (1.0 + self.refresh(problem)) - 1.0;
        }
        if growth != 0.0 {
            update(&mut self.v, &self.initial_gap, |v, g0| {
                *v += growth * (*v - g0);
            });
        }
        self.penetration = self.control.penetration(&self.pressure, &self.v);
        growth
    }

    /// Takes a pressure that it had before, with its `v` and penetration; whether steps keep its total is found anew,
    /// since nothing to scale may be left.
    pub fn go_back(&mut self, pressure: &[f64], v: &[f64], penetration: f64) {
        self.pressure.copy_from_slice(pressure);
        self.v.copy_from_slice(v);
        self.penetration = penetration;
        self.growth(dot(pressure, v) - dot(pressure, &self.initial_gap));
    }

    /// Makes a direction conjugate to the pressure where that is scaled, so that a step along it leaves the scale
    /// right: `d ← d − (d·(v − g0) / p·(v − g0)) p`.
    pub fn deflate(&self, direction: &mut [f64]) {
        if self.keeps_total && matches!(self.control, LoadControl::Penetration(_)) {
            let along = |x: &[f64]| dot(x, &self.v) - dot(x, &self.initial_gap);
            let part = along(direction) / along(&self.pressure);
            add_scaled(direction, -part, &self.pressure);
        }
    }

    /// Whether steps are to keep the total that the pressure has.
    pub fn keeps_total(&self) -> bool {
        self.keeps_total
    }

    /// Brings a pressure ≥ 0 to the total that steps are to keep.
    pub fn rescale(&self, pressure: &mut [f64]) {
        match self.control {
            LoadControl::Penetration(_) if self.keeps_total => {
                LoadControl::Total(sum(&self.pressure)).rescale(pressure);
            }
            control => control.rescale(pressure),
        }
    }

    /// `p ← p + t s`, `v ← v + t y` with `y = (K + η) s`, and balanced; returns the part that the pressure has grown by
    /// then. No product, but where that is much.
    pub fn advance(
        &mut self,
        problem: &mut DiscreteProblem,
        t: f64,
        step: &[f64],
        image: &[f64],
    ) -> f64 {
        add_scaled(&mut self.pressure, t, step);
        add_scaled(&mut self.v, t, image);
        self.balance(problem)
    }

    /// `p ← max(p, 0)`, brought to the prescribed total or balanced: one product.
    pub fn clip(&mut self, problem: &mut DiscreteProblem) {
        each(&mut self.pressure, |p| *p = p.max(0.0));
        self.control.rescale(&mut self.pressure);
        self.refresh(problem);
    }

    pub fn energy(&self) -> f64 {
        self.control
            .energy(&self.pressure, &self.v, &self.initial_gap)
    }

    /// Where nothing presses, presses evenly on these elements.
    pub fn press_somewhere(&mut self, mask: &[bool]) {
        if !self.pressure.iter().any(|p| *p > 0.0) {
            update(&mut self.pressure, mask, |p, is_pressed| {
                *p = f64::from(u8::from(*is_pressed));
            });
        }
    }

    /// The largest line of the certificate, by the running `v`, infinite where something is no number; whether no
    /// element pulls.
    ///
    /// The complementarity is a mean of gaps in contact, so it is never the largest.
    pub fn residual(&self) -> (f64, bool) {
        self.residual_of(&self.v, self.penetration)
    }

    /// The same of another `v` and penetration at its pressure.
    pub fn residual_of(&self, v: &[f64], penetration: f64) -> (f64, bool) {
        let lines = by_parts(self.elements(), |part| self.lines(part, v, penetration));
        let lines = lines
            .into_iter()
            .fold(ResidualExtremes::default(), ResidualExtremes::and);
        let length = lines.largest.max(lines.overlap);
        // `max` drops a NaN, but in a sum it stays.
        let is_number = (lines.sum + penetration).is_finite();
        let residual = if !is_number {
            f64::INFINITY
        } else if length == 0.0 {
            0.0
        } else {
            length / self.reference_length(penetration)
        };
        (residual, !lines.pulls)
    }

    /// The length that gaps are small beside.
    pub fn reference_length(&self, penetration: f64) -> f64 {
        let mean = match self.control {
            LoadControl::Total(total) => (total + self.held_total) / self.elements() as f64,
            LoadControl::Penetration(_) => 0.0,
        };
        penetration.abs().max(self.cell_response * mean)
    }

    fn lines(&self, part: std::ops::Range<usize>, v: &[f64], penetration: f64) -> ResidualExtremes {
        let mut lines = ResidualExtremes::default();
        let fields = self.pressure[part.clone()].iter().zip(&v[part.clone()]);
        for ((p, v), _) in (fields.zip(&self.can_touch[part])).filter(|(_, can_touch)| **can_touch)
        {
            let gap = v - penetration;
            lines.overlap = lines.overlap.max(-gap);
            lines.pulls |= *p < 0.0;
            lines.sum += p + v;
            if *p > 0.0 {
                lines.largest = lines.largest.max(gap.abs());
            }
        }
        lines
    }
}

impl ResidualExtremes {
    fn and(self, other: Self) -> Self {
        Self {
            largest: self.largest.max(other.largest),
            overlap: self.overlap.max(other.overlap),
            pulls: self.pulls || other.pulls,
            sum: self.sum + other.sum,
        }
    }
}

#[cfg(test)]
mod tests;
