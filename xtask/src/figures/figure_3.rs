//! Fig. 3: the deformed layer and the tops of the elements along the axis, read both ways.

use pellicle_cli::drawing::Axis;
use pellicle_cli::drawing::accuracy::BRACKETS;
use pellicle_cli::drawing::colours;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{Dash, Rect};

use super::chart::{self, ChartLine, LEFT};
use super::runner::{Runner, SolvedStep};
use super::sheet::{Caption, MATERIALS, Picture, Sheet, TEXTURED};
use crate::XtaskError;

/// In pixels.
const PANEL: (f64, f64) = (540.0, 330.0);
const COLUMN: f64 = LEFT + PANEL.0 + 28.0;
const ROW: f64 = PANEL.1 + 128.0;
const LEGEND: f64 = 66.0;

/// The scale of the depths.
const DEPTH: f64 = 1e-3;

/// Room above the undeformed tops and below the deepest point, as parts of the depth.
const ABOVE: f64 = 0.14;
const BELOW: f64 = 0.06;

/// By the loads of Fig. 2, and by the labels of Fig. 3, which give each coating the loads of the other: a case and a
/// step of it for the small and the large load.
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

/// One panel: the small and the large load, and three lines of each.
struct Reading {
    name: &'static str,
    loads: [SolvedStep; 2],
    lines: Vec<ChartLine>,
}

/// Both readings of the labels, for both coatings.
pub(super) fn draw(runner: &Runner) -> Result<Picture, XtaskError> {
    let mut readings = Vec::new();
    for (name, [small, large]) in PANELS {
        let loads = [
            runner.step(small.0, small.1)?,
            runner.step(large.0, large.1)?,
        ];
        readings.push(Reading::new(name, loads));
    }
    let mut notes = vec![
        MATERIALS.to_owned(),
        format!("Depths are measured from the undeformed tops; their axes differ. {BRACKETS}."),
    ];
    notes.extend(readings.iter().flat_map(|reading| &reading.loads).map(note));
    let caption = Caption {
        title: "Fig. 3: deformed layer and tops of the elements along the axis",
        subtitle: format!("{}{TEXTURED}", runner.mark()),
        notes,
    };
    let mut sheet = Sheet::new((2.0 * COLUMN, LEGEND + 2.0 * ROW), &caption);
    for (i, reading) in readings.iter().enumerate() {
        let place = Rect {
            left: COLUMN * (i % 2) as f64 + LEFT,
            top: Sheet::TOP + LEGEND + 44.0 + ROW * (i / 2) as f64,
            width: PANEL.0,
            height: PANEL.1,
        };
        let (title, lines) = (reading.title(), &reading.lines);
        chart::draw(&mut sheet.svg, &title, place, reading.axes(), lines);
    }
    // The large load first, since its lines are not broken.
    let (small, large) = readings[0].lines.split_at(3);
    chart::legend(&mut sheet.svg, (3, 400.0), large.iter().chain(small));
    let tables = readings.iter();
    let csv = chart::csv(tables.map(|reading| (reading.name, reading.lines.as_slice())));
    Ok(sheet.finish("fig3", csv))
}

/// The note on the data of a load.
fn note(load: &SolvedStep) -> String {
    load.note(&format!(
        "{}, Q = {}",
        load.case,
        power(load.numbers().force, 4)
    ))
}

impl Reading {
    fn new(name: &'static str, loads: [SolvedStep; 2]) -> Self {
        let [small, large] = &loads;
        let lines = [
            lines(small, "small", Dash::Dashed),
            lines(large, "large", Dash::Solid),
        ];
        Self {
            name,
            lines: lines.into_iter().flatten().collect(),
            loads,
        }
    }

    /// `name: small and large E₁R²`.
    fn title(&self) -> String {
        let [small, large] = self
            .loads
            .each_ref()
            .map(|load| power(load.numbers().force, 4));
        format!("{}: {small} and {large} E₁R²", self.name)
    }

    /// The axes: along x the larger contact and a margin, down to the deepest point of the surface that is shown.
    fn axes(&self) -> [Axis; 2] {
        let radius = |load: &SolvedStep| -> f64 { load.numbers().contact_radius };
        let reach = 1.12 * self.loads.iter().map(radius).fold(0.0, f64::max);
        let surface = self.lines.iter().filter(|line| line.colour != colours::INK);
        let shown = surface
            .flat_map(ChartLine::points)
            .filter(|(x, _)| x.abs() <= reach);
        let depth = shown.map(|(_, depth)| depth).fold(0.0, f64::max);
        [
            Axis::new(-reach, reach, "x, R".into(), 6),
            Axis::new(
                (1.0 + BELOW) * depth,
                -ABOVE * depth,
                "depth z, 10⁻³ R".into(),
                6,
            ),
        ]
    }
}

/// Depths of indenter, layer and tops below the undeformed tops, along x beside the axis.
fn lines(load: &SolvedStep, which: &str, dash: Dash) -> [ChartLine; 3] {
    let fields = load.fields();
    let height = load.summary.relief_height().unwrap_or(0.0);
    // u + w* − f*
    let top = |e: usize| fields.displacement[e] + fields.shortening[e] - fields.profile[e];
    let along = |depth: &dyn Fn(usize) -> f64, is_there: &dyn Fn(usize) -> bool| {
        let row: Vec<usize> = (0..fields.size)
            .map(|i| i * fields.size + fields.size / 2)
            .collect();
        let point = |e: &usize| (fields.centre(e / fields.size), depth(*e) / DEPTH);
        let runs = row.chunk_by(|one, next| is_there(*one) == is_there(*next));
        let runs = runs.filter(|run| is_there(run[0]));
        runs.map(|run| run.iter().map(point).collect()).collect()
    };
    let everywhere = |_| true;
    let line = |name: &str, colour, parts| ChartLine {
        dash,
        ..ChartLine::new(format!("{name}, {which} load"), colour, parts)
    };
    // In contact the indenter lies on what it touches, and is drawn below it.
    [
        ChartLine {
            width: 1.4,
            ..line(
                "indenter",
                colours::INK,
                along(&|e| top(e) - fields.gap[e], &everywhere),
            )
        },
        line(
            "surface of the layer",
            colours::ORANGE,
            along(&|e| fields.displacement[e] + height, &everywhere),
        ),
        ChartLine {
            width: 2.6,
            ..line(
                "tops of the elements",
                colours::BLUE,
                along(&top, &|e| fields.mask[e]),
            )
        },
    ]
}
