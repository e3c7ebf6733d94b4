//! The boundary condition of the domain.

/// The boundary condition of a square domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// The surface continues without load.
    #[default]
    Free,
    /// The square repeats periodically.
    Periodic,
}
