//! The proof that a pressure solves the contact problem, computed afresh from the pressure alone.
//!
//! With `v = K p + η p + g0` and `D = Σ p v / Σ p` (or the prescribed penetration), `g = v − D`, every line is
//! a number without scale:
//!
//! ```text
//! complementarity = Σ p |g| / (D Σ p)        gap_in_contact = max over p > 0 of |g| / D
//! overlap = max(0, −min g) / D               load = |4a² Σ p − Q| / Q
//! ```
//!
//! and the smallest pressure, which must not be negative. Nothing is taken from an iteration's own residual.

use crate::{
    DeformedSurface, DiscreteProblem, Load,
    vector::{smallest, sum, update_with},
    window::Window,
};

/// Residuals of the complementarity problem at a pressure; all dimensionless but the smallest pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// `Σ p |g| / (D Σ p)`.
    pub complementarity: f64,
    /// `max |g| / D` over the elements with `p > 0`.
    pub gap_in_contact: f64,
    /// `max(0, −min g) / D` over all elements.
    pub overlap: f64,
    /// `|4a² Σ p − Q| / Q`; 0 where the penetration is prescribed, since `g` is then taken from it.
    pub load: f64,
    /// Smallest pressure of all elements, in Pa; must be ≥ 0.
    pub min_pressure: f64,
    /// The bound on every line.
    pub tolerance: f64,
}

impl Certificate {
    /// The largest of the dimensionless lines; NaN where one of them is.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let lines = [
            self.complementarity,
            self.gap_in_contact,
            self.overlap,
            self.load,
        ];
        lines.into_iter().fold(0.0, largest)
    }

    /// Whether every line keeps to the tolerance and the pressure is finite and nowhere negative.
    #[must_use]
    pub fn is_satisfied(&self) -> bool {
        self.worst() <= self.tolerance && self.min_pressure >= 0.0 && self.min_pressure.is_finite()
    }
}

/// A pressure judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Penetration `D`, in m.
    pub penetration: f64,
    /// Force `Q = 4a² Σ p`, in N.
    pub force: f64,
    /// Pressure `p` of each element, in Pa; N² values.
    pub pressure: Vec<f64>,
    /// How well this solves the problem.
    pub certificate: Certificate,
}

impl Solution {
    /// Judges `pressure` (N² values, in Pa) by one fresh product with `K`.
    #[must_use]
    pub fn judge(
        problem: &mut DiscreteProblem,
        load: Load,
        pressure: Vec<f64>,
        tolerance: f64,
    ) -> Self {
        Self::judge_with_surface(problem, load, pressure, tolerance).0
    }

    /// The same, and the surface that was computed for it.
    #[must_use]
    pub fn judge_with_surface(
        problem: &mut DiscreteProblem,
        load: Load,
        pressure: Vec<f64>,
        tolerance: f64,
    ) -> (Self, DeformedSurface) {
        let everywhere = problem.everywhere();
        let mut fields = JudgedFields::default();
        let solution =
            Self::judge_within(problem, &everywhere, load, pressure, tolerance, &mut fields);
        let surface = DeformedSurface::new(
            fields.displacement,
            &solution.pressure,
            problem.relief_compliance(),
            problem.initial_gap(),
            solution.penetration,
        );
        (solution, surface)
    }

    /// Judges a pressure on a window of the grid, nought outside, which makes the product cheaper; the solution's pressure is that on the window. The
    /// fields' memory is used again.
    pub(crate) fn judge_within(
        problem: &mut DiscreteProblem,
        window: &Window,
        load: Load,
        pressure: Vec<f64>,
        tolerance: f64,
        fields: &mut JudgedFields,
    ) -> Self {
        let JudgedFields { displacement, gap } = fields;
        for field in [&mut *displacement, &mut *gap] {
            if field.len() != problem.elements() {
                // Memory that is first touched where it is written, by all threads.
                *field = vec![0.0; problem.elements()];
            }
        }
        problem.displace_into(window, &pressure, displacement);
        let (compliance, initial_gap) = (problem.relief_compliance(), problem.initial_gap());
        let total = sum(&pressure);
        let penetration = match load {
            Load::Penetration(penetration) => penetration,
            // D = Σ p v / Σ p
            Load::Force(_) => {
                weighted(window, &pressure, displacement, compliance, initial_gap) / total
            }
        };
        // g = K p + η p + g0 − D
        update_with(gap, displacement, initial_gap, |g, u, g0| {
            *g = u + g0 - penetration;
        });
        window.update(gap, compliance, &pressure, |g, eta, p| *g += eta * p);
        let force = total * problem.element_area();
        let certificate = Certificate {
            load: match load {
                Load::Force(wanted) => (force - wanted).abs() / wanted,
                Load::Penetration(_) => 0.0,
            },
            tolerance,
            ..residuals(window, &pressure, gap, penetration, total)
        };
        Self {
            penetration,
            force,
            pressure,
            certificate,
        }
    }
}

/// The fields of the whole grid that a pressure is judged by.
#[derive(Default)]
pub struct JudgedFields {
    displacement: Vec<f64>,
    pub gap: Vec<f64>,
}

/// `Σ p v` with `v = K p + η p + g0`, over the elements with pressure (`g0` is infinite where the indenter ends).
fn weighted(
    window: &Window,
    pressure: &[f64],
    displacement: &[f64],
    compliance: &[f64],
    initial_gap: &[f64],
) -> f64 {
    let parts = window.by_lines(pressure, |line, pressure| {
        let fields = [displacement, compliance, initial_gap].map(|field| window.line(field, line));
        let mut sum = 0.0;
        for (j, p) in pressure.iter().enumerate().filter(|(_, p)| **p != 0.0) {
            let [u, eta, g0] = fields.map(|field| field[j]);
            sum += p * (u + eta * p + g0);
        }
        sum
    });
    parts.into_iter().sum()
}

/// The lines that need no load.
fn residuals(
    window: &Window,
    pressure: &[f64],
    gap: &[f64],
    penetration: f64,
    total: f64,
) -> Certificate {
    let parts = window.by_lines(pressure, |line, pressure| {
        InContact::of(pressure, window.line(gap, line))
    });
    let found = parts.into_iter().fold(InContact::default(), InContact::and);
    let overlap = largest(0.0, -smallest(gap));
    let outside = if window.is_whole() {
        f64::INFINITY
    } else {
        0.0
    };
    // Without pressure nothing is weighed; without penetration nothing sets a scale, and only zeros pass.
    let relative = |length: f64| {
        if length == 0.0 {
            0.0
        } else {
            length / penetration.abs()
        }
    };
    Certificate {
        complementarity: if total == 0.0 {
            0.0
        } else {
            relative(found.weighted_gap / total)
        },
        gap_in_contact: relative(found.largest_gap),
        overlap: relative(overlap),
        load: 0.0,
        min_pressure: smallest(&[smallest(pressure), outside]),
        tolerance: 0.0,
    }
}

/// What the gap is where there is pressure; NaN where one of the gaps is.
#[derive(Clone, Copy, Default)]
struct InContact {
    weighted_gap: f64,
    largest_gap: f64,
}

impl InContact {
    fn of(pressure: &[f64], gap: &[f64]) -> Self {
        let mut found = Self::default();
        for (p, g) in pressure.iter().zip(gap).filter(|(p, _)| **p != 0.0) {
            found.weighted_gap += p * g.abs();
            found.largest_gap = largest(found.largest_gap, g.abs());
        }
        found
    }

    fn and(self, other: Self) -> Self {
        Self {
            weighted_gap: self.weighted_gap + other.weighted_gap,
            largest_gap: largest(self.largest_gap, other.largest_gap),
        }
    }
}

/// The larger of two, NaN if either is: `f64::max` drops NaN, which must not pass for a small number here.
fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

#[cfg(test)]
mod tests;
