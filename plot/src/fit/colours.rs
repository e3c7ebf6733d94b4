//! The colours of measurements.

use crate::sheet::colours::{self, Colour};

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
pub(super) fn colour(i: usize) -> Colour {
    COLOURS[i % COLOURS.len()]
}
