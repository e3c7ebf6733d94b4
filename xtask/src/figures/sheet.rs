//! A sheet with a heading, room for panels, and notes on the data below.

use pellicle_cli::drawing::heading;
use pellicle_cli::drawing::{Anchor, Svg};

use super::picture::Picture;

/// Left side of heading and notes, in pixels.
const LEFT: f64 = 40.0;

/// Size and distance of the notes' letters, in pixels.
const NOTE: f64 = 15.0;
const LINE: f64 = 24.0;
const BELOW: f64 = 18.0;

/// A sheet under way.
pub(super) struct Sheet {
    pub svg: Svg,
    width: f64,
}

impl Sheet {
    /// Where panels begin, from the top: the notes are below, not in the heading.
    pub(super) const TOP: f64 = heading::HEIGHT - 22.0;

    /// A sheet of this width whose panels need this height, with a title, a line on what is the same in all panels, and
    /// notes.
    pub(super) fn new(size: (f64, f64), title: &str, subtitle: &str, notes: &[String]) -> Self {
        let (width, height) = size;
        let bottom = Self::TOP + height;
        let mut svg = Svg::new(width, bottom + LINE * notes.len() as f64 + BELOW);
        heading::draw(&mut svg, LEFT, width - LEFT, title, subtitle);
        for (i, note) in notes.iter().enumerate() {
            let y = bottom + LINE * (i as f64 + 0.5);
            svg.text((LEFT, y), NOTE, Anchor::Start, note);
        }
        Self { svg, width }
    }

    /// The sheet as a picture.
    pub(super) fn finish(self, name: &'static str, csv: String) -> Picture {
        Picture {
            name,
            svg: self.svg.finish(),
            width: self.width,
            csv,
        }
    }
}
