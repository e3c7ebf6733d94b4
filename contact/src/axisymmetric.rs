//! Axisymmetric contact without a grid, by Fredholm's integral equation of the second kind, as solved by W. C. Hayes
//! and others (1972) for a layer on a rigid base.
//!
//! The pressure is written as waves whose transform is `p̅(k) = E*/2 ∫₀ᵃ g(t) cos kt dt`, with `E*` of the surfaces in
//! contact: of the topmost layer, and of an elastic indenter in series. On half-spaces each `g(t)` deforms the surface
//! only within the circle t; layers add a smooth kernel, with `Φ` the compliance of both bodies over its limit for
//! short waves:
//!
//! ```text
//! g(x) + 1/π ∫₀ᵃ g(t) (M(x + t) + M(x − t)) dt = 2/π (D − d(x))      M(y) = ∫ (Φ(k) − 1) cos ky dk
//! ```
//!
//! where `d(x)` is the penetration that the indenter's shape needs on a half-space for the contact radius x; see
//! [`AxisymmetricProfile`]. The pressure is finite at the edge if `g(a) = 0`, which gives `D`. With `g₁` the solution
//! for a flat punch of unit penetration:
//!
//! ```text
//! F = π E* ∫ g dt      S = π E* ∫ g₁ dt      dS/da = π²/2 E* g₁(a)²      U = π²/4 E* ∫ g 2/π (D − d) dt
//! ```
//!
//! The third follows from the first line: its derivative by `a` is `−1/π (M(x + a) + M(x − a)) g₁(a)`, and the
//! equation's operator is symmetric.

mod contact;
mod elasticity;
mod equation;
mod film_equation;
mod layer_kernel;
mod pressure;
mod profile;
pub mod quadrature;

pub use contact::{AxisymmetricContact, PunchContact, punch_stiffness};
pub use elasticity::AxisymmetricElasticity;
pub use pressure::AxisymmetricPressure;
pub use profile::AxisymmetricProfile;

#[cfg(test)]
mod tests;
