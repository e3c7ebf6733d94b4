//! Rounded edges: arcs of circles that meet the plane of the tops without a kink.

/// Depth of a circle of radius r below its highest tangent, at a distance x from the point of contact, m:
/// `r − √(r² − x²)`, written without cancellation, as `x²/(r + √(r² − x²))`. It is r beyond the circle.
pub(crate) fn sag(radius: f64, x: f64) -> f64 {
    if x.abs() >= radius {
        return radius;
    }
    x * x / (radius + ((radius - x) * (radius + x)).sqrt())
}

/// An arc that rounds the edge between a plane and what falls off beside it, tangent to both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rounding {
    /// Radius of the arc, m; 0 for a sharp edge.
    pub(crate) radius: f64,
    /// Where the arc ends on the slope and where it reaches the plane, as distances from the middle of the recess, m;
    /// both are the edge's own if it is sharp.
    pub(crate) ends: [f64; 2],
}

impl Rounding {
    /// The arc between the plane and a straight wall that falls from it, at a distance `edge` (m) from the middle of
    /// a recess, at an angle φ (radians) to the plane.
    ///
    /// The arc touches both at the distance `t = r tan(φ/2)` from the edge.
    pub(crate) fn of_wall(radius: f64, edge: f64, angle: f64) -> Self {
        let tangent = radius * (0.5 * angle).tan();
        Self {
            radius,
            ends: [edge - tangent * angle.cos(), edge + tangent],
        }
    }

    /// The arc between the plane and a spherical cap of radius R whose rim has the radius a (m) and the depth d (m).
    ///
    /// The centre of the arc lies r below the plane and `R + r` from that of the sphere, so its distance from the
    /// axis is `ρ = √(a² + 2 d r)`; the arc touches the sphere at the distance `ρ R/(R + r)`.
    pub(crate) fn of_cap(radius: f64, [rim, depth]: [f64; 2], sphere: f64) -> Self {
        if radius == 0.0 {
            return Self {
                radius,
                ends: [rim; 2],
            };
        }
        let outer = (rim * rim + 2.0 * depth * radius).sqrt();
        Self {
            radius,
            ends: [outer * sphere / (sphere + radius), outer],
        }
    }

    /// Width of the arc in the plane, m; 0 for a sharp edge.
    pub(crate) fn width(&self) -> f64 {
        let [inner, outer] = self.ends;
        outer - inner
    }

    /// Depth below the plane at a distance (m) from the middle, m; `slope` gives it where the recess falls off.
    pub(crate) fn depth(&self, distance: f64, slope: impl Fn(f64) -> f64) -> f64 {
        let [inner, outer] = self.ends;
        if distance >= outer {
            0.0
        } else if distance < inner {
            slope(distance)
        } else {
            sag(self.radius, outer - distance)
        }
    }

    /// Distance from a place to the ridge that the edge is, m: at least half the width of its rounding. An edge counts
    /// as sharp for a grid to which this is short, and not for one that resolves its arc.
    pub(crate) fn distance_to_ridge(&self, distance: f64) -> f64 {
        let [inner, outer] = self.ends;
        let from_middle = (distance - 0.5 * (inner + outer)).abs();
        from_middle.max(0.5 * self.width())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sag_is_that_of_a_circle() {
        assert_eq!([sag(5.0, 3.0), sag(5.0, -4.0)], [1.0, 2.0]);
        assert_eq!(
            [sag(5.0, 5.0), sag(5.0, 9.0), sag(0.0, 0.0)],
            [5.0, 5.0, 0.0]
        );
        // x²/2r for a flat circle, where the difference of lengths would lose ten digits.
        assert!((sag(1e5, 1e-3) / 5e-12 - 1.0).abs() < 1e-15);
    }

    /// The depth and the slope on both sides of the end on the slope.
    fn at_inner_end(rounding: Rounding, slope: impl Fn(f64) -> f64) -> [[f64; 2]; 2] {
        let ([at, _], by) = (rounding.ends, 1e-6);
        let depth = |x: f64| rounding.depth(x, &slope);
        [-by, by].map(|side| {
            let (near, far) = (depth(at + 1e-3 * side), depth(at + side));
            [near, (far - near) / side]
        })
    }

    #[test]
    fn the_arc_continues_walls_and_caps_without_a_kink() {
        // A cap of depth 1 and rim 3 belongs to a sphere of radius 5.
        let of_cap = Rounding::of_cap(0.7, [3.0, 1.0], 5.0);
        let cap = at_inner_end(of_cap, |r| 1.0 - sag(5.0, r));
        let angle = 0.5_f64.atan();
        let of_wall = Rounding::of_wall(0.7, 2.0, angle);
        let wall = at_inner_end(of_wall, |u| (2.0 - u) * 0.5);
        for [before, after] in [cap, wall] {
            assert!((before[0] - after[0]).abs() < 1e-8, "{before:?} {after:?}");
            // Curvatures of 1/0.7 over 1e-6.
            assert!((before[1] - after[1]).abs() < 1e-5, "{before:?} {after:?}");
        }
        for rounding in [of_cap, of_wall] {
            let outer = rounding.ends[1];
            assert_eq!(rounding.depth(outer, |_| 9.0), 0.0);
            // (1e-4)²/(2 · 0.7)
            let found = rounding.depth(outer - 1e-4, |_| 9.0);
            assert!((found / (1e-8 / 1.4) - 1.0).abs() < 1e-7, "{found}");
        }
    }

    #[test]
    fn an_arc_at_a_vertical_wall_is_a_quarter_of_a_circle() {
        let Rounding { ends, .. } = Rounding::of_wall(0.5, 2.0, std::f64::consts::FRAC_PI_2);
        assert!(
            (ends[0] - 2.0).abs() < 1e-15 && (ends[1] - 2.5).abs() < 1e-15,
            "{ends:?}"
        );
    }

    #[test]
    fn a_sharp_edge_is_a_ridge_and_a_round_one_is_as_far_as_half_its_width() {
        let sharp = Rounding::of_cap(0.0, [3.0, 1.0], 5.0);
        assert_eq!(
            [3.0, 2.5, 4.0].map(|r| sharp.distance_to_ridge(r)),
            [0.0, 0.5, 1.0]
        );
        let round = Rounding {
            radius: 1.0,
            ends: [2.0, 4.0],
        };
        assert_eq!(
            [3.0, 2.5, 6.0].map(|r| round.distance_to_ridge(r)),
            [1.0, 1.0, 3.0]
        );
    }
}
