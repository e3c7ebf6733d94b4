//! The levels of filled contours, and the colour of each band between them.

use crate::axes::labels;
use crate::axes::ticks;
use crate::sheet::colour_map::ColourMap;
use crate::sheet::colours::{self, Colour};

/// Largest number of bands on one side of zero; there are at least half as many.
const MANY: usize = 12;
/// The same on the other side, if its values are much smaller.
const FEW: usize = 4;

/// A side of zero whose largest value is below this part of the other side's gets its own levels.
const MUCH_SMALLER: f64 = 0.4;

/// Bands of values, each of one colour.
#[derive(Debug, Clone, PartialEq)]
pub struct ContourBands {
    /// The limits between bands, rising.
    pub levels: Vec<f64>,
    /// The colours, one more than there are levels.
    colours: Vec<Colour>,
}

impl ContourBands {
    /// Returns bands of values from 0 to `largest`, in the colours of a map.
    #[must_use]
    pub fn up_to(largest: f64, map: ColourMap) -> Self {
        let levels = between(0.0, largest, MANY);
        let last = levels.len().max(1) as f64;
        let colours = (0..=levels.len()).map(|i| map.at(i as f64 / last));
        Self {
            colours: colours.collect(),
            levels,
        }
    }

    /// Returns bands of values of both signs: blue for negative, red for positive, paler towards zero, which is a
    /// level. If one sign's values are much smaller, its levels are closer together and its colours equally strong.
    #[must_use]
    pub fn signed(least: f64, largest: f64) -> Self {
        let (below, above) = (-least.min(0.0), largest.max(0.0));
        let larger = below.max(above);
        let step = if below.min(above) < MUCH_SMALLER * larger {
            |size: f64, larger: f64| between(0.0, size, if size < larger { FEW } else { MANY })
        } else {
            |size: f64, larger: f64| {
                let levels = between(0.0, larger, MANY).into_iter();
                levels.take_while(|level| *level < size).collect()
            }
        };
        let [negative, positive] = [below, above].map(|size| step(size, larger));
        let zero = (below > 0.0 && above > 0.0).then_some(0.0);
        let has = |size: f64, levels: &[f64]| if size > 0.0 { levels.len() + 1 } else { 0 };
        let shade = |i: usize, bands: usize| (i as f64 + 0.5) / bands as f64;
        let [blues, reds] = [has(below, &negative), has(above, &positive)];
        let blue = (0..blues).rev().map(|i| diverging(-shade(i, blues)));
        let red = (0..reds).map(|i| diverging(shade(i, reds)));
        let mut colours: Vec<_> = blue.chain(red).collect();
        if colours.is_empty() {
            colours.push(diverging(0.0));
        }
        let negative = negative.iter().rev().map(|level| -level);
        Self {
            levels: negative.chain(zero).chain(positive).collect(),
            colours,
        }
    }

    /// The colours, from the lowest band up.
    #[must_use]
    pub fn colours(&self) -> &[Colour] {
        &self.colours
    }

    /// Returns the colour of a value; for NaN, that of the lowest band.
    #[must_use]
    pub fn colour(&self, value: f64) -> Colour {
        self.colours[self.levels.partition_point(|level| *level <= value)]
    }

    /// Returns the label of a level, with enough digits to distinguish it from its neighbours.
    #[must_use]
    pub fn label(&self, level: f64) -> String {
        let steps = self.levels.windows(2).map(|pair| pair[1] - pair[0]);
        let near = steps.fold(level.abs(), f64::min);
        labels::tick(level, 10.0 * near)
    }

    /// Returns a colour for the line at a level that is visible on the bands beside it.
    #[must_use]
    pub fn ink(&self, level: usize) -> Colour {
        let darker = self.colours[level]
            .luma()
            .min(self.colours[level + 1].luma());
        if darker < 110.0 {
            colours::WHITE
        } else {
            colours::INK
        }
    }
}

/// The round values strictly between two values.
fn between(from: f64, to: f64, count: usize) -> Vec<f64> {
    let margin = 1e-6 * (to - from);
    let ticks = ticks::linear(from, to, count).into_iter();
    ticks
        .filter(|tick| *tick > from + margin && *tick < to - margin)
        .collect()
}

/// Blue at −1, white at 0, red at 1: distinct for the colour-blind too.
fn diverging(part: f64) -> Colour {
    let colour = colorous::RED_BLUE.eval_continuous(0.5 - 0.5 * part);
    Colour(colour.r, colour.g, colour.b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_round_and_each_band_has_its_colour() {
        let bands = ContourBands::up_to(3.3, ColourMap::Viridis);
        assert_eq!(bands.levels, [0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
        assert_eq!(bands.colour(-1.0), ColourMap::Viridis.at(0.0));
        assert_eq!(bands.colour(0.4), bands.colour(f64::NAN));
        assert_eq!(bands.colour(9.0), ColourMap::Viridis.at(1.0));
        assert_ne!(bands.colour(0.99), bands.colour(1.0));
    }

    #[test]
    fn zero_separates_blue_from_red_however_small_one_side_is() {
        let bands = ContourBands::signed(-1.0, 0.1);
        let zero = bands.levels.iter().position(|level| *level == 0.0).unwrap();
        assert!(zero >= 4 && bands.levels.len() - zero >= 2, "{bands:?}");
        for (value, is_red) in [(-0.9, false), (-1e-9, false), (1e-9, true), (0.09, true)] {
            let Colour(red, _, blue) = bands.colour(value);
            assert_eq!(red > blue, is_red, "{value}");
        }
        // Values of similar size on both sides have the same steps.
        assert_eq!(
            ContourBands::signed(-3.0, 2.5).levels,
            [-2.5, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0]
        );
    }

    #[test]
    fn values_of_one_sign_have_no_level_at_zero() {
        assert!(!ContourBands::signed(-2.0, -1.0).levels.contains(&0.0));
        assert!(!ContourBands::signed(1.0, 2.0).levels.contains(&0.0));
        let none = ContourBands::signed(0.0, 0.0);
        assert_eq!((none.levels.len(), none.colours.len()), (0, 1));
        let none = ContourBands::up_to(0.0, ColourMap::Viridis);
        assert_eq!((none.levels.len(), none.colours.len()), (0, 1));
    }
}
