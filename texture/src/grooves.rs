//! Grooves: equal straight channels below a plane.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::error::{Quantity, TextureError, not_negative, positive};
use crate::placement::Placement;
use crate::rounding::Rounding;

/// The cross-section of a groove of width w and depth d, with the distance u from its middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum GrooveProfile {
    /// Vertical walls and a flat floor: d for `|u| < w/2`.
    #[default]
    Rectangular,
    /// Two planes: `d (1 − 2|u|/w)`.
    V,
    /// One wave: `d (1 + cos(2πu/w))/2`.
    Sine,
}

/// The description of grooves; [`Grooves::new`] checks it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrooveSpec {
    /// The cross-section.
    pub profile: GrooveProfile,
    /// Width w of a groove in the plane, m, as if its edges were sharp.
    pub width: f64,
    /// Depth d, m.
    pub depth: f64,
    /// Distance between the middles of neighbouring grooves, m.
    pub period: f64,
    /// A point on the middle of one groove, m.
    pub offset: [f64; 2],
    /// Angle of the pattern from x to y, radians: 0 for grooves along y, one after the other along x.
    pub rotation: f64,
    /// Radius of the arcs that round the edges, m; 0 for sharp ones. A sine has none.
    pub edge_radius: f64,
}

/// Straight channels below the plane, with sharp or rounded edges.
///
/// An edge radius rounds each edge by an arc that is tangent to the plane and to the wall. Beside a vertical wall it
/// lies in the plane outside the width; the walls keep their places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grooves {
    spec: GrooveSpec,
    placement: Placement,
    edge: Rounding,
}

/// Relative slack on the width: an element whose centre lies on a wall up to rounding belongs to the plane.
const WALL_SLACK: f64 = 1e-12;

/// The largest radius of an arc at the edge of a wall at this angle to the plane (radians), as long as this (m): it
/// touches both at the distance `r tan(φ/2)` from the edge.
fn largest_arc(angle: f64, length: f64) -> f64 {
    if length > 0.0 {
        length / (0.5 * angle).tan()
    } else {
        0.0
    }
}

impl GrooveSpec {
    /// Angle of the walls to the plane, radians, and their length, m; no length of a sine, which has none.
    fn wall(&self) -> [f64; 2] {
        let half = 0.5 * self.width;
        match self.profile {
            GrooveProfile::Rectangular => [FRAC_PI_2, self.depth],
            GrooveProfile::V => [(self.depth / half).atan(), half.hypot(self.depth)],
            GrooveProfile::Sine => [0.0, 0.0],
        }
    }
}

impl Grooves {
    /// Checks a description and builds the grooves.
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if width, depth or period is not positive and finite, [`TextureError::Negative`]
    /// if the edge radius is negative or not finite, [`TextureError::NotFinite`] for offset and rotation,
    /// [`TextureError::WideGroove`] if the grooves overlap or leave nothing between vertical walls,
    /// [`TextureError::EdgeRadius`] if the arcs are longer than the walls or the edge is that of a sine,
    /// [`TextureError::RoundedOverlap`] if the arcs of neighbours overlap.
    pub fn new(spec: GrooveSpec) -> Result<Self, TextureError> {
        let GrooveSpec {
            profile,
            width,
            depth,
            period,
            edge_radius,
            ..
        } = spec;
        positive(Quantity::Width, width)?;
        positive(Quantity::Depth, depth)?;
        positive(Quantity::Period, period)?;
        not_negative(Quantity::EdgeRadius, edge_radius)?;
        let placement = Placement::new(spec.offset, spec.rotation)?;
        let leaves_nothing = profile == GrooveProfile::Rectangular && width >= period;
        if width > period || leaves_nothing {
            return Err(TextureError::WideGroove { width, period });
        }
        let [angle, length] = spec.wall();
        let largest = largest_arc(angle, length);
        if edge_radius > largest * (1.0 + WALL_SLACK) {
            let found = edge_radius;
            return Err(TextureError::EdgeRadius { found, largest });
        }
        let edge = Rounding::of_wall(edge_radius, 0.5 * width, angle);
        let opening = 2.0 * edge.ends[1];
        if opening > period {
            return Err(TextureError::RoundedOverlap {
                found: edge_radius,
                width: opening,
                period,
            });
        }
        Ok(Self {
            spec,
            placement,
            edge,
        })
    }

    /// The description of the grooves.
    #[must_use]
    pub fn spec(&self) -> GrooveSpec {
        self.spec
    }

    /// Distance from a vector (m) to the nearest one that moves the grooves onto themselves, m.
    #[must_use]
    pub fn distance_to_translation(&self, vector: [f64; 2]) -> f64 {
        self.distance_along(self.placement.turned_back(vector)[0])
    }

    /// Depth below the plane at a point, m.
    pub(crate) fn depth_at(&self, point: [f64; 2]) -> f64 {
        let GrooveSpec {
            profile,
            width,
            depth,
            ..
        } = self.spec;
        let (u, half) = (self.distance_to_middle(point), 0.5 * width);
        let is_inside = u < half * (1.0 - WALL_SLACK);
        match profile {
            GrooveProfile::Rectangular if is_inside => depth,
            GrooveProfile::Rectangular => self.edge.depth(u.max(half), |_| depth),
            GrooveProfile::V => self.edge.depth(u, |u| (depth * (1.0 - u / half)).max(0.0)),
            // d (1 + cos(2πu/w))/2 = d cos²(πu/w)
            GrooveProfile::Sine if is_inside => depth * (PI * u / width).cos().powi(2),
            GrooveProfile::Sine => 0.0,
        }
    }

    /// Mean depth of the surface below the plane, the edges taken as sharp, m; between vertical walls only of the
    /// plane, 0.
    pub(crate) fn mean_depth(&self) -> f64 {
        match self.spec.profile {
            GrooveProfile::Rectangular => 0.0,
            GrooveProfile::V | GrooveProfile::Sine => 0.5 * self.spec.depth * self.area_fraction(),
        }
    }

    /// Fraction of the plane that the grooves take, their edges taken as sharp: `w/T`.
    #[must_use]
    pub fn area_fraction(&self) -> f64 {
        self.spec.width / self.spec.period
    }

    /// Distance from a point to the nearest wall, m: positive beside the grooves, negative in them; none without
    /// vertical walls.
    pub(crate) fn distance_to_wall(&self, point: [f64; 2]) -> Option<f64> {
        let has_walls = self.spec.profile == GrooveProfile::Rectangular;
        has_walls.then(|| self.distance_to_middle(point) - 0.5 * self.spec.width)
    }

    /// Width in the plane of the arc that rounds an edge, m; 0 if it is sharp.
    pub(crate) fn arc_width(&self) -> f64 {
        self.edge.width()
    }

    /// Distance from a point to the nearest edge that is a ridge, m.
    pub(crate) fn distance_to_ridge(&self, point: [f64; 2]) -> f64 {
        match self.spec.profile {
            GrooveProfile::V => self.edge.distance_to_ridge(self.distance_to_middle(point)),
            GrooveProfile::Rectangular | GrooveProfile::Sine => f64::INFINITY,
        }
    }

    /// Whether a point lies beside the grooves or on a wall, with a relative slack of 1e-12 on the width.
    pub(crate) fn is_beside(&self, point: [f64; 2]) -> bool {
        self.distance_to_middle(point) >= 0.5 * self.spec.width * (1.0 - WALL_SLACK)
    }

    pub(crate) fn is_mirrored(&self) -> bool {
        self.placement
            .is_mirrored([self.spec.period, f64::INFINITY])
    }

    /// Distance from a point to the middle of the nearest groove, m.
    fn distance_to_middle(&self, point: [f64; 2]) -> f64 {
        self.distance_along(self.placement.local(point)[0])
    }

    fn distance_along(&self, u: f64) -> f64 {
        let period = self.spec.period;
        (u - period * (u / period).round()).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEC: GrooveSpec = GrooveSpec {
        profile: GrooveProfile::Rectangular,
        width: 2.0,
        depth: 0.5,
        period: 5.0,
        offset: [0.0, 0.0],
        rotation: 0.0,
        edge_radius: 0.0,
    };

    fn depths<const N: usize>(spec: GrooveSpec, at: [f64; N]) -> [f64; N] {
        let grooves = Grooves::new(spec).unwrap();
        at.map(|x| grooves.depth_at([x, 7.7]))
    }

    #[test]
    fn each_profile_is_its_formula() {
        assert_eq!(
            depths(SPEC, [0.0, 0.99, 1.0, 2.5, 4.5]),
            [0.5, 0.5, 0.0, 0.0, 0.5]
        );
        let of = |profile| depths(GrooveSpec { profile, ..SPEC }, [0.0, -0.5, 1.0, 5.0]);
        assert_eq!(of(GrooveProfile::V), [0.5, 0.25, 0.0, 0.5]);
        let sine = of(GrooveProfile::Sine);
        let near = |found: f64, wanted: f64| (found - wanted).abs() < 1e-16;
        assert!(
            near(sine[0], 0.5) && near(sine[1], 0.25) && sine[2] == 0.0,
            "{sine:?}"
        );
    }

    #[test]
    fn rounded_walls_keep_their_places() {
        let round = GrooveSpec {
            edge_radius: 0.5,
            ..SPEC
        };
        let [floor, wall, arc, plane] = depths(round, [0.99, 1.0, 1.2, 1.5]);
        assert_eq!([floor, wall, plane], [0.5, 0.5, 0.0]);
        // 0.5 − √(0.5² − 0.3²)
        assert!((arc - 0.1).abs() < 1e-16, "{arc}");
    }

    #[test]
    fn grooves_turn_from_x_to_y() {
        let turned = GrooveSpec {
            rotation: f64::to_radians(90.0),
            offset: [0.0, 1.0],
            ..SPEC
        };
        let grooves = Grooves::new(turned).unwrap();
        assert_eq!(grooves.depth_at([3.0, 1.5]), 0.5);
        assert_eq!(grooves.depth_at([3.0, 3.5]), 0.0);
        assert!(!grooves.is_mirrored() && grooves.distance_to_translation([0.3, 10.0]) < 1e-15);
        assert!(
            Grooves::new(GrooveSpec {
                offset: [7.0, 2.5],
                ..turned
            })
            .unwrap()
            .is_mirrored()
        );
    }

    #[test]
    fn impossible_grooves_are_refused() {
        let refused = |spec| Grooves::new(spec).unwrap_err();
        let wide = GrooveSpec { width: 5.0, ..SPEC };
        assert!(matches!(refused(wide), TextureError::WideGroove { .. }));
        assert!(
            Grooves::new(GrooveSpec {
                profile: GrooveProfile::Sine,
                ..wide
            })
            .is_ok()
        );
        let round = |edge_radius, spec| GrooveSpec {
            edge_radius,
            ..spec
        };
        assert!(matches!(
            refused(round(0.6, SPEC)),
            TextureError::EdgeRadius { .. }
        ));
        let near = GrooveSpec {
            period: 2.5,
            ..SPEC
        };
        assert!(matches!(
            refused(round(0.5, near)),
            TextureError::RoundedOverlap { .. }
        ));
        let sine = GrooveSpec {
            profile: GrooveProfile::Sine,
            ..SPEC
        };
        assert!(matches!(
            refused(round(0.1, sine)),
            TextureError::EdgeRadius { largest: 0.0, .. }
        ));
    }
}
