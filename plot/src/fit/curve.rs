//! Measured points with the model's curves, and the whitened residuals below.

use pellicle::display::DisplayUnit;

use super::axes;
use super::colours::colour;
use super::heading::FitHeading;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

const LEFT: f64 = 112.0;
const TOP: f64 = heading::HEIGHT + 8.0;
const WIDE: f64 = 840.0;
const HIGH: f64 = 430.0;
const BETWEEN: f64 = 26.0;
const LOW: f64 = 200.0;
const WIDTH: f64 = LEFT + WIDE + 36.0;
const HEIGHT: f64 = TOP + HIGH + BETWEEN + LOW + 84.0;

/// Height of a line of the legend, number of columns, and most curves named.
const ENTRY: f64 = 26.0;
const COLUMNS: usize = 2;
const NAMED: usize = 12;

/// Most points drawn in all; most and fewest per curve.
const POINTS: usize = 3000;
const MOST_OF_ONE: usize = 500;
const FEWEST_OF_ONE: usize = 40;

/// A curve with at most this many points is drawn with its points above the line.
const FEW: usize = 60;

/// Light of a model's line relative to its points.
const DARK: f64 = 0.55;

/// Half-width of the band that holds most whitened residuals, in standard deviations.
const BAND: f64 = 2.0;

/// One measured point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedPoint {
    /// The abscissa of the measurement.
    pub abscissa: f64,
    /// The measured value.
    pub observed: f64,
    /// The value of the model, including the shift.
    pub model: f64,
    /// The residual whitened by the noise covariance.
    pub whitened: f64,
}

/// A measured curve.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedCurve {
    /// Its name.
    pub name: String,
    /// Its points, in the order of measurement.
    pub points: Vec<FittedPoint>,
    /// Whether the fit used it.
    pub usage: CurveUse,
}

/// Whether a curve was used in a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveUse {
    /// It was used.
    Used,
    /// It was left out because it disagrees with the others.
    LeftOut,
}

/// A quantity on an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisQuantity {
    /// Its name and symbol.
    pub name: &'static str,
    /// Its unit.
    pub scale: DisplayUnit,
}

/// The picture of the measured curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// The heading.
    pub head: FitHeading,
    /// The quantity on the abscissa.
    pub x: AxisQuantity,
    /// The observed quantity.
    pub y: AxisQuantity,
    /// The curves.
    pub all: Vec<FittedCurve>,
}

impl Curves {
    /// Draws the picture as SVG; `None` without a point.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let [upper, lower] = self.panels()?;
        let named = self.all.len().min(NAMED);
        let lines = named.div_ceil(COLUMNS) + usize::from(self.note().is_some());
        let mut svg = style.sheet(WIDTH, HEIGHT + ENTRY * lines as f64);
        if style.heading == Heading::Shown {
            heading::draw(
                &mut svg,
                LEFT,
                WIDTH - LEFT,
                &self.head.title,
                &self.head.numbers,
            );
        }
        self.draw_curves(&mut svg, &upper);
        self.draw_residuals(&mut svg, &lower);
        self.draw_legend(&mut svg, named);
        Some(svg.finish())
    }

    /// The panel of the curves and that of the residuals.
    fn panels(&self) -> Option<[Panel; 2]> {
        let points = || self.all.iter().flat_map(|curve| &curve.points);
        let x = axes::ends(points().map(|point| point.abscissa))?;
        let y = axes::ends(points().flat_map(|point| [point.observed, point.model]))?;
        let both = axes::suits_logarithms(x) && y[0] > 0.0;
        let axis = |ends, of: &AxisQuantity, count| {
            if both {
                axes::logarithmic(ends, &of.scale, of.name)
            } else {
                axes::linear(ends, &of.scale, of.name, count)
            }
        };
        let place = |top, height| Rect::at((LEFT, top), (WIDE, height));
        let below = axis(x, &self.x, 8);
        let upper = Panel {
            place: place(TOP, HIGH),
            x: below.clone().unlabelled(),
            y: axis(y, &self.y, 6),
        };
        let lower = Panel {
            place: place(TOP + HIGH + BETWEEN, LOW),
            x: below,
            y: self.residual_axis(),
        };
        Some([upper, lower])
    }

    fn residual_axis(&self) -> Axis {
        let used = self.used().flat_map(|(_, curve)| &curve.points);
        let ends = axes::ends(used.map(|point| point.whitened.abs()));
        let most = 1.1 * ends.map_or(0.0, |[_, high]| high).max(1.25 * BAND);
        Axis::new(-most, most, "residual / σ, whitened".into(), 5)
    }

    /// Colour of a model's curve, darker than its points; ink if there is only one curve.
    fn line_colour(&self, i: usize) -> Colour {
        match self.all.len() {
            1 => colours::INK,
            _ => colour(i).lit(DARK),
        }
    }

    fn used(&self) -> impl Iterator<Item = (usize, &FittedCurve)> {
        let curves = self.all.iter().enumerate();
        curves.filter(|(_, curve)| curve.usage == CurveUse::Used)
    }

    fn draw_curves(&self, svg: &mut Svg, panel: &Panel) {
        panel.draw_mesh(svg);
        let scaled = |x: f64, y: f64| panel.at(x / self.x.scale.divisor, y / self.y.scale.divisor);
        svg.within(panel.place, |svg| {
            // Curves that were left out are drawn below the rest.
            let mut order: Vec<_> = self.all.iter().enumerate().collect();
            order.sort_by_key(|(_, curve)| curve.usage == CurveUse::Used);
            for (i, curve) in order {
                let shown = shown(&curve.points, self.stride(curve));
                let places: Vec<_> = shown
                    .map(|point| scaled(point.abscissa, point.observed))
                    .collect();
                // Few points do not hide a line below them; many would.
                let stroke = Stroke::new(self.line_colour(i), 1.6);
                let line = line(curve, scaled);
                if places.len() <= FEW {
                    svg.line(&line, stroke);
                    svg.dots(&places, 4.2, ink(i, curve));
                } else {
                    svg.dots(&places, 3.0, ink(i, curve));
                    svg.line(&line, stroke);
                }
            }
        });
        panel.draw_axes(svg);
        if panel.x.is_logarithmic {
            let place = (panel.place.right() - 10.0, panel.place.bottom() - 16.0);
            svg.text(place, 14.0, Anchor::End, "logarithmic axes");
        }
    }

    fn draw_residuals(&self, svg: &mut Svg, panel: &Panel) {
        panel.draw_mesh(svg);
        let across = |y: f64| [panel.at(panel.x.from, y), panel.at(panel.x.to, y)];
        svg.within(panel.place, |svg| {
            for (i, curve) in self.used() {
                let shown = shown(&curve.points, self.stride(curve));
                let at = |point: &FittedPoint| {
                    panel.at(point.abscissa / self.x.scale.divisor, point.whitened)
                };
                svg.dots(&shown.map(at).collect::<Vec<_>>(), 2.4, colour(i));
            }
            svg.line(&across(0.0), Stroke::new(colours::INK, 1.4));
            let band = [across(-BAND), across(BAND)];
            svg.broken_lines(&band, Stroke::new(colours::INK, 1.0), Dash::Dashed);
        });
        panel.draw_axes(svg);
    }

    fn draw_legend(&self, svg: &mut Svg, named: usize) {
        let column = (WIDTH - LEFT) / COLUMNS as f64;
        for (i, curve) in self.all.iter().take(named).enumerate() {
            let x = LEFT + column * (i % COLUMNS) as f64;
            let y = HEIGHT + ENTRY * (i / COLUMNS) as f64;
            svg.dots(&[(x + 10.0, y)], 5.0, ink(i, curve));
            let left_out = if curve.usage == CurveUse::LeftOut {
                " (left out)"
            } else {
                ""
            };
            let name = format!("{}{left_out}", curve.name);
            let name = heading::fitted(&name, column - 40.0, 15.0);
            svg.text((x + 26.0, y), 15.0, Anchor::Start, &name);
        }
        if let Some(note) = self.note() {
            let y = HEIGHT + ENTRY * named.div_ceil(COLUMNS) as f64;
            svg.text((LEFT, y), 14.0, Anchor::Start, &note);
        }
    }

    /// The note on unnamed curves and on points not drawn.
    fn note(&self) -> Option<String> {
        let more = self.all.len().saturating_sub(NAMED);
        let stride = self.all.iter().map(|curve| self.stride(curve)).max();
        let stride = stride.filter(|stride| *stride > 1);
        let thinned =
            stride.map(|stride| format!("one point in {stride} of the longest curve is drawn"));
        let unnamed = (more > 0).then(|| format!("and {more} more curves"));
        let notes: Vec<_> = unnamed.into_iter().chain(thinned).collect();
        (!notes.is_empty()).then(|| notes.join("; "))
    }

    /// The stride n of a curve: every n-th point is drawn.
    fn stride(&self, curve: &FittedCurve) -> usize {
        let share = POINTS / self.all.len().max(1);
        let most = share.clamp(FEWEST_OF_ONE, MOST_OF_ONE);
        curve.points.len().div_ceil(most).max(1)
    }
}

/// Every `stride`-th point.
fn shown(points: &[FittedPoint], stride: usize) -> impl Iterator<Item = &FittedPoint> {
    points.iter().step_by(stride)
}

fn ink(i: usize, curve: &FittedCurve) -> Colour {
    match curve.usage {
        CurveUse::Used => colour(i),
        CurveUse::LeftOut => colours::LEFT_OUT,
    }
}

/// The model's curve in the order of its abscissae, as a measurement may go back and forth; empty for a curve left out.
fn line(curve: &FittedCurve, at: impl Fn(f64, f64) -> (f64, f64)) -> Vec<(f64, f64)> {
    if curve.usage == CurveUse::LeftOut {
        return Vec::new();
    }
    let mut points: Vec<_> = curve.points.iter().collect();
    points.sort_by(|one, other| one.abscissa.total_cmp(&other.abscissa));
    let stride = points.len().div_ceil(MOST_OF_ONE).max(1);
    let last = points.len().saturating_sub(1);
    let kept = points.iter().enumerate();
    let kept = kept.filter(|(i, _)| i.is_multiple_of(stride) || *i == last);
    kept.map(|(_, point)| at(point.abscissa, point.model))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curves(points: usize, shift: f64) -> Curves {
        let scale = |divisor, label: &str| DisplayUnit {
            divisor,
            label: label.into(),
        };
        let point = |i: usize| {
            let abscissa = 1e-6 * (1 + i) as f64;
            FittedPoint {
                abscissa,
                observed: abscissa.powf(2.0 / 3.0) + shift,
                model: abscissa.powf(2.0 / 3.0),
                whitened: (i % 3) as f64 - 1.0,
            }
        };
        let curve = |name: &str, usage| FittedCurve {
            name: name.into(),
            points: (0..points).map(point).collect(),
            usage,
        };
        Curves {
            head: FitHeading {
                title: "a fit".into(),
                numbers: "fitted".into(),
            },
            x: AxisQuantity {
                name: "force Q",
                scale: scale(1e-6, "µN"),
            },
            y: AxisQuantity {
                name: "depth D",
                scale: scale(1e-6, "µm"),
            },
            all: vec![
                curve("one", CurveUse::Used),
                curve("other", CurveUse::LeftOut),
            ],
        }
    }

    #[test]
    fn thousands_of_points_are_thinned_with_a_note() {
        let few = curves(200, 0.0).draw(&Style::default()).unwrap();
        let many = curves(20_000, 0.0).draw(&Style::default()).unwrap();
        assert!(!few.contains("one point in") && many.contains("one point in 40"));
        assert!(many.len() < 3 * few.len(), "{} {}", many.len(), few.len());
        assert!(few.contains("other (left out)"));
    }

    #[test]
    fn forces_over_decades_get_logarithmic_axes_unless_a_depth_is_negative() {
        let is_logarithmic = |shift| {
            let drawn = curves(200, shift).draw(&Style::default());
            drawn.unwrap().contains("logarithmic axes")
        };
        assert!(is_logarithmic(0.0));
        assert!(!is_logarithmic(-1.0));
    }

    #[test]
    fn without_a_point_there_is_no_picture() {
        assert_eq!(curves(0, 0.0).draw(&Style::default()), None);
    }
}
