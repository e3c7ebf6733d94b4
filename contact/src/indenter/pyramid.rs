//! Regular pyramids with one radius for tip and ridges: the shape, its derivation and the standard face angles.

use std::f64::consts::PI;

use super::Profile;
use super::cone::root_minus_one;
use super::error::{IndenterError, IndenterQuantity, acute, not_negative};
use super::sphere::{cap_height, half_chord};

/// A regular pyramid, one ridge along +x, with tip and ridges sharp or rounded with one radius.
///
/// # Shape
///
/// With n faces at the angle α to the axis, the sharp pyramid is `f = m max_k n_k·x`, `m = cot α`, where `n_k` are the
/// horizontal directions in which the faces rise. A sphere and a plane touch in one point only, so a cap and flat faces
/// alone cannot meet smoothly: another surface must join them. The body used here is the smallest convex one that
/// contains the tip sphere, radius R, and opens like the pyramid: a sharp pyramid with a ball of radius R about each of
/// its points (a Minkowski sum). Its lower surface is the upper envelope of all planes that touch the sphere and whose
/// slope s is that of a supporting plane of the pyramid,
///
/// ```text
/// f(x) = max over s in P of  s·x − R (√(1 + |s|²) − 1),      P the polygon with the corners m n_k
/// ```
///
/// As a maximum of planes f is convex; as the conjugate of a strictly convex function it is C¹ everywhere (its
/// curvature at most `1/(R sin³ α)`), and `R → 0` gives the sharp pyramid. Let u ≥ 0 be the distance from the axis
/// along the nearest ridge, v ≥ 0 the distance across it, `c = m cos(π/n)` the slope of a ridge, `q = √(1 + c²)` and
/// `w = √(R² − v²)`. The maximum lies
///
/// ```text
/// inside P           the sphere        f = ρ²/(R + √(R² − ρ²))             v < v₁ and q u < c w
/// on an edge of P    a round ridge     f = c u − R (q − 1) + q v²/(R + w)  v < v₁ and q u ≥ c w
/// in a corner of P   a flat face       f = m (u cos(π/n) + v sin(π/n)) − R (1/sin α − 1)   v ≥ v₁ = R cos α sin(π/n)
/// ```
///
/// A ridge is a cylinder of radius R whose axis runs parallel to it; the faces are those of the sharp pyramid with its
/// apex at the depth `R (1/sin α − 1)` below the tip, the same as for a [`Cone`](super::Cone), to which the pyramid
/// tends with growing n.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    face_angle: f64,
    tip_radius: f64,
    /// Horizontal directions of the ridges.
    ridges: Vec<[f64; 2]>,
    slopes: Slopes,
}

/// Constants of the angles, computed once: recomputing them for every height took four fifths of a solution's time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Slopes {
    /// `sin(π/n)` and `cos(π/n)`.
    half_sector: [f64; 2],
    /// `m = cot α`, of a face.
    face: f64,
    /// `c = m cos(π/n)`, of a ridge.
    ridge: f64,
    /// `q = √(1 + c²)`.
    stretch: f64,
    /// `v₁ = R cos α sin(π/n)`, the half-width of a round ridge, in m.
    rounded: f64,
    /// `R (√(1 + m²) − 1)` and `R (√(1 + c²) − 1)`: depths (m) of face and ridge below those of the sharp pyramid.
    drops: [f64; 2],
}

impl Slopes {
    fn new(faces: usize, face_angle: f64, tip_radius: f64) -> Self {
        let (sine, cosine) = (PI / faces as f64).sin_cos();
        let face = face_angle.tan().recip();
        let ridge = face * cosine;
        Self {
            half_sector: [sine, cosine],
            face,
            ridge,
            stretch: 1.0_f64.hypot(ridge),
            rounded: tip_radius * face_angle.cos() * sine,
            drops: [face, ridge].map(|slope| tip_radius * root_minus_one(slope)),
        }
    }
}

/// Nodes in the interval from 0 to 1 and weights of the three-point Gauss rule.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_31, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

impl Pyramid {
    /// Face angle of the Berkovich pyramid, 65.03°: three faces with the Vickers ratio of true surface area to depth².
    ///
    /// The angle of the original (E. S. Berkovich, Zavodskaya Laboratoriya 16, 1950, 345–347).
    pub const BERKOVICH_FACE_ANGLE: f64 = 65.03_f64.to_radians();

    /// Face angle of the modified Berkovich pyramid, 65.27°: three faces with the Vickers ratio of projected area to
    /// depth², 24.50.
    pub const MODIFIED_BERKOVICH_FACE_ANGLE: f64 = 65.27_f64.to_radians();

    /// Face angle of the Vickers pyramid, 68°: half the angle of 136° between opposite faces.
    pub const VICKERS_FACE_ANGLE: f64 = 68.0_f64.to_radians();

    /// Face angle of the corner of a cube, `arctan(1/√2)` = 35.264°, often rounded to 35.26°.
    pub const CUBE_CORNER_FACE_ANGLE: f64 = 0.615_479_708_670_387_3;

    /// The fewest faces that enclose a body.
    pub const FEWEST_FACES: usize = 3;

    /// The most faces: a pyramid of 360 differs from a cone by less than 4e-5 of its height.
    pub const MOST_FACES: usize = 360;

    /// A pyramid with `faces` equal faces at the angle `face_angle` (rad) to its axis, and the radius `tip_radius` (m)
    /// of its tip and ridges, 0 for sharp ones.
    ///
    /// # Errors
    ///
    /// [`IndenterError::FaceCount`] if there are fewer than 3 or more than 360 faces, [`IndenterError::Angle`] if the
    /// face angle does not lie in (0, π/2), [`IndenterError::Negative`] if the tip radius is negative or not finite.
    pub fn new(faces: usize, face_angle: f64, tip_radius: f64) -> Result<Self, IndenterError> {
        let (least, most) = (Self::FEWEST_FACES, Self::MOST_FACES);
        if !(least..=most).contains(&faces) {
            return Err(IndenterError::FaceCount {
                found: faces,
                least,
                most,
            });
        }
        let face_angle = acute(IndenterQuantity::FaceAngle, face_angle)?;
        let tip_radius = not_negative(IndenterQuantity::TipRadius, tip_radius)?;
        let direction = |k: usize| (2.0 * PI * k as f64 / faces as f64).sin_cos();
        let ridges = (0..faces)
            .map(direction)
            .map(|(sine, cosine)| [cosine, sine])
            .collect();
        Ok(Self {
            face_angle,
            tip_radius,
            ridges,
            slopes: Slopes::new(faces, face_angle, tip_radius),
        })
    }

    /// The Berkovich pyramid at 65.03° with the given tip radius (m).
    ///
    /// # Errors
    ///
    /// [`IndenterError::Negative`] if the tip radius is negative or not finite.
    pub fn berkovich(tip_radius: f64) -> Result<Self, IndenterError> {
        Self::new(3, Self::BERKOVICH_FACE_ANGLE, tip_radius)
    }

    /// The modified Berkovich pyramid at 65.27° with the given tip radius (m).
    ///
    /// # Errors
    ///
    /// [`IndenterError::Negative`] if the tip radius is negative or not finite.
    pub fn modified_berkovich(tip_radius: f64) -> Result<Self, IndenterError> {
        Self::new(3, Self::MODIFIED_BERKOVICH_FACE_ANGLE, tip_radius)
    }

    /// The Vickers pyramid with the given tip radius (m).
    ///
    /// # Errors
    ///
    /// [`IndenterError::Negative`] if the tip radius is negative or not finite.
    pub fn vickers(tip_radius: f64) -> Result<Self, IndenterError> {
        Self::new(4, Self::VICKERS_FACE_ANGLE, tip_radius)
    }

    /// The corner of a cube with the given tip radius (m).
    ///
    /// # Errors
    ///
    /// [`IndenterError::Negative`] if the tip radius is negative or not finite.
    pub fn cube_corner(tip_radius: f64) -> Result<Self, IndenterError> {
        Self::new(3, Self::CUBE_CORNER_FACE_ANGLE, tip_radius)
    }

    /// Number of faces n.
    #[must_use]
    pub fn faces(&self) -> usize {
        self.ridges.len()
    }

    /// Angle α between the axis and the faces, rad.
    #[must_use]
    pub fn face_angle(&self) -> f64 {
        self.face_angle
    }

    /// Radius R of tip and ridges, m; 0 for sharp ones.
    #[must_use]
    pub fn tip_radius(&self) -> f64 {
        self.tip_radius
    }

    /// Distances along (u) and across (v) the nearest ridge.
    fn ridge_coordinates(&self, x: f64, y: f64) -> (f64, f64) {
        let along_and_across =
            |[cosine, sine]: &[f64; 2]| (x * cosine + y * sine, (y * cosine - x * sine).abs());
        let candidates = self.ridges.iter().map(along_and_across);
        candidates
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0.0))
    }

    /// Height at the distances u along and v across a ridge.
    fn height_at(&self, (along, across): (f64, f64)) -> f64 {
        let Slopes {
            half_sector: [sine, cosine],
            face,
            ridge,
            stretch,
            rounded,
            drops: [of_face, of_ridge],
        } = self.slopes;
        let radius = self.tip_radius;
        // A face: f = m (u cos(π/n) + v sin(π/n)) − R (√(1 + m²) − 1), beyond v₁.
        if across >= rounded {
            return face * (along * cosine + across * sine) - of_face;
        }
        let chord = half_chord(radius, across);
        // The sphere: its slope towards the ridge, u/√(R² − ρ²), is below that of the ridge.
        if stretch * along < ridge * chord {
            return cap_height(radius, along.hypot(across));
        }
        // A ridge: f = c u − R (q − 1) + q v²/(R + w).
        ridge * along - of_ridge + stretch * cap_height(radius, across)
    }

    /// The arcs of a circle between a ridge and the middle of a face.
    fn arcs(&self, radius: f64) -> Arcs {
        let Slopes {
            half_sector: [sine, _],
            ridge,
            stretch,
            rounded,
            ..
        } = self.slopes;
        let sector = PI / self.faces() as f64;
        let angle_of = |across: f64| {
            if across < sine * radius {
                (across / radius).asin()
            } else {
                sector
            }
        };
        let round = angle_of(rounded);
        // The sphere ends at q u = c w: v² = q² ρ² − c² R².
        let [far, near] = [stretch * radius, ridge * self.tip_radius];
        let ridge = if far > near {
            angle_of(((far - near) * (far + near)).sqrt()).min(round)
        } else {
            0.0
        };
        Arcs {
            ridge,
            sphere: round - ridge,
            face: sector - round,
            sector,
        }
    }
}

/// Angles of a circle that the parts of the surface occupy, starting from a ridge.
struct Arcs {
    ridge: f64,
    sphere: f64,
    face: f64,
    /// Sum of the three.
    sector: f64,
}

impl Arcs {
    /// `∫ f(sin θ) dθ` over the ridge: by the three-point Gauss rule.
    fn over_ridge(&self, function: impl Fn(f64) -> f64) -> f64 {
        if self.ridge == 0.0 {
            return 0.0;
        }
        let terms = GAUSS.map(|[place, weight]| weight * function((place * self.ridge).sin()));
        self.ridge * terms.iter().sum::<f64>()
    }

    /// The mean from the parts of an integral over the angle; a part is 0 if its arc is.
    fn mean(&self, of_ridge: f64, of_sphere: impl Fn() -> f64, of_face: f64) -> f64 {
        let of_sphere = if self.sphere > 0.0 {
            self.sphere * of_sphere()
        } else {
            0.0
        };
        (of_ridge + of_sphere + of_face) / self.sector
    }
}

impl Profile for Pyramid {
    fn height(&self, x: f64, y: f64) -> f64 {
        self.height_at(self.ridge_coordinates(x, y))
    }

    fn mean_profile(&self, radius: f64) -> f64 {
        if radius == 0.0 {
            return 0.0;
        }
        let Slopes {
            face,
            ridge,
            stretch,
            drops: [below_face, below_ridge],
            ..
        } = self.slopes;
        let arcs = self.arcs(radius);
        let caps = arcs.over_ridge(|sine| cap_height(self.tip_radius, radius * sine));
        // ∫ (c ρ cos θ − R (q − 1) + q (R − w)) dθ
        let of_ridge =
            ridge * radius * arcs.ridge.sin() - below_ridge * arcs.ridge + stretch * caps;
        // ∫ (m ρ cos(π/n − θ) − R (√(1 + m²) − 1)) dθ
        let of_face = face * radius * arcs.face.sin() - below_face * arcs.face;
        arcs.mean(of_ridge, || cap_height(self.tip_radius, radius), of_face)
    }

    fn mean_slope(&self, radius: f64) -> f64 {
        let Slopes {
            face,
            ridge,
            stretch,
            ..
        } = self.slopes;
        let (tip, arcs) = (self.tip_radius, self.arcs(radius));
        // ∫ (c cos θ + q ρ sin² θ/w) dθ
        let caps = arcs.over_ridge(|sine| sine * sine / half_chord(tip, radius * sine));
        let of_ridge = ridge * arcs.ridge.sin() + stretch * radius * caps;
        let of_face = face * arcs.face.sin();
        arcs.mean(of_ridge, || radius / half_chord(tip, radius), of_face)
    }

    fn distance_to_edge(&self, x: f64, y: f64, scale: f64) -> f64 {
        // A ridge is rounded up to v = R cos α sin(π/n), the tip farther.
        let (_, across) = self.ridge_coordinates(x, y);
        if self.slopes.rounded < 2.0 * scale {
            across
        } else {
            f64::INFINITY
        }
    }
}

#[cfg(test)]
mod tests;
