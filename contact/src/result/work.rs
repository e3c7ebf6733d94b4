//! The work of a solution, counted in products with `K`.

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

/// Work of one loading step.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Work {
    /// Iterations on the finest grid.
    pub iterations: usize,
    /// Products with `K` on the finest grid, including those of the certificate.
    ///
    /// A product on a region that holds the contact counts as one.
    pub operator_applications: usize,
    /// Products on the finest grid for the contact stiffness, in addition to those for the solution; not stored.
    #[serde(skip)]
    pub stiffness_applications: usize,
    /// Products among the candidates of a dilute contact on the finest grid, each a small part of a full one; not
    /// stored.
    #[serde(skip)]
    pub candidate_applications: usize,
    /// Wall-clock time of the step on all its grids, in s.
    #[serde(deserialize_with = "nan_from_null")]
    pub seconds: f64,
    /// Work per grid level, coarsest first, the finest included.
    pub levels: Vec<LevelWork>,
}

/// Work on one grid level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct LevelWork {
    /// Elements per side.
    pub elements: usize,
    /// Iterations.
    pub iterations: usize,
    /// Products with `K`.
    pub operator_applications: usize,
    /// Products with `K` for the contact stiffness; not stored.
    #[serde(skip)]
    pub stiffness_applications: usize,
    /// Products among the candidates of a dilute contact; not stored.
    #[serde(skip)]
    pub candidate_applications: usize,
}
