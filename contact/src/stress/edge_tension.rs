//! The largest tension at the edge of a contact, where a sliding indenter cracks a surface.
//!
//! The tension has a cusp at the edge: sampled under element centres it is 7 to 14 % too small at the usual grids, and
//! converges like √h. Here it is [continued](patch) to the [edge's place](outline) within the elements from both sides
//! of the edge, as far as it is smooth there: within 1 % where some twenty elements make a radius
//! (`docs/grid-error.md`).

mod edge_contact;
mod least_squares;
mod outline;
mod patch;
mod surface_parts;

use pellicle_influence::InfluenceError;

pub use edge_contact::EdgeContact;
use edge_contact::Place;
use outline::{EdgePoint, beside, crossed_cells, outline};
use patch::{Continued, Patch};
use surface_parts::{Part, SurfaceParts};

use super::MOST_MOVES;
use super::field::StressField;
use crate::PeakPlace;
use crate::result::peak::place_near;

/// A cell of the edge is examined if an element beside the contact there has at least this part of the largest tension:
/// sampled there, the tension at equal edges varies by a quarter with their places within the elements.
const NEARLY: f64 = 0.65;
/// About how many cells are examined first at most.
const MOST_POINTS: usize = 10;
/// Cells at least this far apart, in elements, are examined first, and those within this distance of the largest at
/// last; a point on a coarser grid is the same within it.
const SAME: f64 = 2.5;
/// With springs of more than this part of `K₀₀` the pressure does not rise like a root.
const SOFT: f64 = 1e-3;
/// Elements in a top layer that is resolved at the edge, and the ratio of moduli that begins another layer.
const FEWEST_ELEMENTS: f64 = 3.0;
const ALIKE: f64 = 2.0;

/// The largest tension at the edge.
#[derive(Clone, Copy, Debug)]
pub struct EdgeTension {
    /// In Pa.
    pub value: f64,
    /// Place (x, y), in m.
    pub at: [f64; 2],
    /// Uncertainty of the continuation on one grid, in Pa.
    pub uncertainty: f64,
    /// Whether the edge there is smooth and wide, and the top layer thick, on the scale of the elements.
    pub is_resolved: bool,
}

/// The largest tension at the edge of a contact; none without an edge whose elements determine one.
///
/// # Errors
/// Amplitudes that the kernel cannot compute.
pub fn edge_tension(contact: &EdgeContact) -> Result<Option<EdgeTension>, InfluenceError> {
    let mut search = EdgeSearch::new(contact)?;
    let cells = search.candidates()?;
    let mut reach = SAME.max(cells.len() as f64 / MOST_POINTS as f64);
    let mut examined = spread(&cells, &[], reach);
    let mut known = search.examine(&examined);
    while let Some((best, _)) = largest(&known) {
        if reach <= SAME {
            return Ok(search.climb(&cells, best.at));
        }
        let near = cells_near(&cells, best.at, reach);
        reach /= 3.0;
        let more = spread(&near, &examined, reach);
        known.extend(search.examine(&more));
        examined.extend(more);
    }
    Ok(None)
}

/// The largest tension reached along the edge from a point (m), as [`edge_tension`] reaches it at last.
///
/// # Errors
/// As [`edge_tension`].
pub fn edge_tension_from(
    contact: &EdgeContact,
    at: [f64; 2],
) -> Result<Option<EdgeTension>, InfluenceError> {
    let cells = crossed_cells(contact);
    Ok(EdgeSearch::new(contact)?.climb(&cells, contact.place(at)))
}

/// The largest tension near a point (m) of the edge on a coarser grid.
///
/// # Errors
/// As [`edge_tension`].
pub fn edge_tension_near(
    contact: &EdgeContact,
    at: [f64; 2],
) -> Result<Option<EdgeTension>, InfluenceError> {
    let mut search = EdgeSearch::new(contact)?;
    let near = cells_near(&crossed_cells(contact), contact.place(at), SAME);
    let known = search.examine(&near);
    Ok(largest(&known).map(|(point, found)| search.judged(point, found)))
}

/// The search along the edge under one field.
struct EdgeSearch<'a> {
    contact: &'a EdgeContact<'a>,
    field: &'a StressField,
    parts: SurfaceParts<'a>,
}

impl<'a> EdgeSearch<'a> {
    fn new(contact: &'a EdgeContact<'a>) -> Result<Self, InfluenceError> {
        Ok(Self {
            contact,
            field: contact.field,
            parts: SurfaceParts::new(contact.field)?,
        })
    }

    /// The cells of the edge beside which the tension nearly is the largest, by falling tension there.
    fn candidates(&mut self) -> Result<Vec<Place>, InfluenceError> {
        let mirrors = self.mirrors();
        let half = (self.contact.size() - 1) as f64 / 2.0;
        let mut cells = crossed_cells(self.contact);
        cells.retain(|cell| {
            let mut axes = mirrors.iter().zip(middle(*cell));
            axes.all(|(is_mirrored, along)| !is_mirrored || along >= half - 0.5)
        });
        let mut places: Vec<Place> = cells
            .iter()
            .flat_map(|cell| beside(self.contact, *cell))
            .collect();
        places.sort_unstable();
        places.dedup();
        let tensions = self.parts.tensions(&places)?;
        let of_place = |place: Place| {
            places
                .binary_search(&place)
                .map_or(f64::NEG_INFINITY, |index| tensions[index])
        };
        let of_cell = |cell: &Place| {
            beside(self.contact, *cell)
                .map(of_place)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let mut valued: Vec<(f64, Place)> =
            cells.iter().map(|cell| (of_cell(cell), *cell)).collect();
        valued.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        let largest = valued.first().map_or(0.0, |(value, _)| *value);
        valued.retain(|(value, _)| *value >= largest - (1.0 - NEARLY) * largest.abs());
        Ok(valued.into_iter().map(|(_, cell)| cell).collect())
    }

    /// Whether stresses are symmetric about the middle of the loaded square in x, and in y.
    fn mirrors(&self) -> [bool; 2] {
        let (size, tractions) = (self.contact.size(), self.field.tractions());
        let is_mirrored = |axis: usize| {
            let mut places = (0..size).flat_map(|i| (0..size).map(move |j| [i, j]));
            tractions[axis] == 0.0
                && places.all(|place| {
                    let mut image = place;
                    image[axis] = size - 1 - place[axis];
                    self.contact.pressure(place).to_bits() == self.contact.pressure(image).to_bits()
                })
        };
        [0, 1].map(is_mirrored)
    }

    /// Continues the tension to the points of the edge in some cells.
    fn examine(&mut self, cells: &[Place]) -> Vec<(EdgePoint, Continued)> {
        let points = outline(self.contact, cells);
        let patches: Vec<Patch> = points
            .iter()
            .filter_map(|point| Patch::new(self.contact, *point))
            .collect();
        for part in [Part::Normal, Part::Tangential] {
            let mut places: Vec<_> = patches
                .iter()
                .flat_map(|patch| patch.places(part))
                .collect();
            places.sort_unstable();
            places.dedup();
            self.parts.compute(part, &places);
        }
        let poisson_ratio = self
            .field
            .tables()
            .foundation()
            .surface_material()
            .poisson_ratio();
        let continued = patches.iter().filter_map(|patch| {
            Some((
                patch.point(),
                patch.continued(&self.parts, poisson_ratio, self.field.slides())?,
            ))
        });
        continued.collect()
    }

    /// The largest tension reached from a place by steps to the largest one near it.
    fn climb(&mut self, cells: &[Place], mut at: [f64; 2]) -> Option<EdgeTension> {
        let mut best: Option<(EdgePoint, Continued)> = None;
        for _ in 0..MOST_MOVES {
            let near = self.examine(&cells_near(cells, at, SAME));
            let found = largest(&near)
                .filter(|(_, found)| best.is_none_or(|(_, best)| found.value > best.value));
            let Some((point, _)) = found else {
                break;
            };
            (best, at) = (found, point.at);
        }
        best.map(|(point, found)| self.judged(point, found))
    }

    /// The result at a point.
    fn judged(&self, point: EdgePoint, found: Continued) -> EdgeTension {
        let EdgeContact {
            relief, indenter, ..
        } = self.contact;
        let (at, side) = (
            self.contact.point(point.at),
            self.contact.grid().element_side(),
        );
        let nearest = point.at.map(super::nearest);
        let is_stiff = self.contact.secant(nearest) <= SOFT * self.contact.own_coefficient();
        EdgeTension {
            value: found.value,
            at,
            uncertainty: found.uncertainty,
            is_resolved: found.is_regular
                && is_stiff
                && place_near(relief, indenter, side, at) == PeakPlace::Inside
                && top_thickness(self.field) >= FEWEST_ELEMENTS * side,
        }
    }
}

/// Thickness of the layers, from the surface down, whose moduli are alike, in m; infinite without layers.
fn top_thickness(field: &StressField) -> f64 {
    let foundation = field.tables().foundation();
    let surface = foundation.surface_material().young_modulus();
    let layers = foundation.layers();
    if layers.is_empty() {
        return f64::INFINITY;
    }
    let is_alike = |modulus: f64| (1.0 / ALIKE..ALIKE).contains(&(modulus / surface));
    let alike = layers
        .iter()
        .take_while(|layer| is_alike(layer.material().young_modulus()));
    alike.fold(0.0, |sum, layer| sum + layer.thickness())
}

/// The cells within a distance of a place, in elements.
fn cells_near(cells: &[Place], at: [f64; 2], reach: f64) -> Vec<Place> {
    let is_near = |cell: &&Place| distance(middle(**cell), at) <= reach;
    cells.iter().filter(is_near).copied().collect()
}

/// Selects cells, in their order, that keep a distance from one another and from others.
fn spread(cells: &[Place], others: &[Place], spacing: f64) -> Vec<Place> {
    let mut selected: Vec<Place> = Vec::new();
    for cell in cells {
        let mut all = selected.iter().chain(others);
        if all.all(|other| distance(middle(*other), middle(*cell)) >= spacing) {
            selected.push(*cell);
        }
    }
    selected
}

/// The middle of a cell, in elements.
fn middle(cell: Place) -> [f64; 2] {
    cell.map(|along| along as f64 + 0.5)
}

fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    (one[0] - other[0]).hypot(one[1] - other[1])
}

fn largest(known: &[(EdgePoint, Continued)]) -> Option<(EdgePoint, Continued)> {
    let mut largest: Option<(EdgePoint, Continued)> = None;
    for (point, found) in known {
        if largest.is_none_or(|(_, best)| found.value > best.value) {
            largest = Some((*point, *found));
        }
    }
    largest
}
