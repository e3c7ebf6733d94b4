//! A sheet with a heading, room for panels, and notes on the data below; a finished sheet is a picture with its
//! numbers.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use pellicle_cli::Failure;
use pellicle_cli::drawing::{Anchor, Svg, heading, render};
use pellicle_cli::results::write_whole;

/// Distance of the panels from the top; the notes are below, not in the heading.
pub(super) const TOP: f64 = heading::HEIGHT - 22.0;

/// Left side of heading and notes, in pixels.
const LEFT: f64 = 40.0;

/// Font size, line distance and bottom margin of the notes, in pixels.
const NOTE: f64 = 15.0;
const LINE: f64 = 24.0;
const BELOW: f64 = 18.0;

/// Width of a small version, in pixels: a page of documentation.
const SMALL_WIDTH: f64 = 940.0;
/// Maximum size of a small version in bytes, as it is kept in the repository.
const SMALL_BYTES: usize = 100_000;

/// The words around the panels.
pub(super) struct Caption {
    pub title: &'static str,
    /// A line on the parameters common to all panels.
    pub subtitle: String,
    pub notes: Vec<String>,
}

/// A drawing and the numbers in it.
pub(super) struct Picture {
    /// Name of its files, without extension.
    pub name: &'static str,
    /// The drawing.
    pub svg: String,
    /// Width of the drawing, in pixels.
    pub width: f64,
    /// Every curve or field in it.
    pub csv: String,
}

impl Caption {
    /// A sheet with this caption, and room of this width and height for panels between heading and notes.
    pub(super) fn sheet(&self, (width, height): (f64, f64)) -> Svg {
        let bottom = TOP + height;
        let mut svg = Svg::new(width, bottom + LINE * self.notes.len() as f64 + BELOW);
        heading::draw(&mut svg, LEFT, width - LEFT, self.title, &self.subtitle);
        for (i, note) in self.notes.iter().enumerate() {
            let y = bottom + LINE * (i as f64 + 0.5);
            svg.text((LEFT, y), NOTE, Anchor::Start, note);
        }
        svg
    }
}

impl Picture {
    /// Writes SVG, PNG and CSV.
    pub(super) fn write(&self, folder: &Path) -> Result<(), Failure> {
        self.write_file(folder, "svg", Ok(&self.svg))?;
        self.write_file(folder, "csv", Ok(&self.csv))?;
        self.write_file(folder, "png", render::png(&self.svg))
    }

    /// Writes a PNG no wider than a page of documentation and no larger than [`SMALL_BYTES`].
    pub(super) fn write_small(&self, folder: &Path) -> Result<(), Failure> {
        self.write_file(folder, "png", self.small())
    }

    fn write_file(
        &self,
        folder: &Path,
        ending: &str,
        bytes: io::Result<impl AsRef<[u8]>>,
    ) -> Result<(), Failure> {
        fs::create_dir_all(folder).map_err(|cause| Failure::write(folder, cause))?;
        let path = folder.join(format!("{}.{ending}", self.name));
        write_whole(&path, |file| file.write_all(bytes?.as_ref()))
    }

    /// The widest small version within the size limit.
    fn small(&self) -> io::Result<Vec<u8>> {
        let mut width = SMALL_WIDTH.min(self.width);
        loop {
            #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
            let zoom = (width / self.width) as f32;
            let bytes = render::small_png(&self.svg, zoom)?;
            if bytes.len() <= SMALL_BYTES || width < 0.5 * SMALL_WIDTH {
                return Ok(bytes);
            }
            width *= 0.93;
        }
    }
}
