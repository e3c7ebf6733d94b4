//! Shapes of rigid indenters: the height `f(x, y)` of the surface above its lowest point.
//!
//! The lowest point lies on the origin, where `f = 0`; elsewhere `f ≥ 0`, and `f = +∞` where the indenter ends. Only a
//! map may be left [where it is](IndenterMap::in_place). Lengths are in m, angles in radians; `ρ = √(x² + y²)`.
//!
//! | shape | height |
//! |---|---|
//! | [`Paraboloid`] | `ρ²/(2R)` |
//! | [`EllipticParaboloid`] | `x²/(2Rx) + y²/(2Ry)` |
//! | [`Sphere`] | `R − √(R² − ρ²)` up to `ρ = R` |
//! | [`Cone`] | `ρ cot α`, its tip a sphere that touches the side |
//! | [`PowerLaw`] | `ρⁿ/cⁿ⁻¹` with any exponent n from 1 |
//! | [`FlatPunch`] | 0 up to its radius |
//! | [`Plane`] | 0 everywhere |
//! | [`Pyramid`] | n equal faces, tip and ridges rounded with one radius |
//! | [`IndenterMap`] | measured samples and the smooth surface through them |
//! | [`Indenter::custom`] | any [`Profile`] of your own |
//!
//! ```
//! use pellicle_contact::{Indenter, Profile, Pyramid};
//!
//! // The blunted Berkovich pyramid of figure 5 of the paper: 400 nm.
//! let berkovich = Indenter::from(Pyramid::berkovich(400e-9)?);
//! // Near its lowest point it is a sphere: f = ρ²/2R (1 + ρ²/4R² + …), and ρ²/4R² = 2e-6 here.
//! let height = berkovich.height(1e-9, 0.5e-9);
//! let paraboloid = 1.25e-18 / (2.0 * 400e-9);
//! assert!((height / paraboloid - 1.0).abs() < 3e-6);
//! # Ok::<(), pellicle_contact::IndenterError>(())
//! ```

mod cone;
mod elliptic_paraboloid;
mod error;
mod flat_punch;
mod map;
mod paraboloid;
mod parameter;
mod plane;
mod power_law;
mod profile;
mod pyramid;
mod sphere;

pub use cone::Cone;
pub use elliptic_paraboloid::EllipticParaboloid;
pub use error::{IndenterError, IndenterQuantity};
pub use flat_punch::FlatPunch;
pub use map::IndenterMap;
pub use paraboloid::Paraboloid;
pub use plane::Plane;
pub use power_law::PowerLaw;
pub use profile::Profile;
pub use pyramid::Pyramid;
pub use sphere::Sphere;

use std::sync::Arc;

/// A rigid indenter of any of the known shapes.
#[derive(Clone, Debug, PartialEq)]
pub enum Indenter {
    /// `ρ²/(2R)`.
    Paraboloid(Paraboloid),
    /// `x²/(2Rx) + y²/(2Ry)`.
    EllipticParaboloid(EllipticParaboloid),
    /// A sphere up to its equator.
    Sphere(Sphere),
    /// A cone, sharp or with a spherical tip.
    Cone(Cone),
    /// `ρⁿ/cⁿ⁻¹`.
    PowerLaw(PowerLaw),
    /// The flat end of a circular cylinder.
    FlatPunch(FlatPunch),
    /// A plane without end.
    Plane(Plane),
    /// A regular pyramid, sharp or rounded.
    Pyramid(Pyramid),
    /// A measured surface.
    Map(IndenterMap),
    /// A user-defined shape.
    Custom(CustomProfile),
}

/// A user-defined shape, shared by all copies of an indenter; it equals only its copies.
#[derive(Clone, Debug)]
pub struct CustomProfile(Arc<dyn Profile>);

impl PartialEq for CustomProfile {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Indenter {
    /// An indenter of any shape.
    ///
    /// ```
    /// use pellicle_contact::{Indenter, Profile};
    ///
    /// /// `f = (ρ/R)⁴ R`, flatter at its tip than a paraboloid.
    /// #[derive(Debug)]
    /// struct Quartic {
    ///     radius: f64,
    /// }
    ///
    /// impl Profile for Quartic {
    ///     fn height(&self, x: f64, y: f64) -> f64 {
    ///         (x * x + y * y).powi(2) / self.radius.powi(3)
    ///     }
    ///
    ///     fn is_mirrored(&self) -> bool {
    ///         true
    ///     }
    /// }
    ///
    /// let indenter = Indenter::custom(Quartic { radius: 2.0 });
    /// assert_eq!(indenter.height(1.0, 1.0), 0.5); // 2² / 2³
    /// ```
    #[must_use]
    pub fn custom(shape: impl Profile + 'static) -> Self {
        Self::Custom(CustomProfile(Arc::new(shape)))
    }

    /// The shape in this variant.
    fn shape(&self) -> &dyn Profile {
        match self {
            Self::Paraboloid(shape) => shape,
            Self::EllipticParaboloid(shape) => shape,
            Self::Sphere(shape) => shape,
            Self::Cone(shape) => shape,
            Self::PowerLaw(shape) => shape,
            Self::FlatPunch(shape) => shape,
            Self::Plane(shape) => shape,
            Self::Pyramid(shape) => shape,
            Self::Map(shape) => shape,
            Self::Custom(shape) => &*shape.0,
        }
    }

    /// Whether the shape is symmetric in x and y; false for every map and for pyramids with an odd number of faces.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        match self {
            Self::Paraboloid(_)
            | Self::EllipticParaboloid(_)
            | Self::Sphere(_)
            | Self::Cone(_)
            | Self::PowerLaw(_)
            | Self::FlatPunch(_)
            | Self::Plane(_) => true,
            Self::Pyramid(pyramid) => pyramid.faces().is_multiple_of(2),
            Self::Map(_) => false,
            Self::Custom(shape) => shape.0.is_mirrored(),
        }
    }

    /// Whether `f(x, y) = f(x, −y)`; also true for every pyramid, since one of its ridges runs along x.
    #[must_use]
    pub fn is_mirrored_in_y(&self) -> bool {
        self.is_mirrored() || matches!(self, Self::Pyramid(_))
    }

    /// Slope of the faces or the side of a pyramid or a cone, the same at every depth beyond a rounded tip; none for
    /// shapes that are not self-similar.
    #[must_use]
    pub fn self_similar_slope(&self) -> Option<f64> {
        let half_angle = match self {
            Self::Cone(cone) => cone.half_angle(),
            Self::Pyramid(pyramid) => pyramid.face_angle(),
            _ => return None,
        };
        Some(half_angle.tan().recip())
    }

    /// Height f(x, y), m; see [`Profile::height`].
    #[must_use]
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.shape().height(x, y)
    }

    /// Average height over a circle, m; see [`Profile::mean_profile`].
    #[must_use]
    pub fn mean_profile(&self, radius: f64) -> f64 {
        self.shape().mean_profile(radius)
    }
}

impl Profile for Indenter {
    fn height(&self, x: f64, y: f64) -> f64 {
        self.shape().height(x, y)
    }

    fn heights(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.shape().heights(points)
    }

    fn mean_profile(&self, radius: f64) -> f64 {
        self.shape().mean_profile(radius)
    }

    fn mean_slope(&self, radius: f64) -> f64 {
        self.shape().mean_slope(radius)
    }

    fn is_mirrored(&self) -> bool {
        self.is_mirrored()
    }

    fn distance_to_rim(&self, x: f64, y: f64) -> f64 {
        self.shape().distance_to_rim(x, y)
    }

    fn distance_to_edge(&self, x: f64, y: f64, scale: f64) -> f64 {
        self.shape().distance_to_edge(x, y, scale)
    }
}

impl From<Paraboloid> for Indenter {
    fn from(shape: Paraboloid) -> Self {
        Self::Paraboloid(shape)
    }
}

impl From<EllipticParaboloid> for Indenter {
    fn from(shape: EllipticParaboloid) -> Self {
        Self::EllipticParaboloid(shape)
    }
}

impl From<Sphere> for Indenter {
    fn from(shape: Sphere) -> Self {
        Self::Sphere(shape)
    }
}

impl From<Cone> for Indenter {
    fn from(shape: Cone) -> Self {
        Self::Cone(shape)
    }
}

impl From<PowerLaw> for Indenter {
    fn from(shape: PowerLaw) -> Self {
        Self::PowerLaw(shape)
    }
}

impl From<FlatPunch> for Indenter {
    fn from(shape: FlatPunch) -> Self {
        Self::FlatPunch(shape)
    }
}

impl From<Plane> for Indenter {
    fn from(shape: Plane) -> Self {
        Self::Plane(shape)
    }
}

impl From<Pyramid> for Indenter {
    fn from(shape: Pyramid) -> Self {
        Self::Pyramid(shape)
    }
}

impl From<IndenterMap> for Indenter {
    fn from(shape: IndenterMap) -> Self {
        Self::Map(shape)
    }
}

#[cfg(test)]
mod tests;
