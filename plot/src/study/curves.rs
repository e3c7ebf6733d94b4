//! Numbers over one key: a panel for each number, a curve for each value of a second key, each point with its ±.

use crate::axes::panel::{Axis, Panel};
use crate::sheet::colour_map::ColourMap;
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};
use crate::study::sample::{Sample, SampleError, SampledAxis, ends};

const LEFT: f64 = 112.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = heading::HEIGHT + 8.0;
/// Distance between panels, and height of a panel over its width.
const BETWEEN: f64 = 26.0;
const ASPECT: f64 = 0.72;
/// Room for the labels and the title of the axis below.
const BELOW: f64 = 84.0;
/// Height of a line of the legend, width of its sign, and size of its letters.
const ENTRY: f64 = 26.0;
const SIGN: f64 = 34.0;
const WORDS: f64 = 16.0;

/// Margin around the points, as a part of their extent.
const MARGIN: f64 = 0.06;
/// Ticks of a linear axis, about.
const TICKS: usize = 6;
/// The part of the colour map that is dark enough for lines on white.
const DARK: f64 = 0.85;
/// Radius of a point, and half the width of the end of an error bar.
const RADIUS: f64 = 4.0;
const CAP: f64 = 5.0;

/// A light green, for an interval of the key.
const INTERVAL: Colour = Colour(204, 236, 226);

/// A number of all cases.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesPanel {
    /// Its axis.
    pub axis: SampledAxis,
    /// For each curve its points, ordered by the key.
    pub curves: Vec<Vec<(f64, Sample)>>,
    /// A limit of the number, drawn as a line.
    pub limit: Option<f64>,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesPicture {
    /// The two lines above.
    pub heading: [String; 2],
    /// The key.
    pub key: SampledAxis,
    /// The panels, from the top down.
    pub panels: Vec<CurvesPanel>,
    /// Names of the curves; empty if there is only one.
    pub names: Vec<String>,
    /// A value of the key with its interval, drawn upright.
    pub answer: Option<(f64, Option<[f64; 2]>)>,
}

/// Draws the picture as SVG; `None` without a number.
#[must_use]
pub fn draw(picture: &CurvesPicture, style: &Style) -> Option<String> {
    let keys = picture.keys()?;
    let width = style.drawn_width();
    let (inside, legend) = (width - LEFT - RIGHT, picture.legend());
    let (rows, columns) = layout(&legend, inside);
    let count = picture.panels.len() as f64;
    let height = ASPECT * inside / count.sqrt();
    let bottom = TOP + count * height + (count - 1.0) * BETWEEN;
    let mut svg = style.sheet(width, bottom + BELOW + ENTRY * rows as f64);
    if style.heading == Heading::Shown {
        let [title, numbers] = &picture.heading;
        heading::draw(&mut svg, LEFT, inside, title, numbers);
    }
    for (i, of) in picture.panels.iter().enumerate() {
        let top = TOP + i as f64 * (height + BETWEEN);
        let x = axis(keys, &picture.key);
        let is_last = i + 1 == picture.panels.len();
        let panel = Panel {
            place: Rect::at((LEFT, top), (inside, height)),
            x: if is_last { x } else { x.unlabelled() },
            y: axis(of.extent()?, &of.axis),
        };
        picture.draw_panel(&mut svg, &panel, of);
    }
    for (i, (sign, words)) in legend.iter().enumerate() {
        let left = LEFT + (i / rows.max(1)) as f64 * inside / columns as f64;
        let y = bottom + BELOW + ENTRY * (i % rows.max(1)) as f64;
        sign.draw(&mut svg, (left, y));
        svg.text((left + SIGN + 8.0, y), WORDS, Anchor::Start, words);
    }
    Some(svg.finish())
}

/// Rows and columns of a legend in a width.
fn layout(legend: &[(Sign, String)], width: f64) -> (usize, usize) {
    let lengths = legend.iter();
    let lengths = lengths.map(|(_, words)| heading::width(words, WORDS) + SIGN + 24.0);
    let longest = lengths.fold(1.0, f64::max);
    let fits = |columns: &usize| longest * *columns as f64 <= width;
    let columns = (1..=4).rev().find(fits).unwrap_or(1);
    (legend.len().div_ceil(columns), columns)
}

/// An axis around numbers.
fn axis([low, high]: [f64; 2], of: &SampledAxis) -> Axis {
    if of.is_logarithmic && low > 0.0 {
        return Axis::logarithmic(low, high, of.title.clone());
    }
    let extent = if high > low {
        high - low
    } else {
        high.abs().max(f64::MIN_POSITIVE)
    };
    let margin = MARGIN * extent;
    Axis::new(low - margin, high + margin, of.title.clone(), TICKS)
}

impl CurvesPanel {
    fn samples(&self) -> impl Iterator<Item = &(f64, Sample)> {
        self.curves.iter().flatten()
    }

    /// The extent of the numbers with their ±, and of the limit.
    fn extent(&self) -> Option<[f64; 2]> {
        let is_shown = |end: &f64| !self.axis.is_logarithmic || *end > 0.0;
        let numbers = self.samples().filter_map(|(_, sample)| sample.ends());
        ends(numbers.flatten().chain(self.limit).filter(is_shown))
    }
}

/// A sign of the legend.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Sign {
    Curve(Colour),
    Gap,
    NotResolved,
    Limit,
    Answer,
}

impl Sign {
    fn draw(self, svg: &mut Svg, (left, y): (f64, f64)) {
        let (right, middle) = (left + SIGN, left + 0.5 * SIGN);
        let line = [(left, y), (right, y)];
        match self {
            Self::Curve(colour) => {
                svg.line(&line, Stroke::new(colour, 2.0));
                svg.circle((middle, y), RADIUS, colour, colour);
            }
            Self::Gap => cross(svg, (middle, y)),
            Self::NotResolved => svg.circle((middle, y), RADIUS, colours::WHITE, colours::INK),
            Self::Limit => {
                svg.broken_lines(&[line], Stroke::new(colours::ORANGE, 2.0), Dash::Dashed);
            }
            Self::Answer => {
                svg.rectangle(Rect::at((left, y - 8.0), (SIGN, 16.0)), INTERVAL);
                let upright = [(middle, y - 8.0), (middle, y + 8.0)];
                svg.line(&upright, Stroke::new(colours::GREEN, 2.0));
            }
        }
    }
}

fn cross(svg: &mut Svg, (x, y): (f64, f64)) {
    let stroke = Stroke::new(colours::INK, 1.5);
    svg.line(&[(x - CAP, y - CAP), (x + CAP, y + CAP)], stroke);
    svg.line(&[(x - CAP, y + CAP), (x + CAP, y - CAP)], stroke);
}

impl CurvesPicture {
    /// The extent of the key; none without a number.
    fn keys(&self) -> Option<[f64; 2]> {
        let samples = || self.panels.iter().flat_map(CurvesPanel::samples);
        samples().find(|(_, sample)| sample.value.is_some())?;
        ends(samples().map(|(key, _)| *key))
    }

    /// The colour of a curve.
    fn colour(&self, curve: usize) -> Colour {
        match self.names.len() {
            0 | 1 => colours::BLUE,
            count => ColourMap::Viridis.at(DARK * curve as f64 / (count - 1) as f64),
        }
    }

    fn legend(&self) -> Vec<(Sign, String)> {
        let names = self.names.iter().enumerate();
        let curves = names.map(|(i, name)| (Sign::Curve(self.colour(i)), name.clone()));
        let has = |is: &dyn Fn(&Sample) -> bool| {
            let mut samples = self.panels.iter().flat_map(CurvesPanel::samples);
            samples.any(|(_, sample)| is(sample))
        };
        let is_gap = |sample: &Sample| sample.value.is_none();
        let is_open = |sample: &Sample| !is_gap(sample) && sample.error == SampleError::NotResolved;
        let has_limit = self.panels.iter().any(|panel| panel.limit.is_some());
        let signs = [
            (has_limit, Sign::Limit, "limit"),
            (
                self.answer.is_some(),
                Sign::Answer,
                "answer, with the interval that ± leaves",
            ),
            (has(&is_open), Sign::NotResolved, "± not resolved"),
            (has(&is_gap), Sign::Gap, "no certified result"),
        ];
        let signs = signs.into_iter().filter(|(is_shown, ..)| *is_shown);
        let signs = signs.map(|(_, sign, words)| (sign, words.to_owned()));
        curves.chain(signs).collect()
    }

    fn draw_panel(&self, svg: &mut Svg, panel: &Panel, of: &CurvesPanel) {
        panel.draw_mesh(svg);
        self.draw_answer(svg, panel);
        if let Some(limit) = of.limit {
            let line = [panel.at(panel.x.from, limit), panel.at(panel.x.to, limit)];
            svg.broken_lines(&[line], Stroke::new(colours::ORANGE, 2.0), Dash::Dashed);
        }
        for (i, curve) in of.curves.iter().enumerate() {
            draw_curve(svg, panel, curve, self.colour(i));
        }
        panel.draw_axes(svg);
    }

    fn draw_answer(&self, svg: &mut Svg, panel: &Panel) {
        let Some((answer, interval)) = self.answer else {
            return;
        };
        let (top, bottom) = (panel.place.top, panel.place.bottom());
        let at = |key: f64| panel.at(key, panel.y.from).0;
        if let Some([low, high]) = interval {
            // A narrow interval is still seen.
            let width = (at(high) - at(low)).max(1.0);
            let place = Rect::at((at(low), top), (width, bottom - top));
            svg.within(panel.place, |svg| svg.rectangle(place, INTERVAL));
        }
        let line = [(at(answer), top), (at(answer), bottom)];
        svg.line(&line, Stroke::new(colours::GREEN, 1.5));
    }
}

/// Draws points, joined where no case between them is missing.
fn draw_curve(svg: &mut Svg, panel: &Panel, curve: &[(f64, Sample)], colour: Colour) {
    for run in curve.split(|(_, sample)| sample.value.is_none()) {
        let points = run.iter();
        let points = points.filter_map(|(key, sample)| Some((*key, sample.value?)));
        svg.line(&panel.all_at(points), Stroke::new(colour, 2.0));
    }
    for (key, sample) in curve {
        let Some(value) = sample.value else {
            let (x, _) = panel.at(*key, panel.y.from);
            cross(svg, (x, panel.place.bottom() - 2.0 * CAP));
            continue;
        };
        draw_error(svg, panel, (*key, sample), colour);
        let fill = match sample.error {
            SampleError::NotResolved => colours::WHITE,
            _ => colour,
        };
        svg.circle(panel.at(*key, value), RADIUS, fill, colour);
    }
}

fn draw_error(svg: &mut Svg, panel: &Panel, (key, sample): (f64, &Sample), colour: Colour) {
    let (SampleError::Known(_), Some([low, high])) = (sample.error, sample.ends()) else {
        return;
    };
    let is_below = panel.y.is_logarithmic && low <= 0.0;
    let low = if is_below { panel.y.from } else { low };
    let [(x, bottom), (_, top)] = [panel.at(key, low), panel.at(key, high)];
    let bar = [
        [(x, bottom), (x, top)],
        [(x - CAP, bottom), (x + CAP, bottom)],
        [(x - CAP, top), (x + CAP, top)],
    ];
    svg.lines(&bar, Stroke::new(colour, 1.5));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> CurvesPicture {
        let sample = |key: f64, value: Option<f64>, error| (key, Sample { value, error });
        let curve = vec![
            sample(1.0, Some(2.0), SampleError::Known(0.1)),
            sample(2.0, None, SampleError::None),
            sample(4.0, Some(3.0), SampleError::NotResolved),
            sample(8.0, Some(3.5), SampleError::None),
        ];
        let axis = |title: &str, is_logarithmic| SampledAxis {
            title: title.into(),
            is_logarithmic,
        };
        CurvesPicture {
            heading: ["study".into(), "4 cases".into()],
            key: axis("surface.period, µm", true),
            panels: vec![CurvesPanel {
                axis: axis("max pressure, GPa", false),
                curves: vec![curve.clone(), curve],
                limit: Some(2.5),
            }],
            names: vec!["surface.area_fraction = 0.1".into(), "0.2".into()],
            answer: None,
        }
    }

    fn with_all(change: impl Fn(&mut Sample)) -> CurvesPicture {
        let mut picture = picture();
        let curves = picture.panels.iter_mut().flat_map(|of| &mut of.curves);
        curves.flatten().for_each(|(_, sample)| change(sample));
        picture
    }

    #[test]
    fn gaps_and_missing_errors_are_drawn_and_named() {
        let svg = draw(&picture(), &Style::default()).expect("numbers");
        let wanted = [
            "no certified result",
            "± not resolved",
            "limit",
            "surface.period, µm",
        ];
        for words in wanted {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!svg.contains("answer"));
        let whole = with_all(|sample| {
            (sample.value, sample.error) = (Some(1.0), SampleError::None);
        });
        let svg = draw(&whole, &Style::default()).expect("numbers");
        assert!(!svg.contains("no certified result") && !svg.contains("not resolved"));
    }

    #[test]
    fn a_picture_without_numbers_is_not_drawn() {
        let empty = with_all(|sample| sample.value = None);
        assert_eq!(draw(&empty, &Style::default()), None);
    }

    #[test]
    fn letters_have_the_same_size_on_paper_of_any_width() {
        let style = Style {
            paper_mm: Some(85.0),
            ..Style::default()
        };
        let svg = draw(&picture(), &style).expect("numbers");
        assert!(svg.contains("width=\"85mm\""), "{}", &svg[..200]);
        assert!(svg.contains("viewBox=\"0 0 510 "), "{}", &svg[..200]);
    }
}
