//! The few numbers that describe a solved contact.

use pellicle_texture::{Grid, SampledRelief};
use rayon::prelude::*;

use crate::{Solution, window::Window};

/// Largest and mean pressure, contact area and extent. An element is in contact where its pressure is positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Largest pressure, in Pa.
    pub max_pressure: f64,
    /// Centre `[x, y]` of the element with the largest pressure (the first of several), in m.
    pub max_pressure_at: [f64; 2],
    /// Force over contact area, in Pa; 0 without contact.
    pub mean_pressure: f64,
    /// True contact area, in m².
    pub contact_area: f64,
    /// Elements in contact.
    pub contact_elements: usize,
    /// Contact area on the tops of the relief, in m².
    pub contact_area_on_relief: f64,
    /// Contact area between the cylinders, in m².
    pub contact_area_between: f64,
    /// Distance from the axis to the farthest element centre in contact, in m; 0 without contact.
    pub contact_radius: f64,
    /// Whole elements between the contact and the nearest edge of the domain; none without contact.
    pub elements_to_edge: Option<usize>,
}

impl Summary {
    /// Summarises a solution on the grid that it was found on.
    #[must_use]
    pub fn new(solution: &Solution, grid: &Grid, relief: &SampledRelief) -> Self {
        Self::within(&Window::whole(grid.size()), solution, grid, relief)
    }

    /// The same where all pressures lie in a window.
    pub(crate) fn within(
        window: &Window,
        solution: &Solution,
        grid: &Grid,
        relief: &SampledRelief,
    ) -> Self {
        let (size, pressure) = (grid.size(), &solution.pressure);
        let place = |e: usize| [grid.centre(e / size), grid.centre(e % size)];
        let [above, left] = window.origin();
        let lines = (above..above + window.size()).into_par_iter();
        let of_line = |i: usize| {
            let first = i * size + left;
            let elements = first..first + window.size();
            let mut found = Contact::default();
            for e in elements.filter(|e| pressure[*e] > 0.0) {
                found.add(e, pressure[e], relief.mask()[e], place(e));
                found.approach(i, e - i * size, size);
            }
            found
        };
        let lines: Vec<Contact> = lines.map(of_line).collect();
        let Contact {
            largest: (max_pressure, largest),
            elements: contact_elements,
            on_relief,
            radius: contact_radius,
            to_edge: elements_to_edge,
        } = lines.into_iter().fold(Contact::default(), Contact::and);
        let area = |elements: usize| elements as f64 * grid.element_area();
        let contact_area = area(contact_elements);
        Self {
            max_pressure,
            max_pressure_at: place(largest),
            mean_pressure: if contact_elements == 0 {
                0.0
            } else {
                solution.force / contact_area
            },
            contact_area,
            contact_elements,
            contact_area_on_relief: area(on_relief),
            contact_area_between: area(contact_elements - on_relief),
            contact_radius,
            elements_to_edge,
        }
    }
}

/// What is counted over some elements.
#[derive(Clone, Copy, Default)]
struct Contact {
    /// The largest pressure and the first element that has it.
    largest: (f64, usize),
    elements: usize,
    on_relief: usize,
    radius: f64,
    to_edge: Option<usize>,
}

impl Contact {
    fn add(&mut self, element: usize, pressure: f64, is_on_relief: bool, [x, y]: [f64; 2]) {
        if pressure > self.largest.0 {
            self.largest = (pressure, element);
        }
        self.elements += 1;
        self.on_relief += usize::from(is_on_relief);
        self.radius = self.radius.max(x.hypot(y));
    }

    /// Counts an element's row and column of so many into the distance from the edge.
    fn approach(&mut self, row: usize, column: usize, size: usize) {
        let last = size - 1;
        let to_edge = row.min(column).min(last - row).min(last - column);
        self.to_edge = nearer(self.to_edge, Some(to_edge));
    }

    /// Both, the other after the one.
    fn and(self, other: Self) -> Self {
        let other_is_larger = other.largest.0 > self.largest.0;
        Self {
            largest: if other_is_larger {
                other.largest
            } else {
                self.largest
            },
            elements: self.elements + other.elements,
            on_relief: self.on_relief + other.on_relief,
            radius: self.radius.max(other.radius),
            to_edge: nearer(self.to_edge, other.to_edge),
        }
    }
}

/// The smaller of two numbers that there may not be.
fn nearer(one: Option<usize>, other: Option<usize>) -> Option<usize> {
    one.into_iter().chain(other).min()
}
