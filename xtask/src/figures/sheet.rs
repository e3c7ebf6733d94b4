//! A sheet with a heading, rows of panels, and notes on the data below; a finished sheet is a picture with its numbers.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use pellicle_cli::Failure;
use pellicle_files::FileError;
use pellicle_files::whole::write_whole;
use pellicle_plot::sheet::svg::{Anchor, Svg};
use pellicle_plot::sheet::{heading, render};

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
    pub name: String,
    /// The drawing.
    pub svg: String,
    /// Every curve or field in it.
    pub csv: String,
}

impl Caption {
    /// A sheet with this caption and the panels, in rows of two, or three in one row. Each is drawn from the upper left
    /// corner of its cell of this size; `above` is the room over the first row.
    pub(super) fn sheet<P>(
        &self,
        above: f64,
        cell: (f64, f64),
        panels: &[P],
        draw: impl Fn(&mut Svg, (f64, f64), &P),
    ) -> Svg {
        let columns = if panels.len() == 3 {
            3
        } else {
            panels.len().min(2)
        };
        let width = cell.0 * columns as f64;
        let bottom = TOP + (above + cell.1 * panels.len().div_ceil(columns) as f64);
        let mut svg = Svg::new(width, bottom + LINE * self.notes.len() as f64 + BELOW);
        heading::draw(&mut svg, LEFT, width - LEFT, self.title, &self.subtitle);
        for (i, note) in self.notes.iter().enumerate() {
            let y = bottom + LINE * (i as f64 + 0.5);
            svg.text((LEFT, y), NOTE, Anchor::Start, note);
        }
        for (i, panel) in panels.iter().enumerate() {
            let left = cell.0 * (i % columns) as f64;
            let top = TOP + above + cell.1 * (i / columns) as f64;
            draw(&mut svg, (left, top), panel);
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

    /// Writes a PNG as wide as a page of documentation, or narrower so as not to be larger than [`SMALL_BYTES`].
    pub(super) fn write_small(&self, folder: &Path) -> Result<(), Failure> {
        let mut width = SMALL_WIDTH;
        let mut small = render::small_png(&self.svg, width);
        while small.as_ref().is_ok_and(|png| png.len() > SMALL_BYTES) && width >= 0.5 * SMALL_WIDTH
        {
            width *= 0.93;
            small = render::small_png(&self.svg, width);
        }
        self.write_file(folder, "png", small)
    }

    fn write_file(
        &self,
        folder: &Path,
        ending: &str,
        bytes: io::Result<impl AsRef<[u8]>>,
    ) -> Result<(), Failure> {
        fs::create_dir_all(folder).map_err(|cause| FileError::write(folder, cause))?;
        let path = folder.join(&self.name).with_extension(ending);
        Ok(write_whole(&path, |file| file.write_all(bytes?.as_ref()))?)
    }
}

/// A table: the names of its columns, then its rows. Texts in a row are in quotes and contain none.
pub(super) fn csv(names: &str, rows: impl IntoIterator<Item = String>) -> String {
    rows.into_iter()
        .fold(format!("{names}\n"), |table, row| table + &row + "\n")
}
