//! Equal elastic cylinders on a lattice, standing on the foundation.

use crate::error::{Quantity, TextureError, not_negative, positive};
use crate::lattice::Lattice;
use crate::pattern::Pattern;
use crate::rounding::sag;
use crate::spring_law::SpringLaw;

/// The description of a relief of cylinders; [`Cylinders::new`] checks it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderSpec {
    /// Arrangement of the axes in the plane.
    pub lattice: Lattice,
    /// Radius r of a cylinder, m; at most half the period.
    pub radius: f64,
    /// Height h of a cylinder, m.
    pub height: f64,
    /// Distance T between the axes of neighbouring cylinders, m.
    pub period: f64,
    /// Position of one cylinder's axis, m; `[0, 0]` puts it under the indenter's lowest point.
    pub offset: [f64; 2],
    /// Young's modulus `E_a` of the cylinders, Pa.
    pub young_modulus: f64,
}

/// Equal cylinders on a lattice, of one-dimensional springs of compliance `η = h / E_a` (3.3), with the height h of the
/// top at each point.
///
/// The top is plane, or rounded at its edge: the height at a distance ρ from the axis is then
/// `h − (r_e − √(r_e² − (ρ − (r − r_e))²))` for `ρ > r − r_e`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinders {
    spec: CylinderSpec,
    pattern: Pattern,
    edge_radius: f64,
    law: SpringLaw,
}

/// Relative slack on the radius: an element whose centre lies on the rim up to rounding belongs to the cylinder.
const RIM_SLACK: f64 = 1e-12;

impl Cylinders {
    /// Checks a description and builds the cylinders.
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if radius, height, period or Young's modulus is not positive and finite,
    /// [`TextureError::NotFinite`] if the offset is not finite, [`TextureError::Overlap`] if the radius exceeds half
    /// the period.
    pub fn new(spec: CylinderSpec) -> Result<Self, TextureError> {
        let CylinderSpec {
            lattice,
            radius,
            height,
            period,
            offset,
            young_modulus,
        } = spec;
        positive(Quantity::Radius, radius)?;
        positive(Quantity::Height, height)?;
        positive(Quantity::YoungModulus, young_modulus)?;
        let pattern = Pattern::new(lattice, period, offset)?;
        if 2.0 * radius > period {
            return Err(TextureError::Overlap { radius, period });
        }
        Ok(Self {
            spec,
            pattern,
            edge_radius: 0.0,
            law: SpringLaw::LINEAR,
        })
    }

    /// Returns the same cylinders with their upper edges rounded by arcs of this radius `r_e` (m), 0 for sharp ones.
    ///
    /// # Errors
    ///
    /// [`TextureError::Negative`] if it is negative or not finite, [`TextureError::EdgeRadius`] if it exceeds the
    /// radius or the height of a cylinder.
    pub fn rounded(self, edge_radius: f64) -> Result<Self, TextureError> {
        let found = not_negative(Quantity::EdgeRadius, edge_radius)?;
        let largest = self.spec.radius.min(self.spec.height);
        if found > largest {
            return Err(TextureError::EdgeRadius { found, largest });
        }
        Ok(Self {
            edge_radius,
            ..self
        })
    }

    /// Returns the same cylinders on a lattice turned about the axis at the offset, by `rotation` (radians) from x to
    /// y.
    ///
    /// # Errors
    ///
    /// [`TextureError::NotFinite`] if the rotation is not finite.
    pub fn turned(self, rotation: f64) -> Result<Self, TextureError> {
        let pattern = self.pattern.turned(rotation)?;
        Ok(Self { pattern, ..self })
    }

    /// Returns the same cylinders of another height (m) and modulus (Pa).
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if either is not positive and finite.
    pub(crate) fn with_springs(
        self,
        height: f64,
        young_modulus: f64,
    ) -> Result<Self, TextureError> {
        let is_linear = self.law.is_linear();
        let spec = CylinderSpec {
            height: positive(Quantity::Height, height)?,
            young_modulus: positive(Quantity::YoungModulus, young_modulus)?,
            ..self.spec
        };
        let other = Self { spec, ..self };
        Ok(if is_linear { other } else { other.stiffening() })
    }

    /// Returns the same cylinders with springs of the [logarithmic law](SpringLaw), never squeezed beyond their height.
    #[must_use]
    pub fn stiffening(self) -> Self {
        let law = SpringLaw::of_checked(self.spec.young_modulus);
        Self { law, ..self }
    }

    /// The law of the springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        self.law
    }

    /// The description of the cylinders.
    #[must_use]
    pub fn spec(&self) -> CylinderSpec {
        self.spec
    }

    /// The lattice of the axes.
    #[must_use]
    pub fn pattern(&self) -> Pattern {
        self.pattern
    }

    /// Radius `r_e` of the arc at the edge of the top, m; 0 if it is sharp.
    #[must_use]
    pub fn edge_radius(&self) -> f64 {
        self.edge_radius
    }

    /// Arrangement of the axes.
    #[must_use]
    pub fn lattice(&self) -> Lattice {
        self.spec.lattice
    }

    /// Radius r of a cylinder, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.spec.radius
    }

    /// Height h of a cylinder, m.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.spec.height
    }

    /// Distance T between the axes of neighbouring cylinders, m.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.spec.period
    }

    /// Position of one cylinder's axis, m.
    #[must_use]
    pub fn offset(&self) -> [f64; 2] {
        self.spec.offset
    }

    /// Young's modulus `E_a` of the cylinders, Pa.
    #[must_use]
    pub fn young_modulus(&self) -> f64 {
        self.spec.young_modulus
    }

    /// Compliance at rest `η = h / E_a` of a cylinder under uniform pressure on its plane top, m/Pa (3.3).
    #[must_use]
    pub fn compliance(&self) -> f64 {
        self.spec.height / self.spec.young_modulus
    }

    /// Fraction of the plane that the cylinders cover, `π r²/T²` (square) or `2π r²/(√3 T²)` (hexagonal).
    #[must_use]
    pub fn area_fraction(&self) -> f64 {
        self.pattern.area_fraction(self.spec.radius)
    }

    /// Whether the lattice is symmetric in x and y by its cell.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.pattern.is_mirrored()
    }

    /// Whether the point (m) lies on a cylinder, the rim included (with a relative slack of 1e-12 on the radius).
    #[must_use]
    pub fn contains(&self, point: [f64; 2]) -> bool {
        self.reaches(self.pattern.distance_to_centre(point))
    }

    /// Depth of the surface below the plane of the tops at a point, m: at most the height of a cylinder.
    pub(crate) fn depth_at(&self, point: [f64; 2]) -> f64 {
        let from_axis = self.pattern.distance_to_centre(point);
        let CylinderSpec { radius, height, .. } = self.spec;
        let on_arc = from_axis - (radius - self.edge_radius);
        if !self.reaches(from_axis) {
            height
        } else if self.edge_radius > 0.0 && on_arc > 0.0 {
            sag(self.edge_radius, on_arc).min(height)
        } else {
            0.0
        }
    }

    /// Compliance of a spring whose top lies at this depth (m) below the plane of the tops, m/Pa.
    pub(crate) fn compliance_at_depth(&self, depth: f64) -> f64 {
        (self.spec.height - depth) / self.spec.young_modulus
    }

    /// Distance from the point to the nearest rim, m: positive on a cylinder, negative between the cylinders.
    #[must_use]
    pub fn distance_to_rim(&self, point: [f64; 2]) -> f64 {
        self.spec.radius - self.pattern.distance_to_centre(point)
    }

    /// Distance from the point to the nearest rim, m; at least half the width of the arc.
    pub(crate) fn distance_to_edge(&self, point: [f64; 2]) -> f64 {
        self.distance_to_rim(point)
            .abs()
            .max(0.5 * self.edge_radius)
    }

    /// Whether a cylinder reaches this distance (m) from its axis.
    fn reaches(&self, from_axis: f64) -> bool {
        from_axis <= self.spec.radius * (1.0 + RIM_SLACK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEC: CylinderSpec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 5e-3,
        height: 1e-4,
        period: 0.0125,
        offset: [0.0, 0.0],
        young_modulus: 2.0,
    };

    #[test]
    fn a_cylinder_is_centred_on_the_offset() {
        let cylinders = Cylinders::new(CylinderSpec {
            offset: [1e-3, -2e-3],
            ..SPEC
        })
        .unwrap();
        assert!(cylinders.contains([1e-3 + 5e-3, -2e-3]));
        assert!(!cylinders.contains([1e-3 + 5.01e-3, -2e-3]));
        assert!(cylinders.contains([1e-3 + 8.0 * 0.0125, -2e-3 - 3.0 * 0.0125]));
        assert_eq!(cylinders.compliance(), 0.5e-4);
    }

    #[test]
    fn the_distance_to_the_rim_is_positive_on_the_top() {
        let cylinders = Cylinders::new(SPEC).unwrap();
        for (x, wanted) in [(0.0, 5e-3), (4e-3, 1e-3), (6e-3, -1e-3), (7.5e-3, 0.0)] {
            let found = cylinders.distance_to_rim([x, 0.0]);
            // differences of numbers up to 0.0125
            assert!((found - wanted).abs() < 1e-17, "{x}: {found}");
        }
    }

    #[test]
    fn a_rounded_edge_is_at_least_half_its_arc_away() {
        let tall = CylinderSpec {
            height: 1.0,
            ..SPEC
        };
        let round = Cylinders::new(tall).unwrap().rounded(1e-3).unwrap();
        for (x, wanted) in [(3e-3, 2e-3), (4.75e-3, 5e-4), (5e-3, 5e-4), (6e-3, 1e-3)] {
            let found = round.distance_to_edge([x, 0.0]);
            assert!((found - wanted).abs() < 1e-16, "{x}: {found}");
        }
    }

    #[test]
    fn overlapping_cylinders_are_refused_and_touching_ones_are_not() {
        assert!(
            Cylinders::new(CylinderSpec {
                radius: 0.00625,
                ..SPEC
            })
            .is_ok()
        );
        let overlap = Cylinders::new(CylinderSpec {
            radius: 0.0063,
            ..SPEC
        });
        assert_eq!(
            overlap,
            Err(TextureError::Overlap {
                radius: 0.0063,
                period: 0.0125
            })
        );
    }

    #[test]
    fn invalid_numbers_are_refused_by_name() {
        let refused = |spec| Cylinders::new(spec).unwrap_err();
        let not_positive = |quantity, found| TextureError::NotPositive { quantity, found };
        assert_eq!(
            refused(CylinderSpec {
                radius: -1.0,
                ..SPEC
            }),
            not_positive(Quantity::Radius, -1.0)
        );
        assert_eq!(
            refused(CylinderSpec {
                height: 0.0,
                ..SPEC
            }),
            not_positive(Quantity::Height, 0.0)
        );
        let infinite = f64::INFINITY;
        assert_eq!(
            refused(CylinderSpec {
                period: infinite,
                ..SPEC
            }),
            not_positive(Quantity::Period, infinite)
        );
        assert_eq!(
            refused(CylinderSpec {
                young_modulus: 0.0,
                ..SPEC
            }),
            not_positive(Quantity::YoungModulus, 0.0)
        );
        let offset = refused(CylinderSpec {
            offset: [0.0, f64::NAN],
            ..SPEC
        });
        assert!(matches!(
            offset,
            TextureError::NotFinite {
                quantity: Quantity::Offset,
                ..
            }
        ));
    }

    #[test]
    fn a_rounded_top_falls_off_along_an_arc_and_its_springs_are_as_much_shorter() {
        let unit = CylinderSpec {
            radius: 10.0,
            height: 6.0,
            period: 30.0,
            ..SPEC
        };
        let sharp = Cylinders::new(unit).unwrap();
        let round = sharp.rounded(5.0).unwrap();
        let depths = |cylinders: Cylinders| {
            [0.0, 5.0, 8.0, 9.0, 10.0, 10.1].map(|x| cylinders.depth_at([x, 0.0]))
        };
        assert_eq!(depths(round), [0.0, 0.0, 1.0, 2.0, 5.0, 6.0]);
        assert_eq!(depths(sharp), [0.0, 0.0, 0.0, 0.0, 0.0, 6.0]);
        assert_eq!(
            [0.0, 1.0, 6.0].map(|depth| round.compliance_at_depth(depth)),
            [3.0, 2.5, 0.0]
        );
        assert_eq!(sharp.rounded(0.0).unwrap(), sharp);
        // At a lower height the arc ends on the base.
        let low = round.with_springs(4.0, 2.0).unwrap();
        assert_eq!([9.0, 10.0].map(|x| low.depth_at([x, 0.0])), [2.0, 4.0]);
    }

    #[test]
    fn an_edge_radius_is_at_most_radius_and_height() {
        let flat = Cylinders::new(SPEC).unwrap();
        let too_large = |found, largest| Err(TextureError::EdgeRadius { found, largest });
        assert_eq!(flat.rounded(2e-4), too_large(2e-4, 1e-4));
        let slender = Cylinders::new(CylinderSpec {
            height: 1.0,
            ..SPEC
        })
        .unwrap();
        assert_eq!(slender.rounded(0.1), too_large(0.1, 5e-3));
        assert!(slender.rounded(5e-3).is_ok() && slender.rounded(f64::NAN).is_err());
    }
}
