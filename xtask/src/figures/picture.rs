//! A picture as files: the drawing, its pixels, and its numbers.

use std::fs;
use std::path::Path;

use pellicle_cli::output::file::create_whole;
use pellicle_cli::picture::png;

use crate::XtaskError;

/// Width of a small version, in pixels: a page of documentation.
const SMALL_WIDTH: f64 = 940.0;

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
        create_whole(&folder.join(&names[0]), |path| fs::write(path, &self.svg))?;
        create_whole(&folder.join(&names[1]), |path| {
            fs::write(path, png::render(&self.svg)?)
        })?;
        create_whole(&folder.join(&names[2]), |path| fs::write(path, &self.csv))?;
        Ok(names)
    }

    /// Writes a PNG no wider than a page of documentation.
    pub(super) fn write_small(&self, folder: &Path) -> Result<(), XtaskError> {
        create_folder(folder)?;
        #[expect(clippy::cast_possible_truncation, reason = "between 0 and 1")]
        let zoom = (SMALL_WIDTH / self.width).min(1.0) as f32;
        let path = folder.join(format!("{}.png", self.name));
        create_whole(&path, |path| {
            fs::write(path, png::render_small(&self.svg, zoom)?)
        })?;
        Ok(())
    }
}

fn create_folder(folder: &Path) -> Result<(), XtaskError> {
    fs::create_dir_all(folder).map_err(|source| XtaskError::Write {
        path: folder.into(),
        source,
    })
}
