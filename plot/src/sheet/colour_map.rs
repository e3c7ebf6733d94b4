//! The colour of a value.

use crate::sheet::colours::Colour;

/// A colour map, safe for the colour-blind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColourMap {
    /// Dark blue to yellow
    #[default]
    Viridis,
    /// Dark blue to yellow, nearly the same with colour-blindness
    Cividis,
    /// White to black
    Greys,
}

impl ColourMap {
    /// All colour maps, with their names and their colours in words.
    pub const ALL: [(Self, &str, &str); 3] = [
        (Self::Viridis, "viridis", "Dark blue to yellow"),
        (
            Self::Cividis,
            "cividis",
            "Dark blue to yellow, nearly the same with colour-blindness",
        ),
        (Self::Greys, "greys", "White to black"),
    ];

    /// Returns the colour at a fraction of the scale: the first colour below 0 and for NaN, the last above 1.
    #[must_use]
    pub fn at(self, fraction: f64) -> Colour {
        let gradient = match self {
            Self::Viridis => colorous::VIRIDIS,
            Self::Cividis => colorous::CIVIDIS,
            Self::Greys => colorous::GREYS,
        };
        let colour = gradient.eval_continuous(within_the_scale(fraction));
        Colour(colour.r, colour.g, colour.b)
    }
}

/// Clamps a number to the range from 0 to 1; 0 for NaN.
#[must_use]
pub fn within_the_scale(number: f64) -> f64 {
    if number > 0.0 { number.min(1.0) } else { 0.0 }
}

/// A scale of colours from one value to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourScale {
    /// The colour map.
    pub map: ColourMap,
    /// The value of the first colour.
    pub from: f64,
    /// The value of the last colour.
    pub to: f64,
}

impl ColourScale {
    /// Returns the standard colours from 0 to a value.
    #[must_use]
    pub fn up_to(to: f64) -> Self {
        let (map, from) = (ColourMap::default(), 0.0);
        Self { map, from, to }
    }

    /// Returns the position of a value on the scale, clamped to the range from 0, the first colour, to 1, the last; 0
    /// for NaN.
    #[must_use]
    pub fn fraction(&self, value: f64) -> f64 {
        within_the_scale((value - self.from) / (self.to - self.from))
    }

    /// Returns the colour of a value.
    #[must_use]
    pub fn colour(&self, value: f64) -> Colour {
        self.map.at(self.fraction(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_has_a_colour_of_the_scale() {
        let shades = ColourScale {
            map: ColourMap::Greys,
            from: 1.0,
            to: 3.0,
        };
        assert_eq!(shades.fraction(2.0), 0.5);
        assert_eq!(shades.colour(-7.0), ColourMap::Greys.at(0.0));
        assert_eq!(shades.colour(f64::INFINITY), ColourMap::Greys.at(1.0));
        assert_eq!(shades.colour(f64::NAN), ColourMap::Greys.at(0.0));
        let empty = ColourScale { to: 1.0, ..shades };
        assert_eq!(empty.fraction(1.0), 0.0);
    }

    #[test]
    fn each_scale_begins_and_ends_in_different_colours() {
        for (map, ..) in ColourMap::ALL {
            assert_ne!(map.at(0.0), map.at(1.0), "{map:?}");
        }
    }

    #[test]
    fn higher_pressure_is_lighter() {
        let lightness = |t: f64| ColourMap::Viridis.at(t).luma();
        let steps: Vec<_> = (0..=20).map(|i| lightness(f64::from(i) / 20.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
    }
}
