//! The best admissible pressure found so far, which is returned if the solver gives up.

use crate::solver::gradient::state::State;
use crate::vector::update;

/// The pressure is copied if its residual is smaller than the best by this factor.
const WORTH_A_COPY: f64 = 0.5;

/// A pressure and its residual.
pub struct BestPressure {
    pressure: Vec<f64>,
    residual: f64,
}

impl BestPressure {
    pub fn new() -> Self {
        Self {
            pressure: Vec::new(),
            residual: f64::INFINITY,
        }
    }

    /// Forgets the kept pressure.
    pub fn restart(&mut self) {
        self.residual = f64::INFINITY;
    }

    /// Keeps the state's pressure if its residual is clearly the smallest so far.
    pub fn offer(&mut self, state: &State, residual: f64) {
        if residual < WORTH_A_COPY * self.residual {
            self.residual = residual;
            self.pressure.resize(state.elements(), 0.0);
            update(&mut self.pressure, &state.pressure, |best, p| *best = *p);
        }
    }

    /// The kept pressure; or the state's, if none is kept or if it is admissible and its residual no larger.
    pub fn or<'a>(&'a self, state: &'a State, residual: f64) -> &'a [f64] {
        let is_admissible = state.pressure.iter().all(|p| *p >= 0.0);
        let is_empty = self.residual == f64::INFINITY;
        if (is_admissible && residual <= self.residual) || is_empty {
            &state.pressure
        } else {
            &self.pressure
        }
    }
}
