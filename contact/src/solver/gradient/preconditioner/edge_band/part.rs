//! A few rows of the band, and the terms of its linear system.

use super::{
    ANSWERS, REACH,
    band_grid::{BandGrid, RowBuffers},
    narrow,
};

/// Rows of the grid whose part of the band is computed by one thread.
pub const ROWS: usize = 16;
/// Neighbours in a row that are computed together, because processors take them by fours.
pub const LANES: usize = 4;

/// `F` by offset along both axes, in units of `F(0)`.
pub type Coefficients = [[f32; ANSWERS]; ANSWERS];
/// A number for each neighbour in a block.
type Lanes = [f32; LANES];

/// Neighbours in a row of the grid, some of them of the band.
#[derive(Clone, Copy)]
struct Block {
    /// The first neighbour on the grid, and in the field that the stencil is laid over.
    element: usize,
    place: usize,
    /// 1 where one is of the band, else 0.
    members: Lanes,
}

/// The mirror image of one of the part's elements.
struct Mirrored {
    place: usize,
    block: usize,
    lane: usize,
}

/// The band in [`ROWS`] rows, and the terms of the linear system on each of its blocks, which are 0 where a neighbour is not of the band.
#[derive(Default)]
pub struct Part {
    blocks: Vec<Block>,
    mirrored: Vec<Mirrored>,
    residual: Vec<Lanes>,
    direction: Vec<Lanes>,
    solution: Vec<Lanes>,
    image: Vec<Lanes>,
}

impl Part {
    pub fn len(&self) -> usize {
        self.blocks.len()
    }

    /// Takes the part's images out of the field that the stencil is laid over.
    pub fn clear_images(&mut self, spread: &mut [f32]) {
        for image in self.mirrored.drain(..) {
            spread[image.place] = 0.0;
        }
    }

    /// Writes the direction of the part's images into the field that the stencil is laid over.
    pub fn mirror(&self, spread: &mut [f32]) {
        for image in &self.mirrored {
            spread[image.place] = self.direction[image.block][image.lane];
        }
    }

    /// Finds the band in the rows from `first_row` on, and takes what it was out of these rows of the field, which begin at the place `first`.
    pub fn surround(
        &mut self,
        grid: BandGrid,
        first_row: usize,
        mask: &[bool],
        (spread, first): (&mut [f32], usize),
    ) {
        for block in self.blocks.drain(..) {
            spread[block.place - first..][..LANES].fill(0.0);
        }
        let mut buffers = RowBuffers::new(grid.size);
        let rows = first_row..first_row + ROWS;
        for i in rows.filter(|i| grid.lines().contains(i)) {
            buffers.find(grid, i, mask);
            let mut next = 0;
            while let Some(ahead) = buffers.band[next..].iter().position(|b| *b) {
                let j = next + ahead;
                next = j + LANES;
                self.push(grid, [i, j], &buffers.band[j..next]);
            }
        }
        let Self {
            residual,
            direction,
            solution,
            image,
            ..
        } = self;
        for terms in [residual, direction, solution, image] {
            terms.resize(self.blocks.len(), [0.0; LANES]);
        }
    }

    /// Adds the block from the element in row `i` and column `j` on.
    fn push(&mut self, grid: BandGrid, [i, j]: [usize; 2], band: &[bool]) {
        let mut members = [0.0; LANES];
        for (lane, member) in members
            .iter_mut()
            .enumerate()
            .filter(|(lane, _)| band[*lane])
        {
            *member = 1.0;
            self.mirrored
                .extend(grid.images([i, j + lane]).map(|place| Mirrored {
                    place,
                    block: self.blocks.len(),
                    lane,
                }));
        }
        self.blocks.push(Block {
            element: i * grid.size + j,
            place: grid.place([i, j]),
            members,
        });
    }

    /// The largest of the band's answers.
    pub fn largest(&self, answer: &[f64]) -> f64 {
        self.blocks.iter().fold(0.0, |largest: f64, block| {
            let answers = answer[block.element..].iter().zip(&block.members);
            let answers = answers.map(|(answer, member)| answer.abs() * f64::from(*member));
            answers.fold(largest, f64::max)
        })
    }

    /// The residual of the solution 0, in parts of `unit`; returns `r·r`.
    pub fn start(&mut self, answer: &[f64], unit: f64) -> f64 {
        self.solution.fill([0.0; LANES]);
        self.direction.fill([0.0; LANES]);
        let mut sums = [0.0; LANES];
        for (residual, block) in self.residual.iter_mut().zip(&self.blocks) {
            let answers = answer[block.element..].iter().zip(&block.members);
            for (r, (answer, member)) in residual.iter_mut().zip(answers) {
                let of_band = *member > 0.0;
                *r = if of_band { narrow(-answer / unit) } else { 0.0 };
            }
            add_product(&mut sums, residual, residual);
        }
        total(&sums)
    }

    /// `d ← r + β d`, also where the stencil finds it, in a field that begins at the place `first`.
    pub fn turn(&mut self, beta: f32, spread: &mut [f32], first: usize) {
        let directions = self.direction.iter_mut().zip(&self.residual);
        for ((direction, residual), block) in directions.zip(&self.blocks) {
            for (d, r) in direction.iter_mut().zip(residual) {
                *d = r + beta * *d;
            }
            spread[block.place - first..][..LANES].copy_from_slice(direction);
        }
    }

    /// `y = F_EE d`; returns `d·y`.
    pub fn multiply(&mut self, spread: &[f32], width: usize, coefficients: &Coefficients) -> f64 {
        let mut sums = [0.0; LANES];
        let images = self.image.iter_mut().zip(&self.direction);
        for ((image, direction), block) in images.zip(&self.blocks) {
            let corner = block.place - REACH * (width + 1);
            *image = stencil(&spread[corner..], width, coefficients);
            for (y, member) in image.iter_mut().zip(&block.members) {
                *y *= member;
            }
            add_product(&mut sums, direction, image);
        }
        total(&sums)
    }

    /// `s ← s + α d`, `r ← r − α y`; returns `r·r`.
    pub fn advance(&mut self, alpha: f32) -> f64 {
        for (solution, direction) in self.solution.iter_mut().zip(&self.direction) {
            for (s, d) in solution.iter_mut().zip(direction) {
                *s += alpha * d;
            }
        }
        let mut sums = [0.0; LANES];
        for (residual, image) in self.residual.iter_mut().zip(&self.image) {
            for (r, y) in residual.iter_mut().zip(image) {
                *r -= alpha * y;
            }
            add_product(&mut sums, residual, residual);
        }
        total(&sums)
    }

    /// Writes the solution, in parts of `unit`, into a field that begins with the element `first`.
    pub fn write(&self, unit: f64, field: &mut [f64], first: usize) {
        for (solution, block) in self.solution.iter().zip(&self.blocks) {
            let solution = solution.iter().zip(&block.members);
            let field = &mut field[block.element - first..];
            for (to, (s, member)) in field.iter_mut().zip(solution) {
                if *member > 0.0 {
                    *to = unit * f64::from(*s);
                }
            }
        }
    }
}

/// `Σ ← Σ + a b`, lane by lane.
fn add_product(sums: &mut Lanes, a: &Lanes, b: &Lanes) {
    for lane in 0..LANES {
        sums[lane] += a[lane] * b[lane];
    }
}

fn total(sums: &Lanes) -> f64 {
    sums.iter().map(|sum| f64::from(*sum)).sum()
}

/// The sum of a field times the coefficients for each of a block's neighbours; the field from where the first coefficient of the first neighbour lies.
fn stencil(field: &[f32], width: usize, coefficients: &Coefficients) -> Lanes {
    let field = &field[..2 * REACH * (width + 1) + LANES];
    let row = |i: usize| &field[i * width..][..2 * REACH + LANES];
    let mut sums = [0.0; LANES];
    for (i, coefficients) in coefficients.iter().enumerate() {
        let (above, below) = (row(REACH - i), row(REACH + i));
        for (j, coefficient) in coefficients.iter().enumerate() {
            let (left, right) = (REACH - j, REACH + j);
            for lane in 0..LANES {
                let mut values = below[right + lane];
                if j > 0 {
                    values += below[left + lane];
                }
                if i > 0 {
                    values += above[right + lane];
                }
                if i > 0 && j > 0 {
                    values += above[left + lane];
                }
                sums[lane] += coefficient * values;
            }
        }
    }
    sums
}
