//! Fig. 3: the deformed layer and the tops of the elements along the axis, read both ways.

use pellicle_cli::picture::number::power;
use std::ops::Range;

use pellicle_cli::output::fields::Fields;
use pellicle_cli::picture::colours;
use pellicle_cli::picture::panel::Axis;
use pellicle_cli::picture::svg::{Dash, Place};

use super::line::{self, Line};
use super::parameters::Parameters;
use super::picture::Picture;
use super::sheet::Sheet;
use super::studio::Studio;
use super::{chart, note};
use crate::{PaperCase, PaperRun, XtaskError};

/// In pixels.
const LEFT: f64 = 112.0;
const PANEL: (f64, f64) = (540.0, 330.0);
const COLUMN: f64 = LEFT + PANEL.0 + 28.0;
const ROW: f64 = PANEL.1 + 128.0;
const LEGEND: f64 = 66.0;

/// The scale of the depths.
const DEPTH: f64 = 1e-3;

/// Room above the undeformed tops and below the deepest point, as parts of the depth.
const ABOVE: f64 = 0.14;
const BELOW: f64 = 0.06;

/// One load of one panel: a run and the step.
type Load = (PaperRun, usize);

/// Fig. 3 by the loads of Fig. 2 and by its own labels, which give each coating the loads of the other.
pub(super) fn figure_3(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let mut loads = |cases: [(PaperCase, usize); 2]| -> Result<Vec<Load>, XtaskError> {
        let run = |(case, step)| Ok((studio.fields(case)?, step));
        cases.into_iter().map(run).collect()
    };
    let panels = [
        (
            "compliant, Q as in Fig. 2",
            loads([(PaperCase::Fig2a, 0), (PaperCase::Fig2c, 0)])?,
        ),
        (
            "stiff, Q as in Fig. 2",
            loads([(PaperCase::Fig2b, 0), (PaperCase::Fig2d, 0)])?,
        ),
        (
            "compliant, Q as labelled",
            loads([(PaperCase::Fig3Soft, 0), (PaperCase::Fig3Soft, 1)])?,
        ),
        (
            "stiff, Q as labelled",
            loads([(PaperCase::Fig3Stiff, 0), (PaperCase::Fig3Stiff, 1)])?,
        ),
    ];
    let mut drawn = Vec::new();
    for (name, loads) in &panels {
        drawn.push((*name, lines(loads)?));
    }
    let mut sheet = sheet(studio, &panels);
    for (i, (name, lines)) in drawn.iter().enumerate() {
        draw_panel(&mut sheet, i, name, &panels[i].1, lines);
    }
    let [small, large] = drawn[0].1.split_at(3).into();
    let entries: [Vec<&Line>; 2] = [large.iter().collect(), small.iter().collect()];
    chart::legend(
        &mut sheet.svg,
        (LEFT, Sheet::TOP + 12.0),
        400.0,
        &[&entries[0], &entries[1]],
    );
    let csv = line::csv(drawn.iter().map(|(name, lines)| (*name, lines.as_slice())));
    Ok(vec![sheet.finish("fig3", csv)])
}

fn sheet(studio: &Studio<'_>, panels: &[(&str, Vec<Load>); 4]) -> Sheet {
    let [compliant, stiff] = [&panels[0].1[0].0, &panels[1].1[0].0].map(Parameters::of);
    let subtitle = format!(
        "{}paraboloid of radius R; coating {}; cylinders {}, {}",
        studio.quality.mark(),
        compliant.thickness(),
        compliant.cylinders(),
        compliant.period()
    );
    let materials = format!(
        "compliant coating: {}; stiff coating: {}",
        compliant.materials(),
        stiff.materials(),
    );
    let axes = format!(
        "Depths are measured from the undeformed tops; their axes differ. {}.",
        note::BRACKETS
    );
    let data = panels.iter().flat_map(|(_, loads)| loads);
    let data = data.map(|(run, step)| {
        let (name, step) = (run.request.case.name(), &run.steps()[*step]);
        format!(
            "{name}, Q = {}: {}",
            power(step.force, 4),
            note::of_step(run, step)
        )
    });
    let notes: Vec<_> = [materials, axes].into_iter().chain(data).collect();
    let title = "Fig. 3: deformed layer and tops of the elements along the axis";
    Sheet::new((2.0 * COLUMN, LEGEND + 2.0 * ROW), title, &subtitle, &notes)
}

fn draw_panel(sheet: &mut Sheet, i: usize, name: &str, loads: &[Load], lines: &[Line]) {
    let place = Place {
        left: COLUMN * (i % 2) as f64 + LEFT,
        top: Sheet::TOP + LEGEND + 44.0 + ROW * (i / 2) as f64,
        width: PANEL.0,
        height: PANEL.1,
    };
    let forces: Vec<_> = loads
        .iter()
        .map(|(run, step)| power(run.steps()[*step].force, 4))
        .collect();
    let title = format!("{name}: {} E₁R²", forces.join(" and "));
    let radius = loads
        .iter()
        .map(|(run, step)| run.steps()[*step].contact_radius);
    let reach = 1.12 * radius.fold(0.0, f64::max);
    let is_shown = |(x, _): &(f64, f64)| x.abs() <= reach;
    let surface = lines.iter().filter(|line| line.colour != colours::INK);
    let depths = surface.flat_map(Line::points).filter(is_shown);
    let depth = depths.map(|(_, depth)| depth).fold(0.0, f64::max);
    let axes = (
        Axis::new(-reach, reach, "x, R".into(), 6),
        Axis::new(
            (1.0 + BELOW) * depth,
            -ABOVE * depth,
            "depth z, 10⁻³ R".into(),
            6,
        ),
    );
    chart::draw(&mut sheet.svg, &title, place, axes, lines);
}

/// Three lines a load: layer, tops, indenter; the smaller load dashed.
fn lines(loads: &[Load]) -> Result<Vec<Line>, XtaskError> {
    let mut lines = Vec::new();
    for ((run, step), (dash, which)) in loads
        .iter()
        .zip([(Dash::Dashed, "small"), (Dash::Solid, "large")])
    {
        let stored = run.fields(*step)?;
        let height = run.record.relief_height().unwrap_or(0.0);
        let section = Section {
            fields: stored.fields(run.side()),
            height,
        };
        let line = |name: &str, colour, width, parts| Line {
            name: format!("{name}, {which} load"),
            colour,
            dash,
            width,
            is_marked: false,
            parts,
        };
        // In contact the indenter lies on what it touches, and is drawn below it.
        let [thin, thick] = [1.4, 2.6];
        lines.push(line("indenter", colours::INK, thin, section.indenter()));
        lines.push(line(
            "surface of the layer",
            colours::ORANGE,
            Line::WIDTH,
            section.layer(),
        ));
        lines.push(line(
            "tops of the elements",
            colours::BLUE,
            thick,
            section.tops(),
        ));
    }
    Ok(lines)
}

/// The row of elements beside the axis, along x.
struct Section<'a> {
    fields: Fields<'a>,
    /// Of the relief.
    height: f64,
}

impl Section<'_> {
    /// The surface of the layer lies `u + h` below the undeformed tops.
    fn layer(&self) -> Vec<Vec<(f64, f64)>> {
        self.parts(|_| true, |e| self.fields.displacement[e] + self.height)
    }

    /// The top of an element lies `u + w*` below where it was.
    fn tops(&self) -> Vec<Vec<(f64, f64)>> {
        self.parts(|e| self.fields.mask[e], |e| self.top(e))
    }

    /// The indenter lies the gap above what it meets.
    fn indenter(&self) -> Vec<Vec<(f64, f64)>> {
        self.parts(|_| true, |e| self.top(e) - self.fields.gap[e])
    }

    /// `u + w* − f*`.
    fn top(&self, e: usize) -> f64 {
        self.fields.displacement[e] + self.fields.shortening[e] - self.fields.profile[e]
    }

    /// The depths along the row where a line is, in runs of neighbouring elements.
    fn parts(
        &self,
        is_there: impl Fn(usize) -> bool,
        depth: impl Fn(usize) -> f64,
    ) -> Vec<Vec<(f64, f64)>> {
        let size = self.fields.size;
        let element = |i: usize| i * size + size / 2;
        let runs = runs(size, |i| is_there(element(i)));
        let point = |i| (self.fields.centre(i), depth(element(i)) / DEPTH);
        runs.into_iter()
            .map(|run| run.map(point).collect())
            .collect()
    }
}

/// The longest runs of indices below `count` for which something holds.
fn runs(count: usize, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in (0..count).filter(|i| holds(*i)) {
        match runs.last_mut() {
            Some(run) if run.end == i => run.end = i + 1,
            _ => runs.push(i..i + 1),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_as_long_as_they_can_be() {
        assert_eq!(runs(6, |i| i != 2), [0..2, 3..6]);
        assert!(runs(3, |_| false).is_empty());
    }
}
