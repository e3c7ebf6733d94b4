//! The checks that `docs/claims.toml` can name, and what each of them looks at.

use serde::Deserialize;

use super::checks::{edges, film, growth, incomplete, loading, section};
use super::{ContactFields, Curve, Cylinders, Finding};

/// A check by its name in the file of claims, where words are joined by hyphens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Checker {
    /// The indenter does not reach all of the layer between the elements.
    GapsStayOpen,
    /// Contact lies on the elements alone.
    OnlyElementsTouch,
    /// Contact lies between the elements too, near the axis.
    LayerTouchesNearAxis,
    /// Elements carry their largest pressure at their edges.
    PeaksAtEdges,
    /// The largest pressure of all is at the central element's edge.
    LargestAtCentralEdge,
    /// The edge of the central element carries the largest mean pressure of all edges.
    MeanEdgeIsLargestAtCentre,
    /// The layer between the elements is curved.
    LayerIsCurved,
    /// The layer between the elements is displaced most beside them.
    LargestBesideElements,
    /// The layer under the central element is displaced most at its edges.
    LargestUnderEdges,
    /// `D(Q)` is not a straight line.
    PenetrationIsNonlinear,
    /// `∂D/∂Q` falls with the load.
    GradientFalls,
    /// `∂D/∂Q` becomes constant.
    GradientBecomesConstant,
    /// The first curve's penetration is below the second's.
    FirstPenetratesLess,
    /// Two curves have one shape.
    CurvesAreSimilar,
    /// The contact area is larger in the first case.
    AreaIsLarger,
    /// The largest pressure is lower in the first case.
    PeakIsLower,
    /// The gradients `∂D/∂Q` differ at the smallest load.
    GradientsDifferAtFirst,
    /// The difference of the gradients fades.
    EffectOnGradientFades,
    /// The difference of the largest pressures fades.
    EffectOnPeakFades,
    /// The difference of the penetrations fades.
    EffectOnPenetrationFades,
    /// The pressure is nearer to the indenter's shape in the first case.
    IsMorePyramidal,
    /// The largest pressure no longer grows with the grid.
    PeakSettles,
}

/// A check's function, by what it looks at; the last number is the claim's threshold.
#[derive(Debug, Clone, Copy)]
pub(super) enum Check {
    /// The fields of one step.
    Fields(fn(&ContactFields, f64) -> Finding),
    /// The fields of one step, and where the cylinders stand.
    Cylinders(fn(&ContactFields, Cylinders, f64) -> Finding),
    /// The fields of one step in each of two cases.
    TwoFields(fn(&ContactFields, &ContactFields, f64) -> Finding),
    /// The share of the contact area that lies between the elements.
    ShareBetween(fn(f64, f64) -> Finding),
    /// Where the largest pressure is.
    PeakPlace(fn([f64; 2], Cylinders) -> Finding),
    /// Elements per side and largest pressure, on half as many elements and on these.
    PeakGrowth(fn((usize, f64), (usize, f64), f64) -> Finding),
    /// A loading curve.
    Curve(fn(&Curve, f64) -> Finding),
    /// The loading curves of two cases.
    TwoCurves(fn(&Curve, &Curve, f64) -> Finding),
}

impl Check {
    /// How many cases it looks at.
    pub(super) fn cases(self) -> usize {
        match self {
            Self::TwoFields(_) | Self::TwoCurves(_) => 2,
            _ => 1,
        }
    }
}

impl Checker {
    /// All of them.
    #[cfg(test)]
    pub(super) const ALL: [Self; 22] = [
        Self::GapsStayOpen,
        Self::OnlyElementsTouch,
        Self::LayerTouchesNearAxis,
        Self::PeaksAtEdges,
        Self::LargestAtCentralEdge,
        Self::MeanEdgeIsLargestAtCentre,
        Self::LayerIsCurved,
        Self::LargestBesideElements,
        Self::LargestUnderEdges,
        Self::PenetrationIsNonlinear,
        Self::GradientFalls,
        Self::GradientBecomesConstant,
        Self::FirstPenetratesLess,
        Self::CurvesAreSimilar,
        Self::AreaIsLarger,
        Self::PeakIsLower,
        Self::GradientsDifferAtFirst,
        Self::EffectOnGradientFades,
        Self::EffectOnPeakFades,
        Self::EffectOnPenetrationFades,
        Self::IsMorePyramidal,
        Self::PeakSettles,
    ];

    /// What it does.
    pub(super) fn check(self) -> Check {
        match self {
            Self::GapsStayOpen => Check::Fields(incomplete::gaps_stay_open),
            Self::OnlyElementsTouch => Check::ShareBetween(incomplete::only_elements_touch),
            Self::LayerTouchesNearAxis => Check::Fields(incomplete::layer_touches_near_axis),
            Self::PeaksAtEdges => Check::Cylinders(edges::peaks_at_edges),
            Self::LargestAtCentralEdge => Check::PeakPlace(edges::largest_at_central_edge),
            Self::MeanEdgeIsLargestAtCentre => {
                Check::Cylinders(edges::mean_edge_is_largest_at_centre)
            }
            Self::LayerIsCurved => Check::Cylinders(section::layer_is_curved),
            Self::LargestBesideElements => Check::Cylinders(section::largest_beside_elements),
            Self::LargestUnderEdges => Check::Cylinders(section::largest_under_edges),
            Self::PenetrationIsNonlinear => Check::Curve(loading::penetration_is_nonlinear),
            Self::GradientFalls => Check::Curve(loading::gradient_falls),
            Self::GradientBecomesConstant => Check::Curve(loading::gradient_becomes_constant),
            Self::FirstPenetratesLess => Check::TwoCurves(loading::first_penetrates_less),
            Self::CurvesAreSimilar => Check::TwoCurves(loading::curves_are_similar),
            Self::AreaIsLarger => Check::TwoCurves(film::area_is_larger),
            Self::PeakIsLower => Check::TwoCurves(film::peak_is_lower),
            Self::GradientsDifferAtFirst => Check::TwoCurves(film::gradients_differ_at_first),
            Self::EffectOnGradientFades => Check::TwoCurves(film::effect_on_gradient_fades),
            Self::EffectOnPeakFades => Check::TwoCurves(film::effect_on_peak_fades),
            Self::EffectOnPenetrationFades => Check::TwoCurves(film::effect_on_penetration_fades),
            Self::IsMorePyramidal => Check::TwoFields(film::is_more_pyramidal),
            Self::PeakSettles => Check::PeakGrowth(growth::peak_settles),
        }
    }
}
