//! Shapes of rigid indenters: the height `f(x, y)` of the surface above its lowest point.
//!
//! The lowest point lies on the origin, where `f = 0`; elsewhere `f ≥ 0`, and `f = +∞` where the indenter ends. Lengths are in
//! m, angles in radians; `ρ = √(x² + y²)`.
//!
//! | shape | height |
//! |---|---|
//! | [`Paraboloid`] | `ρ²/(2R)` |
//! | [`Sphere`] | `R − √(R² − ρ²)` up to `ρ = R` |
//! | [`Cone`] | `ρ cot α`, its tip a sphere that touches the side |
//! | [`FlatPunch`] | 0 up to its radius |
//! | [`Pyramid`] | n equal faces, tip and ridges rounded with one radius |
//! | [`IndenterMap`] | measured samples and the smooth surface through them |
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

mod any;
mod cone;
mod error;
mod flat_punch;
mod map;
mod paraboloid;
mod profile;
mod pyramid;
mod sphere;

pub use any::Indenter;
pub use cone::Cone;
pub use error::{IndenterError, IndenterQuantity};
pub use flat_punch::FlatPunch;
pub use map::IndenterMap;
pub use paraboloid::Paraboloid;
pub use profile::Profile;
pub use pyramid::Pyramid;
pub use sphere::Sphere;
