//! Fixed colours of the pictures: Okabe and Ito's for lines, grey for elements without pressure.

use std::fmt;

/// A screen colour: red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// Elements of the relief without pressure.
pub const RELIEF: Colour = Colour(222, 222, 222);

/// Elements without relief and without pressure.
pub const BARE: Colour = Colour(250, 250, 250);

/// The outline of the relief, visible on white and on either end of viridis.
pub const RELIEF_OUTLINE: Colour = Colour(150, 150, 150);

/// Text and axes.
pub const INK: Colour = Colour(30, 30, 30);

/// Grid lines.
pub const GRID: Colour = Colour(225, 225, 225);

/// Paper.
pub const WHITE: Colour = Colour(255, 255, 255);

/// Blue of Okabe and Ito's palette, which the colour-blind can tell from [`ORANGE`].
pub const BLUE: Colour = Colour(0, 114, 178);

/// Vermilion of the same palette.
pub const ORANGE: Colour = Colour(213, 94, 0);

/// Bluish green of the same palette.
pub const GREEN: Colour = Colour(0, 158, 115);

/// Reddish purple of the same palette.
pub const PURPLE: Colour = Colour(204, 121, 167);

/// Sky blue of the same palette.
pub const SKY: Colour = Colour(86, 180, 233);

/// Orange of the same palette, yellower than [`ORANGE`].
pub const AMBER: Colour = Colour(230, 159, 0);

/// The indenter in a section.
pub const INDENTER: Colour = Colour(205, 210, 216);

/// The relief in a section.
pub const SPRINGS: Colour = Colour(158, 202, 225);

/// The body below the relief in a section.
pub const BODY: Colour = Colour(240, 228, 205);

/// Indigo of Tol's muted palette, for lines beyond the colours of Okabe and Ito's palette.
pub const INDIGO: Colour = Colour(51, 34, 136);

/// Wine of the same palette.
pub const WINE: Colour = Colour(136, 34, 85);

/// Olive of the same palette.
pub const OLIVE: Colour = Colour(153, 153, 51);

/// Teal of the same palette.
pub const TEAL: Colour = Colour(68, 170, 153);

/// The background of an interval.
pub const INTERVAL: Colour = Colour(226, 238, 247);

/// Measurements that were left out of a fit.
pub const LEFT_OUT: Colour = Colour(190, 190, 190);

impl Colour {
    /// Returns the colour under this much light; 1 leaves it unchanged.
    #[must_use]
    pub fn lit(self, light: f64) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to a byte"
        )]
        let channel = |value: u8| (f64::from(value) * light).round().clamp(0.0, 255.0) as u8;
        Self(channel(self.0), channel(self.1), channel(self.2))
    }

    /// Luma by ITU-R BT.601, from 0 for black to 255 for white: the grey level of the colour.
    #[must_use]
    pub fn luma(self) -> f64 {
        0.299 * f64::from(self.0) + 0.587 * f64::from(self.1) + 0.114 * f64::from(self.2)
    }
}

impl fmt::Display for Colour {
    /// In the notation of SVG: `#1e1e1e`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_written_in_svg_notation() {
        assert_eq!(INK.to_string(), "#1e1e1e");
    }
}
