//! A uniformly loaded circle made of square elements; those on its rim carry the share within the circle.

use pellicle_contact::axisymmetric::quadrature::composite;
use pellicle_influence::{Depth, ElementFields, SubsurfaceState, SurfaceLoad};
use pellicle_kernel::Foundation;

use super::super::run::ValidationError;

/// A circle on the surface under a pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedCircle {
    /// Radius, m.
    pub radius: f64,
    /// Pressure, Pa.
    pub pressure: f64,
}

impl LoadedCircle {
    /// Returns the states at points (x, y) (m) relative to the centre at a depth, from `count` elements along the
    /// diameter.
    ///
    /// # Errors
    /// An error if the depth is outside the body, or if the kernel cannot give the amplitudes.
    pub fn states(
        &self,
        foundation: &Foundation,
        count: usize,
        depth: Depth,
        places: &[[f64; 2]],
    ) -> Result<Vec<SubsurfaceState>, ValidationError> {
        let side = 2.0 * self.radius / count as f64;
        let distances = places.iter().map(|[x, y]| x.hypot(*y));
        let reach = self.radius * 1.5 + distances.fold(0.0, f64::max);
        let element = ElementFields::new(foundation, side, depth, reach)?;
        let shares: Vec<([f64; 2], f64)> = self.shares(count);
        let state = |[x, y]: &[f64; 2]| {
            let mut sum = SubsurfaceState::default();
            for ([along_x, along_y], share) in &shares {
                let from = [x - along_x, y - along_y];
                sum += element.state(SurfaceLoad::Pressure, from) * (self.pressure * share);
            }
            sum
        };
        Ok(places.iter().map(state).collect())
    }

    /// The centres of the elements and the share of each within the circle.
    fn shares(&self, count: usize) -> Vec<([f64; 2], f64)> {
        let side = 2.0 * self.radius / count as f64;
        let centre = |i: usize| (i as f64 + 0.5) * side - self.radius;
        let elements = (0..count * count).map(|e| [centre(e / count), centre(e % count)]);
        let with_share = |at: [f64; 2]| (at, self.share(at, side));
        elements
            .map(with_share)
            .filter(|(_, share)| *share > 0.0)
            .collect()
    }

    /// Share of an element: the length of the chord within it, integrated over its width.
    fn share(&self, [x, y]: [f64; 2], side: f64) -> f64 {
        let half = side / 2.0;
        let (left, right) = ((x - half).max(-self.radius), (x + half).min(self.radius));
        let chord = |x: f64| {
            let half_chord = ((self.radius - x) * (self.radius + x)).max(0.0).sqrt();
            let within = (y + half).min(half_chord) - (y - half).max(-half_chord);
            within.max(0.0)
        };
        let terms = composite(&[left, f64::midpoint(left, right), right]);
        terms
            .iter()
            .map(|(x, weight)| weight * chord(*x))
            .sum::<f64>()
            / (side * side)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn element_shares_add_up_to_the_area_of_the_circle() {
        let circle = LoadedCircle {
            radius: 3.0,
            pressure: 1.0,
        };
        for count in [8, 37] {
            let side = 6.0 / count as f64;
            let shares: f64 = circle.shares(count).iter().map(|(_, share)| share).sum();
            let area = std::f64::consts::PI * 9.0;
            // The chord length has a kink where the chord leaves the element through a side.
            assert!((shares * side * side / area - 1.0).abs() < 1e-3 / count as f64);
        }
    }
}
