//! Encodes pixels as a PNG file.

/// Pixels per metre of paper: 150 per inch, so that the widest picture fits a page.
pub const DENSITY: u32 = 5906;

/// The bytes of one pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PixelFormat {
    /// Red, green, blue.
    Rgb,
    /// Red, green, blue, opacity.
    Rgba,
}

/// Encodes pixels as a PNG file; the result is empty if the sides do not fit the pixels.
#[must_use]
pub fn encode(width: usize, height: usize, kind: PixelFormat, pixels: &[u8]) -> Vec<u8> {
    encode_at([width, height], DENSITY, kind, pixels)
}

/// Encodes pixels likewise, with this many pixels per metre of paper.
#[must_use]
pub fn encode_at(sides: [usize; 2], density: u32, kind: PixelFormat, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Writing to memory fails only if the sides do not fit the pixels.
    drop(try_encode(&mut bytes, sides, density, kind, pixels));
    bytes
}

fn try_encode(
    bytes: &mut Vec<u8>,
    [width, height]: [usize; 2],
    density: u32,
    kind: PixelFormat,
    pixels: &[u8],
) -> Result<(), png::EncodingError> {
    let mut encoder = encoder(bytes, width, height);
    encoder.set_pixel_dims(Some(dimensions(density)));
    encoder.set_color(match kind {
        PixelFormat::Rgb => png::ColorType::Rgb,
        PixelFormat::Rgba => png::ColorType::Rgba,
    });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    // As small as with a filter chosen for each row, the default for this compression, and faster.
    encoder.set_filter(png::Filter::Paeth);
    encoder.write_header()?.write_image_data(pixels)
}

/// Returns an encoder with the sides and the density set.
pub(super) fn encoder(
    bytes: &mut Vec<u8>,
    width: usize,
    height: usize,
) -> png::Encoder<'_, &mut Vec<u8>> {
    let side = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    let mut encoder = png::Encoder::new(bytes, side(width), side(height));
    encoder.set_pixel_dims(Some(dimensions(DENSITY)));
    encoder
}

fn dimensions(density: u32) -> png::PixelDimensions {
    png::PixelDimensions {
        xppu: density,
        yppu: density,
        unit: png::Unit::Meter,
    }
}
