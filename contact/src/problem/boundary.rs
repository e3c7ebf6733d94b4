//! The surroundings of the square.

/// The boundary condition of a square domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// The surface goes on without load.
    #[default]
    Free,
    /// The square repeats itself.
    Periodic,
}
