//! The section through the point of the largest von Mises stress: filled contours of the von Mises stress and the
//! largest principal stress, contact and relief on the surface above, and the interfaces between the bodies.

use pellicle::display::{DisplayUnit, Unit, quantity, significant};

use crate::axes::colour_bar;
use crate::axes::contour_bands::ContourBands;
use crate::axes::labels::{self, power};
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::step::subject::Subject;
use crate::stress::contour_places::{ContourPlaces, boxed};
use crate::stress::depth_scale::DepthScale;
use crate::stress::extremes::{BodyExtremes, Extreme, Extremes};
use crate::stress::section_field::SectionField;
use crate::stress::surface_strip::{CONTACT, ON_SURFACE, SurfaceStrip};
use crate::stress::view::{StressSection, StressView};

const LEFT: f64 = 112.0;
const PANEL_WIDTH: f64 = 850.0;
const PANEL_HEIGHT: f64 = 380.0;
const GAP: f64 = 24.0;
const BAR: f64 = 30.0;
/// Width of the picture, in pixels.
const WIDTH: f64 = LEFT + PANEL_WIDTH + GAP + BAR + colour_bar::BESIDE;

/// Space above a panel for its title and for the strip on the surface.
const ABOVE: f64 = 76.0;
const BELOW: f64 = 66.0;
const HEIGHT: f64 = heading::HEIGHT + 2.0 * (ABOVE + PANEL_HEIGHT + BELOW);

const TITLE: f64 = 16.0;
const INTERFACE: f64 = 2.4;
const MARK: f64 = 6.0;

/// One of the two stresses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stress {
    VonMises,
    MaxPrincipal,
}

/// A largest value with its place, and the index of its body.
type Largest = (usize, Extreme<3>);

/// Draws the picture as SVG.
#[must_use]
pub fn draw(subject: &Subject<'_>, view: &StressView, extremes: &Extremes) -> String {
    let section = &view.section;
    let mut svg = subject.style.sheet(WIDTH, HEIGHT);
    subject.draw_heading(&mut svg, LEFT, WIDTH - LEFT, &where_is(subject, section));
    let drawing = SectionDrawing::new(subject, section, &extremes.bodies);
    let block = ABOVE + PANEL_HEIGHT + BELOW;
    for (i, stress) in [Stress::VonMises, Stress::MaxPrincipal]
        .into_iter()
        .enumerate()
    {
        drawing.draw(&mut svg, heading::HEIGHT + block * i as f64, stress);
    }
    svg.finish()
}

/// `,  section at y = 0 m`, or along the direction of sliding.
fn where_is(subject: &Subject<'_>, section: &StressSection) -> String {
    let line = section.line;
    let [x, y] = line.at(0.0);
    match along_axis(section) {
        "x" => format!(",  section at y = {}", subject.position([y])),
        "y" => format!(",  section at x = {}", subject.position([x])),
        _ => {
            let through = subject.position(line.through);
            let degrees = line.direction.to_degrees();
            format!(
                ",  section through x, y = {through} at {}°",
                power(degrees, 4)
            )
        }
    }
}

/// Name of the coordinate along the section.
fn along_axis(section: &StressSection) -> &'static str {
    let (sin, cos) = section.line.direction.sin_cos();
    match (sin.abs() < 1e-9 && cos > 0.0, cos.abs() < 1e-9 && sin > 0.0) {
        (true, _) => "x",
        (_, true) => "y",
        _ => "s",
    }
}

/// The data that both panels share.
struct SectionDrawing<'a> {
    subject: &'a Subject<'a>,
    section: &'a StressSection,
    bodies: &'a [BodyExtremes],
    depths: DepthScale,
    metres: DisplayUnit,
    depth_metres: DisplayUnit,
}

impl<'a> SectionDrawing<'a> {
    fn new(
        subject: &'a Subject<'a>,
        section: &'a StressSection,
        bodies: &'a [BodyExtremes],
    ) -> Self {
        let depths = section.depths_of_bodies();
        let deepest = depths.last().copied().unwrap_or(0.0);
        let [from, to] = section.ends();
        Self {
            subject,
            section,
            bodies,
            depths: DepthScale::new(&depths),
            metres: subject.metres(from.abs().max(to.abs())),
            depth_metres: subject.metres(deepest),
        }
    }

    fn panel(&self, top: f64) -> Panel {
        let place = Rect::at((LEFT, top + ABOVE), (PANEL_WIDTH, PANEL_HEIGHT));
        let [from, to] = self.section.ends().map(|along| along / self.metres.divisor);
        let title = labels::axis_title(along_axis(self.section), &self.metres.label);
        let depth = labels::axis_title("depth z", &self.depth_metres.label);
        Panel {
            place,
            x: Axis::new(from, to, title, 8),
            y: self.depths.axis(self.depth_metres.divisor, depth),
        }
    }

    fn draw(&self, svg: &mut Svg, top: f64, stress: Stress) {
        let panel = self.panel(top);
        let values = match stress {
            Stress::VonMises => &self.section.von_mises,
            Stress::MaxPrincipal => &self.section.max_principal,
        };
        let field = SectionField::new(self.section, values, &self.depths);
        let marked = self.mark(&field, &panel, stress);
        let [least, largest] = field.extent();
        // At the edge of a contact the extreme is larger than any value on the planes.
        let largest = marked.map_or(largest, |(_, value)| largest.max(value));
        let pascals = DisplayUnit::of(
            largest.abs().max(least.abs()),
            Unit::Pascal,
            self.subject.units,
        );
        let [least, largest] = [least, largest].map(|value| value / pascals.divisor);
        let bands = match stress {
            Stress::VonMises => ContourBands::up_to(largest, self.subject.style.colours),
            Stress::MaxPrincipal => ContourBands::signed(least, largest),
        };
        let image = field.raster(panel.place, |value| bands.colour(value / pascals.divisor));
        svg.image(panel.place, &image);
        let mut places = ContourPlaces::new(panel.place);
        let mark = marked.map(|(place, value)| (place, mark_text(value, &pascals)));
        if let Some((place, text)) = &mark {
            places.reserve_mark(*place, text);
        }
        let names = self.names(&panel, &mut places);
        svg.within(panel.place, |svg| {
            field.draw_contours(svg, &panel, &bands, pascals.divisor, &mut places);
            self.draw_interfaces(svg, &panel);
            for (place, name) in &names {
                boxed(svg, *place, name);
            }
        });
        let surface = SurfaceStrip {
            fields: &self.subject.fields,
            section: self.section,
        };
        surface.draw(svg, panel.place);
        panel.draw_axes(svg);
        if let Some((place, text)) = &mark {
            svg.circle(*place, MARK, colours::WHITE, colours::INK);
            boxed(svg, places.beside_mark(*place, text), text);
        }
        self.draw_words(svg, top, stress);
        let bar = Rect {
            left: panel.place.right() + GAP,
            width: BAR,
            ..panel.place
        };
        let title = labels::axis_title(stress.name(), &pascals.label);
        colour_bar::draw_bands(svg, bar, &bands, &title);
    }

    /// Returns the position and the value of the largest stress on the section: those found by the search, if they lie
    /// on the section.
    fn mark(
        &self,
        field: &SectionField<'_>,
        panel: &Panel,
        stress: Stress,
    ) -> Option<((f64, f64), f64)> {
        let found = self
            .largest(stress)
            .filter(|(_, found)| self.is_on_section(found));
        let (along, depth, body, value) = match found {
            Some((body, found)) => {
                let [x, y, z] = found.at;
                (body < self.depths.bodies()).then_some(())?;
                (self.section.line.along([x, y]), z, body, found.value)
            }
            None => field.largest()?,
        };
        let down = self.depths.down(body, depth);
        (0.0..=1.0).contains(&down).then_some(())?;
        Some((panel.at(along / self.metres.divisor, down), value))
    }

    /// Returns the largest value in all bodies, as found by the search.
    fn largest(&self, stress: Stress) -> Option<Largest> {
        let found = self.bodies.iter().map(|body| match stress {
            Stress::VonMises => body.von_mises,
            Stress::MaxPrincipal => body.max_principal,
        });
        let found = found.enumerate();
        let found = found.filter_map(|(body, found)| Some((body, found?)));
        found.max_by(|(_, one), (_, other)| one.value.total_cmp(&other.value))
    }

    /// Whether a point lies on the section, to within a pixel.
    fn is_on_section(&self, found: &Extreme<3>) -> bool {
        let [x, y, _] = found.at;
        let [from, to] = self.section.ends();
        self.section.line.distance([x, y]) <= (to - from) / PANEL_WIDTH
    }

    /// Places the names of the bodies, each in the upper right corner of its body, and of the interfaces, each on its
    /// line.
    fn names(&self, panel: &Panel, places: &mut ContourPlaces) -> Vec<((f64, f64), String)> {
        let mut names = Vec::new();
        for (i, body) in self.bodies.iter().take(self.depths.bodies()).enumerate() {
            let [top, _] = self.depths.within(i);
            let (right, y) = panel.at(panel.x.to, top);
            names.push((places.in_corner((right, y), &body.name), body.name.clone()));
            if i > 0 {
                places.reserve_line(y);
                let name = format!("interface {}", i - 1);
                names.push((places.on_left(y, &name), name));
            }
        }
        names
    }

    fn draw_interfaces(&self, svg: &mut Svg, panel: &Panel) {
        for body in 1..self.depths.bodies() {
            let [down, _] = self.depths.within(body);
            let line = panel.all_at([(panel.x.from, down), (panel.x.to, down)]);
            svg.line(&line, Stroke::new(colours::WHITE, 2.0 * INTERFACE));
            svg.line(&line, Stroke::new(colours::INK, INTERFACE));
        }
    }

    /// Draws the title, legend and notes above a panel.
    fn draw_words(&self, svg: &mut Svg, top: f64, stress: Stress) {
        let mut title = stress.name().to_owned();
        if let Some((body, found)) = self.largest(stress) {
            let at = self.subject.position(found.at);
            let value = quantity(found.value, Unit::Pascal, self.subject.units);
            let beside = if self.is_on_section(&found) {
                ""
            } else {
                " (off this section)"
            };
            title = format!(
                "{} {value} in {}, at x, y, z = {at}{beside}",
                stress.title(),
                self.bodies[body].name
            );
        }
        svg.text((LEFT, top + 16.0), TITLE, Anchor::Start, &title);
        let mut x = LEFT;
        let y = top + ABOVE - ON_SURFACE - 15.0;
        let mut key = |svg: &mut Svg, height: f64, colour, name: &str| {
            let swatch = Rect::at((x, y - height / 2.0), (30.0, height));
            svg.rectangle(swatch, colour);
            svg.text((swatch.right() + 8.0, y), 15.0, Anchor::Start, name);
            x += 60.0 + 10.0 * name.chars().count() as f64;
        };
        key(svg, CONTACT, colours::INK, "contact");
        if self.subject.fields.mask.contains(&true) {
            key(svg, 14.0, colours::SPRINGS, "relief");
        }
        if stress == Stress::MaxPrincipal {
            svg.text(
                (x, y),
                15.0,
                Anchor::Start,
                "red: tension; blue, dashed lines: compression",
            );
        }
        let place = (LEFT + PANEL_WIDTH, y);
        svg.text(place, 15.0, Anchor::End, &self.enlargement());
    }

    /// Describes the enlargement of depths relative to horizontal lengths.
    fn enlargement(&self) -> String {
        let [from, to] = self.section.ends();
        let across = PANEL_WIDTH / (to - from);
        let factors = (0..self.depths.bodies()).map(|body| {
            let [top, bottom] = self.depths.within(body);
            let depths = [top, bottom].map(|down| self.depths.depth(body, down));
            power(
                PANEL_HEIGHT * (bottom - top) / (depths[1] - depths[0]) / across,
                2,
            )
        });
        let mut factors: Vec<String> = factors.collect();
        factors.dedup();
        format!("depth {} × enlarged", factors.join(", "))
    }
}

/// Writes a value beside its mark, in the unit of the bar.
#[must_use]
pub fn mark_text(value: f64, pascals: &DisplayUnit) -> String {
    let number = significant(value / pascals.divisor, 4);
    if pascals.label.ends_with("Pa") {
        format!("{number} {}", pascals.label)
    } else {
        number
    }
}

impl Stress {
    fn name(self) -> &'static str {
        match self {
            Self::VonMises => "von Mises stress",
            Self::MaxPrincipal => "largest principal stress",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::VonMises => "Largest von Mises stress",
            Self::MaxPrincipal => "Largest principal stress",
        }
    }
}
