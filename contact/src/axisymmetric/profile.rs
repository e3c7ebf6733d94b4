//! Shapes of axisymmetric indenters, by the penetration that they need on a half-space.

use crate::Indenter;
use crate::path::domain::root_finding::where_zero;
use crate::reference::power_law::penetration_over_height;

/// A convex shape with a height `f(r)` above its lowest point.
///
/// On a half-space the contact radius x needs the penetration `d(x) = x ∫₀ˣ f′(r)/√(x² − r²) dr` (I. N. Sneddon 1965),
/// whatever the modulus.
///
/// | shape | height | `d(x)` |
/// |---|---|---|
/// | [`Paraboloid`](Self::Paraboloid) | `r²/2R` | `x²/R` |
/// | [`Sphere`](Self::Sphere) | `R − √(R² − r²)` | `x artanh x/R` |
/// | [`Cone`](Self::Cone) | `m r`, its tip a sphere that touches the side | `π/2 m x` if sharp |
/// | [`Power`](Self::Power) | `rⁿ/cⁿ⁻¹` | `√π Γ(n/2 + 1)/Γ(n/2 + 1/2) xⁿ/cⁿ⁻¹` |
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxisymmetricProfile {
    /// `r²/2R`.
    Paraboloid {
        /// `R`, m.
        radius: f64,
    },
    /// `R − √(R² − r²)`.
    Sphere {
        /// `R`, m.
        radius: f64,
    },
    /// A cone; its tip is a sphere up to the circle `R m/√(1 + m²)`, where both have the slope m.
    Cone {
        /// `m`, the rise of the side per distance from the axis.
        slope: f64,
        /// Radius `R` of the tip, m; 0 for a sharp one.
        tip_radius: f64,
    },
    /// `rⁿ/cⁿ⁻¹`.
    Power {
        /// `n`, at least 1.
        exponent: f64,
        /// `c`, m.
        length: f64,
    },
}

impl AxisymmetricProfile {
    /// The profile of an indenter; none if it has edges, is not axisymmetric or only known by its heights.
    #[must_use]
    pub fn of(indenter: &Indenter) -> Option<Self> {
        match indenter {
            Indenter::Paraboloid(shape) => Some(Self::Paraboloid {
                radius: shape.radius(),
            }),
            Indenter::EllipticParaboloid(shape) => shape
                .common_radius()
                .map(|radius| Self::Paraboloid { radius }),
            Indenter::Sphere(shape) => Some(Self::Sphere {
                radius: shape.radius(),
            }),
            Indenter::Cone(shape) => Some(Self::Cone {
                slope: shape.half_angle().tan().recip(),
                tip_radius: shape.tip_radius(),
            }),
            Indenter::PowerLaw(shape) => Some(Self::Power {
                exponent: shape.exponent(),
                length: shape.coefficient(),
            }),
            Indenter::FlatPunch(_)
            | Indenter::Plane(_)
            | Indenter::Pyramid(_)
            | Indenter::Map(_)
            | Indenter::Custom(_) => None,
        }
    }

    /// Radius of curvature at the lowest point, m; none if it is 0 or infinite.
    #[must_use]
    pub fn tip_radius(self) -> Option<f64> {
        match self {
            Self::Paraboloid { radius } | Self::Sphere { radius } => Some(radius),
            Self::Cone { tip_radius, .. } => Some(tip_radius).filter(|radius| *radius > 0.0),
            // r²/c
            Self::Power { exponent, length } => {
                Some(length / 2.0).filter(|_| exponent.total_cmp(&2.0).is_eq())
            }
        }
    }

    /// The radius at which the shape ends, m; infinite without end.
    #[must_use]
    pub fn rim(self) -> f64 {
        match self {
            Self::Sphere { radius } => radius,
            Self::Paraboloid { .. } | Self::Cone { .. } | Self::Power { .. } => f64::INFINITY,
        }
    }

    /// `d(x)`, m: the penetration of a half-space at the contact radius x (m), below the [rim](Self::rim).
    #[must_use]
    pub fn half_space_penetration(self, x: f64) -> f64 {
        match self {
            Self::Paraboloid { radius } => x * x / radius,
            Self::Sphere { radius } => x * (x / radius).atanh(),
            Self::Cone { slope, tip_radius } => {
                let seam = seam(slope, tip_radius);
                if x <= seam {
                    return x * (x / tip_radius).atanh();
                }
                // ln((R + x)/(√(R² − b²) + √(x² − b²))) + m arccos b/x, with b the tip's last circle: f′ = r/√(R² − r²)
                // up to it, then m
                let [cap, side] = [tip_radius, x].map(|end| ((end - seam) * (end + seam)).sqrt());
                let of_tip = if seam > 0.0 {
                    ((tip_radius + x) / (cap + side)).ln()
                } else {
                    0.0
                };
                x * (of_tip + slope * (seam / x).acos())
            }
            Self::Power { exponent, length } => {
                // √π Γ(n/2 + 1)/Γ(n/2 + 1/2) xⁿ/cⁿ⁻¹
                penetration_over_height(exponent) * x * (x / length).powf(exponent - 1.0)
            }
        }
    }

    /// The contact radius x (m) at which a half-space needs the penetration `d(x)` given (m): the inverse of
    /// [`Self::half_space_penetration`], to rounding.
    #[must_use]
    pub fn half_space_radius(self, penetration: f64) -> f64 {
        let rim = self.rim();
        where_zero(|x| {
            if x < rim {
                (self.half_space_penetration(x) / penetration).ln()
            } else {
                f64::INFINITY
            }
        })
    }

    /// Where `d(x)` is not smooth, m; none if it is a polynomial.
    #[must_use]
    pub fn kink(self) -> Option<f64> {
        match self {
            Self::Paraboloid { .. } => None,
            Self::Sphere { radius } => Some(radius),
            Self::Cone { slope, tip_radius } => Some(seam(slope, tip_radius)),
            Self::Power { .. } => Some(0.0),
        }
    }
}

/// The circle at which the tip of a cone meets its side, m: `R cos α` with `m = cot α`.
fn seam(slope: f64, tip_radius: f64) -> f64 {
    tip_radius * slope / 1.0_f64.hypot(slope)
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::{composite, halved};
    use super::*;
    use crate::{Cone, Paraboloid, PowerLaw, Sphere};

    /// `x ∫ f′/√(x² − r²) dr` with r = x sin θ, by differences of the heights.
    fn by_quadrature(indenter: &Indenter, x: f64, kink: f64) -> f64 {
        let seam = (kink / x).min(1.0).asin();
        let toward = |[start, end]: [f64; 2]| halved([start, end], &|[l, r]| r - l > 0.02);
        let mut borders = toward([0.0, seam]);
        borders.extend(
            toward([seam, std::f64::consts::FRAC_PI_2])
                .into_iter()
                .skip(1),
        );
        let terms = composite(&borders).into_iter().map(|(angle, weight)| {
            let r = x * angle.sin();
            let step = 1e-5 * x;
            let slope = (indenter.height(r + step, 0.0) - indenter.height((r - step).abs(), 0.0))
                / (2.0 * step);
            weight * slope
        });
        x * terms.sum::<f64>()
    }

    #[test]
    fn the_penetrations_are_sneddon_s_integrals_of_the_slope() {
        let cone = Cone::new(1.1, 0.3).unwrap();
        let indenters: [(Indenter, f64, f64); 6] = [
            (PowerLaw::new(3.3, 0.8).unwrap().into(), 0.7, 0.0),
            (Paraboloid::new(2.0).unwrap().into(), 0.7, 0.0),
            (Sphere::new(2.0).unwrap().into(), 1.6, 0.0),
            (Cone::new(1.1, 0.0).unwrap().into(), 0.7, 0.0),
            (cone.into(), 0.1, 1.0),
            (cone.into(), 0.7, 0.3 * 1.1_f64.cos()),
        ];
        for (indenter, x, kink) in indenters {
            let profile = AxisymmetricProfile::of(&indenter).unwrap();
            let (found, wanted) = (
                profile.half_space_penetration(x),
                by_quadrature(&indenter, x, kink),
            );
            // Differences over 1e-5 of the radius; at the seam's kink of the curvature and at a sharp tip one step of
            // them is off.
            assert!(
                (found / wanted - 1.0).abs() < 2e-5,
                "{profile:?} {x}: {found} {wanted}"
            );
        }
    }

    #[test]
    fn a_power_of_one_is_a_cone_and_of_two_a_paraboloid() {
        let power = |exponent| AxisymmetricProfile::Power {
            exponent,
            length: 3.0,
        };
        let cone = AxisymmetricProfile::Cone {
            slope: 1.0,
            tip_radius: 0.0,
        };
        let paraboloid = AxisymmetricProfile::Paraboloid { radius: 1.5 };
        for x in [0.2, 1.0, 7.0] {
            for (one, other) in [(power(1.0), cone), (power(2.0), paraboloid)] {
                let ratio = one.half_space_penetration(x) / other.half_space_penetration(x);
                // A few roundings of the logarithm of Γ.
                assert!((ratio - 1.0).abs() < 4e-15, "{one:?} {ratio}");
            }
        }
    }

    #[test]
    fn the_radius_is_the_inverse_of_the_penetration() {
        let shapes = [
            AxisymmetricProfile::Paraboloid { radius: 2.0 },
            AxisymmetricProfile::Sphere { radius: 2.0 },
            AxisymmetricProfile::Cone {
                slope: 0.5,
                tip_radius: 2.0,
            },
            AxisymmetricProfile::Power {
                exponent: 3.3,
                length: 0.8,
            },
        ];
        for shape in shapes {
            // Below and beyond the seam of the cone, and near the rim of the sphere.
            for x in [1e-9, 0.4, 1.7, 1.999] {
                let found = shape.half_space_radius(shape.half_space_penetration(x));
                assert!((found / x - 1.0).abs() < 1e-13, "{shape:?} {x}: {found}");
            }
        }
    }

    #[test]
    fn the_tip_s_penetration_continues_into_the_side_s() {
        let cone = AxisymmetricProfile::Cone {
            slope: 0.5,
            tip_radius: 2.0,
        };
        let seam = seam(0.5, 2.0);
        let [before, after] =
            [1.0 - 1e-9, 1.0 + 1e-9].map(|factor| cone.half_space_penetration(factor * seam));
        assert!((after / before - 1.0).abs() < 1e-8, "{before} {after}");
    }
}
