//! Warnings about a result that is otherwise sound.

mod words;

use pellicle_influence::ElasticBody;

use crate::{ContactSlope, CutOff, LimitRatio, PeakPlace, UnresolvedArc, UnresolvedNumbers};

/// A warning about the model or the grid, with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// The contact comes close to the edge of the domain, so pressure may be cut off.
    DomainEdge {
        /// Loading step, counted from 0.
        step: usize,
        /// Whole elements between the contact and the edge.
        elements: usize,
    },
    /// The contact is cut off: it would continue beyond the domain or a map.
    CutOff {
        /// Loading step, counted from 0.
        step: usize,
        /// The limit.
        by: CutOff,
    },
    /// Every contact of the path is only a small part of the domain.
    DomainMuchLarger {
        /// Elements across the widest contact.
        elements: usize,
        /// Its radius, in m: as found, or as estimated where it is too small for the grid.
        radius: f64,
        /// Side of the domain, in m.
        side: f64,
        /// A side to choose instead, in m.
        wanted: f64,
    },
    /// The linear springs of the relief shorten by more than their height.
    FilmShortening {
        /// Loading step, counted from 0.
        step: usize,
        /// Largest shortening over height.
        times: f64,
    },
    /// A part of the contact does not wear, or no longer.
    WornThrough {
        /// Loading step, counted from 0.
        step: usize,
        /// Its area, m².
        area: f64,
    },
    /// Few elements per radius of a cylinder or a dimple, or per half width of a groove.
    TextureUnderResolved {
        /// Elements per radius.
        elements_per_radius: f64,
    },
    /// Recesses in the body's own surface are as deep as they are wide, or nearly so.
    DeepRecesses {
        /// Depth over half the width.
        slope: f64,
    },
    /// Few elements to the shortest wave of the gap under a measured map: the grid misses summits, and none of its
    /// numbers is resolved.
    MapUnderResolved {
        /// Loading step, counted from 0.
        step: usize,
        /// Elements to the shortest wave.
        elements_per_wave: f64,
        /// Elements per side that would be enough.
        wanted: usize,
    },
    /// A layer much thinner than an element, whose own stiffness the grid cannot resolve.
    LayerUnderResolved {
        /// The body that has the layer.
        of: ElasticBody,
        /// Layer, counted from the surface, from 0.
        layer: usize,
        /// Thickness over the side of an element.
        elements_per_thickness: f64,
    },
    /// The influence coefficients are less accurate than wanted; all numbers are uncertain by about as much.
    CoefficientAccuracy {
        /// Estimated error, relative to the largest coefficient.
        found: f64,
        /// Error wanted.
        wanted: f64,
    },
    /// The largest pressure is not that of the continuum: it is at an edge, where it grows with the grid, or it still
    /// changes.
    PeakNotResolved {
        /// Loading step, counted from 0.
        step: usize,
        /// Relative change of the largest pressure from the previous grid.
        change: f64,
        /// The place of the largest pressure.
        place: PeakPlace,
        /// The arcs that round the edges of the relief, if there are any and the grid does not resolve them.
        arc: Option<UnresolvedArc>,
    },
    /// A positive penetration at which nothing is in contact, the first of them.
    NothingTouches {
        /// Loading step, counted from 0.
        step: usize,
        /// The penetration, m.
        penetration: f64,
    },
    /// A path on a single grid: no number has an error.
    NoGridError {
        /// Elements along its longer side.
        elements: usize,
    },
    /// Numbers other than the largest pressure still change from grid to grid, or there are only two grids.
    NotResolved {
        /// Loading step, counted from 0.
        step: usize,
        /// These numbers.
        numbers: UnresolvedNumbers,
    },
    /// The edges of the relief are arcs that the grid does not resolve: pressures there are those of sharp ones.
    ArcUnderResolved(UnresolvedArc),
    /// The surfaces in contact are steep, beyond small strains.
    SteepIndenter {
        /// Loading step, counted from 0.
        step: usize,
        /// Their slope.
        slope: ContactSlope,
    },
    /// A self-similar indenter, steep at every depth, is in contact beyond its rounded tip.
    SteepTip {
        /// Slope of its faces or its side.
        slope: f64,
    },
    /// A layer is shortened by a sizeable part of its thickness.
    LayerShortening {
        /// Loading step, counted from 0.
        step: usize,
        /// The body that has the layer.
        of: ElasticBody,
        /// Layer, counted from the surface, from 0.
        layer: usize,
        /// Its largest shortening over its thickness.
        part: f64,
    },
    /// A layer is worn by a sizeable part of its thickness, and solved as whole.
    LayerWorn {
        /// Loading step, counted from 0.
        step: usize,
        /// The body that has the layer, on top.
        of: ElasticBody,
        /// The largest depth of wear over its thickness.
        part: f64,
    },
    /// A number is impossible: linear elasticity does not describe such a contact.
    BeyondModel {
        /// Loading step, counted from 0.
        step: usize,
        /// The number farthest beyond its limit.
        beyond: LimitRatio,
    },
    /// A step did not reach its tolerance.
    NotConverged {
        /// Loading step, counted from 0.
        step: usize,
        /// Largest line of the certificate.
        worst: f64,
        /// Bound wanted.
        tolerance: f64,
    },
}

impl Warning {
    /// Returns a short, stable name for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::DomainEdge { .. } => "domain-edge",
            Self::CutOff { .. } => "cut-off",
            Self::DomainMuchLarger { .. } => "domain-much-larger",
            Self::FilmShortening { .. } => "film-shortening",
            Self::WornThrough { .. } => "worn-through",
            Self::DeepRecesses { .. } => "deep-recesses",
            Self::TextureUnderResolved { .. } => "texture-under-resolved",
            Self::MapUnderResolved { .. } => "map-under-resolved",
            Self::LayerUnderResolved { .. } => "layer-under-resolved",
            Self::CoefficientAccuracy { .. } => "coefficient-accuracy",
            Self::PeakNotResolved { .. } => "peak-not-resolved",
            Self::NothingTouches { .. } => "nothing-touches",
            Self::NoGridError { .. } => "no-grid-error",
            Self::NotResolved { .. } => "not-resolved",
            Self::ArcUnderResolved(_) => "arc-under-resolved",
            Self::SteepIndenter { .. } | Self::SteepTip { .. } => "steep-indenter",
            Self::LayerShortening { .. } => "layer-shortening",
            Self::LayerWorn { .. } => "layer-worn",
            Self::BeyondModel { .. } => "beyond-model",
            Self::NotConverged { .. } => "not-converged",
        }
    }

    /// The loading step concerned, counted from 0; none if the warning concerns the whole path.
    #[must_use]
    pub fn step(&self) -> Option<usize> {
        match self {
            Self::DomainEdge { step, .. }
            | Self::CutOff { step, .. }
            | Self::FilmShortening { step, .. }
            | Self::WornThrough { step, .. }
            | Self::MapUnderResolved { step, .. }
            | Self::PeakNotResolved { step, .. }
            | Self::NotResolved { step, .. }
            | Self::SteepIndenter { step, .. }
            | Self::LayerShortening { step, .. }
            | Self::LayerWorn { step, .. }
            | Self::BeyondModel { step, .. }
            | Self::NothingTouches { step, .. }
            | Self::NotConverged { step, .. } => Some(*step),
            Self::DomainMuchLarger { .. }
            | Self::SteepTip { .. }
            | Self::DeepRecesses { .. }
            | Self::TextureUnderResolved { .. }
            | Self::NoGridError { .. }
            | Self::ArcUnderResolved(_)
            | Self::LayerUnderResolved { .. }
            | Self::CoefficientAccuracy { .. } => None,
        }
    }
}
