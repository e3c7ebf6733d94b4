//! The stresses under Fig. 2, which the paper does not show: sections through the largest von Mises stress.

use pellicle_cli::drawing::extremes;
use pellicle_cli::results::{read_stresses, stresses_file};
use pellicle_plot::step::subject::Subject;
use pellicle_plot::stress::section;
use pellicle_plot::stress::view::StressView;

use super::runner::Runner;
use super::sheet::{Picture, csv};
use crate::XtaskError;

/// The cases, the names of their pictures, and the depth and width of these in units of R: about two cylinder radii,
/// and the contact.
const CASES: [(&str, &str, f64, f64); 4] = [
    ("cases/fig2a", "fig2a-stress", 0.012, 0.06),
    ("cases/fig2b", "fig2b-stress", 0.012, 0.06),
    ("cases/fig2c", "fig2c-stress", 0.02, 0.1),
    ("cases/fig2d", "fig2d-stress", 0.02, 0.1),
];

/// Draws one picture per case, in the program's style.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let picture = |(case, name, deepest, extent): (&'static str, &str, f64, f64)| {
        let stress = format!(
            "stress={{ depths = {{ from = 0, to = {deepest}, count = 2 }}, extent = {extent} }}"
        );
        let steps = runner.steps(&[(case, &[&stress])])?;
        let view = read_stresses(&runner.folder(case).join(stresses_file(0)))?;
        let subject = steps[0].subject();
        let title = &runner.marked(subject.title);
        let extremes = extremes::of_step(&steps[0].numbers);
        let svg = section::draw(&Subject { title, ..subject }, &view, &extremes);
        let csv = csv("x,z,body,von Mises,largest principal", rows(&view));
        Ok(Picture {
            name: name.into(),
            svg,
            csv,
        })
    };
    CASES.into_iter().map(picture).collect()
}

/// One row per point of the section.
fn rows(view: &StressView) -> impl Iterator<Item = String> {
    let section = &view.section;
    let planes = section.depths.iter().zip(&section.bodies);
    let points = planes.flat_map(|plane| section.along.iter().map(move |x| (x, plane)));
    let values = section.von_mises.iter().zip(&section.max_principal);
    points
        .zip(values)
        .map(|((x, (z, body)), (von_mises, principal))| {
            format!("{x:e},{z:e},{body},{von_mises:e},{principal:e}")
        })
}
