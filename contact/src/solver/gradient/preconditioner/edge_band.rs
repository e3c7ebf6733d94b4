//! The band of elements just outside the working set, where the answer of a filter of the whole plane must be made to vanish.
//!
//! With `F` the inverse of the system on the whole periodic grid, `I` the working set and `E` all that lies outside, the inverse of the system on `I`
//! is the Schur complement `F_II − F_IE F_EE⁻¹ F_EI`: it answers a residual `r` on `I` by `F (r + s)`, with the `s` on `E` that makes the answer
//! vanish there:
//!
//! ```text
//! F_EE s = −(F r)_E
//! ```
//!
//! `F` falls off so quickly that a band a few elements wide stands for all of `E`, and a few of its coefficients for all of them. Without the
//! band the filter is wrong at the contact's edge, and that alone takes twice the iterations.

mod band_grid;
mod part;

use rayon::prelude::*;

use self::{
    band_grid::BandGrid,
    part::{Coefficients, Part, ROWS},
};
use crate::grid::sector::Sector;
use crate::solver::gradient::working_set::WorkingSet;

/// Offset along both axes up to which the coefficients of `F` are counted.
const REACH: usize = 3;
/// Coefficients of a quarter of the stencil along a side.
const ANSWERS: usize = REACH + 1;
/// Answers of `F` to a unit, by offset along both axes.
pub type Answers = [[f64; ANSWERS]; ANSWERS];
/// Part of its residual to which `s` is found, and the steps after which it is good enough as it is: 3 on a homogeneous body, up to all under
/// a stiff coat.
const ACCURACY: f64 = 0.1;
const MOST_STEPS: usize = 12;
/// Elements of the grid worth a thread of their own when the band is laid.
const ELEMENTS: usize = 1 << 12;
/// Blocks up to which the band is one thread's work: waking another takes as long.
const FEW: usize = 1 << 9;

/// The band around one working set.
pub struct EdgeBand {
    grid: BandGrid,
    parts: Vec<Part>,
    /// Blocks in all parts.
    count: usize,
    coefficients: Coefficients,
    own_coefficient: f64,
    /// The field that the stencil is laid over: 0 but on the band and its mirror images.
    spread: Vec<f32>,
}

impl EdgeBand {
    /// An empty band on a sector of `size` elements per side.
    pub fn new(size: usize, sector: Sector) -> Self {
        let grid = BandGrid::new(size, sector);
        Self {
            grid,
            parts: (0..size.div_ceil(ROWS)).map(|_| Part::default()).collect(),
            count: 0,
            coefficients: [[0.0; ANSWERS]; ANSWERS],
            own_coefficient: 1.0,
            spread: grid.field(),
        }
    }

    /// Takes the coefficients of `F`, its answers to a unit by offset along the axes.
    pub fn take_coefficients(&mut self, answers: &Answers) {
        self.own_coefficient = answers[0][0];
        self.coefficients = answers.map(|row| row.map(|f| narrow(f / answers[0][0])));
    }

    /// Lays the band around a set.
    pub fn surround(&mut self, set: &WorkingSet) {
        let (grid, spread) = (self.grid, &mut self.spread);
        for part in &mut self.parts {
            part.clear_images(spread);
        }
        let parts = grid.rows_of(spread).zip(&mut self.parts).enumerate();
        let parts = parts.with_min_len(ELEMENTS / (ROWS * grid.size) + 1);
        parts.for_each(|(index, (spread, part))| {
            let rows = (spread, grid.first_place(index));
            part.surround(grid, index * ROWS, set.mask(), rows);
        });
        self.count = self.parts.iter().map(Part::len).sum();
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Writes `s` for the `answer` `F r` into the band's elements of `field`: conjugate gradients on `F_EE s = −(F r)_E`.
    pub fn balance(&mut self, answer: &[f64], field: &mut [f64]) {
        let least = self.parts_at_once();
        let largest = self.parts.par_iter().with_min_len(least);
        let largest: Vec<f64> = largest.map(|part| part.largest(answer)).collect();
        let unit = largest.into_iter().fold(0.0, f64::max);
        if !(unit > 0.0 && unit.is_finite()) {
            return;
        }
        let start = self.sum_over_parts(|part| part.start(answer, unit));
        self.solve(start);
        let unit = unit / self.own_coefficient;
        let parts = self.parts.par_iter().with_min_len(least);
        let elements = ROWS * self.grid.size;
        let rows = field.par_chunks_mut(elements).zip(parts).enumerate();
        rows.for_each(|(index, (field, part))| part.write(unit, field, index * elements));
    }

    /// Solves for the residual, all in units of 1, from a solution of 0 and the residual's product with itself.
    fn solve(&mut self, start: f64) {
        let (mut product, mut beta) = (start, 0.0);
        let enough = ACCURACY * ACCURACY * start;
        for _ in 0..MOST_STEPS {
            self.turn(narrow(beta));
            let alpha = product / self.multiply();
            // Cut off at the reach, F_EE may be indefinite under a stiff coat.
            if !(alpha > 0.0 && alpha.is_finite()) {
                break;
            }
            let after = self.sum_over_parts(|part| part.advance(narrow(alpha)));
            if after <= enough {
                break;
            }
            beta = after / std::mem::replace(&mut product, after);
        }
    }

    /// `d ← r + β d`, also where the stencil finds it.
    fn turn(&mut self, beta: f32) {
        let (grid, least) = (self.grid, self.parts_at_once());
        let parts = grid.rows_of(&mut self.spread).zip(&mut self.parts);
        let parts = parts.enumerate().with_min_len(least);
        parts.for_each(|(index, (spread, part))| part.turn(beta, spread, grid.first_place(index)));
        for part in &self.parts {
            part.mirror(&mut self.spread);
        }
    }

    /// `F_EE d`, into the image, in units of `F(0)`; returns `d·F_EE d`.
    fn multiply(&mut self) -> f64 {
        let (spread, coefficients) = (std::mem::take(&mut self.spread), self.coefficients);
        let width = self.grid.width();
        let product = self.sum_over_parts(|part| part.multiply(&spread, width, &coefficients));
        self.spread = spread;
        product
    }

    /// The sum of what is said of each part, in an order that does not depend on the number of threads.
    fn sum_over_parts(&mut self, of_part: impl Fn(&mut Part) -> f64 + Send + Sync) -> f64 {
        let least = self.parts_at_once();
        let parts = self.parts.par_iter_mut().with_min_len(least);
        let sums: Vec<f64> = parts.map(of_part).collect();
        sums.iter().sum()
    }

    /// Parts that one thread computes, at least.
    fn parts_at_once(&self) -> usize {
        if self.count <= FEW {
            self.parts.len()
        } else {
            1
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a few digits are what is wanted"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use pellicle_influence::ElasticOperator;

    use super::{ACCURACY, Answers, EdgeBand};
    use crate::{
        DiscreteProblem,
        grid::sector::Sector,
        solver::gradient::{control::Control, tests::begun, working_set::WorkingSet},
    };

    /// More than one part, the last not full.
    const SIZE: usize = 41;

    /// A body that does not move.
    struct Rigid;

    impl ElasticOperator for Rigid {
        fn size(&self) -> usize {
            SIZE
        }

        fn apply_into(&mut self, _: &[f64], displacement: &mut [f64]) {
            displacement.fill(0.0);
        }
    }

    fn inside([i, j]: [usize; 2]) -> bool {
        let [x, y] = [i, j].map(|along| along as f64);
        let island = |at: [f64; 2], radius: f64| (x - at[0]).hypot(y - at[1]) < radius;
        island([0.0, 7.0], 5.2) || island([17.0, 2.0], 3.4) || island([24.0, 25.0], 10.3)
    }

    /// The set of what is inside, moved by some columns.
    fn set(moved: usize) -> WorkingSet {
        let presses = |e: usize| f64::from(u8::from(inside([e / SIZE, e % SIZE + moved])));
        let pressure: Vec<f64> = (0..SIZE * SIZE).map(presses).collect();
        let field = |value: f64| vec![value; SIZE * SIZE];
        let problem = DiscreteProblem::new(Box::new(Rigid), field(0.0), field(1.0), 1.0);
        begun(&mut problem.unwrap(), Control::Penetration(0.0), &pressure).1
    }

    /// Whether an element lies beside the set, three elements away at most, and three from the border at least.
    fn is_of_band([i, j]: [usize; 2], first: usize) -> bool {
        let around = |k: usize| k.saturating_sub(3)..=k + 3;
        let near = around(i).any(|i| around(j).any(|j| inside([i, j])));
        let lines = first..SIZE - 3;
        near && !inside([i, j]) && lines.contains(&i) && lines.contains(&j)
    }

    #[test]
    fn what_is_written_on_the_band_answers_it() {
        let answers: Answers = std::array::from_fn(|i| {
            std::array::from_fn(|j| match i * i + j * j {
                0 => 2.5,
                square => -0.25 / (square as f64).powf(1.5),
            })
        });
        let waves =
            |e: usize| 1.0 + 0.5 * (0.2 * (e / SIZE) as f64 + 0.3 * (e % SIZE) as f64).sin();
        let answer: Vec<f64> = (0..SIZE * SIZE).map(waves).collect();
        for (sector, first) in [(Sector::Whole, 3), (Sector::Quadrant, 0)] {
            let mut band = EdgeBand::new(SIZE, sector);
            band.take_coefficients(&answers);
            band.surround(&set(0));
            let mut written = vec![0.0; SIZE * SIZE];
            band.balance(&answer, &mut written);
            // Of another set nothing stays.
            let mut again = vec![0.0; SIZE * SIZE];
            band.surround(&set(4));
            band.balance(&answer, &mut vec![0.0; SIZE * SIZE]);
            band.surround(&set(0));
            band.balance(&answer, &mut again);
            assert!(written == again, "{sector:?}");
            let mirrored = |k: i64| usize::try_from(if k < 0 { -1 - k } else { k }).unwrap();
            // All of the band, and what lies next to an axis.
            let (mut missed, mut whole) = ([0.0; 2], [0.0; 2]);
            for e in 0..SIZE * SIZE {
                let place = [e / SIZE, e % SIZE];
                if !is_of_band(place, first) {
                    assert!(written[e] == 0.0, "{place:?}");
                    continue;
                }
                let [i, j] = place.map(|k| i64::try_from(k).unwrap());
                let mut sum = answer[e];
                for (m, n) in (-3..=3_i64).flat_map(|m| (-3..=3_i64).map(move |n| (m, n))) {
                    let [m_abs, n_abs] = [m, n].map(|k| usize::try_from(k.abs()).unwrap());
                    sum +=
                        answers[m_abs][n_abs] * written[mirrored(i + m) * SIZE + mirrored(j + n)];
                }
                for part in 0..=usize::from(place.contains(&0)) {
                    missed[part] += sum * sum;
                    whole[part] += answer[e] * answer[e];
                }
            }
            assert!(whole[0] > 100.0 && missed[0] > 0.0, "{sector:?}: a band");
            // Single precision adds nothing to speak of.
            assert!(
                missed[0] < (1.01 * ACCURACY).powi(2) * whole[0],
                "{sector:?}: {missed:?}"
            );
            assert!(
                missed[1] <= 0.04 * whole[1],
                "{sector:?}: {missed:?} of {whole:?}"
            );
        }
    }
}
