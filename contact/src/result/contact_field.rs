//! A pressure on its elements, with the gaps and the geometry around it, which determine the shape of the contact.

use pellicle_texture::Grid;

use crate::{
    Model,
    grid::region::{Place, Region},
    result::certificate::JudgedFields,
};

/// A solved contact on the region that holds all pressures.
pub struct ContactField<'a> {
    pub model: &'a Model,
    pub grid: &'a Grid,
    pub region: &'a Region,
    /// Pressure on the region, in Pa.
    pub pressure: &'a [f64],
    /// Hardness at which the pressure is cut, in Pa; infinite without one.
    pub hardness: f64,
    /// `g0` on the region's grid, in m.
    pub initial_gap: &'a [f64],
    /// Displacements on the region and beyond.
    pub judged: &'a JudgedFields,
    /// Whether an element lies on the relief, on the region's grid.
    pub mask: &'a [bool],
    /// Compliance at rest `η` of the relief on the region's grid, in m/Pa.
    pub compliance: &'a [f64],
    /// Influence coefficient of an element on itself, in m/Pa.
    pub coefficient: f64,
}

impl ContactField<'_> {
    /// Returns the element of the region at a place, itself, its mirror image or its periodic image; none elsewhere.
    pub fn element(&self, place: Place) -> Option<usize> {
        self.region.element(place)
    }

    /// The pressure at a place, in Pa; 0 outside the region.
    pub fn pressure_at(&self, place: Place) -> f64 {
        self.element(place).map_or(0.0, |e| self.pressure[e])
    }

    /// Row and column of a region's element.
    fn place(&self, element: usize) -> [usize; 2] {
        let size = self.region.size();
        [element / size, element % size]
    }

    /// Whether the pressure of an element of the region is cut.
    pub fn is_at_limit(&self, element: usize) -> bool {
        self.pressure[element] >= self.hardness
    }

    /// Whether an element of the region lies on the relief.
    pub fn is_on_relief(&self, element: usize) -> bool {
        self.mask[self.region.index_on_grid(self.place(element))]
    }

    /// `w*/p` of an element of the region, in m/Pa: `η` for linear springs.
    pub fn secant_of(&self, element: usize) -> f64 {
        let compliance = self.compliance[self.region.index_on_grid(self.place(element))];
        let law = self.model.relief.spring_law();
        law.secant(compliance, self.pressure[element])
    }

    /// `g0` of an element of the region, in m.
    pub fn initial_gap_of(&self, element: usize) -> f64 {
        self.initial_gap[self.region.index_on_grid(self.place(element))]
    }

    /// The gap of an element of the region, in m; infinite where the indenter has no surface.
    pub fn gap_of(&self, element: usize) -> f64 {
        let initial_gap = self.initial_gap_of(element);
        let shortening = self.secant_of(element) * self.pressure[element];
        let on_grid = self.region.on_grid(self.place(element));
        self.judged.gap_of(on_grid, initial_gap) + shortening
    }

    /// The gaps of the elements without pressure in a row of the region, in m, by column.
    pub fn gaps_of_line(&self, line: usize) -> impl Fn(usize) -> f64 {
        let initial_gap = self.region.line(self.initial_gap, line);
        self.judged.gaps_of_line(self.region, line, initial_gap)
    }

    /// Counts the elements in contact among the four of the cell at a place.
    pub fn in_contact_around(&self, [i, j]: Place) -> usize {
        let [rows, size] = self.region.lengths();
        let inside = |i: isize, lines| usize::try_from(i).ok().filter(|i| i + 1 < lines);
        if let (Some(i), Some(j)) = (inside(i, rows), inside(j, size)) {
            let pair = |line: usize| &self.pressure[line * size + j..][..2];
            let count = |pair: &[f64]| pair.iter().map(|p| usize::from(*p > 0.0)).sum::<usize>();
            return count(pair(i)) + count(pair(i + 1));
        }
        let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
        corners
            .iter()
            .filter(|place| self.pressure_at(**place) > 0.0)
            .count()
    }

    /// Whether the four elements of the cell at a place lie on one side of the relief's outline.
    pub fn is_one_side(&self, [i, j]: Place) -> bool {
        let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
        let side = |place: Place| self.element(place).is_some_and(|e| self.is_on_relief(e));
        corners.into_iter().map(side).all(|on| on == side([i, j]))
    }

    /// Coordinates of a place, which need not be a centre, in m.
    pub fn point(&self, place: [f64; 2]) -> [f64; 2] {
        let (lengths, half) = (self.grid.lengths(), 0.5 * self.grid.element_side());
        let first = self.region.index_on_whole([0, 0]);
        // x = (2i + 1 − N_x) h/2
        [0, 1].map(|axis: usize| {
            (2.0 * (place[axis] + first[axis] as f64) + 1.0 - lengths[axis] as f64) * half
        })
    }

    /// Coordinates of an element's centre, in m.
    pub fn centre(&self, [i, j]: Place) -> [f64; 2] {
        self.point([i as f64, j as f64])
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{Cache, RadialTables};
    use pellicle_kernel::{Foundation, Material};
    use pellicle_texture::{Film, Relief};

    use super::*;
    use crate::{Boundary, Paraboloid};

    const SIZE: usize = 6;

    /// Evaluates a function of the field on a square of side 6, on a film of stiffening springs; relief covers x > 0.
    fn with_field<T>(
        boundary: Boundary,
        pressure: &[f64],
        evaluate: impl FnOnce(&ContactField<'_>) -> T,
    ) -> T {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let model = Model {
            tables: Arc::new(RadialTables::build(&body).unwrap()),
            relief: Relief::Film(Film::new(0.5, 2.0).unwrap().stiffening()),
            indenter: Paraboloid::new(1.0).unwrap().into(),
            cache: Cache::none(),
        };
        let (grid, region) = (
            Grid::new(6.0, SIZE).unwrap(),
            Region::domain(SIZE, boundary),
        );
        let elements = 0..SIZE * SIZE;
        let mask: Vec<bool> = elements.clone().map(|e| e / SIZE >= 3).collect();
        let compliance: Vec<f64> = elements.map(|e| 0.25 + 0.01 * (e as f64)).collect();
        let nothing = vec![0.0; SIZE * SIZE];
        evaluate(&ContactField {
            model: &model,
            grid: &grid,
            region: &region,
            pressure,
            hardness: 3.0,
            initial_gap: &nothing,
            judged: &JudgedFields::on(region),
            mask: &mask,
            compliance: &compliance,
            coefficient: 1.0,
        })
    }

    #[test]
    fn four_elements_lie_on_one_side_unless_the_outline_is_between_them() {
        let pressure = [0.0; SIZE * SIZE];
        with_field(Boundary::Free, &pressure, |field| {
            for i in 0..5 {
                for j in 0..5 {
                    assert_eq!(field.is_one_side([i, j]), i != 2, "{i} {j}");
                }
            }
            // Beyond the grid there is no relief.
            let ends = [[5, 2], [4, 5], [0, 5], [-1, 2], [1, -1], [4, -1]];
            let found = ends.map(|place| field.is_one_side(place));
            assert_eq!(found, [false, false, true, true, true, false]);
        });
        with_field(Boundary::Periodic, &pressure, |field| {
            // The next cell repeats this one.
            let ends = [[5, 2], [4, 5], [0, 5]].map(|place| field.is_one_side(place));
            assert_eq!(ends, [false, true, true]);
        });
    }

    #[test]
    fn contact_around_a_point_counts_four_elements_of_this_cell_or_the_next() {
        let pressure: Vec<f64> = (0..SIZE * SIZE)
            .map(|e| f64::from(u8::from(e % 5 == 0 || e / SIZE == 4)))
            .collect();
        for boundary in [Boundary::Free, Boundary::Periodic] {
            let count = |i: isize, j: isize| {
                let corners = [[i, j], [i + 1, j], [i, j + 1], [i + 1, j + 1]];
                let presses = |[i, j]: [isize; 2]| {
                    let size = SIZE.cast_signed();
                    let wrapped = [i, j].map(|k| k.rem_euclid(size).unsigned_abs());
                    let is_here = boundary == Boundary::Periodic
                        || wrapped == [i, j].map(isize::unsigned_abs);
                    is_here && pressure[wrapped[0] * SIZE + wrapped[1]] > 0.0
                };
                corners.into_iter().filter(|place| presses(*place)).count()
            };
            with_field(boundary, &pressure, |field| {
                for i in 0..6 {
                    for j in 0..6 {
                        assert_eq!(field.in_contact_around([i, j]), count(i, j), "{i} {j}");
                    }
                }
            });
        }
    }

    #[test]
    fn springs_shorten_by_their_law_and_the_hardness_is_the_limit() {
        let mut pressure = vec![0.0; SIZE * SIZE];
        (pressure[8], pressure[27]) = (2.0, 3.0);
        with_field(Boundary::Free, &pressure, |field| {
            for (e, eta) in [(8, 0.33), (27, 0.52)] {
                // h (1 − exp(−p/E)) with h = η E
                let shortening = -eta * 2.0 * (-pressure[e] / 2.0).exp_m1();
                let found = field.secant_of(e) * pressure[e];
                assert!((found / shortening - 1.0).abs() < 1e-13, "{e}");
            }
            assert!((field.secant_of(5) / 0.3 - 1.0).abs() < 1e-14);
            let limits = [8, 27, 5].map(|e| field.is_at_limit(e));
            assert_eq!(limits, [false, true, false]);
        });
    }
}
