//! A factorised sparse approximate inverse of the system on the working set, `(K + η)_II⁻¹ ≈ Gᵀ G`.
//!
//! The elements are ordered from coarse to fine. Each is given its nearest *earlier* elements, and its row of `G` is
//! the last row of the inverse Cholesky factor of the small dense system of these and itself (Kaporin 1994; Vecchia's
//! approximation, optimal in the Kullback–Leibler sense: Schäfer, Katzfuss and Owhadi 2021):
//!
//! ```text
//! (K + η)_nn = L Lᵀ,    Lᵀ g = e_last
//! ```
//!
//! Coefficients depend on the offset alone, so elements with neighbours in the same places and of the same compliances
//! share one row; inside a smooth contact nearly all of them do, on a rough surface few. Rows once computed are kept
//! while the set changes, so an exchange costs the rows whose neighbours it touches.
//!
//! A small set is solved directly instead.

mod direct;
mod order;
mod row;
mod scattered;

use std::{
    collections::HashMap,
    sync::{Arc, LazyLock},
};

use pellicle_influence::{Sector, SurfaceElasticity};
use rayon::prelude::*;

pub use self::scattered::ScatteredFactor;
use self::{
    direct::DirectFactor,
    order::{COLOURS, Rank, TOP, earlier_offsets},
    row::{AT_ONCE, LocalSystem, NearCoefficients, SystemBatch, class},
};
use crate::grid::window::Window;
use crate::solver::gradient::working_set::WorkingSet;

/// Stands for the row of an element outside the set.
const OUTSIDE: u32 = u32::MAX;
/// Elements of a set that is solved directly, at most: with 140 elements on 65,536 it takes 11 products instead of 40,
/// and up to here the dense factor costs no more than they do.
const MOST_DIRECT: usize = 500;
/// Places where an element's neighbours are looked for, nearest first. In a contact of a few summits most are empty:
/// with 160 places it takes twice the products.
const PLACES: usize = 4000;
/// Elements, in units of the spacing of an element's level, from the axis of a sector within which mirror images
/// count in a row.
const NEAR_AXIS: u32 = 8;
/// Numbers in a pattern before the neighbours.
const HEAD: usize = 4;
/// Rows beyond which all are forgotten, some 0.5 GB with 30 neighbours: a path of many loads meets ever new ones.
const MOST_ROWS: usize = 1 << 20;
/// Elements that look for their rows together: one part of a fixed length, for every number of threads.
const PART: usize = 1 << 12;
/// Batches of rows that one thread takes at least.
const BATCHES: usize = 8;

/// The factor `G` on one grid's working set.
pub struct SparseFactor {
    /// Rows, and elements of each.
    lengths: [usize; 2],
    sector: Sector,
    neighbours: usize,
    elasticity: Arc<SurfaceElasticity>,
    /// Class of `η/K₀₀` of every element.
    classes: Vec<u16>,
    /// The row of each pattern met so far.
    known: HashMap<Pattern, u32>,
    rows: Rows,
    /// Coefficients between elements of each level.
    near: Vec<NearCoefficients>,
    /// Compliance `η` of the relief (m/Pa).
    compliance: Vec<f64>,
    /// The factor of a small set, in place of the rows.
    direct: Option<DirectFactor>,
    /// Row of each element.
    row_of: Vec<u32>,
    product: Vec<f64>,
}

/// Of each colour: where earlier elements lie.
static EARLIER: LazyLock<[Vec<[i32; 2]>; 3]> =
    LazyLock::new(|| [0, 1, 2].map(|colour| earlier_offsets(colour, PLACES)));

/// A row depends on this alone: level and colour, the element's class, its distance from the axes of a quadrant if they
/// are near, and of each neighbour the index of its offset and its class.
type Pattern = Box<[u32]>;

/// Rows of `G`, one after the other.
#[derive(Default)]
struct Rows {
    heads: Vec<RowHead>,
    /// Entries beside the diagonal by distance in the field's index; single precision is enough for a preconditioner.
    entries: Vec<(i32, f32)>,
}

/// A row of `G`.
struct RowHead {
    diagonal: f64,
    /// Where its entries end; they begin where those of the row before end.
    end: usize,
}

impl Rows {
    fn len(&self) -> usize {
        self.heads.len()
    }

    fn clear(&mut self) {
        self.heads.clear();
        self.entries.clear();
    }

    fn append(&mut self, others: Self) {
        let first = self.entries.len();
        self.entries.extend(others.entries);
        let heads = others.heads.into_iter();
        self.heads.extend(heads.map(|head| RowHead {
            end: first + head.end,
            ..head
        }));
    }

    fn push(&mut self, diagonal: f64, entries: impl Iterator<Item = (i32, f32)>) {
        self.entries.extend(entries);
        let end = self.entries.len();
        self.heads.push(RowHead { diagonal, end });
    }

    /// Diagonal and other entries of a row.
    fn row(&self, row: u32) -> (f64, &[(i32, f32)]) {
        let row = row as usize;
        let first = row
            .checked_sub(1)
            .map_or(0, |before| self.heads[before].end);
        let RowHead { diagonal, end } = self.heads[row];
        (diagonal, &self.entries[first..end])
    }
}

impl SparseFactor {
    /// A factor with `neighbours` entries a row beside the diagonal, for a grid.
    pub fn new(
        elasticity: Arc<SurfaceElasticity>,
        grid: &Window,
        relief_compliance: &[f64],
        neighbours: usize,
    ) -> Self {
        let elements = grid.elements();
        Self {
            lengths: grid.lengths(),
            sector: grid.sector(),
            neighbours,
            classes: classes(&elasticity, relief_compliance),
            compliance: relief_compliance.to_vec(),
            direct: None,
            known: HashMap::new(),
            rows: Rows::default(),
            near: (0..=TOP)
                .map(|level| NearCoefficients::of(&elasticity, level))
                .collect(),
            row_of: vec![OUTSIDE; elements],
            product: vec![0.0; elements],
            elasticity,
        }
    }

    /// Takes other compliances of the relief, in m/Pa: rows are of patterns of compliances, so those known stay right.
    pub fn take_compliance(&mut self, relief_compliance: &[f64]) {
        self.classes = classes(&self.elasticity, relief_compliance);
        self.compliance.copy_from_slice(relief_compliance);
    }

    /// Finds the row of every element of the set, and computes those not met before.
    pub fn update(&mut self, set: &WorkingSet) {
        self.direct = None;
        if set.len() <= MOST_DIRECT {
            let (grid, eta) = ((self.row(), self.sector), &self.compliance);
            self.direct = DirectFactor::new(&self.elasticity, grid, eta, set.mask());
            if self.direct.is_some() {
                return;
            }
        }
        if self.rows.len() > MOST_ROWS {
            self.known.clear();
            self.rows.clear();
        }
        let mut row_of = std::mem::take(&mut self.row_of);
        let parts = row_of.par_chunks_mut(PART).enumerate();
        let unknown: Vec<Vec<(usize, Pattern)>> = parts
            .map(|(part, rows)| self.look_up(part * PART, rows, set.mask()))
            .collect();
        let mut fresh: Vec<Pattern> = Vec::new();
        for (element, pattern) in unknown.into_iter().flatten() {
            let next = u32::try_from(self.rows.len() + fresh.len()).unwrap_or(OUTSIDE);
            row_of[element] = *self.known.entry(pattern).or_insert_with_key(|pattern| {
                fresh.push(pattern.clone());
                next
            });
        }
        let batches = fresh.par_chunks(AT_ONCE).with_min_len(BATCHES);
        let rows: Vec<Rows> = batches
            .map_init(
                || SystemBatch::new(self.neighbours),
                |batch, patterns| self.rows(batch, patterns),
            )
            .collect();
        rows.into_iter().for_each(|rows| self.rows.append(rows));
        self.row_of = row_of;
    }

    /// Writes the rows of the elements from `first` on; returns those of unknown patterns.
    fn look_up(&self, first: usize, rows: &mut [u32], mask: &[bool]) -> Vec<(usize, Pattern)> {
        let mut unknown = Vec::new();
        let mut pattern = Vec::new();
        for (element, row) in (first..).zip(rows) {
            *row = OUTSIDE;
            if mask[element] {
                self.pattern_into(element, mask, &mut pattern);
                match self.known.get(pattern.as_slice()) {
                    Some(known) => *row = *known,
                    None => unknown.push((element, pattern.clone().into_boxed_slice())),
                }
            }
        }
        unknown
    }

    fn pattern_into(&self, element: usize, mask: &[bool], pattern: &mut Vec<u32>) {
        let size = self.row();
        let (i, j) = (index(element / size), index(element % size));
        let Rank { level, colour } = Rank::of(i, j);
        pattern.clear();
        pattern.push(COLOURS * level + colour);
        pattern.push(u32::from(self.classes[element]));
        let near = self.near_axis(level);
        pattern.extend([0, 1].map(|axis: usize| [i, j][axis].unsigned_abs().min(near[axis])));
        for (place, [x, y]) in (0..).zip(&EARLIER[colour as usize]) {
            let [row, column] = [i + (x << level), j + (y << level)];
            let (Some(i), Some(j)) = (self.within(0, row), self.within(1, column)) else {
                continue;
            };
            let neighbour = i * size + j;
            if mask[neighbour] {
                pattern.push(place << 16 | u32::from(self.classes[neighbour]));
                if pattern.len() == self.neighbours + HEAD {
                    return;
                }
            }
        }
    }

    /// Elements from each axis within which mirror images count in a row of this level; none but at those of a sector.
    fn near_axis(&self, level: u32) -> [u32; 2] {
        let lines = self.sector.mirrored_lines((NEAR_AXIS << level) as usize);
        lines.map(|lines| index(lines).unsigned_abs())
    }

    /// Elements of a row.
    fn row(&self) -> usize {
        let [_, size] = self.lengths;
        size
    }

    /// The index of a row or a column, if it lies on the grid.
    fn within(&self, axis: usize, index: i32) -> Option<usize> {
        let place = usize::try_from(index).ok()?;
        (place < self.lengths[axis]).then_some(place)
    }

    /// Computes the rows of some patterns.
    fn rows(&self, batch: &mut SystemBatch, patterns: &[Pattern]) -> Rows {
        let neighbours = patterns.iter().map(|pattern| neighbours_of(pattern));
        let neighbours: Vec<(Vec<[i32; 2]>, Vec<u16>)> = neighbours.collect();
        let systems = patterns.iter().zip(&neighbours);
        let systems = systems.map(|(pattern, (places, classes))| {
            let level = pattern[0] / COLOURS;
            let near = self.near_axis(level);
            LocalSystem {
                elasticity: &self.elasticity,
                near: &self.near[level as usize],
                level,
                places,
                classes,
                own_class: class_in(pattern[1]),
                to_axis: [0, 1].map(|axis: usize| {
                    let along = pattern[2 + axis];
                    (along < near[axis]).then_some(along)
                }),
            }
        });
        let systems: Vec<LocalSystem<'_>> = systems.collect();
        let mut rows = Rows::default();
        for (values, system) in batch.rows(&systems).into_iter().zip(&systems) {
            let (diagonal, values) = values.split_last().expect("the element itself");
            let distances = system
                .places
                .iter()
                .map(|[x, y]| (x * index(self.row()) + y) << system.level);
            #[expect(
                clippy::cast_possible_truncation,
                reason = "a preconditioner needs no more"
            )]
            let values = values.iter().map(|g| *g as f32);
            rows.push(*diagonal, distances.zip(values));
        }
        rows
    }

    /// `r ← Gᵀ G r`; values outside the set become 0.
    pub fn apply(&mut self, field: &mut [f64]) {
        if let Some(direct) = &mut self.direct {
            return direct.apply(field);
        }
        self.multiply(field);
        field.fill(0.0);
        for (element, (row, value)) in self.row_of.iter().zip(&self.product).enumerate() {
            if *row != OUTSIDE {
                let (diagonal, entries) = self.rows.row(*row);
                field[element] += diagonal * value;
                for (distance, g) in entries {
                    field[at(element, *distance)] += f64::from(*g) * value;
                }
            }
        }
    }

    /// `G r`, into the buffer.
    fn multiply(&mut self, field: &[f64]) {
        let rows = &self.rows;
        let parts = self.product.par_chunks_mut(PART);
        let parts = parts.zip(self.row_of.par_chunks(PART)).enumerate();
        parts.for_each(|(part, (product, row_of))| {
            for (element, (product, row)) in (part * PART..).zip(product.iter_mut().zip(row_of)) {
                if *row != OUTSIDE {
                    let (diagonal, entries) = rows.row(*row);
                    let terms = entries
                        .iter()
                        .map(|(d, g)| f64::from(*g) * field[at(element, *d)]);
                    *product = diagonal * field[element] + terms.sum::<f64>();
                }
            }
        });
    }
}

/// Places (in the spacing of the level) and classes of the neighbours in a pattern.
fn neighbours_of(pattern: &[u32]) -> (Vec<[i32; 2]>, Vec<u16>) {
    let colour = pattern[0] % COLOURS;
    let neighbours = &pattern[HEAD..];
    let offset = |entry: &u32| EARLIER[colour as usize][(entry >> 16) as usize];
    (
        neighbours.iter().map(offset).collect(),
        neighbours.iter().map(|entry| class_in(*entry)).collect(),
    )
}

/// The class of every element's compliance (m/Pa).
fn classes(elasticity: &SurfaceElasticity, relief_compliance: &[f64]) -> Vec<u16> {
    let own = elasticity.coefficient([0, 0]);
    let classes = relief_compliance.iter().map(|eta| class(eta / own));
    classes.collect()
}

/// The class of compliance in the lower half of a pattern's entry.
fn class_in(entry: u32) -> u16 {
    let [_, _, high, low] = entry.to_be_bytes();
    u16::from_be_bytes([high, low])
}

/// A grid index as a signed number; grids end at 16,384 elements per side.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "indices of a grid lie far below 2³¹"
)]
fn index(index: usize) -> i32 {
    index as i32
}

/// The element at a distance in the field's index, which lies on the grid.
#[expect(
    clippy::cast_sign_loss,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "a place on the grid, below 2²⁸"
)]
fn at(element: usize, distance: i32) -> usize {
    (element as i32 + distance) as usize
}
