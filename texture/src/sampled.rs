//! The sampled relief that a solver uses: three fields on a grid and the spring law.

use rayon::prelude::*;

use crate::spring_law::SpringLaw;

/// The relief at the centres of a grid's elements: mask, surface profile and compliance, N² values each, index
/// `i * N + j`, or at those of a quadrant.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledRelief {
    pub(crate) mask: Vec<bool>,
    pub(crate) profile: Vec<f64>,
    pub(crate) compliance: Vec<f64>,
    pub(crate) law: SpringLaw,
}

impl SampledRelief {
    /// The relief of a pattern, from whether each element lies on it and the depth (m) below the plane of the tops.
    pub(crate) fn of_depths(
        samples: &[(bool, f64)],
        springs: impl Fn(f64) -> f64 + Send + Sync,
        law: SpringLaw,
    ) -> Self {
        let depths = samples.par_iter().map(|(_, depth)| *depth);
        Self {
            mask: samples.par_iter().map(|(is_on, _)| *is_on).collect(),
            profile: depths.clone().map(level).collect(),
            compliance: depths.map(springs).collect(),
            law,
        }
    }

    /// Whether each element lies on the relief: on a cylinder's top, under a film, on a map; never on a bare surface.
    #[must_use]
    pub fn mask(&self) -> &[bool] {
        &self.mask
    }

    /// Surface profile `f*` at each element, m: 0 on the tops, `−h` between the cylinders.
    #[must_use]
    pub fn profile(&self) -> &[f64] {
        &self.profile
    }

    /// The law of the springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        self.law
    }

    /// Compliance at rest η of the relief at each element, m/Pa: `h / E_a` on the tops, 0 between the cylinders.
    #[must_use]
    pub fn compliance(&self) -> &[f64] {
        &self.compliance
    }

    /// Returns mask, surface profile and compliance as separate fields.
    #[must_use]
    pub fn into_parts(self) -> (Vec<bool>, Vec<f64>, Vec<f64>) {
        (self.mask, self.profile, self.compliance)
    }

    /// Fraction of the elements that lie on the relief; it tends to
    /// [`Relief::area_fraction`](crate::Relief::area_fraction).
    #[must_use]
    pub fn mask_fraction(&self) -> f64 {
        self.mask.iter().filter(|&&on| on).count() as f64 / self.mask.len() as f64
    }
}

/// The profile at a depth below the plane of the tops, m: never the negative zero.
pub(crate) fn level(depth: f64) -> f64 {
    0.0 - depth
}
