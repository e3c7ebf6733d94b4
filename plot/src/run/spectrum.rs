//! The power spectra of the maps of a case, on logarithmic axes.

use pellicle::display::{Unit, quantity, significant};
use pellicle::input::units::Units;

use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Rect, Stroke};

const PLACE: Rect = Rect::at((132.0, heading::HEIGHT + 8.0), (620.0, 460.0));
const WIDTH: f64 = PLACE.left + PLACE.width + 36.0;
/// Height of a line of the legend, and distance of the legend below the panel.
const ENTRY: f64 = 28.0;
const LEGEND: f64 = 86.0;

/// Powers below this fraction of the largest are not shown: they are the rounding of heights in single precision. Four
/// decades of wavenumbers of a self-affine surface lie above it.
const ROUNDING: f64 = 1e-16;

/// A map with its roughness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughMap<'a> {
    /// Its name.
    pub name: &'static str,
    /// Root mean square of its heights, m.
    pub rms_height: f64,
    /// Root mean square of its slopes.
    pub rms_slope: f64,
    /// Wavenumbers of the bands, 1/m.
    pub wavenumber: &'a [f64],
    /// Power spectral density in each band, m⁴.
    pub power: &'a [f64],
}

/// Whether one of the maps has any roughness.
#[must_use]
pub fn is_drawn(maps: &[RoughMap<'_>]) -> bool {
    maps.iter().any(|map| !points(map).is_empty())
}

/// Draws the picture as SVG; `None` without a rough map.
#[must_use]
pub fn draw(title: &str, maps: &[RoughMap<'_>], units: Units, style: &Style) -> Option<String> {
    if !is_drawn(maps) {
        return None;
    }
    let legend = ENTRY * maps.len() as f64;
    let mut svg = style.sheet(WIDTH, PLACE.bottom() + LEGEND + legend);
    if style.heading == Heading::Shown {
        let numbers = "power spectrum, averaged over directions";
        heading::draw(&mut svg, PLACE.left, WIDTH - PLACE.left, title, numbers);
    }
    let lines: Vec<_> = maps.iter().map(points).collect();
    let ends = |axis: fn(&(f64, f64)) -> f64| {
        let values = lines.iter().flatten().map(axis);
        values.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), value| {
            (low.min(value), high.max(value))
        })
    };
    let ((from, to), (least, most)) = (ends(|point| point.0), ends(|point| point.1));
    let [wavenumber, power] = match units {
        Units::Si => ["1/m", "m⁴"],
        Units::Consistent => ["case units"; 2],
    };
    let panel = Panel {
        place: PLACE,
        x: Axis::logarithmic(from, to, format!("wavenumber q, {wavenumber}")),
        y: Axis::logarithmic(least, most, format!("power spectral density C, {power}")),
    };
    panel.draw_mesh(&mut svg);
    for (k, (map, line)) in maps.iter().zip(&lines).enumerate() {
        let colour = colour(k);
        let places = panel.all_at(line.iter().copied());
        svg.within(PLACE, |svg| svg.line(&places, Stroke::new(colour, 2.0)));
        svg.dots(&places, 3.0, colour);
        let y = PLACE.bottom() + LEGEND + ENTRY * k as f64;
        let left = PLACE.left;
        svg.line(&[(left, y), (left + 40.0, y)], Stroke::new(colour, 2.0));
        svg.text((left + 50.0, y), 16.0, Anchor::Start, &words(map, units));
    }
    panel.draw_axes(&mut svg);
    Some(svg.finish())
}

/// For example `surface: rms height 1.2 nm, rms slope 0.05`.
fn words(map: &RoughMap<'_>, units: Units) -> String {
    let height = quantity(map.rms_height, Unit::Metre, units);
    let slope = significant(map.rms_slope, 3);
    format!("{}: rms height {height}, rms slope {slope}", map.name)
}

fn colour(map: usize) -> Colour {
    [colours::BLUE, colours::ORANGE][map % 2]
}

/// Wavenumbers and powers of the bands with nonzero power.
fn points(map: &RoughMap<'_>) -> Vec<(f64, f64)> {
    let RoughMap {
        wavenumber, power, ..
    } = map;
    let largest = power.iter().copied().fold(0.0, f64::max);
    let points = wavenumber.iter().copied().zip(power.iter().copied());
    points
        .filter(|(q, power)| *q > 0.0 && *power > ROUNDING * largest)
        .collect()
}
