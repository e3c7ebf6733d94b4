//! The edge of a contact as points, one for each cell of element centres that it crosses.
//!
//! It is the zero line of the field by which the [contact's area](crate::result::contact_shape) is measured, moved
//! inwards.

use super::edge_contact::{EdgeContact, Place};
use crate::result::contact_shape::{OFFSET, OWN_PRESSURE};

/// Corners of a cell in order, from the one that identifies it.
const TURN: [Place; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// A point of the edge. Lengths are in elements, from the centre of the first loaded element.
#[derive(Clone, Copy, Debug)]
pub struct EdgePoint {
    pub at: [f64; 2],
    /// The direction out of the contact, a unit vector across the edge within the cell.
    pub outward: [f64; 2],
}

/// The cells that the edge crosses, by their first corners.
pub fn crossed_cells(contact: &EdgeContact) -> Vec<Place> {
    let size = contact.size();
    let cells = (-1..size).flat_map(|i| (-1..size).map(move |j| [i, j]));
    let is_crossed = |cell: &Place| {
        let inside = corners(*cell).map(|corner| contact.is_in_contact(corner));
        inside.contains(&true) && inside.contains(&false)
    };
    cells.filter(is_crossed).collect()
}

/// The elements without pressure among the corners of a cell.
pub fn beside(contact: &EdgeContact, cell: Place) -> impl Iterator<Item = Place> {
    corners(cell)
        .into_iter()
        .filter(|corner| !contact.is_in_contact(*corner))
}

fn corners([i, j]: Place) -> [Place; 4] {
    TURN.map(|[m, n]| [i + m, j + n])
}

/// The points of the edge in some cells that it crosses, but none where the contact ends with the indenter, a map or
/// the grid.
pub fn outline(contact: &EdgeContact, cells: &[Place]) -> Vec<EdgePoint> {
    let mut places: Vec<Place> = cells
        .iter()
        .flat_map(|cell| beside(contact, *cell))
        .collect();
    places.sort_unstable();
    places.dedup();
    let gaps = contact.gaps(&places);
    let level = |place: Place| -> f64 {
        match places.binary_search(&place) {
            Ok(index) => -gaps[index].max(0.0),
            Err(_) => level_inside(contact, place),
        }
    };
    let points = cells
        .iter()
        .flat_map(|cell| points_of(contact, *cell, &level));
    points.collect()
}

/// `s = (κ K₀₀ + η) p` of an element in contact, in m.
fn level_inside(contact: &EdgeContact, place: Place) -> f64 {
    (OWN_PRESSURE * contact.own_coefficient() + contact.secant(place)) * contact.pressure(place)
}

/// The points of the edge in one cell: one, or two where opposite corners are in contact.
fn points_of(contact: &EdgeContact, cell: Place, level: &impl Fn(Place) -> f64) -> Vec<EdgePoint> {
    let places = corners(cell);
    let levels = places.map(level);
    let inside = places.map(|place| contact.is_in_contact(place));
    let mut crossings: Vec<[f64; 2]> = Vec::new();
    for k in 0..4 {
        let next = (k + 1) % 4;
        if inside[k] != inside[next] {
            let part = levels[k] / (levels[k] - levels[next]);
            let along = |axis: usize| {
                let [from, to] = [k, next].map(|corner| TURN[corner][axis] as f64);
                from + part * (to - from)
            };
            crossings.push([along(0), along(1)]);
        }
    }
    if crossings.iter().flatten().any(|along| !along.is_finite())
        || levels.contains(&f64::NEG_INFINITY)
    {
        return Vec::new();
    }
    // The edge runs from where the circuit leaves the contact to where it enters it again.
    let first = usize::from(!inside[0]);
    let count = crossings.len();
    let pairs = (first..first + count).step_by(2);
    pairs
        .filter_map(|k| edge_point(cell, crossings[k % count], crossings[(k + 1) % count]))
        .collect()
}

/// The middle of a segment of the zero line, moved inwards; the contact lies to its left or right as the circuit of the
/// corners, from x to y, leaves it at `from` and enters it at `to`.
fn edge_point(cell: Place, from: [f64; 2], to: [f64; 2]) -> Option<EdgePoint> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    // Where the circuit is outside it runs on the right of the way back, so the outside lies to the right of the
    // segment.
    let outward = [along[1] / length, -along[0] / length];
    (length > 0.0).then(|| EdgePoint {
        at: [0, 1].map(|axis: usize| {
            cell[axis] as f64 + f64::midpoint(from[axis], to[axis]) - OFFSET * outward[axis]
        }),
        outward,
    })
}
