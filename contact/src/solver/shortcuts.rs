//! The shortcuts of a path to a solution, each of which a test can switch off.

/// What spares a path work without changing its solution: the certificate judges every solution in the same way. All
/// are on by default; [`SolverOptions::mirror_symmetry`](crate::SolverOptions::mirror_symmetry) is another.
///
/// | without | processor time, where it matters most | elsewhere |
/// |---|---|---|
/// | coarser grids | 6.6 times for 0.1 % of a rough surface in contact, 1.1 times for 20 %, N = 1024 | 1 to 4 times |
/// | guess | 1.2 times for 250 loads at N = 32 | 1.05 times at N = 128, 1 above |
/// | windows | 3.5 times for Hertz and rigid pillars, N = 1024 | 1 where the contact fills the square |
/// | candidates | 2.4 times for 0.1 % of a rough surface in contact, N = 1024 | 1 |
/// | memory | 1.5 to 1.7 times for 250 loads at N = 32 | 1.2 to 1.4 times at N = 128, 1 for one load |
/// | edge band | 1.1 times for 20 % of a rough surface in contact, with 1.7 times the products | 0.7 times in a cell |
/// | sparse factor | 4.5 times for a rough coating 100 times as stiff as its base, N = 256 | 1 up to a contrast of 2 |
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
