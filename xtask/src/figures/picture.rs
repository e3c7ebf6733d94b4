//! A picture as files: the drawing, its pixels, and its numbers.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use pellicle_cli::drawing::png;
use pellicle_cli::results::{write_bytes, write_whole};

use crate::XtaskError;

/// Width of a small version, in pixels: a page of documentation.
const SMALL_WIDTH: f64 = 940.0;
/// Most bytes of a small version: it is kept in the repository.
const SMALL_BYTES: usize = 100_000;

/// A drawing and what is drawn.
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

impl Picture {
    /// Writes SVG, PNG and CSV; the names of the files.
    pub(super) fn write(&self, folder: &Path) -> Result<[String; 3], XtaskError> {
        create_folder(folder)?;
        let name = |ending| format!("{}.{ending}", self.name);
        let names = ["svg", "png", "csv"].map(name);
        write_bytes(&folder.join(&names[0]), self.svg.as_bytes())?;
        write_whole(&folder.join(&names[1]), |file| {
            file.write_all(&png::render(&self.svg)?)
        })?;
        write_bytes(&folder.join(&names[2]), self.csv.as_bytes())?;
        Ok(names)
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
            let bytes = png::render_small(&self.svg, zoom)?;
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
