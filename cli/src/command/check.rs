//! `pellicle check`: the case as resolved, and what solving it would take.

use crate::arguments::CaseArguments;
use crate::case::Case;
use crate::case::surface::SurfaceCase;
use crate::case::units::Units;
use crate::display::{Unit, quantity, significant};
use crate::failure::Failure;
use crate::program::Outcome;
use crate::{cache, terminal};

/// Memory of a run per element, in bytes, measured as the resident set of fig2c at N = 512, 1024 and 2048: 250, 230 and 223
/// with one step, of which a step's four fields are 32.
const BYTES_PER_ELEMENT: f64 = 210.0;

/// Memory of a loading step per element, in bytes: four fields.
const BYTES_PER_ELEMENT_AND_STEP: f64 = 32.0;

/// Prints the case with every default filled in, and below it what the grid makes of it.
///
/// # Errors
///
/// [`Failure`] if the case is wrong.
pub fn check(arguments: &CaseArguments) -> Result<Outcome, Failure> {
    let mut case = Case::read(&arguments.path, &arguments.sets)?;
    let cache = cache::open();
    let chosen = case.grid.side.is_none();
    let side = case.side(&case.model(&cache)?.value);
    case.grid.side = Some(side);
    let resolved = toml::to_string(&case)?;
    let estimates = estimates(&case, side, chosen);
    terminal::print(&format!("{}\n{resolved}\n{estimates}", heading(case.units)))?;
    cache::tell_warnings(&cache);
    Ok(Outcome::Done)
}

fn heading(units: Units) -> &'static str {
    match units {
        Units::Si => "# The case as resolved, in m, Pa, N and rad.",
        Units::Consistent => "# The case as resolved, in its own units.",
    }
}

/// What the grid makes of the case, as comments, so that the whole is a case file again.
fn estimates(case: &Case, side: f64, chosen: bool) -> String {
    let elements = case.grid.elements;
    let element_side = side / elements as f64;
    let metres = |value| quantity(value, Unit::Metre, case.units);
    let how = if chosen {
        "chosen from the load"
    } else {
        "as given"
    };
    let steps = case.load.steps().len();
    let per_element = BYTES_PER_ELEMENT + BYTES_PER_ELEMENT_AND_STEP * steps as f64;
    let bytes = per_element * (elements * elements) as f64;
    let per_feature = features(case).into_iter().map(|(name, length)| {
        let count = significant(length / element_side, 3);
        (format!("elements per {name}"), count)
    });
    let mut lines = vec![
        (
            "side of the domain".to_owned(),
            format!("{} ({how})", metres(side)),
        ),
        ("element side".to_owned(), metres(element_side)),
    ];
    lines.extend(per_feature);
    lines.push(("loading steps".to_owned(), steps.to_string()));
    lines.push((
        "memory, about".to_owned(),
        format!("{} MB", significant(bytes / 1e6, 2)),
    ));
    let line = |(name, value): &(String, String)| format!("# {name:<38}{value}\n");
    lines.iter().map(line).collect()
}

/// The lengths that a grid should resolve.
fn features(case: &Case) -> Vec<(String, f64)> {
    let layers = case.foundation.layer.iter().enumerate();
    let thickness = layers.map(|(i, layer)| (format!("thickness of layer {i}"), layer.thickness));
    let relief = match &case.surface {
        SurfaceCase::Cylinders(cylinders) => vec![
            ("radius of a cylinder".to_owned(), cylinders.radius),
            ("period of the cylinders".to_owned(), cylinders.period),
        ],
        SurfaceCase::Bare | SurfaceCase::Film { .. } | SurfaceCase::Map(_) => Vec::new(),
    };
    thickness.chain(relief).collect()
}
