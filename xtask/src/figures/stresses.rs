//! The stresses under Fig. 2, which the paper does not show: sections through the largest von Mises stress.

use std::fmt::Write as _;

use pellicle_cli::drawing::{Style, Subject, stress_section};
use pellicle_cli::results::{StressSection, StressView};

use super::runner::Runner;
use super::sheet::Picture;
use crate::XtaskError;

/// The cases, the names of their pictures, and how deep and how far across these reach, in units of R: about two
/// radii of a cylinder, and the contact.
const CASES: [(&str, &str, f64, f64); 4] = [
    ("cases/fig2a", "fig2a-stress", 0.012, 0.06),
    ("cases/fig2b", "fig2b-stress", 0.012, 0.06),
    ("cases/fig2c", "fig2c-stress", 0.02, 0.1),
    ("cases/fig2d", "fig2d-stress", 0.02, 0.1),
];

/// One picture a case, as the program draws it.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    CASES
        .iter()
        .map(|(case, name, deepest, extent)| {
            let stress = format!(
                "stress={{ depths = {{ from = 0, to = {deepest}, count = 2 }}, extent = {extent} }}"
            );
            let (step, view) = runner.stressed_step(case, &stress)?;
            let title = format!("{}{}", runner.mark(), step.summary.title);
            let subject = Subject {
                title: &title,
                units: step.summary.units,
                relief_height: step.summary.relief_height(),
                step: step.numbers(),
                fields: step.fields(),
                style: Style::default(),
            };
            Ok(Picture {
                name,
                svg: stress_section::draw(&subject, &view),
                width: stress_section::WIDTH,
                csv: csv(&view),
            })
        })
        .collect()
}

/// One row a point of the section.
fn csv(view: &StressView) -> String {
    let StressSection {
        along,
        depths,
        bodies,
        von_mises,
        max_principal,
        ..
    } = &view.section;
    let mut csv = String::from("x,z,body,von Mises,largest principal\n");
    let planes = depths.iter().zip(bodies);
    let points = planes.flat_map(|plane| along.iter().map(move |x| (x, plane)));
    let values = von_mises.iter().zip(max_principal);
    for ((x, (z, body)), (von_mises, principal)) in points.zip(values) {
        // Writing to a string does not fail.
        let _ = writeln!(csv, "{x:e},{z:e},{body},{von_mises:e},{principal:e}");
    }
    csv
}
