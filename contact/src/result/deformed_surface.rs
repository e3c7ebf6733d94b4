//! The surface under the indenter, deformed by a pressure.

use pellicle_texture::SpringLaw;

use crate::vector::{add_scaled, update, update_with};

/// The surface deformed by a pressure, and the remaining gap; N² values each.
#[derive(Debug, Clone, PartialEq)]
pub struct DeformedSurface {
    /// Elastic displacement `u = K p` of each element's centre, in m, positive into the body.
    pub displacement: Vec<f64>,
    /// Shortening `w*` of the relief, in m: `η p` (3.3) for linear springs.
    pub shortening: Vec<f64>,
    /// Gap `g = u + w* + g0 − D`, in m; +∞ where the indenter has no surface. Negative where the pressure is cut at a
    /// hardness.
    pub gap: Vec<f64>,
    /// Plastic depth `max(0, −g)` where the pressure is at the hardness, in m, 0 elsewhere: the depth by which the
    /// elastic surface overlaps the indenter. Empty without a hardness.
    pub plastic_depth: Vec<f64>,
    /// Profile `f*` after wear, in m; empty without wear, where it is that of the relief.
    pub worn_profile: Vec<f64>,
}

impl DeformedSurface {
    /// The surface displaced by a pressure at a penetration `D`, with the relief's springs of compliance `η` and the
    /// initial gap `g0`.
    pub(crate) fn new(
        displacement: Vec<f64>,
        (pressure, hardness): (&[f64], f64),
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
        let mut plastic_depth = Vec::new();
        if hardness.is_finite() {
            plastic_depth.clone_from(&gap);
            update(&mut plastic_depth, pressure, |depth, p| {
                *depth = if *p < hardness {
                    0.0
                } else {
                    (-*depth).max(0.0)
                };
            });
        }
        Self {
            displacement,
            shortening,
            gap,
            plastic_depth,
            worn_profile: Vec::new(),
        }
    }
}
