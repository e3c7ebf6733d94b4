//! A sheet with a heading, room for panels, and notes on the data below; finished, it is a picture with its numbers.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use pellicle_cli::drawing::{Anchor, Svg};
use pellicle_cli::drawing::{heading, render};
use pellicle_cli::results::{write_bytes, write_whole};

use crate::XtaskError;

/// The two coatings of figures 2 to 4.
pub(super) const MATERIALS: &str = "compliant coating: E₁/E₂ = 0.1, ν₁ = 0.4, ν₂ = 0.3; stiff coating: E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4";

/// Body and indenter of figures 2 and 3.
pub(super) const TEXTURED: &str =
    "paraboloid of radius R; coating H = 10⁻⁴ R; cylinders r = 5·10⁻³ R, h = 10⁻⁴ R, T = R/80";

/// Left side of heading and notes, in pixels.
const LEFT: f64 = 40.0;

/// Size and distance of the notes' letters, in pixels.
const NOTE: f64 = 15.0;
const LINE: f64 = 24.0;
const BELOW: f64 = 18.0;

/// Width of a small version, in pixels: a page of documentation.
const SMALL_WIDTH: f64 = 940.0;
/// Most bytes of a small version: it is kept in the repository.
const SMALL_BYTES: usize = 100_000;

/// The words around the panels.
pub(super) struct Caption {
    pub title: &'static str,
    /// A line on what is the same in all panels.
    pub subtitle: String,
    pub notes: Vec<String>,
}

/// A sheet on which panels are drawn.
pub(super) struct Sheet {
    pub svg: Svg,
    width: f64,
}

/// A drawing and the numbers in it.
pub(super) struct Picture {
    /// Name of its files, without ending.
    pub name: &'static str,
    /// The drawing.
    pub svg: String,
    /// Width of the drawing, in pixels.
    pub width: f64,
    /// Every curve or field in it.
    pub csv: String,
}

impl Sheet {
    /// Where panels begin, from the top: the notes are below, not in the heading.
    pub(super) const TOP: f64 = heading::HEIGHT - 22.0;

    /// A sheet of this width whose panels need this height.
    pub(super) fn new((width, height): (f64, f64), caption: &Caption) -> Self {
        let bottom = Self::TOP + height;
        let mut svg = Svg::new(width, bottom + LINE * caption.notes.len() as f64 + BELOW);
        heading::draw(
            &mut svg,
            LEFT,
            width - LEFT,
            caption.title,
            &caption.subtitle,
        );
        for (i, note) in caption.notes.iter().enumerate() {
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

impl Picture {
    /// Writes SVG, PNG and CSV.
    pub(super) fn write(&self, folder: &Path) -> Result<(), XtaskError> {
        create_folder(folder)?;
        let file = |ending| folder.join(format!("{}.{ending}", self.name));
        write_bytes(&file("svg"), self.svg.as_bytes())?;
        write_bytes(&file("csv"), self.csv.as_bytes())?;
        write_whole(&file("png"), |file| {
            file.write_all(&render::png(&self.svg)?)
        })?;
        Ok(())
    }

    /// Writes a PNG no wider than a page of documentation and no larger than [`SMALL_BYTES`].
    pub(super) fn write_small(&self, folder: &Path) -> Result<(), XtaskError> {
        create_folder(folder)?;
        let path = folder.join(format!("{}.png", self.name));
        write_whole(&path, |file| file.write_all(&self.small()?))?;
        Ok(())
    }

    /// The widest small version that is not too large.
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

fn create_folder(folder: &Path) -> Result<(), XtaskError> {
    fs::create_dir_all(folder).map_err(|source| XtaskError::Write {
        path: folder.into(),
        source,
    })
}
