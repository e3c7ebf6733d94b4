//! The few numbers that describe a solved contact.

use std::cmp::Ordering;

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use crate::{
    result::averaged_pressure,
    result::contact_field::ContactField,
    result::contact_shape::ContactShape,
    result::not_stored,
    result::peak::{Peak, PeakPlace},
    result::point,
};

/// Largest and mean pressure, contact area and extent. An element is in contact where its pressure is positive; the
/// contact's edge is placed within an element from the pressure and the gap beside it, or from geometry where the
/// indenter ends or an outline of the relief bounds the contact. Values that only the error estimate and the warnings
/// need are not stored; read back, they are NaN, false, inside or none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Largest pressure, in Pa: inside smooth contact the vertex of the paraboloid through the largest element and its
    /// neighbours, at an edge the largest element's.
    #[serde(deserialize_with = "nan_from_null")]
    pub max_pressure: f64,
    /// Where the pressure is largest, `[x, y]` in m; the first of several equal places.
    #[serde(with = "point")]
    pub max_pressure_at: [f64; 2],
    /// The place of the largest pressure.
    #[serde(skip)]
    pub peak_place: PeakPlace,
    /// Largest pressure averaged over a disc of the [stated diameter](crate::SolverOptions::averaging_length), in Pa;
    /// none without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_averaged_pressure: Option<f64>,
    /// Force over contact area, in Pa; 0 without contact. It is never above the largest pressure: where the area
    /// follows from an outline and is smaller than that of the elements in contact, it is the largest pressure.
    #[serde(deserialize_with = "nan_from_null")]
    pub mean_pressure: f64,
    /// Force over the area of a periodic cell, or over the
    /// [nominal area](crate::RoughContact::nominal_area) of a measured surface that ends, in Pa; none for others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nominal_pressure: Option<f64>,
    /// True contact area, in m². On the finest grid it is at least force over largest pressure, the smallest area that
    /// can carry the force, unless the contact meets an outline.
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area: f64,
    /// Uncertainty of the area from the position of its edge within an element, in m².
    #[serde(skip, default = "not_stored::nan")]
    pub edge_uncertainty: f64,
    /// Whether the contact meets an outline of the relief or the indenter's rim, which elements follow as a staircase;
    /// or ends at a pressure that is cut at the hardness.
    #[serde(skip)]
    pub meets_outline: bool,
    /// Elements in contact.
    pub contact_elements: usize,
    /// Contact area on the tops of the relief, in m².
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area_on_relief: f64,
    /// Contact area between the tops, in m².
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area_between: f64,
    /// Distance from the axis to the farthest point of the contact's edge, in m; 0 without contact.
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_radius: f64,
    /// Area of the elements whose pressure is cut at the hardness, in m²; none without one, as for the next two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_at_limit: Option<f64>,
    /// This area over the contact area; 0 without contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fraction_at_limit: Option<f64>,
    /// Largest [plastic depth](crate::DeformedSurface::plastic_depth), in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plastic_depth: Option<f64>,
    /// Largest shortening `w*` of the relief, in m.
    #[serde(skip, default = "not_stored::nan")]
    pub largest_shortening: f64,
    /// Whole elements between the contact and the nearest edge of the domain; none without contact.
    #[serde(skip)]
    pub elements_to_edge: Option<usize>,
}

impl Summary {
    /// Summarises a solved contact under the force `force` (N), with the pressure averaged over discs of this diameter
    /// (m), if any.
    pub(crate) fn of(field: &ContactField<'_>, force: f64, averaging: Option<f64>) -> Self {
        let (region, grid) = (field.region, field.grid);
        let (size, lengths) = (grid.row(), grid.lengths());
        let law = field.model.relief.spring_law();
        let of_line = |line: usize, pressure: &[f64]| {
            let compliance = region.line(field.compliance, line);
            let mut found = Contact::default();
            let image = |column| region.first_image([line, column]);
            let mut columns = pressure.iter().enumerate().filter(|(_, p)| **p > 0.0);
            for (column, p) in columns.clone() {
                let [i, j] = image(column);
                found.add(i * size + j, *p);
                let element = line * region.size() + column;
                if field.is_at_limit(element) {
                    found.at_limit += 1;
                    found.depth = found.depth.max(-field.gap_of(element));
                }
                found.shortening = found.shortening.max(law.shortening(compliance[column], *p));
            }
            // In a row, no element is nearer to an edge than the outermost two.
            for (column, _) in [columns.next(), columns.next_back()].into_iter().flatten() {
                found.reach_to(image(column), lengths);
            }
            found
        };
        let lines = region.by_lines(field.pressure, of_line);
        let Contact {
            largest: (max_pressure, largest),
            elements,
            shortening: largest_shortening,
            at_limit,
            depth,
            to_edge: elements_to_edge,
        } = lines.into_iter().fold(Contact::default(), Contact::and);
        let with_hardness = |value: f64| field.hardness.is_finite().then_some(value);
        let nothing = Self {
            max_pressure,
            max_pressure_at: grid.point([0; 2]),
            peak_place: PeakPlace::Inside,
            max_averaged_pressure: averaging.map(|_| 0.0),
            mean_pressure: 0.0,
            nominal_pressure: (region.repeats()).then(|| force / grid.area()),
            contact_area: 0.0,
            edge_uncertainty: 0.0,
            meets_outline: false,
            contact_elements: 0,
            contact_area_on_relief: 0.0,
            contact_area_between: 0.0,
            contact_radius: 0.0,
            area_at_limit: with_hardness(0.0),
            fraction_at_limit: with_hardness(0.0),
            plastic_depth: with_hardness(depth),
            largest_shortening,
            elements_to_edge,
        };
        if elements == 0 {
            return nothing;
        }
        let shape = ContactShape::of(field);
        let largest = region.place_of_image([largest / size, largest % size]);
        let (peak, weight) = (Peak::of(field, largest), region.weight());
        let area_at_limit = at_limit as f64 * (weight as f64 * grid.element_area());
        Self {
            max_pressure: peak.pressure,
            max_pressure_at: region.first_image_of_point(peak.at),
            peak_place: peak.place,
            max_averaged_pressure: averaging
                .and_then(|over| averaged_pressure::largest(field, over)),
            mean_pressure: (force / shape.area).min(peak.pressure),
            contact_area: shape.area,
            edge_uncertainty: shape.uncertainty,
            meets_outline: shape.meets_outline,
            contact_elements: weight * elements,
            contact_area_on_relief: shape.area_on_relief,
            contact_area_between: (shape.area - shape.area_on_relief).max(0.0),
            contact_radius: shape.radius,
            area_at_limit: with_hardness(area_at_limit),
            fraction_at_limit: with_hardness(fraction(area_at_limit, shape.area)),
            ..nothing
        }
    }

    /// The same contact under the force `force` (N), its area at least the smallest that can carry it: `F ≤ p_max A`.
    /// Elements longer than the waves of a surface find less. Where the contact meets an outline the area is that of
    /// the geometry.
    pub(crate) fn with_least_area(self, force: f64) -> Self {
        let least = force / self.max_pressure;
        if self.meets_outline || !least.is_finite() || self.contact_area >= least {
            return self;
        }
        let on_relief = least * fraction(self.contact_area_on_relief, self.contact_area);
        Self {
            contact_area: least,
            edge_uncertainty: self.edge_uncertainty * least / self.contact_area,
            contact_area_on_relief: on_relief,
            contact_area_between: least - on_relief,
            mean_pressure: self.max_pressure,
            fraction_at_limit: (self.area_at_limit).map(|area| fraction(area, least)),
            ..self
        }
    }
}

/// The part of an area that another one is, at most 1; 0 of no area.
fn fraction(part: f64, of: f64) -> f64 {
    let fraction = part / of;
    if fraction.is_finite() {
        fraction.min(1.0)
    } else {
        0.0
    }
}

/// Counts and extremes over some elements.
#[derive(Clone, Copy, Default)]
struct Contact {
    /// The largest pressure and the first element that has it.
    largest: (f64, usize),
    elements: usize,
    shortening: f64,
    /// Elements whose pressure is cut.
    at_limit: usize,
    depth: f64,
    to_edge: Option<usize>,
}

impl Contact {
    fn add(&mut self, element: usize, pressure: f64) {
        self.largest = larger(self.largest, (pressure, element));
        self.elements += 1;
    }

    /// Updates the distance to the edge of the domain with an element's row and column, of so many.
    fn reach_to(&mut self, [row, column]: [usize; 2], [rows, columns]: [usize; 2]) {
        let to_edge = row
            .min(column)
            .min(rows - 1 - row)
            .min(columns - 1 - column);
        self.to_edge = nearer(self.to_edge, Some(to_edge));
    }

    /// Combines two parts.
    fn and(self, other: Self) -> Self {
        Self {
            largest: larger(self.largest, other.largest),
            elements: self.elements + other.elements,
            shortening: self.shortening.max(other.shortening),
            at_limit: self.at_limit + other.at_limit,
            depth: self.depth.max(other.depth),
            to_edge: nearer(self.to_edge, other.to_edge),
        }
    }
}

/// The larger of two pressures, or the first of equal ones, with their elements.
fn larger(one: (f64, usize), other: (f64, usize)) -> (f64, usize) {
    match one.0.total_cmp(&other.0).then(other.1.cmp(&one.1)) {
        Ordering::Less => other,
        _ => one,
    }
}

/// The smaller of two optional numbers.
fn nearer(one: Option<usize>, other: Option<usize>) -> Option<usize> {
    one.into_iter().chain(other).min()
}

#[cfg(test)]
mod tests {
    use super::Contact;

    #[test]
    fn parts_of_a_contact_combine_in_any_order() {
        let part = |elements: &[(usize, f64)], to_edge: Option<[usize; 2]>| {
            let mut part = Contact::default();
            for (element, pressure) in elements {
                part.add(*element, *pressure);
            }
            if let Some(place) = to_edge {
                part.reach_to(place, [10, 10]);
            }
            part
        };
        let one = part(&[(5, 2.0), (3, 4.0), (8, 4.0)], Some([2, 6]));
        let other = part(&[(4, 4.0), (1, 3.0)], Some([8, 5]));
        for both in [one.and(other), other.and(one)] {
            // Of equal pressures, that of the first element.
            assert_eq!((both.largest, both.elements), ((4.0, 3), 5));
            assert_eq!(both.to_edge, Some(1));
        }
        assert_eq!(one.to_edge, Some(2));
        assert_eq!(part(&[], None).and(one).to_edge, Some(2));
        assert_eq!(part(&[], Some([9, 4])).to_edge, Some(0));
        for beside_an_edge in [[1, 4], [4, 1], [8, 4], [4, 8]] {
            assert_eq!(part(&[], Some(beside_an_edge)).to_edge, Some(1));
        }
    }
}
