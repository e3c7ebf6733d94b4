//! The stresses under one solved pressure: at points by sums over the loaded elements, on planes by FFT.

use std::sync::Arc;

use pellicle_influence::{
    Depth, ElementFields, InfluenceError, PlaneFields, RadialTables, Squares, SubsurfaceState,
};
use pellicle_texture::Grid;

use super::model::Sliding;
use super::residual::ResidualStress;
use crate::{Boundary, LoadingPath};

/// `σ_xx` and `σ_yy` among the fields of a plane.
const NORMAL_STRESSES: [usize; 2] = [3, 4];

/// The displacements and stresses under the pressure of one loading step, and under sliding.
#[derive(Debug, Clone)]
pub struct StressField {
    tables: Arc<RadialTables>,
    grid: Grid,
    tractions: [f64; 2],
    residual: ResidualStress,
    loaded: LoadedSquare,
}

/// The smallest square of a grid's elements that holds all pressures.
#[derive(Debug, Clone)]
pub(super) struct LoadedSquare {
    /// First element of the square on the grid.
    pub origin: [usize; 2],
    /// Elements along a side.
    pub size: usize,
    /// Pressures row by row, in Pa.
    pub pressure: Vec<f64>,
}

impl StressField {
    /// The field of a step of a path; none if there is no such step or the path is that of a periodic cell.
    #[must_use]
    pub fn new(path: &LoadingPath, step: usize, sliding: Sliding) -> Option<Self> {
        let pressure = &path.steps.get(step)?.solution.pressure;
        (path.boundary == Boundary::Free)
            .then(|| Self::of(path.tables.clone(), path.grid, pressure, sliding))
    }

    /// The field of the pressures on the elements of a grid, row by row, in Pa.
    ///
    /// # Panics
    /// If the number of pressures differs from that of the elements.
    #[must_use]
    pub fn of(tables: Arc<RadialTables>, grid: Grid, pressure: &[f64], sliding: Sliding) -> Self {
        assert_eq!(pressure.len(), grid.len(), "one pressure an element");
        Self {
            tables,
            grid,
            tractions: sliding.tractions(),
            residual: ResidualStress::default(),
            loaded: LoadedSquare::of(grid.size(), pressure),
        }
    }

    /// The same field with what the bodies carry without a load.
    #[must_use]
    pub fn with_residual(self, residual: ResidualStress) -> Self {
        Self { residual, ..self }
    }

    /// The grid of the pressures.
    #[must_use]
    pub fn grid(&self) -> Grid {
        self.grid
    }

    pub(super) fn tables(&self) -> &RadialTables {
        &self.tables
    }

    pub(super) fn residual(&self) -> &ResidualStress {
        &self.residual
    }

    pub(super) fn tractions(&self) -> [f64; 2] {
        self.tractions
    }

    /// Whether the surface is dragged along.
    pub(super) fn slides(&self) -> bool {
        self.tractions.iter().any(|factor| *factor != 0.0)
    }

    pub(super) fn loaded(&self) -> &LoadedSquare {
        &self.loaded
    }

    /// The state at (x, y) (m) and a depth; displacements in m, stresses in Pa, to 1e-11 of the largest value of each
    /// field at that depth.
    ///
    /// `u_x` and `u_y` are NaN under sliding where they are unbounded, above a frictionless interface. On the surface
    /// itself some stresses jump or are unbounded at the borders of elements; they are ±∞ or NaN there.
    ///
    /// # Errors
    /// As [`ElementFields::new`].
    pub fn at(&self, point: [f64; 2], depth: Depth) -> Result<SubsurfaceState, InfluenceError> {
        let states = self.at_points(&[point], depth)?;
        Ok(states[0])
    }

    /// The states at several points at one depth.
    ///
    /// # Errors
    /// As [`ElementFields::new`].
    pub fn at_points(
        &self,
        points: &[[f64; 2]],
        depth: Depth,
    ) -> Result<Vec<SubsurfaceState>, InfluenceError> {
        let side = self.grid.element_side();
        let farthest = points.iter().map(|[x, y]| x.hypot(*y));
        let farthest = farthest.fold(0.0, f64::max) + self.grid.side();
        let fields = ElementFields::new(self.tables.foundation(), side, depth, farthest)?;
        let loaded = self.loaded.elements(self.grid);
        let states = points.iter();
        Ok(states
            .map(|point| {
                let loaded = fields.sum_over(&loaded, self.tractions, *point);
                self.residual.added(loaded, depth)
            })
            .collect())
    }

    /// Planes under the elements within a square of side `extent` (m) about the axis, limited to the grid.
    #[must_use]
    pub fn planes(&self, extent: f64) -> StressPlanes {
        let size = self.grid.size();
        let within = |i: &usize| self.grid.centre(*i).abs() <= extent / 2.0;
        let first = (0..size).find(within).unwrap_or(size / 2);
        let count = (first..size).take_while(within).count().max(1);
        // Without a load, an element without pressure stands for the square.
        let unloaded = LoadedSquare {
            origin: [first; 2],
            size: 1,
            pressure: vec![0.0],
        };
        // The planes are computed on a square that also holds the pressures.
        let LoadedSquare {
            origin,
            size: loaded,
            pressure,
        } = match self.loaded.size {
            0 => &unloaded,
            _ => &self.loaded,
        };
        let low = first.min(origin[0]).min(origin[1]);
        let high = (first + count)
            .max(origin[0] + loaded)
            .max(origin[1] + loaded);
        let squares = Squares {
            loaded: *loaded,
            shown: high - low,
            before: origin.map(|origin| origin - low),
        };
        StressPlanes {
            fields: PlaneFields::new(
                self.tables.foundation(),
                self.grid.element_side(),
                squares,
                pressure,
                self.tractions,
            ),
            computed: high - low,
            before: first - low,
            centres: (first..first + count)
                .map(|i| self.grid.centre(i))
                .collect(),
            residual: self.residual.clone(),
            cut: vec![0.0; count * count],
        }
    }
}

impl LoadedSquare {
    /// Whether the pressures are symmetric in x and y to the last bit.
    pub fn is_mirrored(&self) -> bool {
        let rows = || self.pressure.chunks_exact(self.size.max(1));
        rows().all(|row| row.iter().eq(row.iter().rev())) && rows().eq(rows().rev())
    }

    /// The loaded elements' centres (m) and pressures (Pa).
    pub fn elements(&self, grid: Grid) -> Vec<([f64; 2], f64)> {
        let places = self.pressure.iter().enumerate();
        let loaded = places.filter(|(_, pressure)| **pressure > 0.0);
        let centre = |i: usize| {
            let place = [i / self.size, i % self.size];
            [0, 1].map(|axis: usize| grid.centre(self.origin[axis] + place[axis]))
        };
        loaded.map(|(i, pressure)| (centre(i), *pressure)).collect()
    }

    fn of(size: usize, pressure: &[f64]) -> Self {
        let mut low = [size; 2];
        let mut high = [0; 2];
        for (i, row) in pressure.chunks_exact(size).enumerate() {
            for (j, _) in row.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                for (axis, index) in [i, j].into_iter().enumerate() {
                    low[axis] = low[axis].min(index);
                    high[axis] = high[axis].max(index + 1);
                }
            }
        }
        let longest = (0..2)
            .map(|axis| high[axis].saturating_sub(low[axis]))
            .max();
        let longest = longest.unwrap_or(0);
        // The shorter side is extended to the longer one, within the grid.
        let origin = low.map(|low| low.min(size - longest));
        let rows = (origin[0]..origin[0] + longest).flat_map(|i| {
            let start = i * size + origin[1];
            pressure[start..start + longest].iter().copied()
        });
        Self {
            origin,
            size: longest,
            pressure: rows.collect(),
        }
    }
}

/// The fields on planes below a square of elements.
pub struct StressPlanes {
    fields: PlaneFields,
    /// Elements along a side of the computed square, and the number of them before the first that is shown.
    computed: usize,
    before: usize,
    centres: Vec<f64>,
    residual: ResidualStress,
    cut: Vec<f64>,
}

impl StressPlanes {
    /// The coordinates of the shown elements' centres, the same along x and y, in m.
    #[must_use]
    pub fn centres(&self) -> &[f64] {
        &self.centres
    }

    /// Calls `take` with the number of each of the nine fields, in the order of [`SubsurfaceState`], and its values on
    /// the plane at a depth, row by row along x. Displacements are in m, stresses in Pa; unbounded ones are NaN.
    ///
    /// # Errors
    /// As [`ElementFields::new`].
    pub fn fields_on(
        &mut self,
        depth: Depth,
        mut take: impl FnMut(usize, &[f64]),
    ) -> Result<(), InfluenceError> {
        let Self {
            computed,
            before,
            cut,
            residual,
            ..
        } = self;
        let shown = self.centres.len();
        let residual = residual.at(depth);
        self.fields.fields_on(depth, |field, values| {
            let own = if NORMAL_STRESSES.contains(&field) {
                residual
            } else {
                0.0
            };
            if shown == *computed && own == 0.0 {
                take(field, values);
                return;
            }
            for (row, cut) in cut.chunks_exact_mut(shown).enumerate() {
                let start = (*before + row) * *computed + *before;
                cut.copy_from_slice(&values[start..start + shown]);
                cut.iter_mut().for_each(|stress| *stress += own);
            }
            take(field, cut);
        })
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Foundation, Material};

    use super::*;

    /// A unit square of 5 × 5 elements with these pressures.
    fn pressed(on: &[([usize; 2], f64)]) -> StressField {
        let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let mut pressure = vec![0.0; 25];
        for ([i, j], p) in on {
            pressure[i * 5 + j] = *p;
        }
        let tables = Arc::new(RadialTables::build(&body).unwrap());
        let grid = Grid::new(1.0, 5).unwrap();
        StressField::of(tables, grid, &pressure, Sliding::default())
    }

    #[test]
    fn the_loaded_square_is_the_smallest_within_the_grid_that_holds_all_pressures() {
        let field = pressed(&[([3, 1], 2.0), ([4, 3], 3.0)]);
        let LoadedSquare {
            origin,
            size,
            pressure,
        } = field.loaded();
        assert_eq!((*origin, *size), ([2, 1], 3));
        assert_eq!(pressure[..], [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0]);
        let elements = field.loaded().elements(field.grid());
        assert_eq!(elements.len(), 2);
        for ((found, p), (wanted, q)) in
            elements.iter().zip([([0.2, -0.2], 2.0), ([0.4, 0.2], 3.0)])
        {
            assert!(*p == q && (0..2).all(|axis| (found[axis] - wanted[axis]).abs() < 1e-15));
        }
        assert_eq!(pressed(&[]).loaded().size, 0);
    }

    #[test]
    fn planes_hold_the_states_at_their_centres_wherever_the_pressure_is() {
        let depth = Depth::below(0.3);
        for on in [[1, 2], [4, 4], [0, 3]] {
            let field = pressed(&[(on, 1.0)]);
            for (extent, shown) in [(0.1, 1), (0.7, 3), (2.0, 5)] {
                let mut planes = field.planes(extent);
                assert_eq!(planes.centres().len(), shown);
                assert!((planes.centres()[0] + 0.1 * (shown - 1) as f64).abs() < 1e-15);
                let points: Vec<_> = planes
                    .centres()
                    .iter()
                    .flat_map(|x| planes.centres().iter().map(|y| [*x, *y]))
                    .collect();
                let states = field.at_points(&points, depth).unwrap();
                let check = |index: usize, values: &[f64]| {
                    for (state, value) in states.iter().zip(values) {
                        let all = [&state.displacement[..], &state.stress[..]].concat();
                        assert!((value - all[index]).abs() < 1e-10, "{index} {on:?}");
                    }
                };
                planes.fields_on(depth, check).unwrap();
            }
        }
        let mut unloaded = pressed(&[]).planes(1.0);
        let zero = |_: usize, values: &[f64]| assert!(values.iter().all(|value| *value == 0.0));
        unloaded.fields_on(depth, zero).unwrap();
    }
}
