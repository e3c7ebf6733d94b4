//! Fig. 3: the deformed layer and the tops of the elements along the axis, in both readings.

use pellicle_cli::drawing::accuracy::BRACKETS;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{Axis, Dash, colours};

use super::chart::{Chart, ChartLine, CurvePanel};
use super::figure_2::{MATERIALS, TEXTURED, sets};
use super::runner::{Runner, SolvedStep};
use super::sheet::Picture;
use crate::XtaskError;

/// The scale of the depths.
const DEPTH: f64 = 1e-3;

/// Room above the undeformed tops and below the deepest point, as fractions of the depth.
const ABOVE: f64 = 0.14;
const BELOW: f64 = 0.06;

/// Panels with the loads of Fig. 2, and with the labels of Fig. 3, which give each coating the loads of the other: the
/// cases of the small and the large load, or the same case twice for two of its steps.
const PANELS: [(&str, [&str; 2]); 4] = [
    ("compliant, Q as in Fig. 2", ["cases/fig2a", "cases/fig2c"]),
    ("stiff, Q as in Fig. 2", ["cases/fig2b", "cases/fig2d"]),
    ("compliant, Q as labelled", ["cases/paper/fig3-soft"; 2]),
    ("stiff, Q as labelled", ["cases/paper/fig3-stiff"; 2]),
];

/// Draws both readings of the labels for both coatings.
pub(super) fn draw(runner: &Runner) -> Result<Picture, XtaskError> {
    let mut notes = vec![
        MATERIALS.to_owned(),
        format!("Depths are measured from the undeformed tops; their axes differ. {BRACKETS}."),
    ];
    let mut panels = Vec::new();
    for (name, [small, large]) in PANELS {
        let step_of_large = usize::from(small == large);
        let loads = [
            runner.step(small, sets(small), 0)?,
            runner.step(large, sets(large), step_of_large)?,
        ];
        notes.extend(
            loads
                .iter()
                .map(|load| load.note(&format!("{}, Q = {}", load.case, force(load)))),
        );
        panels.push(panel(name, &loads));
    }
    let title = "Fig. 3: deformed layer and tops of the elements along the axis";
    let chart = Chart {
        name: "fig3",
        caption: runner.caption(title, TEXTURED, notes),
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
    power(load.numbers().force, 4)
}

/// Three lines for each load; along x the larger contact and a margin, down to the deepest visible point of the
/// surface.
fn panel(name: &'static str, loads: &[SolvedStep; 2]) -> CurvePanel {
    let [small, large] = loads;
    let lines = [
        lines(small, "small", Dash::Dashed),
        lines(large, "large", Dash::Solid),
    ];
    let lines: Vec<_> = lines.into_iter().flatten().collect();
    let radii = loads
        .iter()
        .map(|load| load.numbers().summary.contact_radius);
    let reach = 1.12 * radii.fold(0.0, f64::max);
    let surface = lines.iter().filter(|line| line.pen.0 != colours::INK);
    let shown = surface
        .flat_map(ChartLine::points)
        .filter(|(x, _)| x.abs() <= reach);
    let depth = shown.map(|(_, depth)| depth).fold(0.0, f64::max);
    let (above, below) = (-ABOVE * depth, (1.0 + BELOW) * depth);
    CurvePanel {
        name,
        title: format!("{name}: {} and {} E₁R²", force(small), force(large)),
        axes: [
            Axis::new(-reach, reach, "x, R".into(), 6),
            Axis::new(below, above, "depth z, 10⁻³ R".into(), 6),
        ],
        lines,
    }
}

/// Depths of indenter, layer and tops below the undeformed tops, along x beside the axis.
fn lines(load: &SolvedStep, which: &str, dash: Dash) -> [ChartLine; 3] {
    let fields = load.fields();
    let height = load.summary.relief_height().unwrap_or(0.0);
    // u + w* − f*
    let top = |e: usize| fields.displacement[e] + fields.shortening[e] - fields.profile[e];
    let row = (0..fields.size).map(|i| i * fields.size + fields.size / 2);
    let row: Vec<usize> = row.collect();
    let line = |name: &str, colour, width, depth: &dyn Fn(usize) -> f64, runs: Vec<&[usize]>| {
        let point = |e: &usize| (fields.centre(e / fields.size), depth(*e) / DEPTH);
        let parts = runs.into_iter().map(|run| run.iter().map(point).collect());
        ChartLine {
            width,
            ..ChartLine::new(
                format!("{name}, {which} load"),
                (colour, dash),
                parts.collect(),
            )
        }
    };
    // In contact the indenter coincides with the surface, and is drawn below it.
    let indenter = |e| top(e) - fields.gap[e];
    let layer = |e| fields.displacement[e] + height;
    let reliefs = row.chunk_by(|one, next| fields.mask[*one] == fields.mask[*next]);
    let reliefs = reliefs.filter(|run| fields.mask[run[0]]).collect();
    [
        line("indenter", colours::INK, 1.4, &indenter, vec![&row]),
        line(
            "surface of the layer",
            colours::ORANGE,
            2.2,
            &layer,
            vec![&row],
        ),
        line("tops of the elements", colours::BLUE, 2.6, &top, reliefs),
    ]
}
