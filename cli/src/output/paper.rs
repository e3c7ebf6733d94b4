//! Pictures for paper: of a width in millimetres, as SVG, PDF, and PNG of a resolution.

use std::path::Path;

use pellicle_files::FileError;
use pellicle_files::whole::{write_bytes, write_new};
use pellicle_plot::sheet::render;

use crate::failure::Failure;

/// A format of pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum PictureFormat {
    /// Lines and letters, sharp at any size.
    Svg,
    /// Pixels.
    Png,
    /// A page of the picture's size, with letters as outlines.
    Pdf,
}

/// How a picture is written.
#[derive(Debug, Clone, Copy)]
pub struct Paper<'a> {
    /// The formats.
    pub formats: &'a [PictureFormat],
    /// Width, in millimetres.
    pub width_mm: f64,
    /// Pixels per inch of a PNG.
    pub dpi: f64,
    /// Whether existing pictures are replaced.
    pub replaces: bool,
}

impl Paper<'_> {
    /// Writes a drawing into a folder under this name, in every format.
    ///
    /// # Errors
    ///
    /// [`Failure::File`] if a file exists and is to be kept, or cannot be written.
    pub fn write(&self, folder: &Path, name: &str, svg: &str) -> Result<(), Failure> {
        for format in self.formats {
            let (ending, bytes) = match format {
                PictureFormat::Svg => ("svg", Ok(svg.as_bytes().to_vec())),
                PictureFormat::Png => ("png", render::paper_png(svg, self.width_mm, self.dpi)),
                PictureFormat::Pdf => ("pdf", render::pdf(svg)),
            };
            let bytes = bytes.map_err(|cause| Failure::write(folder, cause))?;
            let path = folder.join(format!("{name}.{ending}"));
            let written: Result<(), FileError> = if self.replaces {
                write_bytes(&path, &bytes)
            } else {
                write_new(&path, &bytes)
            };
            written?;
        }
        Ok(())
    }
}
