//! All pairs of unknowns, with the single unknowns on the diagonal: ellipses of the covariance, or samples if there are
//! any.

use super::unknown::FittedUnknown;
use super::{FitHeading, axes};
use crate::picture::colours::{self, Colour};
use crate::picture::heading;
use crate::picture::panel::{Axis, Panel};
use crate::picture::style::{Heading, Style};
use crate::picture::svg::{Anchor, Dash, Rect, Stroke, Svg};

/// File name of the picture, without extension.
pub const NAME: &str = "fit-corner";

const LEFT: f64 = 112.0;
const TOP: f64 = heading::HEIGHT + 44.0;
const SIDE: f64 = 300.0;
const STEP: f64 = SIDE + 34.0;

/// `Δχ²` of two unknowns at 68 and 95 %: `−2 ln(1 − p)`.
const LEVELS: [f64; 2] = [2.278_869, 5.991_465];

/// Half-width of a panel in standard deviations.
const REACH: f64 = 2.9;
/// Largest factor up to which a panel reaches, if the data determine little.
const FARTHEST: f64 = 100.0;

/// Points of an ellipse or a marginal; bars of a histogram; dots of a pair.
const POINTS: usize = 400;
const BARS: usize = 40;
const DOTS: usize = 2000;

/// The picture of the pairs of unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct CornerPlot {
    /// The heading.
    pub head: FitHeading,
    /// The unknowns, each with a covariance.
    pub unknowns: Vec<FittedUnknown>,
    /// Correlation of the logarithms of the unknowns.
    pub correlation: Vec<Vec<f64>>,
    /// Samples of the posterior, each with a value of every unknown; empty if none were drawn.
    pub samples: Vec<Vec<f64>>,
}

impl CornerPlot {
    /// Draws the picture as SVG; `None` for a single unknown.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let count = self.unknowns.len();
        let axes: Option<Vec<Axis>> = self.unknowns.iter().map(axis).collect();
        let axes = axes.filter(|_| count > 1)?;
        let width = LEFT + count as f64 * STEP + 10.0;
        let mut svg = style.sheet(width, TOP + count as f64 * STEP + 52.0);
        if style.heading == Heading::Shown {
            heading::draw(
                &mut svg,
                LEFT,
                width - LEFT,
                &self.head.title,
                &self.head.numbers,
            );
            heading::draw_accuracy(&mut svg, LEFT, self.legend());
        }
        for row in 0..count {
            for column in 0..row {
                let panel = panel(row, column, count, &axes);
                self.draw_pair(&mut svg, &panel, row, column);
            }
            self.draw_marginal(&mut svg, row, &axes);
        }
        Some(svg.finish())
    }

    fn legend(&self) -> &'static str {
        if self.samples.is_empty() {
            "ellipses: 68 and 95 % of the covariance; diagonal, line: profile likelihood, dashed: covariance (Wald)"
        } else {
            "dots and bars: samples of the posterior; ellipses: 68 and 95 % of the covariance"
        }
    }

    fn draw_pair(&self, svg: &mut Svg, panel: &Panel, row: usize, column: usize) {
        let [x, y] = [column, row].map(|i| &self.unknowns[i]);
        let at = |(a, b): (f64, f64)| panel.at(a / x.scale.divisor, b / y.scale.divisor);
        panel.draw_mesh(svg);
        svg.within(panel.place, |svg| {
            let stride = self.samples.len().div_ceil(DOTS).max(1);
            let samples = self.samples.iter().step_by(stride);
            let dots: Vec<_> = samples.map(|of| at((of[column], of[row]))).collect();
            svg.dots(&dots, 1.4, colours::SKY);
            for (level, width) in LEVELS.into_iter().zip([2.4, 1.6]) {
                let ellipse = self.ellipse(row, column, level);
                let places: Vec<_> = ellipse.into_iter().map(at).collect();
                svg.line(&places, Stroke::new(colours::BLUE, width));
            }
        });
        svg.dots(&[at((x.value, y.value))], 4.0, colours::ORANGE);
        panel.draw_axes(svg);
    }

    /// Returns the ellipse of the covariance on which `Δχ²` has this value; it is an ellipse in the logarithms.
    fn ellipse(&self, row: usize, column: usize, level: f64) -> Vec<(f64, f64)> {
        let [x, y] = [column, row].map(|i| &self.unknowns[i]);
        let [sx, sy] = [x, y].map(|of| of.deviation().unwrap_or(0.0));
        let rho = self.correlation[row][column].clamp(-1.0, 1.0);
        let across = (1.0 - rho * rho).sqrt();
        let point = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / POINTS as f64).sin_cos();
            let r = level.sqrt();
            let (u, v) = (r * cos, r * (rho * cos + across * sin));
            (x.value * (sx * u).exp(), y.value * (sy * v).exp())
        };
        (0..=POINTS).map(point).collect()
    }

    /// Draws the density of one unknown over its maximum, with its name above.
    fn draw_marginal(&self, svg: &mut Svg, index: usize, axes: &[Axis]) {
        let unknown = &self.unknowns[index];
        let density = Axis {
            ticks: Vec::new(),
            ..Axis::new(0.0, 1.12, String::new(), 2)
        };
        let panel = Panel {
            y: density,
            ..panel(index, index, axes.len(), axes)
        };
        let at = |[value, density]: [f64; 2]| panel.at(value / unknown.scale.divisor, density);
        svg.within(panel.place, |svg| {
            self.draw_bars(svg, &panel, index);
            let likelihood = |[value, delta]: [f64; 2]| at([value, (-0.5 * delta).exp()]);
            let wald = |value| Some([value, unknown.parabola(value)?]);
            let wald: Vec<_> = values(unknown).filter_map(wald).map(likelihood).collect();
            svg.broken_lines(&[wald], Stroke::new(colours::ORANGE, 2.0), Dash::Dashed);
            let profile: Vec<_> = unknown
                .smooth_profile()
                .into_iter()
                .map(likelihood)
                .collect();
            svg.line(&profile, Stroke::new(colours::BLUE, 2.4));
        });
        panel.draw_axes(svg);
        let name = heading::fitted(&unknown.name, SIDE, 15.0);
        let top = panel.place.top;
        svg.text((panel.place.left, top - 32.0), 15.0, Anchor::Start, &name);
        svg.text(
            (panel.place.left, top - 13.0),
            13.0,
            Anchor::Start,
            &unknown.numbers(),
        );
    }

    /// The histogram of the samples.
    fn draw_bars(&self, svg: &mut Svg, panel: &Panel, index: usize) {
        const BAR: Colour = Colour(190, 222, 242);
        let divisor = self.unknowns[index].scale.divisor;
        let mut counts = [0_usize; BARS];
        for sample in &self.samples {
            let fraction = panel.x.fraction(sample[index] / divisor);
            let within = (0.0..1.0).contains(&fraction);
            let bar = (0..BARS).find(|bar| fraction < (bar + 1) as f64 / BARS as f64);
            if let Some(bar) = bar.filter(|_| within) {
                counts[bar] += 1;
            }
        }
        let most = counts.iter().copied().max().unwrap_or(0).max(1);
        for (bar, count) in counts
            .into_iter()
            .enumerate()
            .filter(|(_, count)| *count > 0)
        {
            let width = panel.place.width / BARS as f64;
            let height = panel.place.height * count as f64 / most as f64 / panel.y.to;
            let place = Rect {
                left: panel.place.left + width * bar as f64,
                top: panel.place.bottom() - height,
                width,
                height,
            };
            svg.rectangle(place, BAR);
        }
    }
}

/// The range of an unknown that is shown: the values that its covariance and its profile allow.
fn reach(unknown: &FittedUnknown) -> Option<[f64; 2]> {
    let deviation = unknown.deviation()?;
    let half = (REACH * deviation).min(FARTHEST.ln());
    let low_enough = |point: &&[f64; 2]| point[1] <= LEVELS[1];
    let profile = unknown.profile.iter().filter(low_enough);
    let ellipse = [-half, half].map(|half| unknown.value * half.exp());
    let [low, high] = axes::ends(profile.map(|point| point[0]).chain(ellipse))?;
    let [from, to] = unknown.bounds;
    let [low, high] = [low.max(from), high.min(to)];
    (low > 0.0 && low < high).then_some([low, high])
}

fn axis(unknown: &FittedUnknown) -> Option<Axis> {
    let ends = reach(unknown)?;
    Some(axes::of_unknown(ends, &unknown.scale, &unknown.symbol, 5))
}

/// Values over the range shown.
fn values(unknown: &FittedUnknown) -> impl Iterator<Item = f64> {
    let [low, high] = reach(unknown).unwrap_or([unknown.value; 2]);
    let ratio = high / low;
    (0..=POINTS).map(move |i| low * ratio.powf(i as f64 / POINTS as f64))
}

/// Panel of a pair. Only the panels at the left and at the bottom of the corner have titles and labels.
fn panel(row: usize, column: usize, count: usize, all: &[Axis]) -> Panel {
    let fitted = |axis: &Axis| Axis {
        title: heading::fitted(&axis.title, SIDE, 18.0),
        ..axis.clone()
    };
    let (x, y) = (fitted(&all[column]), fitted(&all[row]));
    Panel {
        place: Rect::at(
            (LEFT + column as f64 * STEP, TOP + row as f64 * STEP),
            (SIDE, SIDE),
        ),
        x: if row + 1 == count { x } else { x.unlabelled() },
        y: if column == 0 { y } else { y.unlabelled() },
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::super::unknown::tests::unknown;
    use super::*;

    fn corner(names: &[&str]) -> CornerPlot {
        CornerPlot {
            head: FitHeading {
                title: "a fit".into(),
                numbers: "fitted".into(),
            },
            unknowns: names.iter().map(|name| unknown(name, 7e10, 0.02)).collect(),
            correlation: vec![vec![1.0, 0.6], vec![0.6, 1.0]],
            samples: Vec::new(),
        }
    }

    #[test]
    fn a_single_unknown_has_no_pairs() {
        assert_eq!(corner(&["one"]).draw(&Style::default()), None);
        let both = corner(&["one", "two"]).draw(&Style::default()).unwrap();
        assert!(both.contains(">one</text>") && both.contains(">E, GPa</text>"));
    }

    #[test]
    fn on_an_ellipse_the_quadratic_form_of_the_covariance_is_its_level() {
        let corner = corner(&["one", "two"]);
        for level in LEVELS {
            for (a, b) in corner.ellipse(1, 0, level) {
                let (u, v) = ((a / 7e10).ln() / 0.02, (b / 7e10).ln() / 0.02);
                let rho = 0.6;
                // xᵀ C⁻¹ x for two unknowns with correlation ρ.
                let form = (u * u - 2.0 * rho * u * v + v * v) / (1.0 - rho * rho);
                // Rounding of logarithms of numbers near 1.
                assert_relative_eq!(form, level, max_relative = 1e-9);
            }
        }
    }

    #[test]
    fn the_levels_contain_their_share_of_a_bivariate_normal_distribution() {
        for (level, part) in LEVELS.into_iter().zip([0.68, 0.95]) {
            // The levels have this many digits.
            assert_relative_eq!(1.0 - (-0.5 * level).exp(), part, max_relative = 1e-6);
        }
    }

    #[test]
    fn samples_are_drawn_as_dots_and_bars() {
        let mut with = corner(&["one", "two"]);
        let sample = |i: i32| vec![7e10 * (1.0 + 3e-3 * f64::from(i % 17)), 7e10];
        with.samples = (0..400).map(sample).collect();
        let [with, without] =
            [with, corner(&["one", "two"])].map(|of| of.draw(&Style::default()).unwrap());
        let bars = |svg: &str| svg.matches("<rect ").count();
        // Only the sheet without samples.
        assert_eq!(bars(&without), 1);
        assert!(bars(&with) > 10, "{}", bars(&with));
    }
}
