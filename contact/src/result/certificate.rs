//! The proof that a pressure solves the contact problem, computed afresh from the pressure alone.
//!
//! Let `v = K p + w* + g0`, where `w*` is the shortening of the springs (`η p` if their law is linear),
//! `D = Σ p v / Σ p` or the prescribed penetration, and `g = v − D`. The lines are dimensionless:
//!
//! ```text
//! complementarity = Σ p |g| / (D Σ p)        gap_in_contact = max over p > 0 of |g| / D
//! overlap = max(0, −min g) / D               load = |4a² Σ p − Q| / Q
//! ```
//!
//! A further line is the smallest pressure, which must not be negative. Where a hardness `p_max` cuts the pressure,
//! elements at the hardness may have a negative gap but not a positive one:
//!
//! ```text
//! D = Σ p v / Σ p over p < p_max                 gap_in_contact, overlap: over p < p_max
//! gap_at_limit = max over p = p_max of g⁺ / D    over_limit = max(0, max p − p_max) = 0
//! ```
//!
//! Complementarity counts `p g⁺` of these elements. Where all pressures are 0 or `p_max`, `D` is the largest `v` of the
//! elements at the limit: the least penetration that carries the force. In a periodic cell the penetration may vanish
//! or be due to the mean displacement alone, so gaps there are relative to the largest deformation without that mean,
//! `max |K p + w* − C(0) p̄|`, and at least to a millionth of `D` and of `C(2π/L) p̄`. Nothing is taken from an
//! iteration's own residual. No gap is computed where the initial gap alone is too wide for an overlap.

mod judged_fields;
mod surface;

pub use judged_fields::JudgedFields;
use surface::{Surface, Violations, largest};

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use crate::{
    DeformedSurface, DiscreteProblem, Load,
    grid::region::Region,
    result::not_stored,
    vector::{smallest, sum},
};

/// Residuals of the complementarity problem at a pressure; all dimensionless except those in Pa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// `Σ p |g| / (D Σ p)`.
    #[serde(deserialize_with = "nan_from_null")]
    pub complementarity: f64,
    /// `max |g| / D` over the elements with `p > 0`.
    #[serde(deserialize_with = "nan_from_null")]
    pub gap_in_contact: f64,
    /// `max(0, −min g) / D` over all elements.
    #[serde(deserialize_with = "nan_from_null")]
    pub overlap: f64,
    /// `|4a² Σ p − Q| / Q`; 0 where the penetration is prescribed, since `g` is then taken from it.
    #[serde(deserialize_with = "nan_from_null")]
    pub load: f64,
    /// Smallest pressure of all elements, in Pa; must be ≥ 0.
    #[serde(deserialize_with = "nan_from_null")]
    pub min_pressure: f64,
    /// `max(0, g) / D` over the elements at the hardness; none without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_at_limit: Option<f64>,
    /// Excess of the largest pressure over the hardness, in Pa; must be 0. None without a hardness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over_limit: Option<f64>,
    /// The bound on every line; not stored, NaN if read back.
    #[serde(skip, default = "not_stored::nan")]
    pub tolerance: f64,
}

impl Certificate {
    /// The largest of the dimensionless lines; NaN if one of them is NaN.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let lines = [
            self.complementarity,
            self.gap_in_contact,
            self.overlap,
            self.load,
            self.gap_at_limit.unwrap_or(0.0),
        ];
        lines.into_iter().fold(0.0, largest)
    }

    /// Whether every line is within the tolerance and the pressure is finite, never negative and never above the
    /// hardness. False for a certificate that was read back, which has no tolerance.
    #[must_use]
    pub fn is_satisfied(&self) -> bool {
        self.worst() <= self.tolerance
            && self.min_pressure >= 0.0
            && self.min_pressure.is_finite()
            && self.over_limit.is_none_or(|excess| excess <= 0.0)
    }
}

/// A pressure with its penetration, force and certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Penetration `D`, in m.
    pub penetration: f64,
    /// Force `Q`, in N: the prescribed force, bit for bit, if there is one; otherwise `4a² Σ p`. The certificate's line
    /// `load` is the deviation of the pressures from a prescribed force.
    pub force: f64,
    /// Pressure `p` of each element, in Pa; N² values.
    pub pressure: Vec<f64>,
    /// The residuals of this solution.
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

    /// Judges `pressure` as [`Self::judge`] does, and also returns the deformed surface.
    #[must_use]
    pub fn judge_with_surface(
        problem: &mut DiscreteProblem,
        load: Load,
        pressure: Vec<f64>,
        tolerance: f64,
    ) -> (Self, DeformedSurface) {
        let everywhere = problem.region();
        let mut fields = JudgedFields::on(everywhere);
        let on_all = Trial {
            region: &everywhere,
            load,
            expected: f64::INFINITY,
            tolerance,
        };
        let solution = Self::judge_within(problem, on_all, pressure, &mut fields);
        let surface = DeformedSurface::new(
            fields.displacement,
            (&solution.pressure, problem.hardness()),
            (problem.spring_law(), problem.relief_compliance()),
            problem.initial_gap(),
            solution.penetration,
        );
        (solution, surface)
    }

    /// Judges a pressure that is zero outside a region of the grid, which makes the product cheaper. The solution's
    /// pressure covers only the region. A reach of the same size reuses the memory of the displacement.
    ///
    /// Displacements are computed on a [reach] around the region, chosen from the expected penetration, or everywhere
    /// if the true penetration is larger.
    pub(crate) fn judge_within(
        problem: &mut DiscreteProblem,
        trial: Trial<'_>,
        pressure: Vec<f64>,
        fields: &mut JudgedFields,
    ) -> Self {
        let Trial {
            region,
            load,
            expected,
            tolerance,
        } = trial;
        let total = sum(&pressure);
        let highest = judged_fields::highest(expected);
        let reach = judged_fields::around(problem, region, highest, total);
        fields.take(reach);
        (problem.support_mut()).apply_around([region, &reach], &pressure, &mut fields.displacement);
        fields.products += 1;
        let surface = Surface {
            initial_gap: problem.initial_gap(),
            compliance: problem.relief_compliance(),
            spring_law: problem.spring_law(),
            limit: problem.hardness(),
            region: region.within(&reach),
            reach,
            pressure: &pressure,
            displacement: &fields.displacement,
        };
        let penetration = match load {
            Load::Penetration(penetration) => penetration,
            Load::Force(_) => surface.multiplier(total),
        };
        // False for NaN.
        let is_as_expected = penetration <= highest;
        if !(is_as_expected || reach.is_whole()) {
            let expected = f64::INFINITY;
            return Self::judge_within(problem, Trial { expected, ..trial }, pressure, fields);
        }
        fields.penetration = penetration;
        let mean_pressure = total / problem.elements() as f64;
        let length = problem
            .gap_scale()
            .length(penetration, mean_pressure, |mean| surface.deformation(mean));
        // 4a² Σ p
        let carried = total * problem.loaded_area();
        let (force, load) = match load {
            Load::Force(wanted) => (wanted, (carried - wanted).abs() / wanted),
            Load::Penetration(_) => (carried, 0.0),
        };
        let Violations {
            complementarity,
            gap_in_contact,
            gap_at_limit,
            over_limit,
            overlap,
        } = surface.violations(penetration, length, total);
        let at_hardness = |line: f64| problem.has_hardness().then_some(line);
        let certificate = Certificate {
            complementarity,
            gap_in_contact,
            overlap,
            load,
            min_pressure: if region.is_whole() {
                smallest(&pressure)
            } else {
                smallest(&[smallest(&pressure), 0.0])
            },
            gap_at_limit: at_hardness(gap_at_limit),
            over_limit: at_hardness(over_limit),
            tolerance,
        };
        Self {
            penetration,
            force,
            pressure,
            certificate,
        }
    }
}

/// The conditions under which a pressure is judged.
#[derive(Clone, Copy)]
pub struct Trial<'a> {
    /// The region that holds all pressures.
    pub region: &'a Region,
    pub load: Load,
    /// The penetration according to the solver, in m; infinite if it gives none.
    pub expected: f64,
    pub tolerance: f64,
}

#[cfg(test)]
mod tests;
