//! A relief as a solver sees it: three fields on a grid.

use rayon::prelude::*;

/// The relief at the centres of a grid's elements: mask, surface profile and compliance, N² values each, index `i * N + j`.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledRelief {
    mask: Vec<bool>,
    profile: Vec<f64>,
    compliance: Vec<f64>,
}

impl SampledRelief {
    /// Gathers mask, `f*` and η of `size` × `size` elements, row by row in parallel.
    pub(crate) fn collect(
        size: usize,
        at: impl Fn(usize, usize) -> (bool, f64, f64) + Sync,
    ) -> Self {
        let elements = size * size;
        let mut mask = vec![false; elements];
        let mut profile = vec![0.0; elements];
        let mut compliance = vec![0.0; elements];
        let rows = mask.par_chunks_mut(size).zip(profile.par_chunks_mut(size));
        let rows = rows.zip(compliance.par_chunks_mut(size)).enumerate();
        rows.for_each(|(i, ((mask, profile), compliance))| {
            for j in 0..size {
                (mask[j], profile[j], compliance[j]) = at(i, j);
            }
        });
        Self {
            mask,
            profile,
            compliance,
        }
    }

    /// Whether each element lies on the relief: on a cylinder's top, under a film, on a map; nowhere on a bare surface.
    #[must_use]
    pub fn mask(&self) -> &[bool] {
        &self.mask
    }

    /// Surface profile `f*` at each element, m: 0 on the tops, `−h` between the cylinders.
    #[must_use]
    pub fn profile(&self) -> &[f64] {
        &self.profile
    }

    /// Compliance η of the relief at each element, m/Pa: `h / E_a` on the tops, 0 between the cylinders.
    #[must_use]
    pub fn compliance(&self) -> &[f64] {
        &self.compliance
    }

    /// Fraction of the elements that lie on the relief; tends to [`Relief::area_fraction`](crate::Relief::area_fraction).
    #[must_use]
    pub fn mask_fraction(&self) -> f64 {
        self.mask.iter().filter(|&&on| on).count() as f64 / self.mask.len() as f64
    }
}
