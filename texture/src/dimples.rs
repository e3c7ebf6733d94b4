//! Dimples: equal spherical caps below a plane, on a lattice.

use crate::error::{Quantity, TextureError, not_negative, positive};
use crate::pattern::Pattern;
use crate::rounding::{Rounding, sag};

/// Spherical caps below the plane, with sharp or rounded rims.
///
/// A cap of rim radius a and depth d is part of a sphere of radius `R = (a² + d²)/2d`; its depth below the plane is
/// `d − (R − √(R² − r²))`. An edge radius rounds the rim by an arc that is tangent to the plane and to the cap; it
/// begins outside the rim, at `√(a² + 2 d r_e)` from the axis, and keeps the cap's own depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimples {
    pattern: Pattern,
    radius: f64,
    depth: f64,
    rim: Rounding,
}

impl Dimples {
    /// Builds caps of this radius of the rim (m), depth (m) and edge radius (m, 0 for sharp rims).
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if radius or depth is not positive and finite, [`TextureError::Negative`] if the
    /// edge radius is negative or not finite, [`TextureError::DeepDimple`] if the depth exceeds the radius,
    /// [`TextureError::Overlap`] if the rims overlap, [`TextureError::RoundedOverlap`] if only the roundings do.
    pub fn new(
        pattern: Pattern,
        radius: f64,
        depth: f64,
        edge_radius: f64,
    ) -> Result<Self, TextureError> {
        positive(Quantity::Radius, radius)?;
        positive(Quantity::Depth, depth)?;
        not_negative(Quantity::EdgeRadius, edge_radius)?;
        let period = pattern.period();
        if depth > radius {
            return Err(TextureError::DeepDimple { depth, radius });
        }
        if 2.0 * radius > period {
            return Err(TextureError::Overlap { radius, period });
        }
        let sphere = sphere_radius(radius, depth);
        let rim = Rounding::of_cap(edge_radius, [radius, depth], sphere);
        let width = 2.0 * rim.ends[1];
        if width > period {
            let found = edge_radius;
            return Err(TextureError::RoundedOverlap {
                found,
                width,
                period,
            });
        }
        Ok(Self {
            pattern,
            radius,
            depth,
            rim,
        })
    }

    /// The lattice of the axes.
    #[must_use]
    pub fn pattern(&self) -> Pattern {
        self.pattern
    }

    /// Radius of the rim in the plane, m, as if it were sharp.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Depth, m.
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.depth
    }

    /// Radius of the arc that rounds the rim, m; 0 if it is sharp.
    #[must_use]
    pub fn edge_radius(&self) -> f64 {
        self.rim.radius
    }

    /// Width of that arc in the plane, m.
    pub(crate) fn arc_width(&self) -> f64 {
        self.rim.width()
    }

    /// Depth below the plane at a point, m.
    pub(crate) fn depth_at(&self, point: [f64; 2]) -> f64 {
        let sphere = sphere_radius(self.radius, self.depth);
        let cap = |r: f64| (self.depth - sag(sphere, r)).max(0.0);
        self.rim.depth(self.pattern.distance_to_centre(point), cap)
    }

    /// Mean depth of the surface below the plane, the rims taken as sharp, m: the volume `π d (3a² + d²)/6` of each.
    pub(crate) fn mean_depth(&self) -> f64 {
        let of_discs = self.pattern.area_fraction(self.radius);
        let flatness = self.depth / self.radius;
        of_discs * self.depth * (3.0 + flatness * flatness) / 6.0
    }

    /// Distance from a point to the nearest rim that is a ridge, m.
    pub(crate) fn distance_to_ridge(&self, point: [f64; 2]) -> f64 {
        self.rim
            .distance_to_ridge(self.pattern.distance_to_centre(point))
    }
}

/// `R = (a² + d²)/2d`.
fn sphere_radius(rim: f64, depth: f64) -> f64 {
    (rim * rim + depth * depth) / (2.0 * depth)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Lattice;

    fn dimples(radius: f64, depth: f64, edge_radius: f64) -> Result<Dimples, TextureError> {
        let pattern = Pattern::new(Lattice::Square, 8.0, [0.0, 0.0]).unwrap();
        Dimples::new(pattern, radius, depth, edge_radius)
    }

    #[test]
    fn a_cap_is_part_of_its_sphere() {
        let found = dimples(3.0, 1.0, 0.0).unwrap();
        // R = 5: depth 1 on the axis, 0 at the rim, 5 − 4 above the deepest point there.
        let at = |x: f64| found.depth_at([x, 8.0]);
        assert_eq!([at(0.0), at(8.0), at(3.0), at(4.0)], [1.0, 1.0, 0.0, 0.0]);
        assert!((at(1.4) - (4.8 - 4.0)).abs() < 1e-15);
        assert_eq!(found.distance_to_ridge([2.5, 0.0]), 0.5);
    }

    #[test]
    fn a_rounded_rim_lies_outside_the_cap_and_keeps_its_depth() {
        let found = dimples(3.0, 1.0, 2.0).unwrap();
        let outer = 13.0_f64.sqrt();
        assert_eq!(found.depth_at([outer, 0.0]), 0.0);
        assert!(found.depth_at([3.0, 0.0]) > 0.0 && found.depth_at([0.0, 0.0]) == 1.0);
        // The arc's half width, where no grid finer than that sees a ridge.
        let width = outer - outer * 5.0 / 7.0;
        assert!((found.distance_to_ridge([3.2, 0.0]) - 0.5 * width).abs() < 1e-14);
    }

    #[test]
    fn the_mean_depth_is_that_of_the_caps() {
        let found = dimples(3.0, 3.0, 0.0).unwrap();
        // Half spheres: 2π 27/3 over 64.
        let wanted = std::f64::consts::TAU * 9.0 / 64.0;
        assert!((found.mean_depth() - wanted).abs() < 1e-15);
    }

    #[test]
    fn impossible_caps_are_refused() {
        assert!(matches!(
            dimples(4.1, 1.0, 0.0),
            Err(TextureError::Overlap { .. })
        ));
        assert!(matches!(
            dimples(3.0, 3.1, 0.0),
            Err(TextureError::DeepDimple { .. })
        ));
        assert!(matches!(
            dimples(3.0, 1.0, 4.0),
            Err(TextureError::RoundedOverlap { .. })
        ));
        assert!(dimples(3.0, 1.0, 3.5).is_ok() && dimples(4.0, 4.0, 0.0).is_ok());
        assert!(dimples(3.0, 0.0, 0.0).is_err() && dimples(3.0, 1.0, -0.1).is_err());
    }
}
