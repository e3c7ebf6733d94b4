//! A small picture of pixels, to be placed in a drawing.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::colours::Colour;
use super::png;

/// Pixels in rows from the top, four bytes each: red, green, blue, opacity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Raster {
    width: usize,
    height: usize,
    rgba: Vec<u8>,
}

impl Raster {
    /// A transparent raster.
    #[must_use]
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            rgba: vec![0; 4 * width * height],
        }
    }

    /// A raster whose pixel in column `i` and row `j`, from the top left, is `colour(i, j)`.
    #[must_use]
    pub fn of(width: usize, height: usize, colour: impl Fn(usize, usize) -> Colour) -> Self {
        let mut raster = Self::new(width, height);
        for j in 0..height {
            for i in 0..width {
                raster.set(i, j, colour(i, j));
            }
        }
        raster
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Makes a pixel opaque.
    ///
    /// # Panics
    ///
    /// If there is no such pixel.
    pub fn set(&mut self, i: usize, j: usize, colour: Colour) {
        let at = 4 * (j * self.width + i);
        self.rgba[at..at + 4].copy_from_slice(&[colour.0, colour.1, colour.2, 255]);
    }

    /// How many pixels are opaque.
    #[must_use]
    pub fn opaque_pixels(&self) -> usize {
        let pixels = self.rgba.chunks_exact(4);
        pixels.filter(|pixel| pixel[3] == 255).count()
    }

    /// The raster at half the size, each pixel the mean of four; what is transparent counts for opacity only.
    #[must_use]
    pub fn halved(&self) -> Self {
        let mut half = Self::new(self.width / 2, self.height / 2);
        for (e, pixel) in half.rgba.chunks_exact_mut(4).enumerate() {
            let (i, j) = (e % half.width, e / half.width);
            pixel.copy_from_slice(&self.mean_of_four(2 * i, 2 * j));
        }
        half
    }

    fn mean_of_four(&self, i: usize, j: usize) -> [u8; 4] {
        let mut sums = [0_u32; 4];
        for (i, j) in [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)] {
            let at = 4 * (j * self.width + i);
            let pixel = &self.rgba[at..at + 4];
            let opaque = u32::from(pixel[3] == 255);
            for (sum, channel) in sums.iter_mut().zip(pixel) {
                *sum += opaque * u32::from(*channel);
            }
        }
        let opaque = (sums[3] / 255).max(1);
        let channel = |sum: u32, of: u32| u8::try_from(sum / of).unwrap_or(u8::MAX);
        let [red, green, blue, opacity] = sums;
        [
            channel(red, opaque),
            channel(green, opaque),
            channel(blue, opaque),
            channel(opacity, 4),
        ]
    }

    /// The raster as the address of a PNG image inside a document.
    #[must_use]
    pub fn data_address(&self) -> String {
        let bytes = png::encode(self.width, self.height, png::Kind::Rgba, &self.rgba);
        format!("data:image/png;base64,{}", STANDARD.encode(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_size_has_the_mean_colour_and_opacity() {
        let mut raster = Raster::new(2, 2);
        raster.set(0, 0, Colour(100, 0, 10));
        raster.set(1, 1, Colour(200, 0, 20));
        // Two opaque pixels of four: their mean colour, half opaque.
        assert_eq!(raster.halved().rgba, [150, 0, 15, 127]);
        assert_eq!(Raster::new(4, 4).halved().rgba, [0; 16]);
    }

    #[test]
    fn a_raster_is_addressed_as_png() {
        let address = Raster::of(3, 2, |_, _| Colour(1, 2, 3)).data_address();
        // The signature of PNG in base 64.
        assert!(
            address.starts_with("data:image/png;base64,iVBORw0KGgo"),
            "{address}"
        );
    }
}
