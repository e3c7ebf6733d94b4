//! The surface under the indenter, deformed by a pressure.

use pellicle_texture::SpringLaw;

use crate::vector::{add_scaled, update_with};

/// The surface that a pressure deforms, and the gap that is left; N² values each.
#[derive(Debug, Clone, PartialEq)]
pub struct DeformedSurface {
    /// Elastic displacement `u = K p` of each element's centre, in m, positive into the body.
    pub displacement: Vec<f64>,
    /// Shortening `w*` of the relief, in m: `η p` (3.3) of linear springs.
    pub shortening: Vec<f64>,
    /// Gap `g = u + w* + g0 − D`, in m; +∞ where the indenter has no surface.
    pub gap: Vec<f64>,
}

impl DeformedSurface {
    /// The surface displaced by a pressure at a penetration `D`, with the relief's springs of compliance `η` and the
    /// initial gap `g0`.
    pub(crate) fn new(
        displacement: Vec<f64>,
        pressure: &[f64],
        (law, compliance): (SpringLaw, &[f64]),
        initial_gap: &[f64],
        penetration: f64,
    ) -> Self {
        let mut shortening = vec![0.0; pressure.len()];
        update_with(&mut shortening, pressure, compliance, |w, p, eta| {
            *w = law.shortening(*eta, *p);
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
