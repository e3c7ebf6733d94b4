//! Warnings about a model on a grid that apply to every load: a texture, a map or a layer that the elements do not
//! resolve.

use pellicle_influence::{ElasticBody, RadialTables};
use pellicle_texture::{Grid, Relief};

use super::LARGEST_SLOPE;
use crate::{
    Boundary, Model, Warning,
    result::{
        map_resolution::{FEWEST_ELEMENTS_PER_WAVE, MapResolution},
        peak::UnresolvedArc,
    },
};

/// With fewer elements than this per cylinder radius its outline is not resolved.
const FEWEST_ELEMENTS_PER_RADIUS: f64 = 4.0;
/// A layer thinner than this fraction of an element changes coefficients by about that fraction at most.
const FEWEST_ELEMENTS_PER_THICKNESS: f64 = 0.02;
/// A nearly incompressible layer on a far stiffer body gives way by flowing aside, which elements longer than twice its
/// thickness follow so coarsely that one in four errors exceeds its estimate.
const FEWEST_ELEMENTS_PER_CONFINED: f64 = 0.5;
/// From this Poisson's ratio on, a layer is nearly incompressible, and from this ratio of moduli on, its base is far
/// stiffer.
const NEARLY_INCOMPRESSIBLE: f64 = 0.45;
const FAR_STIFFER: f64 = 10.0;
/// Relative accuracy of the estimated accuracy of the coefficients, which is printed with two digits: an estimate of
/// 1.04e-12 is as good as the 1e-12 wanted.
const ESTIMATED_TO: f64 = 0.05;
/// Layers whose moduli have a smaller ratio count as alike.
const MOST_ALIKE: f64 = 2.0;
/// Warnings about a model on a grid that apply to every load: a texture or layer that the elements do not resolve, or
/// influence coefficients less accurate than required.
#[must_use]
pub fn model_warnings(model: &Model, grid: &Grid) -> Vec<Warning> {
    let mut warnings = Vec::new();
    if let Some(radius) = model.relief.feature_radius() {
        let elements_per_radius = radius / grid.element_side();
        if elements_per_radius < FEWEST_ELEMENTS_PER_RADIUS {
            warnings.push(Warning::TextureUnderResolved {
                elements_per_radius,
            });
        }
    }
    if let Relief::Recesses(recesses) = &model.relief {
        let slope = recesses.depth() / recesses.half_width();
        if recesses.young_modulus().is_none() && slope > LARGEST_SLOPE {
            warnings.push(Warning::DeepRecesses { slope });
        }
    }
    let bodies = ElasticBody::ALL.into_iter();
    warnings.extend(bodies.flat_map(|of| unresolved_layers(model, grid, of)));
    let (found, wanted) = (model.tables.error_estimate(), RadialTables::GOAL);
    if found > wanted * (1.0 + ESTIMATED_TO) {
        warnings.push(Warning::CoefficientAccuracy { found, wanted });
    }
    warnings
}

/// The layers of a body that elements do not resolve.
fn unresolved_layers(model: &Model, grid: &Grid, of: ElasticBody) -> Vec<Warning> {
    let body = model.tables.bodies().of(of);
    let layers = body.layers();
    let moduli = layers.iter().map(|layer| layer.material().young_modulus());
    let moduli: Vec<_> = moduli.collect();
    let base = body.base_material();
    let base = base.map_or(f64::INFINITY, |base| base.young_modulus());
    let fewest = |layer: usize| {
        let below = moduli.get(layer + 1).copied().unwrap_or(base);
        let is_confined = layers[layer].material().poisson_ratio() >= NEARLY_INCOMPRESSIBLE
            && below >= FAR_STIFFER * moduli[layer];
        if is_confined {
            FEWEST_ELEMENTS_PER_CONFINED
        } else {
            FEWEST_ELEMENTS_PER_THICKNESS
        }
    };
    let warning = |layer: usize| {
        let beside = [layer.checked_sub(1), Some(layer + 1)];
        let mut beside = beside.into_iter().flatten().filter_map(|i| moduli.get(i));
        let alike = 1.0 / MOST_ALIKE..MOST_ALIKE;
        // Part of a graded layer, which is resolved if the whole of it is.
        if beside.any(|modulus| alike.contains(&(modulus / moduli[layer]))) {
            return None;
        }
        let elements_per_thickness = layers[layer].thickness() / grid.element_side();
        (elements_per_thickness < fewest(layer)).then_some(Warning::LayerUnderResolved {
            of,
            layer,
            elements_per_thickness,
        })
    };
    (0..layers.len()).filter_map(warning).collect()
}

/// The warning that the arcs at the edges of a relief are not resolved; of a solution the peak's warning tells it, if
/// the peak is there.
#[must_use]
pub fn arc_under_resolved(model: &Model, grid: &Grid) -> Option<Warning> {
    UnresolvedArc::of(&model.relief, grid).map(Warning::ArcUnderResolved)
}

/// The warning that the elements are too long for the waves of a measured map around a contact of this radius (m);
/// none without a map, without contact, or with enough elements.
#[must_use]
pub fn map_under_resolved(
    model: &Model,
    grid: &Grid,
    boundary: Boundary,
    contact_radius: f64,
) -> Option<Warning> {
    let mut resolution = MapResolution::new(model, grid, boundary);
    too_few_per_wave(grid, 0, resolution.elements_per_wave(contact_radius)?)
}

/// Warns of too few elements to the shortest wave of a map.
pub(super) fn too_few_per_wave(
    grid: &Grid,
    step: usize,
    elements_per_wave: f64,
) -> Option<Warning> {
    if elements_per_wave >= FEWEST_ELEMENTS_PER_WAVE {
        return None;
    }
    let wanted = FEWEST_ELEMENTS_PER_WAVE / elements_per_wave * grid.size() as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of elements, the largest if there are too many"
    )]
    let wanted = wanted.ceil() as usize;
    Some(Warning::MapUnderResolved {
        step,
        elements_per_wave,
        wanted,
    })
}
