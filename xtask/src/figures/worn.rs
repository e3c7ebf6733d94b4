//! What rounded edges and wear do to the pillars of Fig. 2(a) and 2(c): the pictures of docs/worn-texture.md.

use pellicle_plot::axes::panel::Axis;
use pellicle_plot::sheet::colours::{BLUE, GREEN, ORANGE, PURPLE};
use pellicle_plot::sheet::svg::Dash::{Dashed, Solid};

use super::chart::{Chart, ChartLine, CurvePanel, Pen};
use super::runner::{Runner, SolvedStep};
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// Radius of the pillars and their height, in units of R.
const RADIUS: f64 = 5e-3;
const HEIGHT: f64 = 1e-4;
/// The unit of x in the pictures, in units of R.
const MILLI: f64 = 1e-3;
/// Half the width that is shown of the worn pillars, in units of R, and the upper end of the pressures, in E₁.
const REACH: f64 = 0.04;
const HIGHEST: f64 = 0.5;
/// The same for rounded edges, on a square that just holds the contact of Fig. 2(a).
const ROUNDED_REACH: f64 = 0.017;
const ROUNDED_HIGHEST: f64 = 0.3;
const SIDE: &str = "grid.side=0.034";

/// Edge radii over the height of the pillars.
const EDGES: [(&str, &str, Pen); 3] = [
    ("sharp edges", "surface.edge_radius=0", (ORANGE, Solid)),
    (
        "edge radius h/2",
        "surface.edge_radius=5e-5",
        (GREEN, Dashed),
    ),
    ("edge radius h", "surface.edge_radius=1e-4", (BLUE, Solid)),
];

/// The sliding distances in units of s₀: without elasticity a pressure E₁ wears a pillar away over s₀.
const WEAR: [&str; 3] = [
    "surface.edge_radius=1e-4",
    "wear.coefficient=1e-4",
    "wear.distances=[0, 1, 2, 3]",
];
const DISTANCES: [(&str, Pen); 4] = [
    ("new", (BLUE, Solid)),
    ("after s₀", (GREEN, Dashed)),
    ("after 2 s₀", (ORANGE, Solid)),
    ("after 3 s₀", (PURPLE, Dashed)),
];

const TEXTURE: &str =
    "paraboloid of radius R, coating H = 10⁻⁴ R, pillars r = 5·10⁻³ R, h = 10⁻⁴ R, T = R/80";

/// Draws the pressure under rounded edges, and heights and pressure as the rounded pillars wear.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let mut rounded = Vec::new();
    for (_, edge, _) in EDGES {
        rounded.extend(runner.steps(&[("cases/fig2a", &[edge, SIDE])])?);
    }
    let worn = runner.steps(&[("cases/fig2c", &WEAR)])?;
    Ok(vec![of_edges(runner, &rounded), of_wear(runner, &worn)])
}

fn of_edges(runner: &Runner, steps: &[SolvedStep]) -> Picture {
    let lines = || -> Vec<ChartLine> {
        let lines = EDGES.iter().zip(steps);
        lines
            .map(|((name, _, pen), step)| along(name, *pen, step, pressure))
            .collect()
    };
    chart(
        "rounded-pillars",
        Caption {
            title: "Rounded edges: pressure along x under the pillars of Fig. 2(a)",
            subtitle: runner.marked(TEXTURE),
            notes: (EDGES.iter().zip(steps))
                .map(|((name, ..), step)| step.note(name))
                .collect(),
        },
        [
            panel(
                "whole",
                "whole contact",
                x_axis([-ROUNDED_REACH, ROUNDED_REACH]),
                pressures(ROUNDED_HIGHEST),
                lines(),
            ),
            panel(
                "rim",
                "rim of the pillar on the axis",
                x_axis([RADIUS - 6.0 * HEIGHT, RADIUS + HEIGHT]),
                pressures(ROUNDED_HIGHEST),
                lines(),
            ),
        ],
    )
}

fn of_wear(runner: &Runner, steps: &[SolvedStep]) -> Picture {
    let lines = |value: fn(&SolvedStep, usize) -> f64| -> Vec<ChartLine> {
        let lines = DISTANCES.iter().zip(steps);
        lines
            .map(|((name, pen), step)| along(name, *pen, step, value))
            .collect()
    };
    let heights = Axis::new(-1.05, 0.05, "height of the relief, h".into(), 6);
    chart(
        "worn-pillars",
        Caption {
            title: "Wear: heights of the pillars of Fig. 2(c) and pressure along x",
            subtitle: runner.marked(TEXTURE),
            notes: std::iter::once(
                "edge radius h; wear k p per distance, s₀ = h/(k E₁)".to_owned(),
            )
            .chain((DISTANCES.iter().zip(steps)).map(|((name, _), step)| step.note(name)))
            .collect(),
        },
        [
            panel(
                "heights",
                "heights",
                x_axis([-REACH, REACH]),
                heights,
                lines(height),
            ),
            panel(
                "pressure",
                "pressure",
                x_axis([-REACH, REACH]),
                pressures(HIGHEST),
                lines(pressure),
            ),
        ],
    )
}

fn chart(name: &'static str, caption: Caption, panels: [CurvePanel; 2]) -> Picture {
    let chart = Chart {
        name,
        caption,
        panel: (620.0, 440.0),
        margins: [44.0, 36.0, 76.0],
        legend: (4, 300.0),
        legend_from: 0,
        panels: panels.into(),
    };
    chart.draw()
}

fn panel(name: &'static str, title: &str, x: Axis, y: Axis, lines: Vec<ChartLine>) -> CurvePanel {
    CurvePanel {
        name,
        title: title.into(),
        axes: [x, y],
        lines,
    }
}

fn x_axis([low, high]: [f64; 2]) -> Axis {
    Axis::new(low / MILLI, high / MILLI, "x, 10⁻³ R".into(), 6)
}

fn pressures(highest: f64) -> Axis {
    Axis::new(0.0, highest, "pressure, E₁".into(), 6)
}

/// A field along x beside the axis.
fn along(
    name: &str,
    pen: Pen,
    step: &SolvedStep,
    value: fn(&SolvedStep, usize) -> f64,
) -> ChartLine {
    let fields = step.fields();
    let size = fields.size;
    let place = |i: usize| 0.5 * (fields.edge(i) + fields.edge(i + 1)) / MILLI;
    let points = (0..size).map(|i| (place(i), value(step, i * size + size / 2)));
    ChartLine::new(name, pen, vec![points.collect()])
}

fn pressure(step: &SolvedStep, element: usize) -> f64 {
    step.fields().pressure[element]
}

fn height(step: &SolvedStep, element: usize) -> f64 {
    step.fields().profile[element] / HEIGHT
}
