//! The pattern of a contact: rows of elements in contact, the sides around them, and the islands that they form.
//!
//! An island is a set of elements connected by their sides. Two elements that share only a corner are two islands: the
//! two open elements beside that corner share it as well, and no pressure acts across a point. In a periodic cell
//! islands continue at the opposite rim.

use std::ops::Range;

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use crate::result::contact_field::ContactField;

/// Elements in contact as runs along the rows.
pub(super) struct ContactPattern {
    rows: Vec<Vec<Range<usize>>>,
    size: usize,
    repeats: bool,
}

/// The islands of a contact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Islands {
    /// Their number.
    pub count: usize,
    /// Area of the largest island by its elements, in m²; 0 if there are none.
    #[serde(deserialize_with = "nan_from_null")]
    pub largest_area: f64,
    /// Mean area of the islands by their elements, in m²; 0 if there are none.
    #[serde(deserialize_with = "nan_from_null")]
    pub mean_area: f64,
    /// Numbers of islands with 1 element, 2 or 3, 4 to 7, and so on up to the largest.
    pub counts_by_octave: Vec<usize>,
}

impl Islands {
    /// Describes islands of these sizes, the largest first, in elements of this area (m²).
    pub(super) fn of(sizes: &[usize], element_area: f64) -> Self {
        let octave = |size: usize| size.ilog2() as usize;
        let largest = sizes.first().copied();
        let mut counts_by_octave = vec![0; largest.map_or(0, |size| octave(size) + 1)];
        for size in sizes {
            counts_by_octave[octave(*size)] += 1;
        }
        let mean = sizes.iter().sum::<usize>() as f64 / sizes.len().max(1) as f64;
        Self {
            count: sizes.len(),
            largest_area: largest.unwrap_or_default() as f64 * element_area,
            mean_area: mean * element_area,
            counts_by_octave,
        }
    }
}

impl ContactPattern {
    pub fn of(field: &ContactField<'_>) -> Self {
        Self {
            rows: field.region.by_lines(field.pressure, |_, row| runs(row)),
            size: field.region.size(),
            repeats: field.region.repeats(),
        }
    }

    /// First and last element in contact of each row that has any.
    pub fn extents(&self) -> impl Iterator<Item = (usize, Range<usize>)> {
        let rows = self.rows.iter().enumerate();
        rows.filter_map(|(i, row)| Some((i, row.first()?.start..row.last()?.end)))
    }

    /// Pairs of adjacent rows, including the last and the first of a periodic cell.
    fn neighbours(&self) -> impl Iterator<Item = [usize; 2]> {
        let last = self.rows.len() - 1;
        let around = (self.repeats && last > 0).then_some([last, 0]);
        (0..last).map(|i| [i, i + 1]).chain(around)
    }

    /// Whether a row's last run continues with its first in the next cell.
    fn is_joined(&self, row: &[Range<usize>]) -> bool {
        let touches =
            |run: &Range<usize>, next: &Range<usize>| run.end == self.size && next.start == 0;
        self.repeats && (row.last().zip(row.first())).is_some_and(|(run, next)| touches(run, next))
    }

    /// Counts the sides between elements in contact and others, or the rim of a domain.
    pub fn sides(&self) -> usize {
        let ends = self
            .rows
            .iter()
            .map(|row| 2 * row.len() - 2 * usize::from(self.is_joined(row)));
        let length = |row: &[Range<usize>]| row.iter().map(Range::len).sum::<usize>();
        let between = self.neighbours().map(|[i, k]| {
            let common: usize = overlaps(&self.rows[i], &self.rows[k])
                .map(|[_, _, n]| n)
                .sum();
            length(&self.rows[i]) + length(&self.rows[k]) - 2 * common
        });
        let rim = match (&self.rows[..], self.repeats) {
            (_, true) | ([], _) => 0,
            ([first, .., last], false) => length(first) + length(last),
            ([only], false) => 2 * length(only),
        };
        ends.sum::<usize>() + between.sum::<usize>() + rim
    }

    /// Finds the numbers of elements of the islands, the largest first.
    pub fn island_sizes(&self) -> Vec<usize> {
        let firsts: Vec<usize> = (self.rows.iter())
            .scan(0, |first, row| {
                Some(std::mem::replace(first, *first + row.len()))
            })
            .collect();
        let runs: Vec<usize> = self.rows.iter().flatten().map(Range::len).collect();
        let mut sets = DisjointSets::new(runs.len());
        for (row, first) in self.rows.iter().zip(&firsts) {
            if self.is_joined(row) {
                sets.join(*first, first + row.len() - 1);
            }
        }
        for [i, k] in self.neighbours() {
            for [one, other, _] in overlaps(&self.rows[i], &self.rows[k]) {
                sets.join(firsts[i] + one, firsts[k] + other);
            }
        }
        let mut sizes = vec![0; runs.len()];
        for (run, length) in runs.into_iter().enumerate() {
            sizes[sets.root(run)] += length;
        }
        sizes.retain(|size| *size > 0);
        sizes.sort_unstable_by(|one, other| other.cmp(one));
        sizes
    }
}

/// Finds the runs of elements in contact in a row.
fn runs(row: &[f64]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (j, _) in row.iter().enumerate().filter(|(_, p)| **p > 0.0) {
        match runs.last_mut() {
            Some(run) if run.end == j => run.end = j + 1,
            _ => runs.push(j..j + 1),
        }
    }
    runs
}

/// Returns the pairs of runs of two rows that share columns: the index of either run, and the number of shared columns.
fn overlaps<'a>(
    one: &'a [Range<usize>],
    other: &'a [Range<usize>],
) -> impl Iterator<Item = [usize; 3]> + 'a {
    let (mut i, mut k) = (0, 0);
    std::iter::from_fn(move || {
        while let (Some(a), Some(b)) = (one.get(i), other.get(k)) {
            let common = a.end.min(b.end).saturating_sub(a.start.max(b.start));
            let pair = [i, k, common];
            if a.end <= b.end {
                i += 1;
            } else {
                k += 1;
            }
            if common > 0 {
                return Some(pair);
            }
        }
        None
    })
}

/// Sets that are joined pair by pair; each is identified by one of its members.
struct DisjointSets {
    parents: Vec<usize>,
}

impl DisjointSets {
    fn new(members: usize) -> Self {
        Self {
            parents: (0..members).collect(),
        }
    }

    fn root(&mut self, mut member: usize) -> usize {
        while self.parents[member] != member {
            // Halves the path for later searches.
            self.parents[member] = self.parents[self.parents[member]];
            member = self.parents[member];
        }
        member
    }

    fn join(&mut self, one: usize, other: usize) {
        let [one, other] = [one, other].map(|member| self.root(member));
        let (low, high) = (one.min(other), one.max(other));
        self.parents[high] = low;
    }
}

#[cfg(test)]
mod tests;
