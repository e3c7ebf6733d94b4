//! The strip above a section: the relief on the surface, and the contact as a bar.

use crate::sheet::colours::{self, Colour};
use crate::sheet::svg::{Rect, Svg};
use crate::stress::view::StressSection;
use pellicle::result::fields::Fields;

/// Heights of the relief and of the bar, in pixels.
pub const ON_SURFACE: f64 = 22.0;
pub const CONTACT: f64 = 7.0;

/// Number of pieces along the section, each about a pixel.
const PIECES: usize = 850;

/// The surface above a section.
pub struct SurfaceStrip<'a> {
    /// Fields of the step.
    pub fields: &'a Fields<'a>,
    /// The section.
    pub section: &'a StressSection,
}

impl SurfaceStrip<'_> {
    /// Draws the strip above the rectangle of the section.
    pub fn draw(&self, svg: &mut Svg, place: Rect) {
        let fields = self.fields;
        self.draw_blocks(svg, place, ON_SURFACE, colours::SPRINGS, |e| fields.mask[e]);
        self.draw_blocks(svg, place, CONTACT, colours::INK, |e| {
            fields.pressure[e] > 0.0
        });
    }

    /// Draws a block of this height above every run of elements for which `holds` is true.
    fn draw_blocks(
        &self,
        svg: &mut Svg,
        place: Rect,
        height: f64,
        colour: Colour,
        holds: impl Fn(usize) -> bool,
    ) {
        for [from, to] in self.runs(holds) {
            let block = Rect {
                left: place.left + place.width * from,
                top: place.top - height,
                width: place.width * (to - from),
                height,
            };
            svg.rectangle(block, colour);
        }
    }

    /// Returns the longest runs along the section whose elements satisfy `holds`, as fractions of its length.
    fn runs(&self, holds: impl Fn(usize) -> bool) -> Vec<[f64; 2]> {
        let [from, to] = self.section.ends();
        let part = |i: usize| i as f64 / PIECES as f64;
        let element = |i: usize| {
            let middle = part(i).midpoint(part(i + 1));
            let place = self.section.line.at(from + (to - from) * middle);
            let [x, y] = place.map(|along| self.fields.nearest(along));
            x * self.fields.size + y
        };
        let mut runs: Vec<[f64; 2]> = Vec::new();
        let mut last = None;
        for i in (0..PIECES).filter(|i| holds(element(*i))) {
            match runs.last_mut() {
                Some(run) if last == Some(i) => run[1] = part(i + 1),
                _ => runs.push([part(i), part(i + 1)]),
            }
            last = Some(i + 1);
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::view::SurfaceLine;

    #[test]
    fn runs_cover_the_elements_below_the_line() {
        let zeros = [0.0; 16];
        let mut pressure = zeros;
        // In the row at y = 0.5: elements 1 and 2 along x.
        (pressure[4 + 2], pressure[8 + 2]) = (1.0, 1.0);
        let section = StressSection {
            line: SurfaceLine {
                through: [0.0, 0.4],
                direction: 0.0,
            },
            along: vec![-2.0, 2.0],
            depths: Vec::new(),
            bodies: Vec::new(),
            von_mises: Vec::new(),
            max_principal: Vec::new(),
        };
        let strip = SurfaceStrip {
            fields: &Fields {
                side: 4.0,
                size: 4,
                pressure: &pressure,
                displacement: &zeros,
                gap: &zeros,
                shortening: &zeros,
                plastic_depth: &[],
                profile: &zeros,
                mask: &[false; 16],
            },
            section: &section,
        };
        let runs = strip.runs(|e| pressure[e] > 0.0);
        assert_eq!(runs.len(), 1);
        let [from, to] = runs[0];
        assert!(
            (from - 0.25).abs() < 2e-3 && (to - 0.75).abs() < 2e-3,
            "{runs:?}"
        );
        assert!(strip.runs(|_| false).is_empty());
    }
}
