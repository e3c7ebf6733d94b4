//! What a pressure makes of the surface under the indenter.

use crate::vector::{each, update, update_with};

/// The surface that a pressure deforms, and the gap that is left; N² values each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DeformedSurface {
    /// Elastic displacement `u = K p` of each element's centre, in m, positive into the body.
    pub displacement: Vec<f64>,
    /// Shortening `w* = η p` of the relief (3.3), in m.
    pub shortening: Vec<f64>,
    /// Gap `g = u + w* + g0 − D`, in m; +∞ where the indenter has no surface.
    pub gap: Vec<f64>,
}

impl DeformedSurface {
    /// With the displacement in place, `w* = η p` and, in the gap's place, `v = u + w* + g0`.
    pub(crate) fn add_up(&mut self, pressure: &[f64], compliance: &[f64], initial_gap: &[f64]) {
        for field in [&mut self.shortening, &mut self.gap] {
            field.resize(pressure.len(), 0.0);
        }
        update_with(&mut self.shortening, pressure, compliance, |w, p, eta| {
            *w = eta * p;
        });
        let (u, w) = (&self.displacement, &self.shortening);
        update_with(&mut self.gap, u, w, |v, u, w| *v = u + w);
        update(&mut self.gap, initial_gap, |v, g0| *v += g0);
    }

    /// `g = v − D`.
    pub(crate) fn lower_by(&mut self, penetration: f64) {
        each(&mut self.gap, |g| *g -= penetration);
    }
}
