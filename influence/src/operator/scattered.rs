//! The product `K p` among scattered elements of a grid: near coefficients one by one, the smooth rest on a coarser
//! grid.
//!
//! Within a radius `R` of elements the coefficient is split,
//!
//! ```text
//! k = near + smooth,    smooth = P(r²) for r < R, k beyond,
//! ```
//!
//! where the polynomial `P` goes through `k` at seven distances around `R`. So `near` is exact by definition and
//! vanishes beyond `R`, and `smooth` changes little over the spacing `h` of a coarser grid of nodes, from which it is
//! interpolated among `q` × `q` of them at both ends:
//!
//! ```text
//! smooth_ij ≈ Σ_ab L_a(i) smooth(h (a − b)) L_b(j)
//! ```
//!
//! The sum over nodes is a convolution on a grid of 1/h² as many elements. (Brandt and Lubrecht 1990; the split as in
//! Skeel, Tezcan and Hardy 2002.)

use rayon::prelude::*;

use super::convolution::ConvolutionOperator;
use super::elastic::ElasticOperator;
use crate::coefficient_table::CoefficientTable;
use crate::error::InfluenceError;

/// `R`, in elements.
const RADIUS: usize = 64;
/// `h`, in elements.
const SPACING: usize = 4;
/// `q`: with 6 the error is ten times as large.
const ORDER: usize = 8;
/// Distances from `R`, in elements, at which the polynomial meets the coefficient.
const MEETINGS: [isize; 7] = [-12, -8, -4, 0, 4, 8, 12];
/// Least elements along a side.
const SMALLEST: usize = 2 * RADIUS;
/// Runs worth a thread of their own.
const RUNS: usize = 64;

/// Elements side by side in one row.
#[derive(Clone, Copy, Debug)]
struct Run {
    row: usize,
    /// The first column.
    first: usize,
    /// Where its elements stand in the list.
    start: usize,
    end: usize,
}

/// Some elements of a grid, row after row.
#[derive(Clone, Debug)]
struct Runs {
    runs: Vec<Run>,
    /// The first run of every row, and the end of the last.
    of_row: Vec<usize>,
}

impl Runs {
    /// Of ascending indices `i N + j`.
    fn of(size: usize, elements: &[u32]) -> Self {
        let mut runs: Vec<Run> = Vec::new();
        for (at, element) in elements.iter().enumerate() {
            let [row, column] = [*element as usize / size, *element as usize % size];
            match runs.last_mut() {
                Some(run) if run.row == row && run.first + run.end - run.start == column => {
                    run.end += 1;
                }
                _ => runs.push(Run {
                    row,
                    first: column,
                    start: at,
                    end: at + 1,
                }),
            }
        }
        let of_row = (0..=size).map(|row| runs.partition_point(|run| run.row < row));
        Self {
            of_row: of_row.collect(),
            runs,
        }
    }

    /// The indices of the runs that reach within `RADIUS` of one, along both axes.
    fn near(&self, of: Run) -> impl Iterator<Item = usize> {
        let rows = of.row.saturating_sub(RADIUS - 1)..(of.row + RADIUS).min(self.of_row.len() - 1);
        let (left, right) = (of.first, of.first + of.len() + RADIUS - 1);
        rows.flat_map(move |row| {
            let runs = self.of_row[row]..self.of_row[row + 1];
            let before = self.runs[runs.clone()]
                .partition_point(|run| run.end_column() + RADIUS <= left + 1);
            (runs.start + before..runs.end).take_while(move |run| self.runs[*run].first < right)
        })
    }
}

impl Run {
    fn len(&self) -> usize {
        self.end - self.start
    }

    /// The column after the last.
    fn end_column(&self) -> usize {
        self.first + self.len()
    }
}

/// Multiplications of a product among these elements (ascending indices `i N + j` of N × N elements), at most, beside
/// those on the coarser grid: near coefficients, and interpolations at both ends.
#[must_use]
pub fn scattered_work(size: usize, elements: &[u32]) -> usize {
    let tiles = size.div_ceil(RADIUS);
    // With an empty tile on either side.
    let width = tiles + 2;
    let mut counts = vec![0_usize; width * width];
    for element in elements {
        let place = [*element as usize / size, *element as usize % size];
        let [row, column] = place.map(|along| along / RADIUS + 1);
        counts[row * width + column] += 1;
    }
    let around = |tile: usize| {
        let rows = [tile - width, tile, tile + width];
        rows.iter()
            .map(|middle| counts[middle - 1..=middle + 1].iter().sum::<usize>())
            .sum::<usize>()
    };
    let used = (0..counts.len()).filter(|tile| counts[*tile] > 0);
    let pairs: usize = used.map(|tile| counts[tile] * around(tile)).sum();
    pairs + 2 * ORDER * ORDER * elements.len()
}

/// `u = K p` among listed elements of a grid.
///
/// Its cost is that of the near pairs of elements and of a product on a grid of a quarter of the elements per side. It is
/// right to 5e-8 of the largest displacement, and near the border of the table's own grid, where nodes lie on one side
/// alone, to 2e-6 (test `scattered_elements_move_as_the_whole_grid_does`): a solution by it is one step of iterative
/// refinement from exact. The bits are the same for every number of threads.
pub struct ScatteredOperator {
    runs: Runs,
    /// Of each row or column of elements: the first of its nodes, and their weights.
    lines: Vec<(usize, [f64; ORDER])>,
    /// `near` of the offsets (m, n), m and |n| < R, row after row from the least n on.
    near: Vec<f64>,
    coarse: ConvolutionOperator,
    /// Pressures and displacements of the nodes.
    nodes: [Vec<f64>; 2],
    /// The part of each run that presses.
    pressing: Vec<[usize; 2]>,
}

/// Columns of the table of near coefficients.
const NEAR_WIDTH: usize = 2 * RADIUS - 1;

impl ScatteredOperator {
    /// For elements, by ascending indices `i N + j`, of a window of `size` × `size` elements; none where that is too
    /// small to be worth it.
    ///
    /// # Panics
    /// If `size` is above the table's, or an index is not of the window.
    #[must_use]
    pub fn new(table: &CoefficientTable, size: usize, elements: &[u32]) -> Option<Self> {
        assert!(size <= table.size(), "a window within the coefficients");
        assert!(
            elements
                .iter()
                .all(|element| (*element as usize) < size * size)
        );
        if size < SMALLEST {
            return None;
        }
        let rest = Smooth::new(table);
        // As many nodes as the coefficients reach across, up to half a stencil beyond the elements.
        let nodes = (size.div_ceil(SPACING) + ORDER).min((table.size() - 1) / SPACING + 1);
        let origin = ((size - 1).cast_signed() - (SPACING * (nodes - 1)).cast_signed()) / 2;
        let coarse = rest.on_nodes(nodes).ok()?;
        let runs = Runs::of(size, elements);
        Some(Self {
            lines: (0..size).map(|line| weights(line, origin, nodes)).collect(),
            near: rest.near(),
            coarse: ConvolutionOperator::new(&coarse),
            nodes: [vec![0.0; nodes * nodes], vec![0.0; nodes * nodes]],
            pressing: vec![[0, 0]; runs.runs.len()],
            runs,
        })
    }

    /// Writes the displacements (m, positive into the body) of the elements under their pressures (Pa, compressive
    /// positive), both in the order of the list.
    ///
    /// # Panics
    /// If a field has not one value per element.
    pub fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let elements = self.runs.runs.last().map_or(0, |run| run.end);
        assert_eq!([pressure.len(), displacement.len()], [elements; 2]);
        self.press_nodes(pressure);
        let [pressures, displacements] = &mut self.nodes;
        self.coarse.apply_into(pressures, displacements);
        for (pressing, run) in self.pressing.iter_mut().zip(&self.runs.runs) {
            let presses = |at: &usize| pressure[*at] != 0.0;
            let first = (run.start..run.end).find(presses).unwrap_or(run.end);
            let last = (first..run.end).rfind(presses).unwrap_or(first);
            *pressing = [first, (last + 1).min(run.end)];
        }
        let this = &*self;
        let mut parts = Vec::with_capacity(this.runs.runs.len().div_ceil(RUNS));
        let mut rest = displacement;
        for runs in this.runs.runs.chunks(RUNS) {
            let (part, others) = rest.split_at_mut(runs.iter().map(Run::len).sum());
            parts.push((runs, part));
            rest = others;
        }
        parts.into_par_iter().for_each(|(runs, part)| {
            let mut part = part;
            for run in runs {
                let (own, others) = part.split_at_mut(run.len());
                this.displace(*run, pressure, own);
                part = others;
            }
        });
    }

    /// Shares the pressures among the nodes.
    fn press_nodes(&mut self, pressure: &[f64]) {
        let width = self.coarse.size();
        let nodes = &mut self.nodes[0];
        nodes.fill(0.0);
        for run in &self.runs.runs {
            let (top, down) = &self.lines[run.row];
            for (at, (left, along)) in (run.start..run.end).zip(&self.lines[run.first..]) {
                let p = pressure[at];
                if p == 0.0 {
                    continue;
                }
                for (row, weight) in (*top..).zip(down) {
                    let nodes = &mut nodes[row * width + left..][..ORDER];
                    let share = weight * p;
                    nodes
                        .iter_mut()
                        .zip(along)
                        .for_each(|(node, w)| *node += share * w);
                }
            }
        }
    }

    /// The displacements of one run.
    fn displace(&self, run: Run, pressure: &[f64], displacement: &mut [f64]) {
        let width = self.coarse.size();
        let (top, down) = &self.lines[run.row];
        for (u, (left, along)) in displacement.iter_mut().zip(&self.lines[run.first..]) {
            let rows = (*top..).zip(down);
            let terms = rows.map(|(row, weight)| {
                let nodes = &self.nodes[1][row * width + left..][..ORDER];
                weight * nodes.iter().zip(along).map(|(u, w)| u * w).sum::<f64>()
            });
            *u = terms.sum();
        }
        for other in self.runs.near(run) {
            let [from, to] = self.pressing[other];
            if from == to {
                continue;
            }
            let other = self.runs.runs[other];
            let near = &self.near[run.row.abs_diff(other.row) * NEAR_WIDTH..][..NEAR_WIDTH];
            let first = other.first + from - other.start;
            for (column, u) in (run.first..).zip(&mut *displacement) {
                *u += dot_near(near, column, first, &pressure[from..to]);
            }
        }
    }
}

/// `Σ near(column − first − i) pᵢ`, over those within the table.
fn dot_near(near: &[f64], column: usize, first: usize, pressure: &[f64]) -> f64 {
    // Pressures too far to the left, and where in the table the first of the others is.
    let skipped = column.saturating_sub(first + RADIUS - 1);
    let place = first + skipped + RADIUS - 1 - column;
    let (Some(near), Some(pressure)) = (near.get(place..), pressure.get(skipped..)) else {
        return 0.0;
    };
    let common = near.len().min(pressure.len());
    let (near_lanes, near_rest) = near[..common].as_chunks::<4>();
    let (lanes, rest) = pressure[..common].as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (k, p) in near_lanes.iter().zip(lanes) {
        for lane in 0..4 {
            sums[lane] += k[lane] * p[lane];
        }
    }
    let rest: f64 = near_rest.iter().zip(rest).map(|(k, p)| k * p).sum();
    sums.iter().sum::<f64>() + rest
}

/// The first node of a line of elements and Lagrange's weights of its nodes, which start at the element `origin`.
fn weights(line: usize, origin: isize, nodes: usize) -> (usize, [f64; ORDER]) {
    let from_origin = (line.cast_signed() - origin) as f64 / SPACING as f64;
    #[expect(clippy::cast_possible_truncation, reason = "a line of a grid")]
    let cell = from_origin.floor() as isize;
    let first = cell - (ORDER / 2 - 1).cast_signed();
    let first = first
        .clamp(0, (nodes - ORDER).cast_signed())
        .cast_unsigned();
    let place = from_origin - first as f64;
    let weight = |node: usize| {
        let others = (0..ORDER).filter(|other| *other != node);
        let factors = others.map(|other| (place - other as f64) / (node as f64 - other as f64));
        factors.product()
    };
    (first, std::array::from_fn(weight))
}

/// The smooth part of the coefficients.
struct Smooth<'a> {
    table: &'a CoefficientTable,
    /// `(r/R)²` and `k` where the polynomial meets the coefficient.
    meetings: [[f64; 2]; MEETINGS.len()],
}

impl<'a> Smooth<'a> {
    fn new(table: &'a CoefficientTable) -> Self {
        let meetings = MEETINGS.map(|more| {
            let distance = RADIUS.saturating_add_signed(more);
            [scaled([distance, 0]), table.coefficient([distance, 0])]
        });
        Self { table, meetings }
    }

    /// `P(r²)`, by Lagrange's formula.
    fn polynomial(&self, offset: [usize; 2]) -> f64 {
        let s = scaled(offset);
        let term = |[own, value]: &[f64; 2]| {
            let others = self.meetings.iter().filter(|[other, _]| other != own);
            let factors = others.map(|[other, _]| (s - other) / (own - other));
            value * factors.product::<f64>()
        };
        self.meetings.iter().map(term).sum()
    }

    fn coefficient(&self, offset: [usize; 2]) -> f64 {
        if is_within(offset) {
            self.polynomial(offset)
        } else {
            self.table.coefficient(offset)
        }
    }

    /// The coefficients among nodes.
    fn on_nodes(&self, nodes: usize) -> Result<CoefficientTable, InfluenceError> {
        let side = SPACING as f64 * self.table.element_side();
        CoefficientTable::from_fn(side, nodes, |offset| {
            self.coefficient(offset.map(|along| SPACING * along))
        })
    }

    /// What it lacks of the coefficients.
    fn near(&self) -> Vec<f64> {
        let mut near = vec![0.0; RADIUS * NEAR_WIDTH];
        for (m, row) in near.chunks_exact_mut(NEAR_WIDTH).enumerate() {
            for (place, value) in row.iter_mut().enumerate() {
                let offset = [m, place.abs_diff(RADIUS - 1)];
                if is_within(offset) {
                    *value = self.table.coefficient(offset) - self.polynomial(offset);
                }
            }
        }
        near
    }
}

/// `(r/R)²` of an offset.
fn scaled([m, n]: [usize; 2]) -> f64 {
    (m * m + n * n) as f64 / (RADIUS * RADIUS) as f64
}

fn is_within([m, n]: [usize; 2]) -> bool {
    m * m + n * n < RADIUS * RADIUS
}

impl std::fmt::Debug for ScatteredOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut shown = formatter.debug_struct("ScatteredOperator");
        shown
            .field("runs", &self.runs.runs.len())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use rayon::ThreadPoolBuilder;

    use super::{RADIUS, ScatteredOperator, scattered_work};
    use crate::operator::{ConvolutionOperator, ElasticOperator};
    use crate::{CoefficientTable, RadialTables};
    use pellicle_kernel::{Foundation, Material};

    const SIZE: usize = 300;

    fn table(foundation: &Foundation) -> CoefficientTable {
        let tables = RadialTables::build(foundation).unwrap();
        CoefficientTable::assemble(&tables, 1e-6, SIZE).unwrap()
    }

    fn steel() -> Material {
        Material::new(210e9, 0.3).unwrap()
    }

    /// Discs of different sizes, some on the border.
    fn islands(size: usize) -> Vec<u32> {
        let discs = [
            (0.0, 5.0, 9.0),
            (77.0, 140.0, 17.0),
            (120.0, 160.0, 5.0),
            (299.0, 299.0, 22.0),
            (210.0, 3.0, 1.0),
        ];
        let within = |e: &usize| {
            let [x, y] = [e / size, e % size].map(|i| i as f64);
            discs.iter().any(|(a, b, r)| (x - a).hypot(y - b) <= *r)
        };
        (0..size * size)
            .filter(within)
            .map(|e| u32::try_from(e).unwrap())
            .collect()
    }

    /// Displacements of the elements by the restricted and by the whole product under pressures on two of three.
    fn both(table: &CoefficientTable, size: usize) -> [Vec<f64>; 2] {
        let elements = islands(size);
        let pressure: Vec<f64> = (0..elements.len())
            .map(|at| {
                if at % 3 == 0 {
                    0.0
                } else {
                    1.0 + (at as f64).sin()
                }
            })
            .collect();
        let mut found = vec![0.0; elements.len()];
        let mut operator = ScatteredOperator::new(table, size, &elements).unwrap();
        operator.apply_into(&pressure, &mut found);
        let mut field = vec![0.0; size * size];
        for (element, p) in elements.iter().zip(&pressure) {
            field[*element as usize] = *p;
        }
        let mut whole = vec![0.0; size * size];
        ConvolutionOperator::windowed(table, size).apply_into(&field, &mut whole);
        [
            found,
            elements
                .iter()
                .map(|element| whole[*element as usize])
                .collect(),
        ]
    }

    /// The largest difference, relative to the largest displacement.
    fn difference([found, whole]: &[Vec<f64>; 2]) -> f64 {
        let largest = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(0.0, |most: f64, u| most.max(u.abs()))
        };
        let off = largest(&mut found.iter().zip(whole).map(|(a, b)| a - b));
        off / largest(&mut whole.iter().copied())
    }

    #[test]
    fn scattered_elements_move_as_the_whole_grid_does() {
        let soft = Material::new(2e9, 0.49).unwrap();
        let coats = [1e-6, 1e-5, 1e-4].map(|h| Foundation::coated(h, soft, steel()).unwrap());
        for foundation in [Foundation::half_space(steel())].iter().chain(&coats) {
            let table = table(foundation);
            // On all of the table's grid nodes end with the elements.
            for (size, bound) in [(SIZE, 2e-6), (213, 5e-8)] {
                let off = difference(&both(&table, size));
                assert!(off < bound, "{size}: {off}");
            }
        }
    }

    #[test]
    fn every_number_of_threads_gives_the_same_bits() {
        let table = table(&Foundation::half_space(steel()));
        let with = |threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| both(&table, SIZE)[0].clone())
        };
        let bits = |field: Vec<f64>| field.into_iter().map(f64::to_bits).collect::<Vec<_>>();
        assert_eq!(bits(with(1)), bits(with(3)));
    }

    #[test]
    fn near_pairs_are_counted_and_far_ones_are_not() {
        let far = [0, u32::try_from(SIZE * SIZE - 1).unwrap()];
        let interpolated = 2 * 64 * 2;
        assert_eq!(scattered_work(SIZE, &far), 2 + interpolated);
        assert_eq!(scattered_work(SIZE, &[0, 1]), 4 + interpolated);
        assert!(
            ScatteredOperator::new(&table(&Foundation::half_space(steel())), RADIUS, &[0])
                .is_none()
        );
    }
}
