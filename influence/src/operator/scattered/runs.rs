//! Listed elements as runs of neighbours, and the number of near pairs among them.

use super::smooth::{ORDER, RADIUS};

/// Adjacent elements in one row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub row: usize,
    /// The first column.
    pub first: usize,
    /// The position of its first element in the list; `end` is that after its last.
    pub start: usize,
    pub end: usize,
}

/// Some elements of a grid, row after row.
#[derive(Clone, Debug, Default)]
pub(super) struct Runs {
    pub runs: Vec<Run>,
    /// The first run of every row, and the end of the last.
    of_row: Vec<usize>,
}

impl Runs {
    /// The runs of ascending indices `i N + j`.
    pub fn of(size: usize, elements: &[u32]) -> Self {
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

    /// The indices of the runs within `RADIUS` of one, along both axes.
    pub fn near(&self, of: Run) -> impl Iterator<Item = usize> {
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
    pub fn len(&self) -> usize {
        self.end - self.start
    }

    /// The column after the last.
    fn end_column(&self) -> usize {
        self.first + self.len()
    }
}

/// Upper bound on the multiplications of a product among these elements (ascending indices `i N + j` of N × N
/// elements), not counting those on the coarser grid: near coefficients, and interpolations at both ends.
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
