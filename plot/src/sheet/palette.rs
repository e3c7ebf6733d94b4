//! Encodes pixels as a PNG file of at most 256 colours, a third of the size of one with all colours.

use std::io;

use color_quant::NeuQuant;

use crate::sheet::png::encoder;

/// Number of colours in a palette.
const COLOURS: usize = 256;

/// The palette is fitted to one pixel in this many: 1 is best and slowest, 30 worst and fastest.
const SAMPLING: i32 = 3;

/// Encodes pixels of three bytes each (red, green, blue) as a PNG file with the best-fitting palette.
///
/// # Errors
///
/// If the sides do not fit the pixels.
pub fn encode(width: usize, height: usize, rgb: &[u8]) -> io::Result<Vec<u8>> {
    let rgba: Vec<u8> = (rgb.chunks_exact(3))
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255])
        .collect();
    let palette = NeuQuant::new(SAMPLING, COLOURS, &rgba);
    let index = |pixel: &[u8]| u8::try_from(palette.index_of(pixel)).unwrap_or(u8::MAX);
    let indices: Vec<u8> = rgba.chunks_exact(4).map(index).collect();
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.color_map_rgb());
    encoder.set_compression(png::Compression::High);
    // Neighbouring indices are not neighbouring colours.
    encoder.set_filter(png::Filter::NoFilter);
    let written = encoder
        .write_header()
        .and_then(|mut file| file.write_image_data(&indices));
    written.map_err(io::Error::other)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_of_few_colours_keeps_them_exactly() {
        let colours = [[255, 255, 255], [30, 30, 30], [0, 114, 178]];
        let rgb: Vec<u8> = (0..64 * 64)
            .flat_map(|i: usize| colours[i / 7 % 3])
            .collect();
        let bytes = encode(64, 64, &rgb).unwrap();
        let mut decoder = png::Decoder::new(io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let mut read = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut read).unwrap();
        let largest = read.iter().zip(&rgb).map(|(a, b)| a.abs_diff(*b)).max();
        // The network reproduces a training colour to within a few levels.
        assert!(largest <= Some(4), "{largest:?}");
    }

    #[test]
    fn sides_that_do_not_match_the_pixels_are_rejected() {
        assert!(encode(3, 3, &[0; 12]).is_err());
    }
}
