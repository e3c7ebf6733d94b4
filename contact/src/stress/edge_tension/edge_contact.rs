//! The elements at the edge of a contact: their pressures, and the gaps of those beside it.

use pellicle_influence::RadialTables;
use pellicle_texture::{Grid, Relief, SampledRelief};
use rayon::prelude::*;

use crate::stress::field::{LoadedSquare, StressField};
use crate::{Indenter, Profile};

/// Row and column of an element, counted from the first loaded one.
pub type Place = [isize; 2];

/// A solved contact seen from its elements.
pub struct EdgeContact<'a> {
    pub field: &'a StressField,
    pub relief: &'a Relief,
    pub indenter: &'a Indenter,
    /// Penetration, in m.
    pub penetration: f64,
    /// Hardness at which the pressure is cut, in Pa; infinite without one.
    pub hardness: f64,
    /// `K₀₀`, `K₀₁`, … by row up to the size of the loaded square, in m/Pa.
    coefficients: Vec<f64>,
    /// The relief's profile and compliance; none without a relief.
    sampled: Option<SampledRelief>,
}

impl<'a> EdgeContact<'a> {
    pub fn new(
        field: &'a StressField,
        (relief, indenter): (&'a Relief, &'a Indenter),
        penetration: f64,
        hardness: f64,
    ) -> Self {
        let sampled = (*relief != Relief::Bare).then(|| relief.sample(&field.grid()));
        Self {
            field,
            relief,
            indenter,
            penetration,
            hardness,
            coefficients: coefficients(field.tables(), field.grid(), field.loaded().size + 1),
            sampled,
        }
    }

    pub fn grid(&self) -> Grid {
        self.field.grid()
    }

    /// Loaded elements along a side of the square that holds all.
    pub fn size(&self) -> isize {
        self.field.loaded().size.cast_signed()
    }

    /// The pressure of an element, in Pa; 0 outside the loaded square.
    pub fn pressure(&self, [i, j]: Place) -> f64 {
        let LoadedSquare { size, pressure, .. } = self.field.loaded();
        match (usize::try_from(i), usize::try_from(j)) {
            (Ok(i), Ok(j)) if i < *size && j < *size => pressure[i * size + j],
            _ => 0.0,
        }
    }

    pub fn is_in_contact(&self, place: Place) -> bool {
        self.pressure(place) > 0.0
    }

    /// x and y of a place, which need not be a centre, in m.
    pub fn point(&self, place: [f64; 2]) -> [f64; 2] {
        let (grid, origin) = (self.grid(), self.field.loaded().origin);
        [0, 1].map(|axis: usize| grid.centre(origin[axis]) + place[axis] * grid.element_side())
    }

    /// The place of a point (x, y), in m.
    pub fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let (grid, origin) = (self.grid(), self.field.loaded().origin);
        [0, 1].map(|axis: usize| (point[axis] - grid.centre(origin[axis])) / grid.element_side())
    }

    /// Index of an element on the grid; none beyond it.
    fn element(&self, place: Place) -> Option<usize> {
        let (size, origin) = (self.grid().size(), self.field.loaded().origin);
        let along = |axis: usize| {
            origin[axis]
                .checked_add_signed(place[axis])
                .filter(|i| *i < size)
        };
        Some(along(0)? * size + along(1)?)
    }

    /// Influence coefficient of an element on itself, in m/Pa.
    pub fn own_coefficient(&self) -> f64 {
        self.coefficients[0]
    }

    /// `w*/p` of an element in contact, in m/Pa; 0 without springs.
    pub fn secant(&self, place: Place) -> f64 {
        match (&self.sampled, self.element(place)) {
            (Some(sampled), Some(e)) => {
                let law = sampled.spring_law();
                law.secant(sampled.compliance()[e], self.pressure(place))
            }
            _ => 0.0,
        }
    }

    /// The gaps `g = K p + g0 − D` of elements without pressure, in m; infinite beyond the grid or the indenter.
    pub fn gaps(&self, places: &[Place]) -> Vec<f64> {
        let points: Vec<[f64; 2]> = places
            .iter()
            .map(|place| self.point(place.map(|along| along as f64)))
            .collect();
        let heights = self.indenter.heights(&points);
        let gap = |(place, height): (&Place, f64)| {
            let Some(e) = self.element(*place) else {
                return f64::INFINITY;
            };
            let profile = self
                .sampled
                .as_ref()
                .map_or(0.0, |sampled| sampled.profile()[e]);
            self.displacement(*place) + height - profile - self.penetration
        };
        places.par_iter().zip(heights).map(gap).collect()
    }

    /// `K p` at an element, in m.
    fn displacement(&self, [i, j]: Place) -> f64 {
        let LoadedSquare { size, pressure, .. } = self.field.loaded();
        let mut sum = 0.0;
        for (row, pressures) in pressure.chunks_exact(*size).enumerate() {
            let Some(first) = pressures.iter().position(|p| *p > 0.0) else {
                continue;
            };
            let of_row = &self.coefficients[i.abs_diff(row.cast_signed()) * (size + 1)..][..=*size];
            let terms = pressures.iter().enumerate().skip(first);
            sum += terms
                .map(|(column, p)| p * of_row[j.abs_diff(column.cast_signed())])
                .sum::<f64>();
        }
        sum
    }
}

/// The coefficients at the offsets below `count`, row by row.
fn coefficients(tables: &RadialTables, grid: Grid, count: usize) -> Vec<f64> {
    let side = grid.element_side();
    let rows = (0..count).into_par_iter();
    let octant: Vec<Vec<f64>> = rows
        .map(|m| (0..=m).map(|n| tables.coefficient(side, [m, n])).collect())
        .collect();
    let all = (0..count).flat_map(|m| (0..count).map(move |n| [m.max(n), m.min(n)]));
    all.map(|[m, n]| octant[m][n]).collect()
}
