//! The pictures of an evaluation: every curve with the law of its unloading, on as many sheets as it takes.

use std::path::Path;

use pellicle_identify::fit_file::evaluation_file::EvaluatedFile;
use pellicle_identify::indentation::{EvaluatedCurve, IndentationNumber};
use pellicle_plot::fit::unloading::{self, UnloadingPanel};
use pellicle_plot::sheet::style::Style;

use super::text;
use crate::failure::Failure;
use crate::output::write_progress::WriteProgress;

/// Name of the first sheet without extension; the number of the others follows it.
const NAME: &str = "unloading";
/// Number of points by which a law is drawn.
const POINTS: u32 = 80;

/// Whether a file is one of these pictures.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let rest = name.strip_prefix(NAME);
    let rest = rest.and_then(|rest| {
        [".svg", ".png"]
            .iter()
            .find_map(|end| rest.strip_suffix(end))
    });
    rest.is_some_and(|rest| {
        let number = rest.strip_prefix('-');
        rest.is_empty() || number.is_some_and(|number| number.parse::<usize>().is_ok())
    })
}

/// Number of sheets.
#[must_use]
pub fn sheets(of: &[EvaluatedFile]) -> usize {
    unloadings(of).count().div_ceil(unloading::PANELS)
}

fn unloadings(of: &[EvaluatedFile]) -> impl Iterator<Item = (&EvaluatedFile, &EvaluatedCurve)> {
    of.iter().filter_map(|file| Some((file, file.unloading()?)))
}

/// Draws and writes the sheets; returns their drawings as SVG.
///
/// # Errors
///
/// [`Failure::File`] if a picture cannot be written.
pub fn write(
    folder: &Path,
    (title, of): (&str, &[EvaluatedFile]),
    style: &Style,
    writer: &WriteProgress<'_>,
) -> Result<Vec<String>, Failure> {
    let panels: Vec<UnloadingPanel> = unloadings(of)
        .map(|(file, curve)| panel(file, curve))
        .collect();
    let (all, mut drawings) = (panels.len(), Vec::new());
    for (sheet, panels) in panels.chunks(unloading::PANELS).enumerate() {
        let name = match sheet {
            0 => NAME.to_owned(),
            sheet => format!("{NAME}-{}", sheet + 1),
        };
        let first = sheet * unloading::PANELS + 1;
        let draw = || unloading::draw(title, panels, [first, all], style);
        drawings.extend(writer.picture(folder, &name, draw)?);
    }
    Ok(drawings)
}

fn panel(file: &EvaluatedFile, curve: &EvaluatedCurve) -> UnloadingPanel {
    let law = &curve.unloading;
    let (last, deepest) = (law.final_depth(), law.depth);
    let along = |k: u32| {
        let depth = last + (deepest - last) * f64::from(k) / f64::from(POINTS);
        (depth, law.force_at(depth))
    };
    let words = [
        IndentationNumber::IndentationModulus,
        IndentationNumber::IndentationHardness,
    ];
    let words = words.map(|of| {
        let number = curve.numbers.get(of).map(|number| text::words(of, number));
        format!("{} = {}", of.symbol(), number.unwrap_or_default())
    });
    let name = file.measured.file.file_name().unwrap_or_default();
    UnloadingPanel {
        name: name.to_string_lossy().into_owned(),
        numbers: words.join(", "),
        points: curve
            .depth
            .iter()
            .copied()
            .zip(curve.force.iter().copied())
            .collect(),
        fitted: curve.phases.fitted.clone(),
        law: (0..=POINTS).map(along).collect(),
        // The tangent at the largest force, down to no force.
        tangent: [
            (deepest - law.force / law.stiffness, 0.0),
            (deepest, law.force),
        ],
    }
}
