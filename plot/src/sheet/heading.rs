//! The lines above a picture: the case, the numbers shown, and their accuracy.

use crate::sheet::svg::{Anchor, Svg};

/// Height of the heading, in pixels.
pub const HEIGHT: f64 = 106.0;

/// Font sizes, in pixels.
const TITLE: f64 = 23.0;
const NUMBERS: f64 = 18.0;
const ACCURACY: f64 = 14.0;

/// Approximate width of a letter relative to its height.
const LETTER: f64 = 0.6;

/// Draws a small third line below the two of [`draw`].
pub fn draw_accuracy(svg: &mut Svg, left: f64, accuracy: &str) {
    svg.text((left, 88.0), ACCURACY, Anchor::Start, accuracy);
}

/// Draws title and numbers; the title is cut to the width.
pub fn draw(svg: &mut Svg, left: f64, width: f64, title: &str, numbers: &str) {
    let title = fitted(title, width, TITLE);
    svg.text((left, 26.0), TITLE, Anchor::Start, &title);
    svg.text((left, 60.0), NUMBERS, Anchor::Start, numbers);
}

/// The approximate width of a line of text, in pixels.
#[must_use]
pub fn width(text: &str, size: f64) -> f64 {
    LETTER * size * text.chars().count() as f64
}

/// Cuts the text to a width.
#[must_use]
pub fn fitted(text: &str, width: f64, size: f64) -> String {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of letters on a sheet"
    )]
    let room = (width / (LETTER * size)) as usize;
    if text.chars().count() <= room {
        return text.to_owned();
    }
    let cut: String = text.chars().take(room.saturating_sub(1)).collect();
    format!("{}…", cut.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_is_cut_at_the_edge_of_the_picture() {
        assert_eq!(fitted("short", 100.0, 10.0), "short");
        assert_eq!(fitted("much too long a title", 60.0, 10.0), "much too…");
    }
}
