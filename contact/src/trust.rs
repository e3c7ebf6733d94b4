//! Doubts about a result: what the grid and the model cannot be trusted with.

use pellicle_influence::RadialTables;
use pellicle_texture::{Grid, Relief};

use crate::{Model, Step, Warning, domain::slope};

/// Fewer elements than this per cylinder radius leave its outline to chance.
const FEWEST_ELEMENTS_PER_RADIUS: f64 = 4.0;
/// A layer thinner than this part of an element changes no coefficient by more than about as much.
const FEWEST_ELEMENTS_PER_THICKNESS: f64 = 0.02;
/// A spring cannot shorten by more than its height.
const LARGEST_SHORTENING: f64 = 1.0;
/// Slopes up to this are small: the error of linear theory is about the square.
const LARGEST_SLOPE: f64 = 0.3;

/// A contact is near the edge with fewer whole elements than this between.
pub(crate) const EDGE_MARGIN: usize = 3;

/// Doubts about a model on a grid that hold for every load: a texture or a layer that the elements do not resolve, influence coefficients that are
/// less accurate than wanted.
#[must_use]
pub fn model_warnings(model: &Model, grid: &Grid) -> Vec<Warning> {
    let mut warnings = Vec::new();
    if let Relief::Cylinders(cylinders) = &model.relief {
        let elements_per_radius = cylinders.radius() / grid.element_side();
        if elements_per_radius < FEWEST_ELEMENTS_PER_RADIUS {
            warnings.push(Warning::TextureUnderResolved {
                elements_per_radius,
            });
        }
    }
    for (layer, found) in model.tables.foundation().layers().iter().enumerate() {
        let elements_per_thickness = found.thickness() / grid.element_side();
        if elements_per_thickness < FEWEST_ELEMENTS_PER_THICKNESS {
            warnings.push(Warning::LayerUnderResolved {
                layer,
                elements_per_thickness,
            });
        }
    }
    let (found, wanted) = (model.tables.error_estimate(), RadialTables::GOAL);
    if found > wanted {
        warnings.push(Warning::CoefficientAccuracy { found, wanted });
    }
    warnings
}

/// Doubts about one loading step.
pub(crate) fn step_warnings(model: &Model, index: usize, step: &Step) -> Vec<Warning> {
    let certificate = &step.solution.certificate;
    let not_converged = (!certificate.is_satisfied()).then(|| Warning::NotConverged {
        step: index,
        worst: certificate.worst(),
        tolerance: certificate.tolerance,
    });
    [
        not_converged,
        shortening(model, index, step),
        peak(index, step),
        steepness(model, index, step),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn shortening(model: &Model, index: usize, step: &Step) -> Option<Warning> {
    let times = step.summary.largest_shortening / model.relief.height()?;
    (times > LARGEST_SHORTENING).then_some(Warning::FilmShortening { step: index, times })
}

fn peak(index: usize, step: &Step) -> Option<Warning> {
    let estimate = step
        .grid_error
        .max_pressure
        .filter(|estimate| !estimate.resolved)?;
    Some(Warning::PeakNotResolved {
        step: index,
        change: estimate.estimate / step.summary.max_pressure,
    })
}

fn steepness(model: &Model, index: usize, step: &Step) -> Option<Warning> {
    let radius = step.summary.contact_radius;
    let slope = slope(&model.indenter, radius);
    (radius > 0.0 && slope.is_finite() && slope > LARGEST_SLOPE)
        .then_some(Warning::SteepIndenter { step: index, slope })
}
