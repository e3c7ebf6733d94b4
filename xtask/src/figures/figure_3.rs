//! Fig. 3: the deformed layer and the tops of the elements along the axis, read both ways.

use pellicle_cli::drawing::Axis;
use pellicle_cli::drawing::colours;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{Dash, Rect};
use pellicle_cli::results::StepSummary;

use super::line::{self, Line};
use super::parameters::Parameters;
use super::picture::Picture;
use super::run::PaperRun;
use super::section::Section;
use super::sheet::Sheet;
use super::studio::Studio;
use super::{chart, note};
use crate::XtaskError;

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

/// One panel: its name, and the small and the large load.
struct Profile {
    name: &'static str,
    loads: Vec<Load>,
    lines: Vec<Line>,
}

/// By the loads of Fig. 2, and by the labels of Fig. 3, which give each coating the loads of the other.
const PANELS: [(&str, [(&str, usize); 2]); 4] = [
    (
        "compliant, Q as in Fig. 2",
        [("cases/fig2a", 0), ("cases/fig2c", 0)],
    ),
    (
        "stiff, Q as in Fig. 2",
        [("cases/fig2b", 0), ("cases/fig2d", 0)],
    ),
    (
        "compliant, Q as labelled",
        [("cases/paper/fig3-soft", 0), ("cases/paper/fig3-soft", 1)],
    ),
    (
        "stiff, Q as labelled",
        [("cases/paper/fig3-stiff", 0), ("cases/paper/fig3-stiff", 1)],
    ),
];

/// Both readings of the labels, for both coatings.
pub(super) fn draw(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let mut profiles = Vec::new();
    for (name, cases) in PANELS {
        profiles.push(profile(studio, name, cases)?);
    }
    let mut sheet = sheet(studio, &profiles);
    for (i, profile) in profiles.iter().enumerate() {
        draw_panel(&mut sheet, i, profile);
    }
    draw_legend(&mut sheet, &profiles[0].lines);
    let tables = profiles
        .iter()
        .map(|profile| (profile.name, profile.lines.as_slice()));
    let csv = line::csv(tables);
    Ok(vec![sheet.finish("fig3", csv)])
}

fn profile(
    studio: &mut Studio<'_>,
    name: &'static str,
    cases: [(&'static str, usize); 2],
) -> Result<Profile, XtaskError> {
    let load = |(case, step)| Ok((studio.fields(case)?, step));
    let loads = cases
        .into_iter()
        .map(load)
        .collect::<Result<Vec<Load>, XtaskError>>()?;
    let lines = lines(&loads)?;
    Ok(Profile { name, loads, lines })
}

impl Profile {
    fn steps(&self) -> impl Iterator<Item = &StepSummary> {
        self.loads.iter().map(|(run, step)| &run.steps()[*step])
    }

    /// `name: small and large E₁R²`.
    fn title(&self) -> String {
        let forces: Vec<_> = self.steps().map(|step| power(step.force, 4)).collect();
        format!("{}: {} E₁R²", self.name, forces.join(" and "))
    }

    /// Half the length shown: the larger contact and a margin.
    fn reach(&self) -> f64 {
        1.12 * self
            .steps()
            .map(|step| step.contact_radius)
            .fold(0.0, f64::max)
    }

    /// The deepest point of the surface that is shown.
    fn depth(&self) -> f64 {
        let reach = self.reach();
        let surface = self.lines.iter().filter(|line| line.colour != colours::INK);
        let shown = surface
            .flat_map(Line::points)
            .filter(|(x, _)| x.abs() <= reach);
        shown.map(|(_, depth)| depth).fold(0.0, f64::max)
    }
}

fn sheet(studio: &Studio<'_>, profiles: &[Profile]) -> Sheet {
    let [compliant, stiff] = [0, 1].map(|i: usize| Parameters::of(&profiles[i].loads[0].0));
    let materials = format!(
        "compliant coating: {}; stiff coating: {}",
        compliant.materials(),
        stiff.materials(),
    );
    let axes = format!(
        "Depths are measured from the undeformed tops; their axes differ. {}.",
        note::BRACKETS
    );
    let data = profiles.iter().flat_map(|profile| &profile.loads).map(data);
    let notes: Vec<_> = [materials, axes].into_iter().chain(data).collect();
    let subtitle = format!("{}{}", studio.quality.mark(), compliant.textured_coating());
    let title = "Fig. 3: deformed layer and tops of the elements along the axis";
    Sheet::new((2.0 * COLUMN, LEGEND + 2.0 * ROW), title, &subtitle, &notes)
}

/// The note on the data of a load.
fn data((run, step): &Load) -> String {
    let (name, step) = (run.case, &run.steps()[*step]);
    let force = power(step.force, 4);
    format!("{name}, Q = {force}: {}", note::of_step(run, step))
}

fn draw_panel(sheet: &mut Sheet, i: usize, profile: &Profile) {
    let place = Rect {
        left: COLUMN * (i % 2) as f64 + LEFT,
        top: Sheet::TOP + LEGEND + 44.0 + ROW * (i / 2) as f64,
        width: PANEL.0,
        height: PANEL.1,
    };
    let (reach, depth) = (profile.reach(), profile.depth());
    let (deepest, highest) = ((1.0 + BELOW) * depth, -ABOVE * depth);
    let axes = (
        Axis::new(-reach, reach, "x, R".into(), 6),
        Axis::new(deepest, highest, "depth z, 10⁻³ R".into(), 6),
    );
    chart::draw(
        &mut sheet.svg,
        &profile.title(),
        place,
        axes,
        &profile.lines,
    );
}

/// One row a load; the large one first, since its lines are not broken.
fn draw_legend(sheet: &mut Sheet, lines: &[Line]) {
    let (small, large) = lines.split_at(lines.len() / 2);
    let rows = [large, small].map(|lines| lines.iter().collect::<Vec<_>>());
    let place = (LEFT, Sheet::TOP + 12.0);
    chart::legend(&mut sheet.svg, place, 400.0, &[&rows[0], &rows[1]]);
}

/// Three lines a load: layer, tops, indenter; the smaller load dashed.
fn lines(loads: &[Load]) -> Result<Vec<Line>, XtaskError> {
    let mut lines = Vec::new();
    for ((run, step), (dash, which)) in loads
        .iter()
        .zip([(Dash::Dashed, "small"), (Dash::Solid, "large")])
    {
        let stored = run.fields(*step)?;
        let height = run.summary.relief_height().unwrap_or(0.0);
        let section = Section {
            fields: stored.fields(run.side()),
            height,
            unit: DEPTH,
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
