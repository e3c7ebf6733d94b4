//! A section along x or y, by default through the axis: indenter, tops of the relief, surface of the body, and the
//! pressure above them.

use std::ops::Range;

use pellicle::display::{DisplayUnit, Unit, quantity};

use crate::axes::labels;
use crate::axes::labels::power;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::Cut;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::step::crop::Crop;
use crate::step::subject::Subject;

const LEFT: f64 = 112.0;
const PANEL_WIDTH: f64 = 940.0;
/// Width of the picture, in pixels.
const WIDTH: f64 = LEFT + PANEL_WIDTH + 40.0;
const PRESSURE: Rect = Rect::at((LEFT, heading::HEIGHT), (PANEL_WIDTH, 230.0));
/// Height between the panels, for the legend.
const BETWEEN: f64 = 44.0;
const DEPTH: Rect = Rect::at(
    (LEFT, PRESSURE.top + PRESSURE.height + BETWEEN),
    (PANEL_WIDTH, 420.0),
);
const HEIGHT: f64 = DEPTH.top + DEPTH.height + 72.0;

/// Margins of the depth axis above the highest and below the deepest point of the surface, as fractions of the depth
/// between them.
const ABOVE: f64 = 0.3;
const BELOW: f64 = 0.12;

const LINE: f64 = 2.2;

/// Depths below the undeformed plane of the tops, m, along one line of elements.
struct Depths<'a> {
    subject: &'a Subject<'a>,
    line: ElementLine,
    /// The elements that are shown.
    elements: Range<usize>,
}

/// A line of elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ElementLine {
    /// A line along x, with this second index.
    AlongX(usize),
    /// A line along y, with this first index.
    AlongY(usize),
}

impl ElementLine {
    fn of(subject: &Subject<'_>) -> Self {
        let fields = &subject.fields;
        match subject.style.cut.unwrap_or_default() {
            Cut::Axis => Self::AlongX(fields.size / 2),
            Cut::Peak => Self::AlongX(peak(fields.pressure) % fields.size),
            Cut::AlongX(y) => Self::AlongX(fields.nearest(y)),
            Cut::AlongY(x) => Self::AlongY(fields.nearest(x)),
        }
    }

    /// Names of the coordinate along the line and of the constant one, and the index of the latter.
    fn names(self) -> (&'static str, &'static str, usize) {
        match self {
            Self::AlongX(index) => ("x", "y", index),
            Self::AlongY(index) => ("y", "x", index),
        }
    }
}

/// The second index of the elements of a section along x; none along y.
#[must_use]
pub fn row(subject: &Subject<'_>) -> Option<usize> {
    match ElementLine::of(subject) {
        ElementLine::AlongX(row) => Some(row),
        ElementLine::AlongY(_) => None,
    }
}

/// Returns the first of the elements with the largest pressure.
fn peak(pressure: &[f64]) -> usize {
    let larger = |best: usize, e: usize| {
        if pressure[e] > pressure[best] {
            e
        } else {
            best
        }
    };
    (0..pressure.len()).fold(0, larger)
}

/// Draws the picture as SVG.
#[must_use]
pub fn draw(subject: &Subject<'_>) -> String {
    let fields = &subject.fields;
    let line = ElementLine::of(subject);
    let crop = Crop::around_contact(fields.pressure, fields.size);
    let depths = Depths {
        subject,
        line,
        elements: match line {
            ElementLine::AlongX(_) => crop.x,
            ElementLine::AlongY(_) => crop.y,
        },
    };
    let mut svg = subject.style.sheet(WIDTH, HEIGHT);
    let (_, across, index) = line.names();
    let at = quantity(fields.centre(index), Unit::Metre, subject.units);
    let more = format!(",  section at {across} = {at}");
    subject.draw_heading(&mut svg, LEFT, PANEL_WIDTH, &more);
    depths.draw_pressure(&mut svg);
    depths.draw_legend(&mut svg);
    depths.draw_depths(&mut svg);
    svg.finish()
}

impl Depths<'_> {
    fn element(&self, i: usize) -> usize {
        let size = self.subject.fields.size;
        match self.line {
            ElementLine::AlongX(j) => i * size + j,
            ElementLine::AlongY(j) => j * size + i,
        }
    }

    /// Elastic surface of the relief or body: `u + w* − f*`.
    fn elastic_top(&self, i: usize) -> f64 {
        let (fields, e) = (&self.subject.fields, self.element(i));
        fields.displacement[e] + fields.shortening[e] - fields.profile[e]
    }

    fn plastic_depth(&self, i: usize) -> f64 {
        let depths = self.subject.fields.plastic_depth;
        depths.get(self.element(i)).copied().unwrap_or(0.0)
    }

    /// Surface that touches the indenter: the plastic depth below the elastic surface.
    fn top(&self, i: usize) -> f64 {
        self.elastic_top(i) + self.plastic_depth(i)
    }

    /// Surface of the indenter: `D − f = u + w* − f* − g`; not finite where it ends.
    fn indenter(&self, i: usize) -> f64 {
        self.elastic_top(i) - self.subject.fields.gap[self.element(i)]
    }

    /// Surface of the body, `u + h`, lowered by the plastic depth where there is no relief; the contact surface if the
    /// relief has no uniform height.
    fn body(&self, i: usize) -> f64 {
        let Some(height) = self.subject.relief_height else {
            return self.top(i);
        };
        let (fields, e) = (&self.subject.fields, self.element(i));
        let plastic_depth = if fields.mask[e] {
            0.0
        } else {
            self.plastic_depth(i)
        };
        fields.displacement[e] + height + plastic_depth
    }

    /// Whether relief and body are drawn separately.
    fn has_relief(&self) -> bool {
        self.subject
            .relief_height
            .is_some_and(|height| height > 0.0)
            && self.subject.fields.mask.contains(&true)
    }

    fn ends(&self) -> [f64; 2] {
        [self.elements.start, self.elements.end].map(|i| self.subject.fields.edge(i))
    }

    /// Returns the highest and the deepest point of tops and body; the undeformed plane of the tops is included.
    fn extent(&self) -> [f64; 2] {
        let elements = self.elements.clone();
        let surfaces = elements.flat_map(|i| [self.body(i), self.top(i)]);
        surfaces.fold([0.0, 0.0], |[high, deep], z| {
            [f64::min(high, z), f64::max(deep, z)]
        })
    }

    fn x_axis(&self) -> (Axis, DisplayUnit) {
        let [from, to] = self.ends();
        let scale = self.subject.metres(from.abs().max(to.abs()));
        let title = labels::axis_title(self.line.names().0, &scale.label);
        let (from, to) = (from / scale.divisor, to / scale.divisor);
        (Axis::new(from, to, title, 8), scale)
    }

    fn draw_pressure(&self, svg: &mut Svg) {
        let (x, metres) = self.x_axis();
        let (scale, shades) = self.subject.pressures();
        let (from, to) = (shades.from, shades.to + 0.08 * (shades.to - shades.from));
        let panel = Panel {
            place: PRESSURE,
            x: x.unlabelled(),
            y: Axis::new(from, to, labels::axis_title("p", &scale.label), 5),
        };
        // The pressure is constant over an element.
        let steps = self.elements.clone().flat_map(|i| {
            let pressure = self.subject.fields.pressure[self.element(i)] / scale.divisor;
            let edge = |i| self.subject.fields.edge(i) / metres.divisor;
            [(edge(i), pressure), (edge(i + 1), pressure)]
        });
        let line = panel.all_at(steps);
        panel.draw_mesh(svg);
        let baseline = PRESSURE.bottom();
        svg.within(PRESSURE, |svg| {
            svg.area(&closed(&line, baseline), Colour(200, 220, 236));
            svg.line(&line, Stroke::new(colours::BLUE, 1.6));
        });
        panel.draw_axes(svg);
    }

    fn draw_depths(&self, svg: &mut Svg) {
        let (x, metres) = self.x_axis();
        let [highest, deepest] = self.extent();
        let scale = self.subject.metres(deepest.max(-highest));
        let [highest, deepest] = [highest, deepest].map(|depth| depth / scale.divisor);
        let span = deepest - highest;
        let span = if span > 0.0 && span.is_finite() {
            span
        } else {
            1.0
        };
        let title = labels::axis_title("depth z", &scale.label);
        let panel = Panel {
            place: DEPTH,
            x,
            y: Axis::new(deepest + BELOW * span, highest - ABOVE * span, title, 7),
        };
        let lines =
            |depth: &dyn Fn(usize) -> f64, runs: Vec<Range<usize>>| -> Vec<Vec<(f64, f64)>> {
                let line = |run: Range<usize>| self.line(run, depth, metres.divisor, scale.divisor);
                runs.into_iter()
                    .map(|run| panel.all_at(line(run)))
                    .collect()
            };
        let bodies = lines(&|i| self.body(i), self.runs(|_| true));
        let tops = lines(&|i| self.top(i), self.runs(|i| self.is_relief(i)));
        let bases = lines(&|i| self.body(i), self.runs(|i| self.is_relief(i)));
        let indenters = lines(
            &|i| self.indenter(i),
            self.runs(|i| self.indenter(i).is_finite()),
        );
        svg.within(DEPTH, |svg| {
            for body in &bodies {
                svg.area(&closed(body, DEPTH.bottom()), colours::BODY);
            }
            for (top, base) in tops.iter().zip(&bases) {
                let outline = top.iter().chain(base.iter().rev()).copied();
                svg.area(&outline.collect::<Vec<_>>(), colours::SPRINGS);
            }
            for indenter in &indenters {
                svg.area(&closed(indenter, DEPTH.top), colours::INDENTER);
            }
            svg.lines(&bodies, Stroke::new(colours::ORANGE, LINE));
            svg.lines(&tops, Stroke::new(colours::BLUE, LINE));
            svg.lines(&indenters, Stroke::new(colours::INK, LINE));
            let plane = panel.all_at([(panel.x.from, 0.0), (panel.x.to, 0.0)]);
            svg.line(&plane, Stroke::new(colours::RELIEF_OUTLINE, 1.0));
        });
        panel.draw_axes(svg);
        let depths = (panel.y.from - panel.y.to) * scale.divisor;
        let [from, to] = self.ends();
        // Vertical pixels per length over horizontal pixels per length.
        let enlarged = (DEPTH.height / depths) / (DEPTH.width / (to - from));
        let note = format!("depth {} × enlarged", power(enlarged, 2));
        let place = (DEPTH.right(), DEPTH.top - 22.0);
        svg.text(place, 15.0, Anchor::End, &note);
    }

    fn is_relief(&self, i: usize) -> bool {
        self.has_relief() && self.subject.fields.mask[self.element(i)]
    }

    /// Returns the longest runs of the shown elements for which `holds` is true.
    fn runs(&self, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
        let mut runs: Vec<Range<usize>> = Vec::new();
        for i in self.elements.clone().filter(|i| holds(*i)) {
            match runs.last_mut() {
                Some(run) if run.end == i => run.end = i + 1,
                _ => runs.push(i..i + 1),
            }
        }
        runs
    }

    /// Returns a line through the centres of a run, extended straight to its ends.
    fn line(
        &self,
        run: Range<usize>,
        depth: &dyn Fn(usize) -> f64,
        metres: f64,
        divisor: f64,
    ) -> Vec<(f64, f64)> {
        let fields = &self.subject.fields;
        let inner = run.len().min(2) - 1;
        // Extrapolates by half an element beyond the outermost centre.
        let beyond = |outer: usize, inner: usize| 1.5 * depth(outer) - 0.5 * depth(inner);
        let first = (fields.edge(run.start), beyond(run.start, run.start + inner));
        let last = (
            fields.edge(run.end),
            beyond(run.end - 1, run.end - 1 - inner),
        );
        let centres = run.map(|i| (fields.centre(i), depth(i)));
        let line = std::iter::once(first).chain(centres).chain([last]);
        line.map(|(x, z)| (x / metres, z / divisor)).collect()
    }

    fn draw_legend(&self, svg: &mut Svg) {
        let surface = if self.has_relief() {
            "surface of the body"
        } else {
            "surface"
        };
        let mut entries = vec![(colours::INK, "indenter"), (colours::ORANGE, surface)];
        if self.has_relief() {
            entries.insert(1, (colours::BLUE, "tops of the relief"));
        }
        let y = DEPTH.top - 22.0;
        for (i, (colour, name)) in entries.into_iter().enumerate() {
            let x = LEFT + 230.0 * i as f64;
            svg.line(&[(x, y), (x + 34.0, y)], Stroke::new(colour, 3.0));
            svg.text((x + 42.0, y), 17.0, Anchor::Start, name);
        }
    }
}

/// Returns the area between a line and a level.
fn closed(line: &[(f64, f64)], level: f64) -> Vec<(f64, f64)> {
    let (Some(first), Some(last)) = (line.first(), line.last()) else {
        return Vec::new();
    };
    let ends = [(last.0, level), (first.0, level)];
    line.iter().copied().chain(ends).collect()
}
