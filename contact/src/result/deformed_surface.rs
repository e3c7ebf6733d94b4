//! The surface under the indenter, deformed by a pressure.

use crate::vector::{add_scaled, update_with};

/// The surface that a pressure deforms, and the gap that is left; N² values each.
#[derive(Debug, Clone, PartialEq)]
pub struct DeformedSurface {
    /// Elastic displacement `u = K p` of each element's centre, in m, positive into the body.
    pub displacement: Vec<f64>,
    /// Shortening `w* = η p` of the relief (3.3), in m.
    pub shortening: Vec<f64>,
    /// Gap `g = u + w* + g0 − D`, in m; +∞ where the indenter has no surface.
    pub gap: Vec<f64>,
}

impl DeformedSurface {
    /// The surface displaced by a pressure at a penetration `D`, with the relief's compliance `η` and the initial gap
    /// `g0`.
    pub(crate) fn new(
        displacement: Vec<f64>,
        pressure: &[f64],
        compliance: &[f64],
        initial_gap: &[f64],
        penetration: f64,
    ) -> Self {
        let mut shortening = vec![0.0; pressure.len()];
        update_with(&mut shortening, pressure, compliance, |w, p, eta| {
            *w = eta * p;
        });
        let mut gap = vec![0.0; pressure.len()];
        update_with(&mut gap, &displacement, initial_gap, |g, u, g0| {
            *g = u + g0 - penetration;
        });
        add_scaled(&mut gap, 1.0, &shortening);
        Self {
            displacement,
            shortening,
            gap,
        }
    }
}
