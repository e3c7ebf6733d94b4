//! Equal elastic cylinders on a lattice, standing on the foundation.

use crate::error::{Quantity, TextureError, finite, positive};
use crate::lattice::Lattice;
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

/// Equal cylinders on a lattice, each a one-dimensional spring of compliance `η = h / E_a` (3.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinders {
    spec: CylinderSpec,
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
            radius,
            height,
            period,
            offset,
            young_modulus,
            ..
        } = spec;
        positive(Quantity::Radius, radius)?;
        positive(Quantity::Height, height)?;
        positive(Quantity::Period, period)?;
        positive(Quantity::YoungModulus, young_modulus)?;
        for coordinate in offset {
            finite(Quantity::Offset, coordinate)?;
        }
        if 2.0 * radius > period {
            return Err(TextureError::Overlap { radius, period });
        }
        Ok(Self {
            spec,
            law: SpringLaw::LINEAR,
        })
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

    /// Compliance at rest `η = h / E_a` of a cylinder under uniform pressure on its top, m/Pa (3.3).
    #[must_use]
    pub fn compliance(&self) -> f64 {
        self.spec.height / self.spec.young_modulus
    }

    /// Fraction of the plane that the tops cover, `π r²/T²` (square) or `2π r²/(√3 T²)` (hexagonal).
    #[must_use]
    pub fn area_fraction(&self) -> f64 {
        self.spec
            .lattice
            .area_fraction(self.spec.radius, self.spec.period)
    }

    /// Whether the lattice is symmetric in x and y, i.e. whether each axis passes through a centre or halfway between
    /// two centres.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        let CylinderSpec {
            lattice,
            period,
            offset,
            ..
        } = self.spec;
        let cell = lattice.cell(period);
        // The offset is a multiple of half the cell along both axes.
        [0, 1]
            .into_iter()
            .all(|axis: usize| (2.0 * offset[axis] / cell[axis]).fract() == 0.0)
    }

    /// Whether the point (m) lies on the top of a cylinder, the rim included (with a relative slack of 1e-12 on the
    /// radius).
    #[must_use]
    pub fn contains(&self, point: [f64; 2]) -> bool {
        self.distance_to_axis(point) <= self.spec.radius * (1.0 + RIM_SLACK)
    }

    /// Distance from the point to the nearest rim, m: positive on the top of a cylinder, negative between the
    /// cylinders.
    #[must_use]
    pub fn distance_to_rim(&self, point: [f64; 2]) -> f64 {
        self.spec.radius - self.distance_to_axis(point)
    }

    /// Distance from the point to the nearest axis, m.
    fn distance_to_axis(&self, [x, y]: [f64; 2]) -> f64 {
        let CylinderSpec {
            lattice,
            period,
            offset,
            ..
        } = self.spec;
        lattice.distance_to_centre(period, [x - offset[0], y - offset[1]])
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
}
