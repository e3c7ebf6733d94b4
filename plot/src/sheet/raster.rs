//! A small raster image, placed in a drawing.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::sheet::colours::Colour;
use crate::sheet::png;

/// Pixels in rows from the top, four bytes each: red, green, blue, opacity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    width: usize,
    height: usize,
    rgba: Vec<u8>,
}

impl Raster {
    /// Returns a transparent raster.
    #[must_use]
    pub fn transparent(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            rgba: vec![0; 4 * width * height],
        }
    }

    /// Returns a raster whose pixel in column `i` and row `j`, from the top left, is `colour(i, j)`.
    #[must_use]
    pub fn of(width: usize, height: usize, colour: impl Fn(usize, usize) -> Colour) -> Self {
        let mut raster = Self::transparent(width, height);
        for j in 0..height {
            for i in 0..width {
                let Colour(red, green, blue) = colour(i, j);
                raster.set(i, j, [red, green, blue, 255]);
            }
        }
        raster
    }

    /// Sets red, green, blue and opacity of a pixel.
    ///
    /// # Panics
    ///
    /// If there is no such pixel.
    pub fn set(&mut self, i: usize, j: usize, rgba: [u8; 4]) {
        let at = 4 * (j * self.width + i);
        self.rgba[at..at + 4].copy_from_slice(&rgba);
    }

    /// The opacity of each pixel.
    #[cfg(test)]
    pub fn opacities(&self) -> impl Iterator<Item = u8> {
        self.rgba.chunks_exact(4).map(|pixel| pixel[3])
    }

    /// Returns the raster as a `data:` URL of a PNG image.
    #[must_use]
    pub fn data_address(&self) -> String {
        let bytes = png::encode(self.width, self.height, png::PixelFormat::Rgba, &self.rgba);
        format!("data:image/png;base64,{}", STANDARD.encode(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_raster_is_embedded_as_png() {
        let address = Raster::of(3, 2, |_, _| Colour(1, 2, 3)).data_address();
        // The signature of PNG in base 64.
        assert!(
            address.starts_with("data:image/png;base64,iVBORw0KGgo"),
            "{address}"
        );
    }
}
