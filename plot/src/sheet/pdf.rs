//! Writes a drawing as a PDF file of one page: lines and areas stay sharp at any size, letters are outlines, so that no
//! typeface is needed, and rasters are embedded with their own pixels.

use std::io::{self, Write as _};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};
use resvg::tiny_skia::{Path, PathSegment, Point, Transform};
use resvg::usvg;

/// Points of a PDF, of 1/72 inch, in a pixel of SVG, of 1/96 inch.
const POINTS: f32 = 0.75;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
/// Rasters are numbered from here on, two for each: colours and opacity.
const FIRST_RASTER: i32 = 5;

/// Writes the page of a drawing.
///
/// # Errors
///
/// If the drawing has what [`Svg`](crate::sheet::svg::Svg) does not draw: gradients, patterns, or rasters but PNG.
pub(super) fn page(tree: &usvg::Tree) -> io::Result<Vec<u8>> {
    let [width, height] = [tree.size().width(), tree.size().height()].map(|side| side * POINTS);
    let mut sheet = Sheet {
        content: Content::new(),
        rasters: Vec::new(),
    };
    // The second axis of a PDF runs upwards.
    sheet
        .content
        .transform([POINTS, 0.0, 0.0, -POINTS, 0.0, height]);
    sheet.group(tree.root())?;

    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.media_box(Rect::new(0.0, 0.0, width, height));
    page.parent(PAGES).contents(CONTENT);
    let mut resources = page.resources();
    let mut names = resources.x_objects();
    for number in 0..sheet.rasters.len() {
        names.pair(Name(name(number).as_bytes()), colours(number));
    }
    names.finish();
    resources.finish();
    page.finish();
    for (number, raster) in sheet.rasters.iter().enumerate() {
        raster.write(&mut pdf, number)?;
    }
    let content = compressed(sheet.content.finish().as_slice())?;
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    Ok(pdf.finish())
}

fn name(number: usize) -> String {
    format!("R{number}")
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "a drawing has a few rasters"
)]
fn colours(number: usize) -> Ref {
    Ref::new(FIRST_RASTER + 2 * number as i32)
}

fn compressed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes)?;
    encoder.finish()
}

fn unknown(what: &str) -> io::Error {
    io::Error::other(format!("found {what} in a drawing, wanted plain colours"))
}

/// What is drawn so far.
struct Sheet {
    content: Content,
    rasters: Vec<Pixels>,
}

impl Sheet {
    fn group(&mut self, group: &usvg::Group) -> io::Result<()> {
        self.content.save_state();
        self.content.transform(matrix(group.transform()));
        if let Some(clip) = group.clip_path() {
            self.clip(clip.root(), clip.transform());
            self.content.clip_nonzero().end_path();
        }
        for node in group.children() {
            match node {
                usvg::Node::Group(group) => self.group(group)?,
                usvg::Node::Path(path) => self.path(path)?,
                usvg::Node::Image(image) => self.image(image)?,
                usvg::Node::Text(text) => self.group(text.flattened())?,
            }
        }
        self.content.restore_state();
        Ok(())
    }

    /// Adds the outlines within a group to the current path.
    fn clip(&mut self, group: &usvg::Group, transform: Transform) {
        let transform = transform.pre_concat(group.transform());
        for node in group.children() {
            match node {
                usvg::Node::Group(group) => self.clip(group, transform),
                usvg::Node::Path(path) => {
                    if let Some(path) = path.data().clone().transform(transform) {
                        self.outline(&path);
                    }
                }
                usvg::Node::Image(_) | usvg::Node::Text(_) => {}
            }
        }
    }

    fn path(&mut self, path: &usvg::Path) -> io::Result<()> {
        if let Some(fill) = path.fill() {
            let [red, green, blue] = rgb(fill.paint())?;
            self.content.set_fill_rgb(red, green, blue);
            self.outline(path.data());
            match fill.rule() {
                usvg::FillRule::NonZero => self.content.fill_nonzero(),
                usvg::FillRule::EvenOdd => self.content.fill_even_odd(),
            };
        }
        if let Some(stroke) = path.stroke() {
            let [red, green, blue] = rgb(stroke.paint())?;
            let (dashes, offset) = (stroke.dasharray().unwrap_or_default(), stroke.dashoffset());
            self.content
                .set_stroke_rgb(red, green, blue)
                .set_line_width(stroke.width().get())
                .set_miter_limit(stroke.miterlimit().get())
                .set_line_cap(match stroke.linecap() {
                    usvg::LineCap::Butt => LineCapStyle::ButtCap,
                    usvg::LineCap::Round => LineCapStyle::RoundCap,
                    usvg::LineCap::Square => LineCapStyle::ProjectingSquareCap,
                })
                .set_line_join(match stroke.linejoin() {
                    usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => LineJoinStyle::MiterJoin,
                    usvg::LineJoin::Round => LineJoinStyle::RoundJoin,
                    usvg::LineJoin::Bevel => LineJoinStyle::BevelJoin,
                })
                .set_dash_pattern(dashes.iter().copied(), offset);
            self.outline(path.data());
            self.content.stroke();
        }
        Ok(())
    }

    fn outline(&mut self, path: &Path) {
        let mut from = Point::zero();
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(to) => {
                    self.content.move_to(to.x, to.y);
                    from = to;
                }
                PathSegment::LineTo(to) => {
                    self.content.line_to(to.x, to.y);
                    from = to;
                }
                PathSegment::QuadTo(bend, to) => {
                    // A parabola as a cubic: its handles end two thirds of the way to the bend.
                    let handle = |end: Point| {
                        let part = |end: f32, bend: f32| end + 2.0 / 3.0 * (bend - end);
                        (part(end.x, bend.x), part(end.y, bend.y))
                    };
                    let ((x1, y1), (x2, y2)) = (handle(from), handle(to));
                    self.content.cubic_to(x1, y1, x2, y2, to.x, to.y);
                    from = to;
                }
                PathSegment::CubicTo(first, second, to) => {
                    self.content
                        .cubic_to(first.x, first.y, second.x, second.y, to.x, to.y);
                    from = to;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    fn image(&mut self, image: &usvg::Image) -> io::Result<()> {
        let usvg::ImageKind::PNG(bytes) = image.kind() else {
            return Err(unknown("a raster that is no PNG"));
        };
        let name = name(self.rasters.len());
        self.rasters.push(Pixels::decoded(bytes)?);
        let (width, height) = (image.size().width(), image.size().height());
        // A raster covers the unit square, from its lower row upwards.
        self.content
            .save_state()
            .transform([width, 0.0, 0.0, -height, 0.0, height])
            .x_object(Name(name.as_bytes()))
            .restore_state();
        Ok(())
    }
}

fn matrix(transform: Transform) -> [f32; 6] {
    let Transform {
        sx,
        ky,
        kx,
        sy,
        tx,
        ty,
    } = transform;
    [sx, ky, kx, sy, tx, ty]
}

fn rgb(paint: &usvg::Paint) -> io::Result<[f32; 3]> {
    match paint {
        usvg::Paint::Color(colour) => {
            Ok([colour.red, colour.green, colour.blue].map(|part| f32::from(part) / 255.0))
        }
        _ => Err(unknown("a gradient or a pattern")),
    }
}

/// A raster: three bytes of colour and one of opacity for each pixel, in rows from the top.
struct Pixels {
    width: u32,
    height: u32,
    rgb: Vec<u8>,
    opacity: Vec<u8>,
}

impl Pixels {
    /// Decodes a raster as [`Raster`](crate::sheet::raster::Raster) encodes it.
    fn decoded(bytes: &[u8]) -> io::Result<Self> {
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info()?;
        let size = reader.output_buffer_size();
        let mut rgba = vec![0; size.ok_or_else(|| io::Error::other("no memory for a raster"))?];
        let info = reader.next_frame(&mut rgba)?;
        if (info.color_type, info.bit_depth) != (png::ColorType::Rgba, png::BitDepth::Eight) {
            return Err(unknown("a raster without opacity"));
        }
        let pixels = rgba.chunks_exact(4);
        Ok(Self {
            width: info.width,
            height: info.height,
            rgb: pixels
                .clone()
                .flat_map(|pixel| &pixel[..3])
                .copied()
                .collect(),
            opacity: pixels.map(|pixel| pixel[3]).collect(),
        })
    }

    fn write(&self, pdf: &mut Pdf, number: usize) -> io::Result<()> {
        let reference = colours(number);
        let opacity = Ref::new(reference.get() + 1);
        let [width, height] = [self.width, self.height].map(u32::cast_signed);
        let bytes = compressed(&self.rgb)?;
        let mut image = pdf.image_xobject(reference, &bytes);
        image.filter(Filter::FlateDecode);
        image.width(width).height(height);
        image.color_space().device_rgb();
        image.bits_per_component(8).s_mask(opacity);
        image.finish();
        let bytes = compressed(&self.opacity)?;
        let mut mask = pdf.image_xobject(opacity, &bytes);
        mask.filter(Filter::FlateDecode);
        mask.width(width).height(height);
        mask.color_space().device_gray();
        mask.bits_per_component(8);
        mask.finish();
        Ok(())
    }
}
