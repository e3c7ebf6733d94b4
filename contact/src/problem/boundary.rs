//! The surroundings of the square.

/// What lies around the square.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// The surface goes on without load.
    #[default]
    Free,
    /// The square repeats itself.
    Periodic,
}
