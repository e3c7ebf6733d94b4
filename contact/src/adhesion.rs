//! Adhesion of axisymmetric contacts on layered bodies.
//!
//! Two laws, both with one number, the work of adhesion w (J/m²):
//!
//! **JKR** (K. L. Johnson, K. Kendall and A. D. Roberts 1971): adhesion acts within the contact. Let `F₀(a)`, `D₀(a)`
//! be the contact without adhesion whose radius is a, and `S(a)` its stiffness, that of a flat punch. Pulled back by δ
//! at constant a, it releases the energy `½ δ² dS/dA` per area that the contact loses. In equilibrium this is w, so
//!
//! ```text
//! F = F₀ − S δ      D = D₀ − δ      δ = √(2 w dA/dS) = √(4π a w/(dS/da))
//! ```
//!
//! **DMT** (B. V. Derjaguin, V. M. Muller and Y. P. Toporov 1975): adhesion acts outside, on undeformed shapes. It
//! pulls a paraboloid or sphere with `2π w R`; shape, pressure and penetration are those without adhesion under the
//! force `F + 2π w R`.
//!
//! A film of linear springs between the bodies ([`AxisymmetricElasticity::with_springs`]) is stretched at the edge of a
//! JKR contact, and releases its energy there; the formulas are the same.
//!
//! [`AxisymmetricElasticity::with_springs`]: crate::axisymmetric::AxisymmetricElasticity::with_springs
//!
//! Which of both holds is told by [Tabor's number](AdhesiveCurve::tabor_number).
//!
//! **Coming into contact and out of it.** Neither law attracts at a distance: the surfaces meet at `D = 0` with no
//! force. There a JKR contact jumps in, under a prescribed penetration to the radius at `D = 0` (F < 0), under a
//! prescribed force to that at `F = 0` (D > 0). On the way out it follows the same curve further, to the least force or
//! the least penetration, whichever is prescribed, and jumps out. The work lost between is that of the loop. A DMT
//! contact comes in and goes out at `D = 0`.

mod contact;
mod curve;
mod law;
mod turns;

pub use contact::{Adhesion, AdhesiveContact};
pub use curve::AdhesiveCurve;
pub use law::{ADHESION_RANGE, AdhesionLaw, TaborRange};

#[cfg(test)]
mod tests;
