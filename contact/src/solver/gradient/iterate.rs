//! The state of the iteration: a pressure, what it deforms, and how far it is from a solution.

use super::{
    super::Iterate,
    control::Control,
    vector::{add_scaled, sum},
};
use crate::DiscreteProblem;

/// Stands for an infinite initial gap: finite, so that `0 · g0` stays 0, and beyond any displacement.
const NEVER: f64 = 1e300;

/// A pressure `p ≥ 0` that keeps to the control, with `v = (K + η) p + g0` and the penetration `D` up to date.
pub struct State {
    pub control: Control,
    pub pressure: Vec<f64>,
    /// `v`, in m.
    pub v: Vec<f64>,
    /// `D`, in m.
    pub penetration: f64,
    pub initial_gap: Vec<f64>,
    applications: usize,
}

impl State {
    /// Starts from a pressure, or evenly over all that can touch where that is zero: one product.
    pub fn start(problem: &mut DiscreteProblem, control: Control, start: &[f64]) -> Self {
        let initial_gap: Vec<f64> = problem
            .initial_gap()
            .iter()
            .map(|g0| g0.min(NEVER))
            .collect();
        let admit = |p: f64, g0: f64| if g0 < NEVER { p.max(0.0) } else { 0.0 };
        let mut pressure: Vec<f64> = start
            .iter()
            .zip(&initial_gap)
            .map(|(p, g0)| admit(*p, *g0))
            .collect();
        if matches!(control, Control::Total(_)) && sum(&pressure) == 0.0 {
            pressure
                .iter_mut()
                .zip(&initial_gap)
                .for_each(|(p, g0)| *p = admit(1.0, *g0));
        }
        control.rescale(&mut pressure);
        let v = vec![0.0; pressure.len()];
        let mut state = Self {
            control,
            pressure,
            v,
            penetration: 0.0,
            initial_gap,
            applications: 0,
        };
        state.refresh(problem);
        state
    }

    pub fn elements(&self) -> usize {
        self.pressure.len()
    }

    /// Products with `K` so far.
    pub fn applications(&self) -> usize {
        self.applications
    }

    /// `v = (K + η) p + g0` and `D` afresh: one product.
    pub fn refresh(&mut self, problem: &mut DiscreteProblem) {
        problem.deform_into(&self.pressure, &mut self.v);
        self.applications += 1;
        add_scaled(&mut self.v, 1.0, &self.initial_gap);
        self.update_penetration();
    }

    /// Writes `(K + η) d` into `image`: one product.
    pub fn image_into(
        &mut self,
        problem: &mut DiscreteProblem,
        direction: &[f64],
        image: &mut [f64],
    ) {
        problem.deform_into(direction, image);
        self.applications += 1;
    }

    /// `D` from the present pressure and `v`.
    pub fn update_penetration(&mut self) {
        self.penetration = self.control.penetration(&self.pressure, &self.v);
    }

    /// `p ← p + t s`, `v ← v + t y` with `y = (K + η) s`: no product.
    pub fn advance(&mut self, t: f64, step: &[f64], image: &[f64]) {
        add_scaled(&mut self.pressure, t, step);
        add_scaled(&mut self.v, t, image);
        self.update_penetration();
    }

    pub fn energy(&self) -> f64 {
        self.control
            .energy(&self.pressure, &self.v, &self.initial_gap)
    }

    /// The largest line of the certificate, by the running `v`.
    pub fn residual(&self) -> f64 {
        let (mut weighted, mut largest, mut overlap) = (0.0, 0.0_f64, 0.0_f64);
        for (p, v) in self.pressure.iter().zip(&self.v) {
            let gap = v - self.penetration;
            overlap = overlap.max(-gap);
            if *p > 0.0 {
                weighted += p * gap.abs();
                largest = largest.max(gap.abs());
            }
        }
        let total = sum(&self.pressure);
        let complementarity = if total > 0.0 { weighted / total } else { 0.0 };
        let length = complementarity.max(largest).max(overlap);
        if length == 0.0 {
            0.0
        } else {
            length / self.penetration.abs()
        }
    }

    pub fn into_iterate(self, residuals: Vec<f64>) -> Iterate {
        Iterate {
            iterations: residuals.len() - 1,
            operator_applications: self.applications,
            pressure: self.pressure,
            residuals,
        }
    }
}
