//! The columns of `K`, cut off at a distance from the diagonal.

use std::ops::Range;

use super::DiscreteProblem;
use crate::Boundary;
use crate::vector::single;

/// Largest reach, which bounds the table to 134 MB.
const LARGEST_REACH: usize = 4095;
/// Among candidates, most places of a column are empty and each is looked up, so the reach is this many times shorter.
const SHORTER_AMONG_CANDIDATES: usize = 8;

/// `K` between elements at most some rows and columns apart, mirror images and the nearest periodic ones included; in
/// single precision and in units of the problem's scale.
pub struct NearColumns<'a> {
    problem: &'a DiscreteProblem,
    reach: usize,
    /// For offsets of 0 to `reach` along x, the coefficients at offsets of −`reach` to `reach` along y.
    rows: Vec<f32>,
}

/// Elements in succession, with their entries of a column. Elements beside an axis or a border may occur in several
/// stretches, whose entries add up.
pub struct Stretch<'a> {
    pub first: usize,
    pub entries: &'a [f32],
}

impl<'a> NearColumns<'a> {
    /// Columns up to a distance, or less where they would cost too much; none if the elasticity is unknown.
    pub fn new(problem: &'a DiscreteProblem, reach: usize) -> Option<Self> {
        let elasticity = problem.elasticity()?;
        let reach = match problem.candidates() {
            Some(_) => reach / SHORTER_AMONG_CANDIDATES,
            None => reach,
        };
        let size = elasticity.size().min(problem.grid().whole_size());
        let reach = reach.min(size - 1).min(LARGEST_REACH);
        let unit = problem.scale().compliance;
        let mut rows = Vec::with_capacity((reach + 1) * (2 * reach + 1));
        for x in 0..=reach {
            let begin = rows.len();
            rows.extend((0..=reach).map(|y| single(elasticity.coefficient([x, reach - y]) / unit)));
            rows.extend_from_within(begin..begin + reach);
            rows[begin + reach + 1..].reverse();
        }
        Some(Self {
            problem,
            reach,
            rows,
        })
    }

    /// The column of an element.
    pub fn of(&self, element: usize) -> Vec<Stretch<'_>> {
        let [along_x, along_y] = self.images(element);
        let mut stretches = Vec::new();
        for x in along_x {
            for row in self.within(0, x) {
                for y in &along_y {
                    self.add_stretches([x, *y], row, &mut stretches);
                }
            }
        }
        stretches
    }

    /// Adds the stretches of one row that an element or an image at a place contributes.
    fn add_stretches<'b>(
        &'b self,
        [x, y]: [isize; 2],
        row: usize,
        stretches: &mut Vec<Stretch<'b>>,
    ) {
        let width = 2 * self.reach + 1;
        let columns = self.within(1, y);
        if columns.is_empty() {
            return;
        }
        let entries = &self.rows[row.cast_signed().abs_diff(x) * width..][..width];
        let entry = |column: usize| (column + self.reach).wrapping_add_signed(-y);
        let Some(candidates) = self.problem.candidates() else {
            stretches.push(Stretch {
                first: row * self.problem.size() + columns.start,
                entries: &entries[entry(columns.start)..][..columns.len()],
            });
            return;
        };
        // Candidates in neighbouring columns have successive indices.
        let mut column = columns.start;
        while column < columns.end {
            let there = (column..columns.end).map_while(|column| candidates.at([row, column]));
            if let Some(first) = candidates.at([row, column]) {
                let count = there.count();
                let entries = &entries[entry(column)..][..count];
                stretches.push(Stretch { first, entries });
                column += count;
            }
            column += 1;
        }
    }

    /// The rows (axis 0) or columns (axis 1) of the grid within reach of a place.
    fn within(&self, axis: usize, place: isize) -> Range<usize> {
        let reach = self.reach.cast_signed();
        let on_grid = |place: isize| usize::try_from(place).unwrap_or(0);
        let end = on_grid(place + reach + 1).min(self.problem.grid().lengths()[axis]);
        on_grid(place - reach).min(end)..end
    }

    /// The rows and columns of an element and of its images.
    fn images(&self, element: usize) -> [Vec<isize>; 2] {
        let (grid, size) = (self.problem.grid(), self.problem.size());
        let place = match self.problem.candidates() {
            Some(candidates) => candidates.place(element),
            None => [element / size, element % size],
        };
        let periods: &[isize] = match self.problem.boundary() {
            Boundary::Free => &[0],
            Boundary::Periodic => &[-1, 0, 1],
        };
        [0, 1].map(|axis: usize| {
            let own = place[axis].cast_signed();
            let mirrored = grid.mirrored()[axis].then_some(-1 - own);
            let cell = grid.whole_size().cast_signed();
            let copies = |own: isize| periods.iter().map(move |period| own + period * cell);
            std::iter::once(own)
                .chain(mirrored)
                .flat_map(copies)
                .collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle_influence::{
        CoefficientTable, RadialTables, Sector, SectorGrid, SurfaceElasticity,
    };
    use pellicle_kernel::{Foundation, Material};

    use super::*;
    use crate::{
        grid::{
            candidates::{Candidates, elements_where},
            window::Window,
        },
        problem::operator_source::OperatorSource,
    };

    /// A flat surface of side 1 on a part of a whole grid of `size` elements per side.
    fn problem(sector: Sector, size: usize, boundary: Boundary) -> DiscreteProblem {
        let [coating, base] = [20.0, 1.0].map(|young| Material::new(young, 0.3).unwrap());
        let body = Foundation::coated(0.05, coating, base).unwrap();
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
        let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
        let grid = SectorGrid::of_square(sector, size);
        let source = OperatorSource::of(elasticity, boundary);
        let field = vec![0.0; grid.elements()];
        DiscreteProblem::on(grid, source, field.clone(), field, 1.0).unwrap()
    }

    /// A column as a field, and how often each element occurs.
    fn column(problem: &DiscreteProblem, reach: usize, element: usize) -> (Vec<f64>, Vec<u32>) {
        let columns = NearColumns::new(problem, reach).unwrap();
        let mut field = vec![0.0; problem.elements()];
        let mut times = vec![0; problem.elements()];
        for stretch in columns.of(element) {
            for (place, k) in stretch.entries.iter().enumerate() {
                field[stretch.first + place] += f64::from(*k);
                times[stretch.first + place] += 1;
            }
        }
        (field, times)
    }

    #[test]
    fn whole_columns_are_those_of_the_operator() {
        for sector in [Sector::Whole, Sector::Half, Sector::Quadrant] {
            let mut problem = problem(sector, 16, Boundary::Free);
            for element in [0, 3, 21, problem.elements() - 1] {
                let (found, _) = column(&problem, 100, element);
                let mut unit = vec![0.0; problem.elements()];
                unit[element] = 1.0;
                let mut wanted = vec![0.0; problem.elements()];
                problem.deform_to_scale(&unit, &mut wanted);
                let largest = wanted[element];
                for (found, wanted) in found.iter().zip(&wanted) {
                    assert!(
                        (found - wanted).abs() < 1e-6 * largest,
                        "{sector:?} {element}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_column_ends_at_its_reach_and_goes_around_a_cell() {
        for boundary in [Boundary::Free, Boundary::Periodic] {
            let problem = problem(Sector::Whole, 16, boundary);
            // The element in row 3 and column 0, up to two away.
            let (field, times) = column(&problem, 2, 3 * 16);
            let elasticity = problem.elasticity().unwrap();
            let unit = problem.scale().compliance;
            for element in 0..256 {
                let [row, column]: [usize; 2] = [element / 16, element % 16];
                let along = match boundary {
                    Boundary::Free => column,
                    Boundary::Periodic => column.min(16 - column),
                };
                let is_near = row.abs_diff(3) <= 2 && along <= 2;
                assert_eq!(times[element], u32::from(is_near), "{boundary:?} {element}");
                if is_near {
                    let wanted = elasticity.coefficient([row.abs_diff(3), along]) / unit;
                    assert!((field[element] / wanted - 1.0).abs() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn among_candidates_a_column_holds_only_theirs() {
        let size = 300;
        let problem = problem(Sector::Whole, size, Boundary::Free);
        let members = elements_where(size, |[i, j]| i == 20 && [30, 34, 60].contains(&j));
        let candidates = Arc::new(Candidates::around(size, &members));
        let part = problem.among(&Window::whole(size), &candidates).unwrap();
        // Three squares of 3 × 3; the third is out of reach.
        let own = candidates.at([20, 30]).unwrap();
        let (field, times) = column(&part, 6 * SHORTER_AMONG_CANDIDATES, own);
        let unit = part.scale().compliance;
        for candidate in 0..candidates.len() {
            let [row, column] = candidates.place(candidate);
            let apart = [row.abs_diff(20), column.abs_diff(30)];
            assert_eq!(times[candidate], u32::from(apart[1] <= 6));
            if times[candidate] > 0 {
                let wanted = problem.elasticity().unwrap().coefficient(apart) / unit;
                assert!((field[candidate] / wanted - 1.0).abs() < 1e-6);
            }
        }
        assert_eq!(times.iter().sum::<u32>(), 18);
    }
}
