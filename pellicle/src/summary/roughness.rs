//! The roughness of the maps of a case, in a summary.

use pellicle_texture::{MapRim, Roughness};
use serde::{Deserialize, Serialize};

use crate::case::Case;
use crate::case::grid::BoundaryCase;
use crate::case::map::MapCase;

/// The roughness of the maps of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoughnessSummary {
    /// Roughness of the surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<Roughness>,
    /// Roughness of the indenter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub indenter: Option<Roughness>,
}

impl RoughnessSummary {
    /// Computes the roughness of the maps of a case; none if it has no maps.
    #[must_use]
    pub fn of(case: &Case) -> Option<Self> {
        let rim = match case.grid.boundary {
            BoundaryCase::Free => MapRim::Ends,
            BoundaryCase::Periodic => MapRim::Repeats,
        };
        let roughness = |map: &MapCase| Roughness::of(map.own(), rim);
        let [surface, indenter] =
            [case.surface.map(), case.indenter.map()].map(|map| map.map(roughness));
        (surface.is_some() || indenter.is_some()).then_some(Self { surface, indenter })
    }

    /// The existing maps, with the names of their tables in a case.
    pub fn maps(&self) -> impl Iterator<Item = (&'static str, &Roughness)> {
        let maps = [("surface", &self.surface), ("indenter", &self.indenter)];
        maps.into_iter()
            .filter_map(|(name, map)| Some((name, map.as_ref()?)))
    }
}
