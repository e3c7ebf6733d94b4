//! The shortcuts of a path to a solution, each of which a test can switch off.

/// What spares a path work without changing its solution: the certificate judges every solution in the same way. All
/// are on by default; [`SolverOptions::mirror_symmetry`](crate::SolverOptions::mirror_symmetry) is another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is switched by itself, and none excludes another"
)]
pub struct Shortcuts {
    /// Coarser grids are solved first, from which the finest starts. Without them there is no error of the grid.
    pub coarser_grids: bool,
    /// The first grid starts from the closed form of a smooth contact.
    pub guess: bool,
    /// A solution is sought on the smallest square that holds the contact.
    pub windows: bool,
    /// A dilute contact is sought among a few candidates.
    pub candidates: bool,
    /// The fields of the last load on a grid are kept for the next.
    pub memory: bool,
    /// The filter's result is forced to vanish in a band around the contact.
    pub edge_band: bool,
    /// The system is factorised approximately where the filter is poor: under stiff coatings, and where steps stall.
    pub sparse_factor: bool,
}

impl Shortcuts {
    /// All of them.
    pub const ALL: Self = Self::each(true);
    /// None of them.
    pub const NONE: Self = Self::each(false);

    const fn each(on: bool) -> Self {
        Self {
            coarser_grids: on,
            guess: on,
            windows: on,
            candidates: on,
            memory: on,
            edge_band: on,
            sparse_factor: on,
        }
    }
}

impl Default for Shortcuts {
    fn default() -> Self {
        Self::ALL
    }
}
