//! Pictures of a fit: curves with residuals, profiles, repeats; and of a plan.

pub mod axes;
pub mod curve;
pub mod designs;
pub mod profiles;
pub mod repeats;
pub mod unknown;

#[cfg(test)]
mod tests;

use super::colours::{self, Colour};

/// Colours of several measurements, distinguishable by the colour-blind.
const COLOURS: [Colour; 10] = [
    colours::BLUE,
    colours::ORANGE,
    colours::GREEN,
    colours::PURPLE,
    colours::SKY,
    colours::AMBER,
    colours::INDIGO,
    colours::WINE,
    colours::OLIVE,
    colours::TEAL,
];

/// Colour of measurement number `i`.
fn colour(i: usize) -> Colour {
    COLOURS[i % COLOURS.len()]
}

/// The heading of a picture of a fit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FitHeading {
    /// The title of the fit.
    pub title: String,
    /// The verdict, with its numbers.
    pub numbers: String,
}
