//! How steep the surfaces in contact are: linear elasticity assumes small slopes.
//!
//! A smooth indenter is steepest where the contact ends. Its slope there is `|∇f|` at the points of the contact's edge,
//! placed within their elements as for the [area](super::contact_shape). A rough surface has the root of the mean
//! square of `|∇g0|` over the elements in contact, from differences between neighbours.

use pellicle_texture::Relief;

use super::{contact_field::ContactField, contact_shape, rough_contact::RoughContact};
use crate::Indenter;

/// Half the distance over which a slope is taken, in elements: for shapes given by formulas, and for maps, whose
/// samples may be steps.
const HALF_STEP: f64 = 0.05;
const HALF_STEP_ON_MAPS: f64 = 0.5;
/// Part of the edge on which a measured indenter is steeper than its slope: single points show noise.
const STEEPER_PART: f64 = 0.1;
/// Largest number of points of the edge at which a user's function, which may be slow, is evaluated: eight times each.
const POINTS_OF_A_FUNCTION: usize = 12;

/// The slope that a contact is judged by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContactSlope {
    /// The indenter's largest slope on the edge of the contact; of a measured one, the slope that a tenth of the edge
    /// exceeds. Infinite at a sphere's equator.
    AtEdge(f64),
    /// The root-mean-square slope of a rough surface, less that of the indenter, over the contact.
    RootMeanSquare(f64),
}

impl ContactSlope {
    /// The slope.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::AtEdge(slope) | Self::RootMeanSquare(slope) => slope,
        }
    }

    /// The slope of a solved contact; none without an edge.
    pub(crate) fn of(field: &ContactField<'_>, rough: Option<&RoughContact>) -> Option<Self> {
        let has_islands = rough.is_some_and(|rough| rough.islands.count > 1);
        if has_islands || matches!(field.model.relief, Relief::Map(_)) {
            root_mean_square(field).map(Self::RootMeanSquare)
        } else {
            at_edge(field).map(Self::AtEdge)
        }
    }
}

/// A point where the contact ends (m), the distance by which the edge lies inside it (m), and whether the indenter ends
/// there.
struct EdgePoint {
    at: [f64; 2],
    inside: f64,
    is_rim: bool,
}

fn at_edge(field: &ContactField<'_>) -> Option<f64> {
    let lines = (field.region).by_lines(field.pressure, |line, row| edge_points(field, line, row));
    let points: Vec<EdgePoint> = lines.into_iter().flatten().collect();
    let apart = match field.model.indenter {
        Indenter::Custom(_) => points.len().div_ceil(POINTS_OF_A_FUNCTION).max(1),
        _ => 1,
    };
    let mut slopes: Vec<f64> = points
        .iter()
        .step_by(apart)
        .map(|point| slope_at(field, point))
        .filter(|slope| !slope.is_nan())
        .collect();
    slopes.sort_by(f64::total_cmp);
    let last = slopes.len().checked_sub(1)?;
    let skipped = match field.model.indenter {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a count"
        )]
        Indenter::Map(_) => (STEEPER_PART * slopes.len() as f64) as usize,
        _ => 0,
    };
    slopes.get(last - skipped.min(last)).copied()
}

/// The points between the elements of a row in contact and their neighbours that are not.
fn edge_points(field: &ContactField<'_>, line: usize, row: &[f64]) -> Vec<EdgePoint> {
    let mut found = Vec::new();
    for (column, _) in row.iter().enumerate().filter(|(_, p)| **p > 0.0) {
        let [i, j] = [line, column].map(usize::cast_signed);
        for way in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let beyond = [i + way[0], j + way[1]];
            let Some(outside) = field.element(beyond) else {
                continue;
            };
            if field.pressure[outside] > 0.0 {
                continue;
            }
            let crossing = contact_shape::crossing_between(field, [i, j], beyond);
            let along = |axis: usize| {
                let (from, to) = ([i, j][axis] as f64, beyond[axis] as f64);
                from + crossing.from_first * (to - from)
            };
            found.push(EdgePoint {
                at: field.point([along(0), along(1)]),
                inside: crossing.offset * field.grid.element_side(),
                is_rim: field.initial_gap_of(outside).is_infinite(),
            });
        }
    }
    found
}

/// `|∇f|` at the edge beside a point; NaN where the indenter has no surface around it.
fn slope_at(field: &ContactField<'_>, point: &EdgePoint) -> f64 {
    let indenter = &field.model.indenter;
    if point.is_rim && matches!(indenter, Indenter::Sphere(_)) {
        return f64::INFINITY;
    }
    // The outline of a map is a wall, as that of a punch.
    if point.is_rim && matches!(indenter, Indenter::Map(_)) {
        return f64::NAN;
    }
    let near = match indenter {
        Indenter::Map(_) => HALF_STEP_ON_MAPS,
        _ => HALF_STEP,
    };
    let step = near * field.grid.element_side();
    let [x, y] = point.at;
    let [u, v] = gradient(indenter, point.at, step);
    let length = u.hypot(v);
    if length == 0.0 || point.inside == 0.0 {
        return length;
    }
    // The indenter rises outwards.
    let inwards = point.inside / length;
    let [u, v] = gradient(indenter, [x - inwards * u, y - inwards * v], step);
    u.hypot(v)
}

/// `∇f` by central differences, one-sided where the indenter ends.
fn gradient(indenter: &Indenter, [x, y]: [f64; 2], step: f64) -> [f64; 2] {
    let difference = |low: f64, high: f64| {
        let middle = || indenter.height(x, y);
        let difference = match (low.is_finite(), high.is_finite()) {
            (true, true) => (high - low) / (2.0 * step),
            (true, false) => (middle() - low) / step,
            (false, true) => (high - middle()) / step,
            (false, false) => f64::NAN,
        };
        // The point itself may lie beyond the end.
        if difference.is_infinite() {
            f64::NAN
        } else {
            difference
        }
    };
    [
        difference(indenter.height(x - step, y), indenter.height(x + step, y)),
        difference(indenter.height(x, y - step), indenter.height(x, y + step)),
    ]
}

/// `√⟨|∇g0|²⟩` over the elements in contact that have neighbours on either side.
fn root_mean_square(field: &ContactField<'_>) -> Option<f64> {
    let twice = 2.0 * field.grid.element_side();
    let of_line = |line: usize, row: &[f64]| {
        let (mut sum, mut count) = (0.0, 0_usize);
        for (column, _) in row.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            let [i, j] = [line, column].map(usize::cast_signed);
            let gap = |place| field.element(place).map(|e| field.initial_gap_of(e));
            let pair = |low, high| Some((gap(high)? - gap(low)?) / twice);
            let pairs = (pair([i - 1, j], [i + 1, j]), pair([i, j - 1], [i, j + 1]));
            let (Some(u), Some(v)) = pairs else {
                continue;
            };
            let square = u * u + v * v;
            if square.is_finite() {
                sum += square;
                count += 1;
            }
        }
        (sum, count)
    };
    let lines = field.region.by_lines(field.pressure, of_line);
    let (sum, count) =
        (lines.into_iter()).fold((0.0, 0), |all, line| (all.0 + line.0, all.1 + line.1));
    (count > 0).then(|| (sum / count as f64).sqrt())
}

#[cfg(test)]
mod tests;
