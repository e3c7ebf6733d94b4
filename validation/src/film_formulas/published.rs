//! Published formulas for a bonded incompressible layer, with the coefficients that programs in use compute with.

use std::f64::consts::PI;

use super::{FilmIndenter, polynomial};

/// A formula for `ψ`.
#[derive(Debug, Clone, Copy)]
pub struct PublishedFormula {
    /// Authors and year.
    pub name: &'static str,
    /// The indenter, which says what length `ψ` depends on.
    pub indenter: FilmIndenter,
    /// `ψ` at a length in thicknesses.
    pub factor: fn(f64) -> f64,
}

/// The formulas that programs for force curves offer: those of Garcia and of Managuli as in `PyFMRheo`, that of Gavara
/// as in `PyFMRheo` and `AtomicJ`, which agree.
///
/// The coefficients 1.133 and 1.7795 of them all are Dimitriadis' moment of the layer's response, where the exact ones
/// are 1.127 and 1.770: [`ThinLayer::series`](super::ThinLayer::series).
pub const PUBLISHED: [PublishedFormula; 6] = [
    PublishedFormula {
        name: "Garcia and Garcia 2018",
        indenter: FilmIndenter::Paraboloid,
        factor: |chi| polynomial(&[1.0, 1.133, 1.497, 1.469, 0.755], chi),
    },
    PublishedFormula {
        name: "Long and others 2011",
        indenter: FilmIndenter::Paraboloid,
        factor: long,
    },
    PublishedFormula {
        name: "Garcia and Garcia 2018",
        indenter: FilmIndenter::Cone,
        factor: |x| polynomial(&[1.0, 0.721, 0.650, 0.491, 0.225], x),
    },
    PublishedFormula {
        name: "Managuli and Roy 2018",
        indenter: FilmIndenter::Cone,
        factor: |x| {
            let c = 1.7795 / PI.powi(2);
            polynomial(&[1.0, 4.0 * c, 20.0 * c * c], x)
        },
    },
    PublishedFormula {
        name: "Gavara and Chadwick 2012",
        indenter: FilmIndenter::Cone,
        factor: |x| polynomial(&[1.0, 2.0 * 1.7795 / PI.powi(2), 16.0 * 1.7795 * 1.7795], x),
    },
    PublishedFormula {
        name: "Garcia and Garcia 2018",
        indenter: FilmIndenter::FlatPunch,
        factor: |x| polynomial(&[1.0, 1.133, 1.283, 0.598, -0.291], x),
    },
];

/// R. Long and others (2011), fitted to finite elements with large strains for radii of 2 to 12.7 thicknesses, here for
/// small strains: the inverse of `(1 + 2.3 ω)/(1 + 1.15 ω^⅓ + 9.5 ω + 4.212 ω²)` with `ω = χ³`.
fn long(chi: f64) -> f64 {
    let omega = chi.powi(3);
    (1.0 + 1.15 * chi + 9.5 * omega + 4.212 * omega * omega) / (1.0 + 2.3 * omega)
}
