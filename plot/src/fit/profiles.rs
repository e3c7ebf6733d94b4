//! One panel for each unknown: how much worse the fit becomes as its value changes.

use pellicle::display::DisplayUnit;

use super::axes;
use super::heading::FitHeading;
use super::unknown::FittedUnknown;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

const LEFT: f64 = 100.0;
const TOP: f64 = heading::HEIGHT + 64.0;
const PANEL_WIDTH: f64 = 360.0;
const PANEL_HEIGHT: f64 = 300.0;
const ACROSS: f64 = PANEL_WIDTH + 110.0;
const DOWN: f64 = PANEL_HEIGHT + 150.0;
const COLUMNS: usize = 3;

/// Height of a panel, as a multiple of the interval's level.
const SHOWN: f64 = 2.2;

/// Points on a parabola.
const POINTS: usize = 120;

/// The picture of the profiles.
#[derive(Debug, Clone, PartialEq)]
pub struct Profiles {
    /// The heading.
    pub head: FitHeading,
    /// Level of the intervals.
    pub level: f64,
    /// The unknowns that have a profile or a covariance.
    pub unknowns: Vec<FittedUnknown>,
}

impl Profiles {
    /// Draws the picture as SVG; `None` without an unknown to show.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let unknowns = self.unknowns.iter();
        let panels: Vec<_> = unknowns
            .filter_map(|unknown| Some((unknown, range(unknown)?)))
            .collect();
        if panels.is_empty() {
            return None;
        }
        let columns = panels.len().min(COLUMNS);
        let rows = panels.len().div_ceil(COLUMNS);
        let width = LEFT + columns.max(2) as f64 * ACROSS - 50.0;
        let mut svg = style.sheet(width, TOP + rows as f64 * DOWN - 70.0);
        if style.heading == Heading::Shown {
            heading::draw(
                &mut svg,
                LEFT,
                width - LEFT,
                &self.head.title,
                &self.head.numbers,
            );
            heading::draw_accuracy(&mut svg, LEFT, &self.legend());
        }
        // A single panel is as wide as the heading.
        let alone = if columns == 1 { ACROSS } else { 0.0 };
        for (i, (unknown, range)) in panels.into_iter().enumerate() {
            let place = Rect {
                left: LEFT + (i % COLUMNS) as f64 * ACROSS,
                top: TOP + (i / COLUMNS) as f64 * DOWN,
                width: PANEL_WIDTH + alone,
                height: PANEL_HEIGHT,
            };
            let mut panel = panel(place, unknown, range);
            if i % COLUMNS > 0 {
                panel.y.title.clear();
            }
            self.draw_panel(&mut svg, &panel, unknown);
        }
        Some(svg.finish())
    }

    fn legend(&self) -> String {
        let is_there = self
            .unknowns
            .iter()
            .any(|unknown| !unknown.profile.is_empty());
        let profile = if is_there {
            "line: profile likelihood; "
        } else {
            ""
        };
        format!(
            "{profile}dashed: from the covariance (Wald); shaded: the {} % interval",
            percent(self.level)
        )
    }

    fn draw_panel(&self, svg: &mut Svg, panel: &Panel, unknown: &FittedUnknown) {
        let (place, divisor) = (panel.place, scale(unknown).divisor);
        let at = |[value, delta]: [f64; 2]| panel.at(value / divisor, delta);
        let name = heading::fitted(&unknown.name, place.width + 60.0, 17.0);
        svg.text((place.left, place.top - 40.0), 17.0, Anchor::Start, &name);
        let numbers = format!("{}, {}", unknown.numbers(), unknown.verdict);
        svg.text(
            (place.left, place.top - 16.0),
            14.0,
            Anchor::Start,
            &numbers,
        );
        svg.within(place, |svg| draw_interval(svg, panel, unknown));
        panel.draw_mesh(svg);
        svg.within(place, |svg| {
            let best = [at([unknown.value, 0.0]), at([unknown.value, panel.y.to])];
            svg.line(&best, Stroke::new(colours::INK, 1.0));
            let [from, to] = [panel.x.from, panel.x.to];
            let level = [
                panel.at(from, unknown.threshold),
                panel.at(to, unknown.threshold),
            ];
            svg.line(&level, Stroke::new(colours::INK, 1.4));
            let parabola: Vec<_> = parabola(unknown, panel).into_iter().map(at).collect();
            svg.broken_lines(&[parabola], Stroke::new(colours::ORANGE, 2.0), Dash::Dashed);
            let profile: Vec<_> = unknown.smooth_profile().into_iter().map(at).collect();
            svg.line(&profile, Stroke::new(colours::BLUE, 2.4));
            let points: Vec<_> = unknown.profile.iter().map(|point| at(*point)).collect();
            svg.dots(&points, 3.6, colours::BLUE);
        });
        panel.draw_axes(svg);
        let (x, y) = panel.at(panel.x.to, unknown.threshold);
        svg.text(
            (x + 5.0, y),
            13.0,
            Anchor::Start,
            &format!("{} %", percent(self.level)),
        );
    }
}

/// A level such as 0.95 in percent.
fn percent(level: f64) -> String {
    let percent = format!("{:.1}", 100.0 * level);
    percent.trim_end_matches(".0").to_owned()
}

/// The unit of the panel; a combination is shown relative to its best value.
fn scale(unknown: &FittedUnknown) -> DisplayUnit {
    match &unknown.combination {
        Some(_) => DisplayUnit {
            divisor: unknown.value,
            label: String::new(),
        },
        None => unknown.scale.clone(),
    }
}

/// The interval of the quantity shown.
fn interval(unknown: &FittedUnknown) -> [Option<f64>; 2] {
    match &unknown.combination {
        Some(known) => known.interval.map(|end| Some(end? * unknown.value)),
        None => unknown.interval,
    }
}

/// Shades the interval, up to the edge of the panel on an open side.
fn draw_interval(svg: &mut Svg, panel: &Panel, unknown: &FittedUnknown) {
    let divisor = scale(unknown).divisor;
    let end = |end: Option<f64>, open: f64| end.map_or(open, |end| end / divisor);
    let [low, high] = interval(unknown);
    let (left, _) = panel.at(end(low, panel.x.from), 0.0);
    let (right, _) = panel.at(end(high, panel.x.to), 0.0);
    let place = Rect {
        left,
        width: (right - left).max(1.0),
        ..panel.place
    };
    svg.rectangle(place, colours::INTERVAL);
}

/// The range of a panel: the profile up to a little above the level, and the interval.
fn range(unknown: &FittedUnknown) -> Option<[f64; 2]> {
    let low_enough = |point: &&[f64; 2]| point[1] <= SHOWN * unknown.threshold;
    let profile = unknown.profile.iter().filter(low_enough);
    let ends = interval(unknown).into_iter().flatten();
    let half = unknown.wald.unwrap_or(0.0);
    let wald = [-half, half].map(|half| unknown.value * (SHOWN.sqrt() * half).exp());
    let wald = wald.map(|end| end.clamp(unknown.bounds[0], unknown.bounds[1]));
    let without_profile = if unknown.profile.is_empty() {
        &wald[..]
    } else {
        &[]
    };
    let values = profile.map(|point| point[0]).chain(ends);
    let [low, high] = axes::ends(values.chain(without_profile.iter().copied()))?;
    (low > 0.0 && low < high).then_some([low, high])
}

fn panel(place: Rect, unknown: &FittedUnknown, range: [f64; 2]) -> Panel {
    let quantity = match &unknown.combination {
        Some(known) => format!("{} over its best value", known.words),
        None => unknown.name.clone(),
    };
    let scale = scale(unknown);
    Panel {
        place,
        x: axes::of_unknown(range, &scale, &quantity, 6),
        y: Axis::new(0.0, SHOWN * unknown.threshold, "Δχ²".into(), 5),
    }
}

/// The parabola of the covariance across the panel.
fn parabola(unknown: &FittedUnknown, panel: &Panel) -> Vec<[f64; 2]> {
    let half = unknown.wald.unwrap_or(0.0) * (1.2 * SHOWN).sqrt();
    let [from, to] =
        [panel.x.from, panel.x.to].map(|end| (end * scale(unknown).divisor / unknown.value).ln());
    // A nonpositive value has no logarithm.
    let from = if from.is_finite() {
        from.max(-half)
    } else {
        -half
    };
    let to = to.min(half);
    let value = |i: usize| unknown.value * (from + (to - from) * i as f64 / POINTS as f64).exp();
    let values = (0..=POINTS).map(value);
    values
        .filter_map(|value| Some([value, unknown.parabola(value)?]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::unknown::tests::unknown;
    use super::*;

    fn profiles(unknowns: Vec<FittedUnknown>) -> Profiles {
        Profiles {
            head: FitHeading {
                title: "a fit".into(),
                numbers: "fitted".into(),
            },
            level: 0.95,
            unknowns,
        }
    }

    #[test]
    fn every_unknown_has_a_panel_with_its_name_interval_and_verdict() {
        let names = ["one", "two", "three", "four"];
        let all = names.map(|name| unknown(name, 7e10, 0.02));
        let svg = profiles(all.to_vec()).draw(&Style::default()).unwrap();
        for name in names {
            assert!(svg.contains(&format!(">{name}, GPa</text>")), "{name}");
        }
        assert!(
            svg.contains("70.00 [67.31, 72.80] GPa, identified"),
            "{svg}"
        );
        assert!(svg.contains("95 %"));
    }

    #[test]
    fn an_unknown_with_neither_profile_nor_covariance_has_no_panel() {
        let mut lost = unknown("lost", 7e10, 0.02);
        lost.profile.clear();
        lost.interval = [None, None];
        lost.wald = None;
        assert_eq!(profiles(vec![lost]).draw(&Style::default()), None);
    }

    #[test]
    fn levels_are_written_in_percent() {
        assert_eq!(percent(0.95), "95");
        assert_eq!(percent(0.999), "99.9");
    }
}
