//! A drawing as SVG text: lines, areas, text and rasters, in drawing order.

use crate::sheet::colours::{self, Colour};
use crate::sheet::raster::Raster;

/// The typeface, embedded in the program; Verdana has the same widths for browsers without `DejaVu Sans`.
pub const FAMILY: &str = "DejaVu Sans";

/// The part of a text that is placed at its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The beginning.
    Start,
    /// The middle.
    Middle,
    /// The end.
    End,
}

/// Direction of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextDirection {
    /// From left to right.
    Across,
    /// Upwards.
    Up,
}

/// The stroke of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width, in pixels.
    pub width: f64,
}

impl Stroke {
    /// Returns a stroke of this colour and width.
    #[must_use]
    pub fn new(colour: Colour, width: f64) -> Self {
        Self { colour, width }
    }
}

/// The pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Unbroken.
    Solid,
    /// Broken into dashes.
    Dashed,
}

/// A rectangle in pixels, from the top left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left side.
    pub left: f64,
    /// Upper side.
    pub top: f64,
    /// Extent to the right.
    pub width: f64,
    /// Extent downwards.
    pub height: f64,
}

impl Rect {
    /// Returns the rectangle with this upper left corner, of this width and height.
    #[must_use]
    pub const fn at((left, top): (f64, f64), (width, height): (f64, f64)) -> Self {
        Self {
            left,
            top,
            width,
            height,
        }
    }

    /// Its right side.
    #[must_use]
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Its lower side.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }
}

/// A drawing in progress; lengths are in pixels, y runs downwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Svg {
    text: String,
}

/// Size of a drawing and the part of it that is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Width of the drawing.
    pub width: f64,
    /// Height of the drawing, including the part cut off.
    pub height: f64,
    /// Height cut off at the top.
    pub top: f64,
    /// Width at which it is shown.
    pub shown_width: f64,
    /// The unit of that width: `mm`, or nothing for pixels.
    pub unit: &'static str,
}

impl Svg {
    /// Returns a white sheet.
    #[must_use]
    pub fn new(width: f64, height: f64) -> Self {
        Self::framed(&Frame {
            width,
            height,
            top: 0.0,
            shown_width: width,
            unit: "",
        })
    }

    /// Returns a white sheet, of which only a part is shown.
    #[must_use]
    pub fn framed(frame: &Frame) -> Self {
        let Frame {
            width,
            height,
            top,
            shown_width,
            unit,
        } = *frame;
        let height = height - top;
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}{unit}\" height=\"{}{unit}\" viewBox=\"0 {} {} {}\" \
             font-family=\"{FAMILY}, Verdana, sans-serif\">\n",
            number(shown_width),
            number(height * shown_width / width),
            number(top),
            number(width),
            number(height)
        );
        let mut svg = Self { text };
        let sheet = Rect {
            left: 0.0,
            top,
            width,
            height,
        };
        svg.rectangle(sheet, colours::WHITE);
        svg
    }

    /// Finishes the document and returns it.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    /// Draws a filled rectangle.
    pub fn rectangle(&mut self, place: Rect, colour: Colour) {
        let place = attributes(place);
        self.push(&format!("<rect {place} fill=\"{colour}\"/>"));
    }

    /// Draws a line through points.
    pub fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        if points.len() > 1 {
            self.lines(&[points], stroke);
        }
    }

    /// Draws many lines with one stroke, as one element.
    pub fn lines(&mut self, lines: &[impl AsRef<[(f64, f64)]>], stroke: Stroke) {
        self.broken_lines(lines, stroke, Dash::Solid);
    }

    /// Draws many lines with one stroke, solid or dashed, as one element.
    pub fn broken_lines(&mut self, lines: &[impl AsRef<[(f64, f64)]>], stroke: Stroke, dash: Dash) {
        let dash = match dash {
            Dash::Solid => "",
            Dash::Dashed => " stroke-dasharray=\"8 5\"",
        };
        let path: String = lines.iter().map(|line| path(line.as_ref())).collect();
        let Stroke { colour, width } = stroke;
        if !path.is_empty() {
            let width = number(width);
            self.push(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" \
                 stroke-linejoin=\"round\"{dash}/>"
            ));
        }
    }

    /// Draws a filled area.
    pub fn area(&mut self, points: &[(f64, f64)], colour: Colour) {
        let path = path(points);
        if !path.is_empty() {
            self.push(&format!("<path d=\"{path}Z\" fill=\"{colour}\"/>"));
        }
    }

    /// Draws a filled circle.
    pub fn circle(&mut self, (x, y): (f64, f64), radius: f64, fill: Colour, edge: Colour) {
        let [x, y, radius] = [x, y, radius].map(number);
        self.push(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{edge}\" stroke-width=\"2\"/>"
        ));
    }

    /// Draws many equal filled circles, as one element.
    pub fn dots(&mut self, places: &[(f64, f64)], radius: f64, colour: Colour) {
        let dot = |(x, y): &(f64, f64)| format!("M{} {}h0", number(*x), number(*y));
        let path: String = places.iter().map(dot).collect();
        if !path.is_empty() {
            let width = number(2.0 * radius);
            self.push(&format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" \
                 stroke-linecap=\"round\"/>"
            ));
        }
    }

    /// Draws a text, vertically centred on the point.
    pub fn text(&mut self, (x, y): (f64, f64), size: f64, anchor: Anchor, text: &str) {
        self.directed_text((x, y), size, anchor, TextDirection::Across, text);
    }

    /// Draws a text in a colour, centred on the point.
    pub fn coloured_text(&mut self, (x, y): (f64, f64), size: f64, ink: Colour, text: &str) {
        let [x, y, size] = [x, y + 0.35 * size, size].map(number);
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"middle\" fill=\"{ink}\">{}</text>",
            escaped(text)
        ));
    }

    /// Draws a text in a direction.
    pub fn directed_text(
        &mut self,
        (x, y): (f64, f64),
        size: f64,
        anchor: Anchor,
        direction: TextDirection,
        text: &str,
    ) {
        if text.is_empty() {
            return;
        }
        let turn = match direction {
            TextDirection::Across => String::new(),
            TextDirection::Up => format!(" transform=\"rotate(-90 {} {})\"", number(x), number(y)),
        };
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        // The middle of lower-case letters is about a third of the font size above the baseline.
        let [x, y, size] = [x, y + 0.35 * size, size].map(number);
        let (ink, text) = (colours::INK, escaped(text));
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{ink}\"{turn}>{text}</text>"
        ));
    }

    /// Draws a raster stretched over a rectangle, with sharp pixels.
    pub fn image(&mut self, place: Rect, raster: &Raster) {
        let (place, address) = (attributes(place), raster.data_address());
        self.push(&format!(
            "<image {place} preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" href=\"{address}\"/>"
        ));
    }

    /// Draws within a rectangle, clipped to it.
    pub fn within(&mut self, place: Rect, draw: impl FnOnce(&mut Self)) {
        let attributes = attributes(place);
        let [left, top, width, height] =
            [place.left, place.top, place.width, place.height].map(number);
        self.push(&format!(
            "<svg {attributes} viewBox=\"{left} {top} {width} {height}\" overflow=\"hidden\">"
        ));
        draw(self);
        self.push("</svg>");
    }

    fn push(&mut self, element: &str) {
        self.text.push_str(element);
        self.text.push('\n');
    }
}

fn attributes(place: Rect) -> String {
    let [x, y, width, height] = [place.left, place.top, place.width, place.height].map(number);
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

/// Returns the path through the points; empty if there are none.
fn path(points: &[(f64, f64)]) -> String {
    let command = |i| if i == 0 { 'M' } else { 'L' };
    let step =
        |(i, (x, y)): (usize, &(f64, f64))| format!("{}{} {}", command(i), number(*x), number(*y));
    points.iter().enumerate().map(step).collect()
}

/// The largest coordinate drawn. The sheet ends far before it, and the renderer, which counts quarter pixels in 16
/// bits, panics beyond it.
const MAX_COORDINATE: f64 = 8e3;

/// Writes a coordinate to a hundredth of a pixel, as short as possible; 0 for NaN.
fn number(value: f64) -> String {
    let value = if value.is_nan() {
        0.0
    } else {
        value.clamp(-MAX_COORDINATE, MAX_COORDINATE)
    };
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

/// Escapes the five special characters of XML; characters that XML cannot hold become spaces.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            letter if letter.is_control() || matches!(letter, '\u{FFFE}' | '\u{FFFF}') => {
                escaped.push(' ');
            }
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short() {
        assert_eq!(number(3.0), "3");
        assert_eq!(number(-0.001), "0");
        assert_eq!(number(12.3456), "12.35");
        assert_eq!(number(100.0), "100");
        assert_eq!(number(-1e300), "-8000");
        assert_eq!(number(f64::INFINITY), "8000");
        assert_eq!(number(f64::NAN), "0");
    }

    #[test]
    fn any_text_is_escaped() {
        let mut svg = Svg::new(10.0, 10.0);
        svg.text((1.0, 1.0), 5.0, Anchor::Start, "<a> & \"b\" \u{1} 'c'");
        let text = svg.finish();
        assert!(text.contains("&lt;a&gt; &amp; &quot;b&quot;   &#39;c&#39;</text>"));
    }

    #[test]
    fn many_lines_form_one_svg_element() {
        let mut svg = Svg::new(10.0, 10.0);
        let stroke = Stroke::new(colours::INK, 1.0);
        svg.lines(
            &[vec![(0.0, 0.0), (1.0, 2.5)], vec![(3.0, 3.0), (4.0, 4.0)]],
            stroke,
        );
        assert!(svg.finish().contains("d=\"M0 0L1 2.5M3 3L4 4\""));
    }
}
