//! Renders a drawing to pixels or to a page of PDF, with the typeface embedded in the program.

use std::io;
use std::sync::{Arc, LazyLock};

use resvg::{tiny_skia, usvg};

use crate::sheet::palette;
use crate::sheet::pdf;
use crate::sheet::png::{self, PixelFormat};
use crate::sheet::svg::FAMILY;

/// Pixels per unit of a drawing. Twice as many take twice as long; the SVG itself is sharp at any size.
const ZOOM: f64 = 1.0;

static OPTIONS: LazyLock<usvg::Options<'static>> = LazyLock::new(|| {
    let mut options = usvg::Options {
        font_family: FAMILY.to_owned(),
        ..usvg::Options::default()
    };
    Arc::make_mut(&mut options.fontdb).load_font_data(dejavu::sans::regular().to_vec());
    options
});

/// Renders a drawing as a PNG file.
///
/// # Errors
///
/// If the drawing is not SVG, or if there is no memory for its pixels.
pub fn png(svg: &str) -> io::Result<Vec<u8>> {
    let (width, height, rgb) = pixels(svg, |_| ZOOM)?;
    Ok(png::encode(width, height, PixelFormat::Rgb, &rgb))
}

/// Renders a drawing as a PNG file of this width on paper (mm) at a number of pixels per inch, both of which are
/// recorded in it.
///
/// # Errors
///
/// Those of [`png()`].
pub fn paper_png(svg: &str, width_mm: f64, dpi: f64) -> io::Result<Vec<u8>> {
    const INCH_MM: f64 = 25.4;
    let tree = tree(svg)?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(f64::from);
    let wanted = (width_mm / INCH_MM * dpi).round();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "some thousand pixels, and pixels per metre"
    )]
    let [across, upwards, density] =
        [wanted, wanted * height / width, dpi / INCH_MM * 1e3].map(|of| of.round() as u32);
    let size = tiny_skia::IntSize::from_wh(across, upwards.max(1));
    let (width, height, rgb) = painted(&tree, single(wanted / width), size)?;
    Ok(png::encode_at(
        [width, height],
        density,
        PixelFormat::Rgb,
        &rgb,
    ))
}

/// Renders a drawing as a PNG file of this width, in as few bytes as possible.
///
/// # Errors
///
/// Those of [`png()`].
pub fn small_png(svg: &str, width: f64) -> io::Result<Vec<u8>> {
    let (width, height, rgb) = pixels(svg, |whole| width / whole)?;
    palette::encode(width, height, &rgb)
}

/// Writes a drawing as a PDF file of one page of the drawing's size, with letters as outlines.
///
/// # Errors
///
/// If the drawing is not SVG, or not one of this crate.
pub fn pdf(svg: &str) -> io::Result<Vec<u8>> {
    pdf::page(&tree(svg)?)
}

/// Width, height and the bytes of the pixels, three for each; the pixels per unit depend on the drawing's width.
fn pixels(svg: &str, zoom: impl Fn(f64) -> f64) -> io::Result<(usize, usize, Vec<u8>)> {
    let tree = tree(svg)?;
    let zoom = single(zoom(tree.size().width().into()));
    let size = tree.size().to_int_size().scale_by(zoom);
    painted(&tree, zoom, size)
}

fn tree(svg: &str) -> io::Result<usvg::Tree> {
    usvg::Tree::from_str(svg, &OPTIONS).map_err(io::Error::other)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "single precision is enough for pixels"
)]
fn single(number: f64) -> f32 {
    number as f32
}

/// Width, height and the bytes of the pixels of a tree.
fn painted(
    tree: &usvg::Tree,
    zoom: f32,
    size: Option<tiny_skia::IntSize>,
) -> io::Result<(usize, usize, Vec<u8>)> {
    let pixels = size.and_then(|size| tiny_skia::Pixmap::new(size.width(), size.height()));
    let mut pixels = pixels.ok_or_else(|| io::Error::other("no memory for the picture"))?;
    let zoom = tiny_skia::Transform::from_scale(zoom, zoom);
    resvg::render(tree, zoom, &mut pixels.as_mut());
    let (width, height) = (pixels.width() as usize, pixels.height() as usize);
    let mut rgb = vec![0; 3 * width * height];
    // The last row and column may extend beyond the sheet; paper is white there.
    for (rgb, pixel) in rgb.chunks_exact_mut(3).zip(pixels.data().chunks_exact(4)) {
        let paper = 255 - pixel[3];
        for (channel, value) in rgb.iter_mut().zip(pixel) {
            *channel = value.saturating_add(paper);
        }
    }
    Ok((width, height, rgb))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::colours::Colour;
    use crate::sheet::svg::{Anchor, Rect, Svg};

    fn pixels(svg: Svg) -> (usize, Vec<u8>) {
        let bytes = png(&svg.finish()).unwrap();
        let mut reader = ::png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        (info.width as usize, pixels)
    }

    #[test]
    fn a_rectangle_is_rendered_in_its_colour_and_place() {
        let mut svg = Svg::new(20.0, 10.0);
        let place = Rect {
            left: 10.0,
            top: 0.0,
            width: 10.0,
            height: 10.0,
        };
        svg.rectangle(place, Colour(10, 20, 30));
        let (width, pixels) = pixels(svg);
        assert_eq!(width, 20);
        assert_eq!(pixels[..3], [255, 255, 255]);
        assert_eq!(pixels[3 * 19..3 * 20], [10, 20, 30]);
    }

    #[test]
    fn a_picture_on_paper_has_the_pixels_of_its_width_and_records_them() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"85mm\" height=\"51mm\" viewBox=\"0 0 510 306\"/>";
        let bytes = paper_png(svg, 85.0, 600.0).unwrap();
        let reader = ::png::Decoder::new(io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let info = reader.info();
        // 85 mm/25.4 mm · 600 = 2007.9; 600/25.4 mm = 23622 per metre
        assert_eq!((info.width, info.height), (2008, 1205));
        assert_eq!(info.pixel_dims.unwrap().xppu, 23622);
    }

    #[test]
    fn text_is_rendered_without_system_fonts() {
        let mut svg = Svg::new(40.0, 20.0);
        svg.text((20.0, 10.0), 16.0, Anchor::Middle, "pµ²");
        assert!(pixels(svg).1.iter().any(|channel| *channel < 100));
    }
}
