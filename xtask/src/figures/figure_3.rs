//! Fig. 3: the deformed layer and the tops of the elements along the axis, in both readings.

use pellicle_cli::drawing::accuracy::UNRESOLVED;
use pellicle_plot::axes::labels::power;
use pellicle_plot::axes::panel::Axis;
use pellicle_plot::sheet::colours::{BLUE, Colour, INK, ORANGE};
use pellicle_plot::sheet::svg::Dash;

use super::chart::{Chart, ChartLine, CurvePanel};
use super::figure_2::{self, MATERIALS, TEXTURED};
use super::runner::{Case, Runner, SolvedStep};
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// The scale of the depths.
const DEPTH: f64 = 1e-3;

/// Room above the undeformed tops and below the deepest point, as fractions of the depth.
const ABOVE: f64 = 0.14;
const BELOW: f64 = 0.06;

/// Panels with the loads of Fig. 2, and with the labels of Fig. 3, which give each coating the loads of the other. The
/// cases of a panel have two steps together: the small and the large load.
const PANELS: [(&str, &[Case<'_>]); 4] = {
    let [a, b, c, d] = figure_2::CASES;
    [
        ("compliant, Q as in Fig. 2", &[a, c]),
        ("stiff, Q as in Fig. 2", &[b, d]),
        (
            "compliant, Q as labelled",
            &[("cases/paper/fig3-soft", &[])],
        ),
        ("stiff, Q as labelled", &[("cases/paper/fig3-stiff", &[])]),
    ]
};

/// Draws both readings of the labels for both coatings.
pub(super) fn draw(runner: &Runner) -> Result<Picture, XtaskError> {
    let mut notes = vec![
        MATERIALS.to_owned(),
        format!("Depths are measured from the undeformed tops; their axes differ. {UNRESOLVED}."),
    ];
    let mut panels = Vec::new();
    for (name, cases) in PANELS {
        let loads = runner.steps(cases)?;
        let note = |load: &SolvedStep| load.note(&format!("{}, Q = {}", load.case, force(load)));
        notes.extend(loads.iter().map(note));
        panels.push(panel(name, &loads));
    }
    let chart = Chart {
        name: "fig3",
        caption: Caption {
            title: "Fig. 3: deformed layer and tops of the elements along the axis",
            subtitle: runner.marked(TEXTURED),
            notes,
        },
        panel: (540.0, 330.0),
        margins: [44.0, 28.0, 84.0],
        legend: (3, 400.0),
        // Starts with the solid lines of the large load.
        legend_from: 3,
        panels,
    };
    Ok(chart.draw())
}

/// `Q`, E₁R².
fn force(load: &SolvedStep) -> String {
    power(load.numbers.force, 4)
}

/// Three lines for each load; along x the larger contact and a margin, down to the deepest visible point of the
/// surface.
fn panel(name: &'static str, loads: &[SolvedStep]) -> CurvePanel {
    let [small, large] = [("small", Dash::Dashed), ("large", Dash::Solid)];
    let lines = [lines(&loads[0], small), lines(&loads[1], large)].concat();
    let radii = loads.iter().map(|load| load.numbers.summary.contact_radius);
    let reach = 1.12 * radii.fold(0.0, f64::max);
    let surface = lines.iter().filter(|line| line.pen.0 != INK);
    let points = surface.flat_map(ChartLine::points);
    let shown = points.filter(|(x, _)| x.abs() <= reach);
    let depth = shown.map(|(_, depth)| depth).fold(0.0, f64::max);
    let (above, below) = (-ABOVE * depth, (1.0 + BELOW) * depth);
    let forces: Vec<_> = loads.iter().map(force).collect();
    CurvePanel {
        name,
        title: format!("{name}: {} E₁R²", forces.join(" and ")),
        axes: [
            Axis::new(-reach, reach, "x, R".into(), 6),
            Axis::new(below, above, "depth z, 10⁻³ R".into(), 6),
        ],
        lines,
    }
}

/// Depths of indenter, layer and tops below the undeformed tops, along x beside the axis.
fn lines(load: &SolvedStep, (which, dash): (&str, Dash)) -> [ChartLine; 3] {
    let fields = load.fields();
    let height = load.run.relief_height().unwrap_or(0.0);
    let row: Vec<usize> = (0..fields.size)
        .map(|i| i * fields.size + fields.size / 2)
        .collect();
    let reliefs = row.chunk_by(|one, next| fields.mask[*one] == fields.mask[*next]);
    let reliefs = reliefs.filter(|run| fields.mask[run[0]]).collect();
    // u + w* − f*
    let top = |e| fields.displacement[e] + fields.shortening[e] - fields.profile[e];
    let layer = |e| fields.displacement[e] + height;
    // In contact the indenter coincides with the surface, and is drawn below it.
    let indenter = |e| top(e) - fields.gap[e];
    let line = |name, colour: Colour, width, depth: &dyn Fn(usize) -> f64, runs: Vec<&[usize]>| {
        let point = |e: &usize| (fields.centre(e / fields.size), depth(*e) / DEPTH);
        let parts = runs.into_iter().map(|run| run.iter().map(point).collect());
        let name = format!("{name}, {which} load");
        ChartLine {
            width,
            ..ChartLine::new(name, (colour, dash), parts.collect())
        }
    };
    [
        line("indenter", INK, 1.4, &indenter, vec![&row]),
        line("surface of the layer", ORANGE, 2.2, &layer, vec![&row]),
        line("tops of the elements", BLUE, 2.6, &top, reliefs),
    ]
}
