//! `report.html`: a run on one page that needs no network. Drawings can be moved and zoomed, the pressure can be
//! turned.

mod case_table;
mod step;
pub mod surface;

use pellicle_contact::Status;

use super::pictures::Kind;
use super::summary::{StepSummary, Summary, WarningSummary};
use crate::display::{Unit, quantity, significant};
use crate::picture::svg::escaped;

/// Name of the file in a results folder.
pub const FILE: &str = "report.html";

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Nothing may be loaded from anywhere; what the page needs stands in it.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

const TOOLS: &str = "<div class=\"tools\"><button type=\"button\" data-act=\"in\" title=\"larger\">+</button>\
                     <button type=\"button\" data-act=\"out\" title=\"smaller\">−</button>\
                     <button type=\"button\" data-act=\"whole\" title=\"as it was\">⟲</button></div>";

/// The pictures of one loading step.
#[derive(Debug, Clone, Default)]
pub struct StepPart {
    /// Which step, counted from 0.
    pub step: usize,
    /// Those that were drawn, as SVG.
    pub drawings: Vec<(Kind, String)>,
    /// The beginning of the figure that is turned, by [`surface::figure`]; none if it cannot be drawn.
    pub surface: Option<String>,
}

/// The pictures of the run as a whole, as SVG.
#[derive(Debug, Clone, Default)]
pub struct RunPart {
    /// Force over penetration, pressure over force.
    pub curve: Option<String>,
    /// Values from grid to grid.
    pub convergence: Option<String>,
}

/// The page.
#[must_use]
pub fn html(summary: &Summary, steps: &[StepPart], run: &RunPart) -> String {
    let title = escaped(&summary.title);
    let mut steps = steps.to_vec();
    // The numbers of the last step are there, drawn or not.
    if let Some(last) = summary.steps.len().checked_sub(1)
        && steps.last().is_none_or(|part| part.step != last)
    {
        steps.push(StepPart {
            step: last,
            ..StepPart::default()
        });
    }
    let body = [
        head(summary),
        warnings(summary),
        curve(summary, run),
        choice(summary, &steps),
        steps
            .iter()
            .map(|part| step_section(summary, part))
            .collect(),
        convergence(run),
        case(summary),
        timing(summary),
    ];
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <link rel=\"icon\" href=\"data:,\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{}<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        body.concat()
    )
}

fn head(summary: &Summary) -> String {
    let (title, version) = (escaped(&summary.title), escaped(&summary.version));
    let metres = |value| quantity(value, Unit::Metre, summary.units);
    let grid = &summary.grid;
    let (elements, side, element) = (grid.elements, metres(grid.side), metres(grid.element_side));
    let failed = summary.steps.iter().any(|step| !step.certificate.satisfied);
    let cut_off = (summary.steps.iter()).any(|step| step.status == Status::CutOff);
    let failure = if failed {
        "<p class=\"failure\" role=\"alert\">Not converged: the certificate of at least one loading step is not satisfied. \
         Do not use its numbers.</p>\n"
    } else if cut_off {
        "<p class=\"failure\" role=\"alert\">Cut off: the contact of at least one loading step would go on where the domain or a map ends. \
         Do not use its numbers.</p>\n"
    } else {
        ""
    };
    format!(
        "<header>\n<h1>{title}</h1>\n<p class=\"muted\">Pellicle {version}, {elements} × {elements} elements on a square of side {side}, \
         element side {element}</p>\n</header>\n{failure}"
    )
}

/// The warnings, before any number.
fn warnings(summary: &Summary) -> String {
    if summary.warnings.is_empty() {
        return String::new();
    }
    let line = |warning: &WarningSummary| format!("<li>{}</li>\n", escaped(&warning.message));
    let lines: String = summary.warnings.iter().map(line).collect();
    format!(
        "<div class=\"warnings\" role=\"alert\"><strong>Before these numbers are used:</strong>\n<ul>\n{lines}</ul></div>\n"
    )
}

fn curve(summary: &Summary, run: &RunPart) -> String {
    let Some(curve) = &run.curve else {
        return String::new();
    };
    let rows = summary.steps.iter().enumerate();
    let rows: Vec<_> = rows.map(|(i, step)| curve_row(summary, i, step)).collect();
    let rows = rows.concat();
    format!(
        "<h2>Curve</h2>\n{}<div class=\"wide\"><table><thead><tr><th>step</th><th>force Q</th><th>penetration D</th>\
         <th>largest pressure</th><th>contact area</th><th>certificate</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        drawing(
            curve,
            "Force over penetration, and largest pressure over force."
        )
    )
}

fn curve_row(summary: &Summary, i: usize, step: &StepSummary) -> String {
    let cells = [
        quantity(step.force, Unit::Newton, summary.units),
        quantity(step.penetration, Unit::Metre, summary.units),
        quantity(step.max_pressure, Unit::Pascal, summary.units),
        quantity(step.contact_area, Unit::SquareMetre, summary.units),
    ];
    let cells = cells
        .map(|cell| format!("<td class=\"number\">{cell}</td>"))
        .concat();
    let verdict = match step.status {
        _ if !step.certificate.satisfied => "<strong>NOT SATISFIED</strong>",
        Status::CutOff => "<strong>CUT OFF</strong>",
        _ => "satisfied",
    };
    format!("<tr><td>{i}</td>{cells}<td>{verdict}</td></tr>\n")
}

/// The choice of the step that is shown.
fn choice(summary: &Summary, steps: &[StepPart]) -> String {
    if steps.len() < 2 {
        return String::new();
    }
    // The page opens at the last step.
    let last = steps.last().map(|part| part.step);
    let option = |part: &StepPart| {
        let force = quantity(summary.steps[part.step].force, Unit::Newton, summary.units);
        let step = part.step;
        let selected = if last == Some(step) { " selected" } else { "" };
        format!("<option value=\"step-{step}\"{selected}>step {step}, Q = {force}</option>\n")
    };
    let options: String = steps.iter().map(option).collect();
    let all = summary.steps.len();
    let some = match steps.len() {
        shown if shown < all => {
            format!(" {shown} of {all} steps are on this page.")
        }
        _ => String::new(),
    };
    format!(
        "<p class=\"choice\"><label>Loading step: <select id=\"choice\">\n{options}</select></label>{some}</p>\n"
    )
}

fn step_section(summary: &Summary, part: &StepPart) -> String {
    let step = &summary.steps[part.step];
    let tolerance = summary.case["solver"]["tolerance"]
        .as_f64()
        .unwrap_or(f64::NAN);
    let heading = match summary.steps.len() {
        1 => "Result".to_owned(),
        _ => format!("Loading step {}", part.step),
    };
    [
        format!(
            "<section class=\"step\" id=\"step-{}\">\n<h2>{heading}</h2>\n",
            part.step
        ),
        step::numbers(summary, step),
        format!(
            "<h3>Certificate</h3>\n{}",
            step::certificate(&step.certificate, tolerance)
        ),
        drawings(part),
        "</section>\n".into(),
    ]
    .concat()
}

/// What there is of a step's pictures.
fn drawings(part: &StepPart) -> String {
    let figure = |(kind, svg): &(Kind, String)| match kind {
        Kind::Map => format!(
            "<h3>Pressure</h3>\n{}{}",
            drawing(
                svg,
                "The pressure on the surface. Black: outline of the contact; grey: outline of the relief."
            ),
            part.surface.as_deref().map(turned).unwrap_or_default(),
        ),
        Kind::Section => format!(
            "<h3>Section</h3>\n{}",
            drawing(
                svg,
                "Depth is positive into the body; how much it is enlarged against the length across is said above it."
            ),
        ),
        // The same as the pressure that can be turned.
        Kind::View => String::new(),
        Kind::Field(field) => {
            format!(
                "<h3>The {}</h3>\n{}",
                field.title(),
                drawing(svg, "Black: outline of the contact.")
            )
        }
    };
    part.drawings.iter().map(figure).collect()
}

fn turned(surface: &str) -> String {
    format!(
        "{surface}{TOOLS}<figcaption>The pressure in three dimensions: drag to turn; + and − to zoom, also the wheel after a click.</figcaption></figure>\n"
    )
}

fn convergence(run: &RunPart) -> String {
    let Some(convergence) = &run.convergence else {
        return String::new();
    };
    let caption = "What the numbers were on the coarser grids, against the finest. A line that does not level off is not resolved.";
    format!("<h2>Grids</h2>\n{}", drawing(convergence, caption))
}

fn case(summary: &Summary) -> String {
    let rows = case_table::rows(&summary.case, summary.units);
    format!(
        "<h2>Case</h2>\n<p>As resolved, every default filled in.</p>\n<div class=\"wide\"><table>\n{rows}</table></div>\n"
    )
}

fn timing(summary: &Summary) -> String {
    let timing = &summary.timing;
    let seconds = |value| significant(value, 3);
    let origin = if timing.coefficients_from_cache {
        "read from the cache"
    } else {
        "computed"
    };
    format!(
        "<h2>Time</h2>\n<p>Coefficients {} s ({origin}), solution {} s, {} threads.</p>\n",
        seconds(timing.coefficients_seconds),
        seconds(timing.solve_seconds),
        timing.threads
    )
}

fn drawing(svg: &str, caption: &str) -> String {
    format!(
        "<figure class=\"drawing\" tabindex=\"0\">\n{svg}{TOOLS}<figcaption>{caption}</figcaption></figure>\n"
    )
}
