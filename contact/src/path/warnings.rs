//! Warnings about a result: limits of the grid and of the model.

pub mod grid;

use pellicle_texture::Grid;

use self::grid::{model_warnings, too_few_per_wave};
use crate::{
    Boundary, ContactError, ContactSlope, Domain, Indenter, Load, Model, ModelLimit, Profile as _,
    Step, Warning, default_side,
    result::{cut_off, peak::UnresolvedArc},
};

/// A spring cannot shorten by more than its height: above this, [`Warning::FilmShortening`].
pub const LARGEST_SHORTENING: f64 = 1.0;
/// Largest slope that counts as small: the error of linear theory is about its square. Above this,
/// [`Warning::SteepIndenter`], or [`Warning::SteepTip`].
pub const LARGEST_SLOPE: f64 = 0.3;
/// Largest shortening of a layer, over its thickness, that counts as a small strain: above this,
/// [`Warning::LayerShortening`].
const LARGEST_STRAIN: f64 = 0.1;

/// A layer worn by more than this part of its thickness is no longer the whole one that is solved:
/// [`Warning::LayerWorn`].
const LARGEST_WORN: f64 = 0.1;

/// A contact with fewer elements across is not resolved; the domain is the cause if the contact covers less than a
/// quarter of its side.
pub const FEWEST_ELEMENTS: usize = 8;
const SMALL_PART: f64 = 0.25;
/// A contact narrower than this fraction of the side needs a smaller domain, however many elements it has.
const SMALLEST_PART: f64 = 0.02;
/// Suitable ratio of the side of the domain to the contact radius.
const SIDE_PER_RADIUS: f64 = 3.0;

/// A contact with fewer whole elements than this to the edge is near it.
pub(crate) const EDGE_MARGIN: usize = 3;

/// All warnings about a path.
pub(crate) fn warnings(
    model: &Model,
    grid: &Grid,
    domain: Domain,
    loads: &[Load],
    steps: &[Step],
) -> Vec<Warning> {
    let is_free = domain.boundary() == Boundary::Free;
    let much_larger = is_free
        .then(|| much_larger(model, grid, loads, steps))
        .flatten();
    // The edge of a contact that the grid hardly resolves is the estimated one.
    let is_meaningful = |warning: &Warning| match (&much_larger, warning) {
        (Some(Warning::DomainMuchLarger { radius, .. }), Warning::SteepIndenter { .. }) => {
            model.indenter.mean_slope(*radius) > LARGEST_SLOPE
        }
        _ => true,
    };
    let edges = steps.iter().enumerate();
    let edges = edges.filter_map(|(index, step)| edge(domain, index, step));
    let of_steps = steps.iter().enumerate();
    let of_steps = of_steps.flat_map(|(index, step)| {
        let per_wave = step.grid_error.elements_per_wave;
        let coarse = per_wave.and_then(|elements| too_few_per_wave(grid, index, elements));
        coarse
            .into_iter()
            .chain(step_warnings(model, grid, index, step))
    });
    let mut found: Vec<_> = (edges.chain(much_larger))
        .chain(model_warnings(model, grid))
        .chain(no_grid_error(grid, steps))
        .chain(nothing_touches(loads, steps))
        .chain(of_steps.filter(is_meaningful))
        .collect();
    tell_once(model, &mut found);
    found
}

/// Replaces the warnings about the slope of a self-similar indenter, the same at every load, by a single one.
fn tell_once(model: &Model, warnings: &mut Vec<Warning>) {
    let Some(slope) = model.indenter.self_similar_slope() else {
        return;
    };
    let is_steep = |warning: &Warning| {
        let Warning::SteepIndenter { slope, .. } = warning else {
            return false;
        };
        matches!(slope, ContactSlope::AtEdge(_))
    };
    if let Some(first) = warnings.iter().position(is_steep) {
        warnings[first] = Warning::SteepTip { slope };
        warnings.retain(|warning| !is_steep(warning));
    }
}

/// Warns of a contact that is cut off or near the edge. A chosen domain already has the margin checked on the coarse
/// grid of the choice.
fn edge(domain: Domain, step: usize, found: &Step) -> Option<Warning> {
    if domain.boundary() == Boundary::Periodic {
        return None;
    }
    if let Some(by) = found.cut_off {
        return Some(Warning::CutOff { step, by });
    }
    let margin = match domain {
        Domain::Side(_) => EDGE_MARGIN,
        Domain::Chosen(_) | Domain::Automatic | Domain::Periodic(_) | Domain::Oblong(_) => 1,
    };
    let elements = found.summary.elements_to_edge?;
    (elements < margin).then_some(Warning::DomainEdge { step, elements })
}

/// Warns if the widest contact is a small part of the domain.
fn much_larger(model: &Model, grid: &Grid, loads: &[Load], steps: &[Step]) -> Option<Warning> {
    let radii = steps.iter().map(|step| step.summary.contact_radius);
    let radius = radii.fold(0.0, f64::max);
    domain_much_larger(model, grid, loads, radius)
}

/// The warning that a domain is far larger than its widest contact, with this radius (m) between centres of elements;
/// none without contact.
#[must_use]
pub fn domain_much_larger(
    model: &Model,
    grid: &Grid,
    loads: &[Load],
    radius: f64,
) -> Option<Warning> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a radius within the grid, in elements"
    )]
    let elements = ((2.0 * radius / grid.element_side()).round() as usize).saturating_add(1);
    let part = elements as f64 / grid.size() as f64;
    // Under a plane the domain is the whole map, however few of its summits touch.
    if matches!(model.indenter, Indenter::Plane(_)) {
        return None;
    }
    let is_small = part < SMALLEST_PART || (elements < FEWEST_ELEMENTS && part < SMALL_PART);
    (radius > 0.0 && is_small).then(|| {
        let wanted = default_side(model, loads);
        let radius = if elements < FEWEST_ELEMENTS {
            wanted / SIDE_PER_RADIUS
        } else {
            radius
        };
        Warning::DomainMuchLarger {
            elements,
            radius,
            side: grid.side(),
            wanted: wanted.max(SIDE_PER_RADIUS * radius),
        }
    })
}

/// Returns an error if the elements are so large that none has its centre under the indenter.
pub(crate) fn check_elements(
    model: &Model,
    grid: &Grid,
    loads: &[Load],
) -> Result<(), ContactError> {
    if cut_off::can_touch(model, grid) {
        return Ok(());
    }
    let wanted = default_side(model, loads);
    Err(ContactError::ElementsTooLarge {
        side: grid.side(),
        element_side: grid.element_side(),
        radius: wanted / SIDE_PER_RADIUS,
        wanted,
    })
}

/// Warnings about one loading step.
fn step_warnings(model: &Model, grid: &Grid, index: usize, step: &Step) -> Vec<Warning> {
    let certificate = &step.solution.certificate;
    let not_converged = (!certificate.is_satisfied()).then(|| Warning::NotConverged {
        step: index,
        worst: certificate.worst(),
        tolerance: certificate.tolerance,
    });
    [
        not_converged,
        shortening(model, index, step),
        unwearing(index, step),
        peak(model, grid, index, step),
        unresolved(index, step),
        steepness(index, step),
        limits(index, step),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Largest shortening of a step's springs over their height; none without springs that have a height. Above
/// [`LARGEST_SHORTENING`] linear springs are compressed by more than their height.
#[must_use]
pub fn relative_shortening(model: &Model, step: &Step) -> Option<f64> {
    Some(step.summary.largest_shortening / model.relief.height()?)
}

fn shortening(model: &Model, index: usize, step: &Step) -> Option<Warning> {
    let times = relative_shortening(model, step)?;
    (times > LARGEST_SHORTENING).then_some(Warning::FilmShortening { step: index, times })
}

fn unwearing(index: usize, step: &Step) -> Option<Warning> {
    let area = step.wear.as_ref()?.unwearing;
    (area > 0.0).then_some(Warning::WornThrough { step: index, area })
}

/// Warns of an unresolved peak; never on a single grid or where the peak is the hardness.
fn peak(model: &Model, grid: &Grid, index: usize, step: &Step) -> Option<Warning> {
    if step.summary.area_at_limit.is_some_and(|area| area > 0.0) {
        return None;
    }
    let error = &step.grid_error;
    let [.., before, last] = error.levels.as_slice() else {
        return None;
    };
    let is_resolved = error.max_pressure?.resolved || last.max_pressure == 0.0;
    // Where elements miss waves of a map, that is the cause, and there is a warning about it.
    (!is_resolved && error.resolves_waves()).then(|| Warning::PeakNotResolved {
        step: index,
        change: (1.0 - before.max_pressure / last.max_pressure).abs(),
        place: step.summary.peak_place,
        arc: UnresolvedArc::of(&model.relief, grid),
    })
}

/// Warns of a penetration at which nothing is in contact.
fn nothing_touches(loads: &[Load], steps: &[Step]) -> Option<Warning> {
    let is_apart = |(_, (load, step)): &(usize, (&Load, &Step))| {
        matches!(load, Load::Penetration(penetration) if *penetration > 0.0)
            && step.summary.contact_elements == 0
    };
    let mut apart = loads.iter().zip(steps).enumerate().filter(is_apart);
    let (step, (load, _)) = apart.next()?;
    let Load::Penetration(penetration) = *load else {
        return None;
    };
    Some(Warning::NothingTouches { step, penetration })
}

/// Warns of a path on a single grid.
fn no_grid_error(grid: &Grid, steps: &[Step]) -> Option<Warning> {
    let is_single = |step: &Step| step.grid_error.levels.len() == 1;
    let [x, y] = grid.lengths();
    let elements = x.max(y);
    (steps.iter().any(is_single)).then_some(Warning::NoGridError { elements })
}

/// Warns of numbers that are not resolved, the largest pressure apart.
fn unresolved(index: usize, step: &Step) -> Option<Warning> {
    let error = &step.grid_error;
    // Where elements miss waves of a map, that is the cause, and there is a warning about it.
    let numbers = error.unresolved().filter(|_| error.resolves_waves())?;
    Some(Warning::NotResolved {
        step: index,
        numbers,
    })
}

fn steepness(index: usize, step: &Step) -> Option<Warning> {
    let slope = step.slope?;
    (slope.value() > LARGEST_SLOPE).then_some(Warning::SteepIndenter { step: index, slope })
}

/// Warns of a number beyond its limit, or else of a layer that is shortened by much.
fn limits(index: usize, step: &Step) -> Option<Warning> {
    if let Some(beyond) = step.beyond() {
        return Some(Warning::BeyondModel {
            step: index,
            beyond,
        });
    }
    step.limits.iter().find_map(|found| match found.limit {
        ModelLimit::LayerThickness { of, layer } if found.ratio > LARGEST_STRAIN => {
            Some(Warning::LayerShortening {
                step: index,
                of,
                layer,
                part: found.ratio,
            })
        }
        ModelLimit::WornLayer { of } if found.ratio > LARGEST_WORN => Some(Warning::LayerWorn {
            step: index,
            of,
            part: found.ratio,
        }),
        _ => None,
    })
}

#[cfg(test)]
mod tests;
