//! Errors of the crate.

use pellicle_influence::InfluenceError;
use pellicle_texture::TextureError;
use thiserror::Error;

use crate::{IndenterError, ModelParameter};

/// Errors of the crate. A solution that misses its tolerance is not an error where a [`Step`](crate::Step) can carry
/// it: its certificate shows this.
#[derive(Debug, Error)]
pub enum ContactError {
    /// A force that is not positive and finite.
    #[error("found {force} for the force, wanted a positive finite number")]
    Force {
        /// Value found, in N.
        force: f64,
    },
    /// A penetration that is not finite.
    #[error("found {penetration} for the penetration, wanted a finite number")]
    Penetration {
        /// Value found, in m.
        penetration: f64,
    },
    /// A contact radius that no force gives, or that more than one force gives.
    #[error(
        "found a contact radius of {radius:.6e} that no force gives, or more than one, wanted an indenter whose contact \
         grows with the force up to it, which that of a flat punch does not"
    )]
    ContactRadius {
        /// Value found, in m.
        radius: f64,
    },
    /// A radius for which an axisymmetric contact is not computed.
    #[error("found {radius:e} for the radius of an axisymmetric contact, wanted {wanted}")]
    AxisymmetricRadius {
        /// Value found, in m.
        radius: f64,
        /// The radii allowed.
        wanted: &'static str,
    },
    /// A work of adhesion that is not positive and finite.
    #[error("found {work} for the work of adhesion, wanted a positive finite number")]
    WorkOfAdhesion {
        /// Value found, in J/m².
        work: f64,
    },
    /// A force at which the surfaces have separated.
    #[error(
        "found a force of {force:.6e} on an adhesive contact, wanted one above the pull-off force of {pull_off:.6e}"
    )]
    BeyondPullOff {
        /// The force, in N.
        force: f64,
        /// The pull-off force, in N.
        pull_off: f64,
    },
    /// A penetration at which the surfaces have separated.
    #[error(
        "found a penetration of {penetration:.6e} of an adhesive contact, wanted one above the least of {last:.6e}"
    )]
    BeyondLastContact {
        /// The penetration, in m.
        penetration: f64,
        /// The least, in m.
        last: f64,
    },
    /// A law of adhesion that has no formula for a shape.
    #[error(
        "found a shape for which the DMT law has no formula, wanted a paraboloid or a sphere, or the JKR law"
    )]
    NoDmtFormula,
    /// A tolerance outside (0, 0.1].
    #[error("found {tolerance} for the tolerance, wanted a number in (0, 0.1]")]
    Tolerance {
        /// Value found.
        tolerance: f64,
    },
    /// A hardness that is not positive and finite.
    #[error("found {hardness} for the hardness, wanted a positive finite number")]
    Hardness {
        /// Value found, in Pa.
        hardness: f64,
    },
    /// A force larger than all elements that can touch can carry at the hardness.
    #[error(
        "found a force of {force:.6e}, which a hardness of {hardness:e} cannot carry on the area of {area:.6e} that can touch, \
         wanted at most {most:.6e}, or a larger domain if the indenter extends beyond this one"
    )]
    BeyondHardness {
        /// The force, in N.
        force: f64,
        /// Hardness, in Pa.
        hardness: f64,
        /// Area of the elements that can touch, in m².
        area: f64,
        /// Their product, in N.
        most: f64,
    },
    /// A quantity that is not computed for contact with a hardness.
    #[error(
        "found a hardness together with {what}, which require elastic contact, wanted no hardness"
    )]
    WithHardness {
        /// The quantity asked for.
        what: &'static str,
    },
    /// A number of a wear that is not valid.
    #[error("found {found} for the {quantity} of the wear, wanted {wanted}")]
    Wear {
        /// The number.
        quantity: &'static str,
        /// Its value.
        found: f64,
        /// The values allowed.
        wanted: &'static str,
    },
    /// Wear of springs that stiffen as they shorten.
    #[error(
        "found wear of springs with a logarithmic law, wanted linear springs, whose length is known"
    )]
    WearOfStiffening,
    /// A quantity that a periodic cell does not have, or that is not computed for one.
    #[error("found {what} in a periodic cell, wanted none: they are those of a single contact")]
    Periodic {
        /// The quantity asked for.
        what: &'static str,
    },
    /// A penetration prescribed in a periodic cell one of whose bodies is a half-space.
    #[error(
        "found a prescribed penetration in a periodic cell of a half-space, whose mean displacement is infinite, wanted a \
         force, or a rigid base under a rigid indenter"
    )]
    InfiniteMean,
    /// A penetration that would close all gaps of a periodic cell over incompressible layers on a rigid base.
    #[error(
        "found a penetration of {penetration:.6e}, which no pressure on incompressible layers reaches, since they only give \
         way into gaps, wanted less than {mean_gap:.6e}, the mean of the initial gap"
    )]
    BeyondGaps {
        /// The penetration, in m.
        penetration: f64,
        /// Mean of `g0`, in m.
        mean_gap: f64,
    },
    /// An oblong cell that is not a whole number of square elements along both sides.
    #[error(
        "found {size} elements along the longer side of a cell of {:e} by {:e}, which are not square, wanted a number that \
         divides both sides into squares", sides[0], sides[1]
    )]
    NotSquareElements {
        /// The sides of the cell, in m.
        sides: [f64; 2],
        /// Elements along the longer side.
        size: usize,
    },
    /// Stresses that are not numbers, so that there is no largest one.
    #[error("found stresses that are not numbers, wanted finite ones")]
    StressNotFinite,
    /// A strength is given, but the stress that reaches it was left out.
    #[error("found a strength but no {quantity} among the stresses, wanted it or no such strength")]
    StressLeftOut {
        /// Name of the stress in results.
        quantity: &'static str,
    },
    /// A field whose length does not match the grid.
    #[error("found {found} values of the {field}, wanted {wanted}, one per element")]
    FieldLength {
        /// Name of the field.
        field: &'static str,
        /// Values found.
        found: usize,
        /// Values wanted.
        wanted: usize,
    },
    /// A field with a value that no surface can have.
    #[error("found {found} for the {field} of element {element}, wanted {wanted}")]
    FieldValue {
        /// Name of the field.
        field: &'static str,
        /// Index of the element.
        element: usize,
        /// The values allowed.
        wanted: &'static str,
        /// Value found.
        found: f64,
    },
    /// An element area that is not positive and finite.
    #[error("found {area} for the area of an element, wanted a positive finite number")]
    ElementArea {
        /// Value found, in m².
        area: f64,
    },
    /// More elements than the dense active set supports.
    #[error(
        "found {elements} elements per side for the active set, which stores a dense matrix, wanted at most {largest}, or the gradient method"
    )]
    TooLargeForActiveSet {
        /// Elements per side found.
        elements: usize,
        /// Most elements per side.
        largest: usize,
    },
    /// The dense system of a working set is not positive definite, so its coefficients are wrong.
    #[error(
        "found a system of {elements} elements in contact that is not positive definite, wanted one that is"
    )]
    NotPositiveDefinite {
        /// Elements in the working set.
        elements: usize,
    },
    /// No element can come into contact under any force.
    #[error(
        "found an indenter of infinite height on all {elements} elements of the grid, wanted one that can touch"
    )]
    NothingCanTouch {
        /// Number of elements.
        elements: usize,
    },
    /// The observer asked to stop.
    #[error("cancelled at loading step {step}")]
    Cancelled {
        /// Loading step under way, counted from 0.
        step: usize,
    },
    /// The elements are so large that none has its centre under the indenter.
    #[error(
        "found a domain of side {side:.3e}, far too large for a contact of radius about {radius:.2e}, so that no element \
         ({element_side:.3e} wide) has its centre under the indenter, wanted a side near {wanted:.2e}, or an automatic one"
    )]
    ElementsTooLarge {
        /// Side of the domain found, in m.
        side: f64,
        /// Side of an element, in m.
        element_side: f64,
        /// The contact radius by the first estimate, in m.
        radius: f64,
        /// A side that would hold it, in m.
        wanted: f64,
    },
    /// A disc smaller than an element, over which no pressure can be averaged.
    #[error(
        "found {length:e} for the length over which the pressure is averaged, wanted at least the side of an element, {element_side:e}"
    )]
    AveragingLength {
        /// The diameter of the disc, in m.
        length: f64,
        /// Side of an element, in m.
        element_side: f64,
    },
    /// The contact reached the edge of every domain tried.
    #[error(
        "found contact at the edge of a domain of side {side:e}, the last of {trials} tried, wanted a larger one: give its side"
    )]
    DomainTooSmall {
        /// Side of the last domain tried, in m.
        side: f64,
        /// Number of domains tried.
        trials: usize,
    },
    /// An error of the grid or the relief.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// A solution that misses its tolerance where a certified one is required.
    #[error(
        "found a certificate of {worst:.1e} under a force of {force:e}, wanted a certified solution"
    )]
    NotCertified {
        /// The force, in N.
        force: f64,
        /// Largest line of the certificate.
        worst: f64,
    },
    /// Adhesion of a contact that is no circle, or does not grow with the load.
    #[error(
        "found a contact that is no circle or does not grow with the load, wanted a tip of revolution on a body \
         without relief but a film of linear springs"
    )]
    NotAxisymmetric,
    /// A parameter that a model does not have.
    #[error("found no {wanted:?} in the model, wanted a number of its bodies, relief or indenter")]
    NoParameter {
        /// The parameter wanted.
        wanted: ModelParameter,
    },
    /// An error of the indenter.
    #[error(transparent)]
    Indenter(#[from] IndenterError),
    /// An error of the influence coefficients.
    #[error(transparent)]
    Influence(#[from] InfluenceError),
}
