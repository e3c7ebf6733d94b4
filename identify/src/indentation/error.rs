//! Why a curve cannot be evaluated.

use thiserror::Error;

/// A curve that cannot be evaluated.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum IndentationError {
    /// The force does not fall far enough after its maximum.
    #[error(
        "the unloading ends at {ends:.2} of the largest force, wanted down to {wanted}: give `unloading` a higher end, or \
         the whole file"
    )]
    Unfinished {
        /// Part of the largest force at which the file ends.
        ends: f64,
        /// Part at which the fit is to end.
        wanted: f64,
    },
    /// Too few points.
    #[error(
        "found {found} points of the unloading between {from} and {to} of the largest force, wanted at least {wanted}"
    )]
    FewPoints {
        /// Points found.
        found: usize,
        /// Upper end, part of the largest force.
        from: f64,
        /// Lower end.
        to: f64,
        /// Points wanted.
        wanted: usize,
    },
    /// No times.
    #[error(
        "found no column of the time, which a drift wants: name it in `columns`, or set `drift = \"off\"`"
    )]
    NoTime,
    /// No hold.
    #[error(
        "found no hold at a constant force below half of the largest one, which `drift = \"hold\"` wants: set `drift = \
         \"off\"`, or give the rate, such as \"0.02 nm/s\""
    )]
    NoHold,
    /// No loading to extrapolate.
    #[error(
        "found too few points of the loading below 0.3 of the largest force, which `depth_zero = \"first contact\"` wants: \
         set \"as recorded\" or a depth"
    )]
    NoContact,
    /// An area that is not positive.
    #[error(
        "found an area of {area:.3e} m² at a contact depth of {depth:.4e} m, wanted a positive one: the area function or \
         the tip does not hold there"
    )]
    Area {
        /// Contact depth, m.
        depth: f64,
        /// Area found, m².
        area: f64,
    },
    /// A contact deeper than a ball.
    #[error(
        "found a contact depth of {depth:.4e} m, more than the radius of the ball, {radius:.4e} m, wanted contacts of its \
         lower half: is the unit of the depth right, and is the radius?"
    )]
    DeeperThanBall {
        /// Contact depth, m.
        depth: f64,
        /// Radius of the ball, m.
        radius: f64,
    },
    /// A modulus that is not positive.
    #[error(
        "found a reduced modulus of {reduced:.4e} Pa, which is not below that of the indenter alone, {indenter:.4e} Pa: \
         are the units right, and is the frame's compliance?"
    )]
    StifferThanIndenter {
        /// Reduced modulus, Pa.
        reduced: f64,
        /// `E_i/(1 − ν_i²)`, Pa.
        indenter: f64,
    },
    /// The power law does not follow.
    #[error("the power law has no fit to the unloading: {reason}")]
    NoFit {
        /// The reason.
        reason: String,
    },
    /// The unloading is straighter or more bent than any contact.
    #[error(
        "found an exponent of the unloading of {found:.3}, beyond its bound of {bound}, wanted one above 1 and up to 2: is \
         `unloading` the right part, is the force zero without contact, and does the depth still creep?"
    )]
    ExponentAtBound {
        /// The exponent.
        found: f64,
        /// The bound.
        bound: f64,
    },
    /// Too few contacts for a calibration.
    #[error(
        "found {found} contacts with the known body, wanted at least {wanted} for a calibration"
    )]
    FewContacts {
        /// Contacts found.
        found: usize,
        /// Contacts wanted.
        wanted: usize,
    },
    /// No area function.
    #[error("found neither an area function nor a contact radius, wanted one of them")]
    NoArea,
    /// No exponent.
    #[error(
        "found readings of a stiffness, which have no exponent of an unloading, wanted one for `epsilon = \"exponent\"`: \
         set a number such as 0.75"
    )]
    NoExponent,
}
