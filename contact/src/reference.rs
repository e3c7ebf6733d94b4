//! Closed forms: contact of axisymmetric indenters and of elliptic paraboloids with a homogeneous half-space, and with
//! a Winkler foundation.
//!
//! Each module holds one struct with the numbers of a contact and one function for each way to specify it. The elastic
//! half-space enters only through its plane-strain modulus `E* = E/(1 − ν²)` (Pa), because the indenter is rigid.
//! Lengths, forces and pressures are in SI or any consistent system. The functions do not check their arguments: for
//! positive ones they are exact to rounding, for others they return what the formula gives.
//!
//! All contacts with the half-space obey `dQ/dD = 2 E* a`, all contacts `dU/dD = Q` and `U = ½ ∫ p (D − f) dA`, with
//! force Q, penetration D, contact radius a and stored energy U; the tests check all of them against these.
//!
//! Sources: I. N. Sneddon, Int. J. Eng. Sci. 3, 1965, 47–57 (cone, punch, sphere, power law); K. L. Johnson, Contact
//! Mechanics, 1985 (Hertz).

pub mod cone;
pub mod elliptic_hertz;
pub mod flat_punch;
pub mod hertz;
pub mod hertz_stress;
pub mod power_law;
pub mod sphere;
pub mod winkler;

#[cfg(test)]
mod identities;
