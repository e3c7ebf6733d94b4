//! Tractions on each interface as maps, with the outline of the contact above and the extremes marked.

use pellicle::display::{DisplayUnit, Unit, quantity};

use crate::axes::colour_bar;
use crate::axes::contour_bands::ContourBands;
use crate::axes::labels;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::raster::Raster;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::step::pressure_map;
use crate::step::subject::Subject;
use crate::stress::contour_places::{ContourPlaces, boxed};
use crate::stress::extremes::{Extreme, Extremes, InterfaceExtremes};
use crate::stress::section::mark_text;
use crate::stress::view::{InterfaceTractions, StressView};

const LEFT: f64 = 112.0;
const SIDE: f64 = 430.0;
const GAP: f64 = 18.0;
const BAR: f64 = 26.0;
/// Width of a map with its axes and its bar, and width of the picture, in pixels.
const CELL: f64 = LEFT + SIDE + GAP + BAR + colour_bar::BESIDE;
const WIDTH: f64 = 2.0 * CELL;

/// Space above a map for its title, and below it for its axis.
const ABOVE: f64 = 52.0;
const BELOW: f64 = 76.0;
const ROW: f64 = ABOVE + SIDE + BELOW;

const TITLE: f64 = 17.0;
const NOTE: f64 = 15.0;
const MARK: f64 = 6.0;

/// Most interfaces in one picture.
pub const MAX_INTERFACES: usize = 8;

/// One of the two tractions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum InterfaceTraction {
    Shear,
    Normal,
}

/// Draws the picture as SVG: a row for each interface.
#[must_use]
pub fn draw(subject: &Subject<'_>, view: &StressView, extremes: &Extremes) -> String {
    let shown = &view.interfaces[..view.interfaces.len().min(MAX_INTERFACES)];
    let height = heading::HEIGHT + ROW * shown.len() as f64;
    let mut svg = subject.style.sheet(WIDTH, height);
    subject.draw_heading(&mut svg, LEFT, WIDTH - LEFT, "");
    for (row, interface) in shown.iter().enumerate() {
        let top = heading::HEIGHT + ROW * row as f64;
        let map = InterfaceMap {
            subject,
            interface,
            centres: &view.centres,
            extremes: (extremes.interfaces.iter()).find(|of| of.index == interface.index),
        };
        map.draw(&mut svg, (0.0, top), InterfaceTraction::Shear);
        map.draw(&mut svg, (CELL, top), InterfaceTraction::Normal);
    }
    svg.finish()
}

/// The maps of one interface.
struct InterfaceMap<'a> {
    subject: &'a Subject<'a>,
    interface: &'a InterfaceTractions,
    centres: &'a [f64],
    extremes: Option<&'a InterfaceExtremes>,
}

impl InterfaceMap<'_> {
    fn draw(&self, svg: &mut Svg, (left, top): (f64, f64), traction: InterfaceTraction) {
        let values = match traction {
            InterfaceTraction::Shear => &self.interface.shear,
            InterfaceTraction::Normal => &self.interface.normal,
        };
        let [least, largest] = extent(values);
        let units = self.subject.units;
        let pascals = DisplayUnit::of(largest.max(-least), Unit::Pascal, units);
        let [least, largest] = [least, largest].map(|value| value / pascals.divisor);
        let bands = match traction {
            InterfaceTraction::Shear => ContourBands::up_to(largest, self.subject.style.colours),
            InterfaceTraction::Normal => ContourBands::signed(least, largest),
        };
        let (panel, metres) = self.panel((left + LEFT, top + ABOVE));
        let place = panel.place;
        let size = self.centres.len();
        let colour =
            |i: usize, j: usize| bands.colour(values[i * size + size - 1 - j] / pascals.divisor);
        svg.image(place, &Raster::of(size, size, colour));
        self.draw_contact(svg, place);
        let marked = self.marked(traction);
        svg.within(place, |svg| {
            draw_mark(svg, &panel, metres, marked.as_ref(), &pascals);
        });
        panel.draw_axes(svg);
        self.draw_words(svg, (place.left, top), traction, marked.as_ref());
        let bar = Rect {
            left: place.right() + GAP,
            width: BAR,
            ..place
        };
        let title = labels::axis_title(traction.symbol(), &pascals.label);
        colour_bar::draw_bands(svg, bar, &bands, &title);
    }

    /// Returns a panel bounded by the outer edges of the outermost elements, and the divisor for the unit of its axes.
    fn panel(&self, (left, top): (f64, f64)) -> (Panel, f64) {
        let half = match self.centres {
            [first, second, ..] => (second - first) / 2.0,
            _ => self.subject.fields.side / 2.0,
        };
        let low = self.centres.first().map_or(0.0, |centre| centre - half);
        let high = self.centres.last().map_or(0.0, |centre| centre + half);
        let scale = self.subject.metres(high.max(-low));
        let axis = |symbol| {
            let title = labels::axis_title(symbol, &scale.label);
            Axis::new(low / scale.divisor, high / scale.divisor, title, 6)
        };
        let panel = Panel {
            place: Rect::at((left, top), (SIDE, SIDE)),
            x: axis("x"),
            y: axis("y"),
        };
        (panel, scale.divisor)
    }

    /// Draws the outline of the contact above, black on white so that it is visible on all colours.
    fn draw_contact(&self, svg: &mut Svg, place: Rect) {
        let fields = &self.subject.fields;
        let elements: Vec<usize> = self.centres.iter().map(|x| fields.nearest(*x)).collect();
        let contact =
            |i: usize, j: usize| fields.pressure[elements[i] * fields.size + elements[j]] > 0.0;
        let line = pressure_map::pen(colours::INK);
        let halo = Stroke::new(colours::WHITE, 3.0 * line.width);
        for stroke in [halo, line] {
            pressure_map::draw_outline(svg, place, self.centres.len(), contact, stroke);
        }
    }

    /// Returns the extreme to mark: the largest shear, the largest tension, or the largest compression if there is no
    /// tension or it is not wanted.
    fn marked(&self, traction: InterfaceTraction) -> Option<(&'static str, Extreme<2>)> {
        let found = self.extremes?;
        match traction {
            InterfaceTraction::Shear => {
                Some(("largest", found.shear.filter(|shear| shear.value > 0.0)?))
            }
            InterfaceTraction::Normal => match found.tension {
                Some(tension) if tension.value > 0.0 => Some(("largest tension", tension)),
                Some(_) => Some(("no tension; largest compression", found.compression?)),
                None => Some(("largest compression", found.compression?)),
            },
        }
    }

    fn draw_words(
        &self,
        svg: &mut Svg,
        (left, top): (f64, f64),
        traction: InterfaceTraction,
        marked: Option<&(&'static str, Extreme<2>)>,
    ) {
        let units = self.subject.units;
        let title = format!(
            "Interface {}, {} deep: {}",
            self.interface.index,
            quantity(self.interface.depth, Unit::Metre, units),
            traction.title()
        );
        svg.text((left, top + 10.0), TITLE, Anchor::Start, &title);
        let note = match marked {
            Some((what, extreme)) => {
                let at = self.subject.position(extreme.at);
                let value = quantity(extreme.value, Unit::Pascal, units);
                format!("{what} {value} at x, y = {at}")
            }
            None => String::new(),
        };
        svg.text((left, top + 34.0), NOTE, Anchor::Start, &note);
    }
}

impl InterfaceTraction {
    fn symbol(self) -> &'static str {
        match self {
            Self::Shear => "shear traction τ",
            Self::Normal => "normal traction σzz",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Shear => "shear traction",
            Self::Normal => "normal traction, tension red",
        }
    }
}

/// The least and the largest of 0 and the finite values.
fn extent(values: &[f64]) -> [f64; 2] {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    finite.fold([0.0, 0.0], |[least, largest], value| {
        [f64::min(least, value), f64::max(largest, value)]
    })
}

/// Marks an extreme that lies within the panel.
fn draw_mark(
    svg: &mut Svg,
    panel: &Panel,
    metres: f64,
    marked: Option<&(&'static str, Extreme<2>)>,
    pascals: &DisplayUnit,
) {
    let Some((_, extreme)) = marked else {
        return;
    };
    let [x, y] = extreme.at.map(|along| along / metres);
    let is_shown = |axis: &Axis, along: f64| (axis.from..=axis.to).contains(&along);
    if !is_shown(&panel.x, x) || !is_shown(&panel.y, y) {
        return;
    }
    let place = panel.at(x, y);
    let text = mark_text(extreme.value, pascals);
    svg.circle(place, MARK, colours::WHITE, colours::INK);
    let beside = ContourPlaces::new(panel.place).beside_mark(place, &text);
    boxed(svg, beside, &text);
}
