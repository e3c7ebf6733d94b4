//! The few numbers that describe a solved contact.

use std::cmp::Ordering;

use pellicle_texture::{Grid, SampledRelief};

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
    /// Largest shortening `η p` of the relief, in m.
    pub largest_shortening: f64,
    /// Distance from the axis to the farthest element centre in contact, in m; 0 without contact.
    pub contact_radius: f64,
    /// Whole elements between the contact and the nearest edge of the domain; none without contact.
    pub elements_to_edge: Option<usize>,
}

impl Summary {
    /// Summarises a solution on the grid that it was found on.
    #[must_use]
    pub fn new(solution: &Solution, grid: &Grid, relief: &SampledRelief) -> Self {
        let relief = (relief.mask(), relief.compliance());
        Self::within(&Window::whole(grid.size()), solution, grid, relief)
    }

    /// The same of a solution on a window that holds all pressures; mask and compliance of the relief are those of the window's sector.
    pub(crate) fn within(
        window: &Window,
        solution: &Solution,
        grid: &Grid,
        (mask, compliance): (&[bool], &[f64]),
    ) -> Self {
        let size = grid.size();
        let place = |e: usize| [grid.centre(e / size), grid.centre(e % size)];
        let sector = window.sector();
        let [above, left] = window.origin();
        let of_line = |line: usize, pressure: &[f64]| {
            let (mask, compliance) = (window.line(mask, line), window.line(compliance, line));
            let mut found = Contact::default();
            let image = |column| sector.first_image([above + line, left + column], size);
            let mut columns = pressure.iter().enumerate().filter(|(_, p)| **p > 0.0);
            for (column, p) in columns.clone() {
                let [i, j] = image(column);
                found.add(i * size + j, *p, mask[column]);
                found.shortening = found.shortening.max(compliance[column] * p);
            }
            // Of one row, no element is farther from the axis or nearer to an edge than the outermost two.
            for (column, _) in [columns.next(), columns.next_back()].into_iter().flatten() {
                let [i, j] = image(column);
                found.reach_to([i, j], place(i * size + j), size);
            }
            found
        };
        let lines = window.by_lines(&solution.pressure, of_line);
        let Contact {
            largest: (max_pressure, largest),
            elements: contact_elements,
            on_relief,
            shortening: largest_shortening,
            radius: contact_radius,
            to_edge: elements_to_edge,
        } = lines.into_iter().fold(Contact::default(), Contact::and);
        let [contact_elements, on_relief] =
            [contact_elements, on_relief].map(|elements| elements * sector.images());
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
            largest_shortening,
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
    shortening: f64,
    radius: f64,
    to_edge: Option<usize>,
}

impl Contact {
    fn add(&mut self, element: usize, pressure: f64, is_on_relief: bool) {
        self.largest = larger(self.largest, (pressure, element));
        self.elements += 1;
        self.on_relief += usize::from(is_on_relief);
    }

    /// Counts an element's row and column of so many, and its place, into the extent.
    fn reach_to(&mut self, [row, column]: [usize; 2], [x, y]: [f64; 2], size: usize) {
        let last = size - 1;
        self.radius = self.radius.max(x.hypot(y));
        let to_edge = row.min(column).min(last - row).min(last - column);
        self.to_edge = nearer(self.to_edge, Some(to_edge));
    }

    /// Both.
    fn and(self, other: Self) -> Self {
        Self {
            largest: larger(self.largest, other.largest),
            elements: self.elements + other.elements,
            on_relief: self.on_relief + other.on_relief,
            shortening: self.shortening.max(other.shortening),
            radius: self.radius.max(other.radius),
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

/// The smaller of two numbers that there may not be.
fn nearer(one: Option<usize>, other: Option<usize>) -> Option<usize> {
    one.into_iter().chain(other).min()
}
