//! The few numbers that describe a solved contact.

use pellicle_texture::{Grid, SampledRelief};

use crate::Solution;

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
}

impl Summary {
    /// Summarises a solution on the grid that it was found on.
    #[must_use]
    pub fn new(solution: &Solution, grid: &Grid, relief: &SampledRelief) -> Self {
        let pressure = &solution.pressure;
        let in_contact = || {
            pressure
                .iter()
                .enumerate()
                .filter(|(_, p)| **p > 0.0)
                .map(|(e, _)| e)
        };
        let place = |e: usize| [grid.centre(e / grid.size()), grid.centre(e % grid.size())];
        let largest = in_contact().fold(0, |best, e| {
            if pressure[e] > pressure[best] {
                e
            } else {
                best
            }
        });
        let contact_elements = in_contact().count();
        let on_relief = in_contact().filter(|e| relief.mask()[*e]).count();
        let area = |elements: usize| elements as f64 * grid.element_area();
        let contact_area = area(contact_elements);
        Self {
            max_pressure: pressure[largest],
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
            contact_radius: in_contact()
                .map(place)
                .map(|[x, y]| x.hypot(y))
                .fold(0.0, f64::max),
        }
    }
}
