//! The same factor among candidates, with a separate row for each: in a contact of scattered summits few elements have
//! neighbours in the same places.

mod order;

use std::sync::{Arc, LazyLock};

use pellicle_influence::SurfaceElasticity;
use rayon::prelude::*;

use self::order::{Rank, TOP, earlier_offsets};
use super::{
    classes, index,
    local_system::{LocalSystem, NearCoefficients, Workspace},
};
use crate::grid::candidates::Candidates;
use crate::solver::gradient::working_set::WorkingSet;

/// Places searched for an element's neighbours, nearest first: with as many as in the other factor, 0.1 % of 1024 ×
/// 1024 elements take 12 products instead of 13, in a fifth more total time.
const SEARCHED: usize = 300;
/// Offsets of earlier elements, by colour.
static EARLIER: LazyLock<[Vec<[i32; 2]>; 3]> =
    LazyLock::new(|| [0, 1, 2].map(|colour| earlier_offsets(colour, SEARCHED)));
/// Rows per parallel chunk.
const PART: usize = 256;

/// The factor `G` on the working set among candidates.
pub struct ScatteredFactor {
    candidates: Arc<Candidates>,
    neighbours: usize,
    elasticity: Arc<SurfaceElasticity>,
    /// Class of `η/K₀₀` of every candidate.
    classes: Vec<u16>,
    /// Coefficients between elements of each level.
    near: Vec<NearCoefficients>,
    /// The row of every candidate; empty for those outside the set.
    rows: Vec<Row>,
    product: Vec<f64>,
}

/// A row of `G`.
#[derive(Default)]
struct Row {
    /// 0 outside the set.
    diagonal: f64,
    /// The candidates of the other entries.
    neighbours: Vec<u32>,
    entries: Vec<f32>,
}

impl ScatteredFactor {
    /// Creates a factor with `neighbours` entries per row in addition to the diagonal.
    pub fn new(
        elasticity: Arc<SurfaceElasticity>,
        candidates: Arc<Candidates>,
        relief_compliance: &[f64],
        neighbours: usize,
    ) -> Self {
        Self {
            neighbours,
            classes: classes(&elasticity, relief_compliance),
            near: (0..=TOP)
                .map(|level| NearCoefficients::of(&elasticity, level))
                .collect(),
            rows: (0..candidates.len()).map(|_| Row::default()).collect(),
            product: vec![0.0; candidates.len()],
            candidates,
            elasticity,
        }
    }

    /// Sets other compliances of the relief, in m/Pa.
    pub fn take_compliance(&mut self, relief_compliance: &[f64]) {
        self.classes = classes(&self.elasticity, relief_compliance);
        self.rows.fill_with(Row::default);
    }

    /// Recomputes the rows of elements of the set whose neighbours have changed.
    pub fn update(&mut self, set: &WorkingSet) {
        let mut rows = std::mem::take(&mut self.rows);
        let parts = rows.par_chunks_mut(PART).enumerate();
        parts.for_each_init(Workspace::default, |workspace, (part, rows)| {
            for (place, row) in rows.iter_mut().enumerate() {
                self.update_row(part * PART + place, row, set.mask(), workspace);
            }
        });
        self.rows = rows;
    }

    fn update_row(
        &self,
        candidate: usize,
        row: &mut Row,
        mask: &[bool],
        workspace: &mut Workspace,
    ) {
        if !mask[candidate] {
            *row = Row::default();
            return;
        }
        let (mut places, neighbours) = self.neighbours_of(candidate, mask);
        if row.diagonal != 0.0 && row.neighbours == neighbours {
            return;
        }
        places.push([0, 0]);
        let level = self.rank(candidate).level;
        let members = neighbours.iter().map(|other| *other as usize);
        let classes = members.chain([candidate]).map(|of| self.classes[of]);
        let system = LocalSystem {
            elasticity: &self.elasticity,
            near: &self.near[level as usize],
            level,
            places: &places,
            classes: &classes.collect::<Vec<_>>(),
            own: 1,
            to_axis: [None, None],
        };
        let entries = system.rows(workspace).iter().map(|[entry, ..]| *entry);
        row.entries = entries.collect();
        row.diagonal = f64::from(row.entries.pop().expect("the element itself"));
        row.neighbours = neighbours;
    }

    fn rank(&self, candidate: usize) -> Rank {
        let [i, j] = self.candidates.place(candidate).map(index);
        Rank::of(i, j)
    }

    /// The nearest earlier elements of the set: their offsets in the spacing of the level, and their candidate indices.
    fn neighbours_of(&self, candidate: usize, mask: &[bool]) -> (Vec<[i32; 2]>, Vec<u32>) {
        let Rank { level, colour } = self.rank(candidate);
        let place = self.candidates.place(candidate).map(index);
        let size = self.candidates.size();
        let mut found = (Vec::new(), Vec::new());
        for offset in &EARLIER[colour as usize] {
            let along = |axis: usize| {
                let i = usize::try_from(place[axis] + (offset[axis] << level)).ok()?;
                (i < size).then_some(i)
            };
            let (Some(i), Some(j)) = (along(0), along(1)) else {
                continue;
            };
            let Some(other) = self.candidates.at([i, j]).filter(|other| mask[*other]) else {
                continue;
            };
            found.0.push(*offset);
            found
                .1
                .push(u32::try_from(other).expect("an index of a grid"));
            if found.1.len() == self.neighbours {
                break;
            }
        }
        found
    }

    /// `r ← Gᵀ G r`; values outside the set become 0.
    pub fn apply(&mut self, field: &mut [f64]) {
        let parts = self
            .product
            .par_chunks_mut(PART)
            .zip(self.rows.par_chunks(PART));
        let values = &*field;
        parts.enumerate().for_each(|(part, (product, rows))| {
            let elements = product.iter_mut().zip(rows).zip(&values[part * PART..]);
            for ((product, row), value) in elements {
                let terms = row.neighbours.iter().zip(&row.entries);
                let terms = terms.map(|(other, g)| f64::from(*g) * values[*other as usize]);
                *product = row.diagonal * value + terms.sum::<f64>();
            }
        });
        field.fill(0.0);
        for (element, (row, value)) in self.rows.iter().zip(&self.product).enumerate() {
            field[element] += row.diagonal * value;
            for (other, g) in row.neighbours.iter().zip(&row.entries) {
                field[*other as usize] += f64::from(*g) * value;
            }
        }
    }
}

#[cfg(test)]
mod tests;
