//! The colours of a pressure map.

use plotters::style::{RGBColor, colors::colormaps::ViridisRGB};

/// Elements of the relief that carry nothing.
pub const RELIEF: RGBColor = RGBColor(222, 222, 222);

/// Elements without relief that carry nothing.
pub const BARE: RGBColor = RGBColor(250, 250, 250);

/// Text and axes.
pub const INK: RGBColor = RGBColor(30, 30, 30);

/// The colour of a fraction of the largest pressure: viridis, perceptually uniform and safe for the colour-blind.
#[must_use]
pub fn of_fraction(fraction: f64) -> RGBColor {
    ViridisRGB::get_color_normalized(fraction, 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_pressure_is_lighter() {
        let lightness = |t: f64| {
            let RGBColor(r, g, b) = of_fraction(t);
            // Luma of ITU-R BT.601.
            0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
        };
        let steps: Vec<_> = (0..=20).map(|i| lightness(f64::from(i) / 20.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
    }
}
