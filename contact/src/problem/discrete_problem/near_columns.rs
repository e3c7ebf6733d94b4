//! The columns of `K`, cut off at a distance from the diagonal.

use super::DiscreteProblem;
use crate::{problem::support::Support, vector::single};

/// Largest reach, which bounds the table to 134 MB.
const LARGEST_REACH: usize = 4095;

/// `K` between elements at most some rows and columns apart, mirror images and the nearest periodic ones included; in
/// single precision and in units of the problem's scale.
pub struct NearColumns<'a> {
    support: &'a dyn Support,
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
        let support = problem.support();
        let elasticity = support.elasticity()?;
        let [x, y] = support.region().shape().whole_lengths();
        let size = (elasticity.size()).min(x).min(y);
        let reach = support.equally_dear_reach(reach);
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
            support,
            reach,
            rows,
        })
    }

    /// The column of an element.
    pub fn of(&self, element: usize) -> Vec<Stretch<'_>> {
        let width = 2 * self.reach + 1;
        let mut stretches = Vec::new();
        self.support.neighbours(element, self.reach, &mut |run| {
            let [x, y] = run.offset;
            let row = &self.rows[x.unsigned_abs() * width..][..width];
            let entries = &row[self.reach.wrapping_add_signed(y)..][..run.count];
            stretches.push(Stretch {
                first: run.first,
                entries,
            });
        });
        stretches
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
            region::{Boundary, Region},
        },
        problem::support::{choice::under, scattered::SHORTER_REACH},
    };

    /// A flat surface of side 1 on a part of a whole grid of `size` elements per side.
    fn problem(sector: Sector, size: usize, boundary: Boundary) -> DiscreteProblem {
        let [coating, base] = [20.0, 1.0].map(|young| Material::new(young, 0.3).unwrap());
        let body = Foundation::coated(0.05, coating, base).unwrap();
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
        let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
        let grid = SectorGrid::of_square(sector, size);
        let support = under(elasticity, Region::bounded(grid, boundary));
        let field = vec![0.0; grid.elements()];
        DiscreteProblem::on(support, field.clone(), field, 1.0).unwrap()
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
        let part = problem.among(&Region::whole(size), &candidates).unwrap();
        // Three squares of 3 × 3; the third is out of reach.
        let own = candidates.at([20, 30]).unwrap();
        let (field, times) = column(&part, 6 * SHORTER_REACH, own);
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
