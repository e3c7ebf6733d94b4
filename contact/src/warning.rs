//! What a user should know about a result that is otherwise sound.

use std::fmt;

/// A doubt about the model or the grid, with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// The contact comes close to the edge of the domain, so pressure may be cut off.
    DomainEdge {
        /// Loading step, counted from 0.
        step: usize,
        /// Whole elements between the contact and the edge.
        elements: usize,
    },
    /// The linear springs of the relief shorten by more than their height.
    FilmShortening {
        /// Loading step, counted from 0.
        step: usize,
        /// Largest shortening over height.
        times: f64,
    },
    /// Few elements per radius of a cylinder.
    TextureUnderResolved {
        /// Elements per radius.
        elements_per_radius: f64,
    },
    /// A layer much thinner than an element, whose own stiffness the grid cannot see.
    LayerUnderResolved {
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
    /// The largest pressure still grows with the grid, as at an edge.
    PeakNotResolved {
        /// Loading step, counted from 0.
        step: usize,
        /// Relative change of the largest pressure from the grid before.
        change: f64,
    },
    /// The indenter is steep where the contact ends, beyond small strains.
    SteepIndenter {
        /// Loading step, counted from 0.
        step: usize,
        /// Slope of the indenter's profile, averaged around the contact's edge.
        slope: f64,
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
    /// A short name that does not change, for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::DomainEdge { .. } => "domain-edge",
            Self::FilmShortening { .. } => "film-shortening",
            Self::TextureUnderResolved { .. } => "texture-under-resolved",
            Self::LayerUnderResolved { .. } => "layer-under-resolved",
            Self::CoefficientAccuracy { .. } => "coefficient-accuracy",
            Self::PeakNotResolved { .. } => "peak-not-resolved",
            Self::SteepIndenter { .. } => "steep-indenter",
            Self::NotConverged { .. } => "not-converged",
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::DomainEdge { step, elements } => write!(
                f,
                "step {step}: the contact comes within {elements} elements of the edge of the domain; choose a larger side"
            ),
            Self::FilmShortening { step, times } => write!(
                f,
                "step {step}: the relief shortens by {times:.2} times its height, beyond what linear springs describe"
            ),
            Self::TextureUnderResolved {
                elements_per_radius,
            } => write!(
                f,
                "{elements_per_radius:.1} elements per cylinder radius are few; use more elements or a smaller side"
            ),
            Self::LayerUnderResolved {
                layer,
                elements_per_thickness,
            } => write!(
                f,
                "layer {layer} is {elements_per_thickness:.3} elements thick: the grid sees little of it"
            ),
            Self::CoefficientAccuracy { found, wanted } => write!(
                f,
                "the influence coefficients of these layers are right to {found:.1e}, wanted {wanted:.0e}: all numbers are uncertain by about as much"
            ),
            Self::PeakNotResolved { step, change } => write!(
                f,
                "step {step}: the largest pressure still changes by {:.1} % from grid to grid, as an edge peak does",
                100.0 * change
            ),
            Self::SteepIndenter { step, slope } => write!(
                f,
                "step {step}: the indenter's slope is {slope:.2} at the edge of the contact, beyond small strains"
            ),
            Self::NotConverged {
                step,
                worst,
                tolerance,
            } => {
                write!(
                    f,
                    "step {step} did not converge: certificate {worst:.1e}, wanted {tolerance:.1e}"
                )
            }
        }
    }
}
