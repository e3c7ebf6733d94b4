//! The stretches of a field outside which it is zero: sums and updates skip everything else.
//!
//! A rough surface touches on a few per cent of its elements, in islands. A sweep over the stretches that hold them
//! costs an eighth of one over all elements. Stretches begin and end with the lanes of the sums, so a sum over them
//! has the same bits as the sum over all elements.

use std::{
    ops::{Deref, Range},
    sync::Arc,
};

use super::{LANES, PART, for_parts, on_parts};

/// Ascending, disjoint stretches of a field; none crosses the border between two parts.
pub struct Stretches {
    length: usize,
    ranges: Vec<Range<usize>>,
    /// For each part the number of stretches before it, and then the number of all.
    before: Vec<usize>,
}

impl Stretches {
    /// All of a field.
    pub fn all(length: usize) -> Self {
        let ends = |part: usize| part * PART..((part + 1) * PART).min(length);
        Self::from_parts(length, |part| vec![ends(part)])
    }

    /// None of a field.
    pub fn none(length: usize) -> Self {
        Self::from_parts(length, |_| Vec::new())
    }

    /// The stretches that hold all elements of a mask.
    pub fn around(mask: &[bool]) -> Self {
        let (elements, rest) = mask.as_chunks::<LANES>();
        let holds = |chunk: usize| match elements.get(chunk) {
            Some(elements) => *elements != [false; LANES],
            None => rest.contains(&true),
        };
        Self::from_parts(mask.len(), |part| {
            let (first, end) = (part * PART, ((part + 1) * PART).min(mask.len()));
            let mut ranges: Vec<Range<usize>> = Vec::new();
            for chunk in (first / LANES..end.div_ceil(LANES)).filter(|chunk| holds(*chunk)) {
                let (start, end) = (chunk * LANES, ((chunk + 1) * LANES).min(mask.len()));
                match ranges.last_mut() {
                    Some(last) if last.end == start => last.end = end,
                    _ => ranges.push(start..end),
                }
            }
            ranges
        })
    }

    fn from_parts(length: usize, of_part: impl Fn(usize) -> Vec<Range<usize>> + Sync) -> Self {
        let ranges = for_parts(length, &of_part);
        let mut before = vec![0];
        for ranges in &ranges {
            before.push(before[before.len() - 1] + ranges.len());
        }
        Self {
            length,
            ranges: ranges.into_iter().flatten().collect(),
            before,
        }
    }

    /// The stretches of one part.
    fn of_part(&self, part: usize) -> &[Range<usize>] {
        &self.ranges[self.before[part]..self.before[part + 1]]
    }

    /// Returns the results of `of_part` for the stretches of each part, in order.
    pub fn by_parts<T: Send>(&self, of_part: impl Fn(&[Range<usize>]) -> T + Sync) -> Vec<T> {
        for_parts(self.length, &|part| of_part(self.of_part(part)))
    }

    /// `Σ aᵢ bᵢ`.
    pub fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        self.sum_of(a, b, |a, b| a * b)
    }

    /// `Σ aᵢ`.
    pub fn sum(&self, a: &[f64]) -> f64 {
        self.sum_of(a, a, |a, _| a)
    }

    fn sum_of(&self, a: &[f64], b: &[f64], term: impl Fn(f64, f64) -> f64 + Sync) -> f64 {
        let parts = self.by_parts(|ranges| {
            let (mut sums, mut last) = ([0.0; LANES], 0.0);
            for range in ranges {
                let (a, a_rest) = a[range.clone()].as_chunks::<LANES>();
                let (b, b_rest) = b[range.clone()].as_chunks::<LANES>();
                for (x, y) in a.iter().zip(b) {
                    for lane in 0..LANES {
                        sums[lane] += term(x[lane], y[lane]);
                    }
                }
                last += a_rest
                    .iter()
                    .zip(b_rest)
                    .map(|(x, y)| term(*x, *y))
                    .sum::<f64>();
            }
            sums.iter().sum::<f64>() + last
        });
        parts.iter().sum()
    }

    /// Whether a pair of elements satisfies a condition.
    pub fn any(&self, a: &[f64], b: &[f64], holds: impl Fn(f64, f64) -> bool + Sync) -> bool {
        let parts = self.by_parts(|ranges| {
            let mut pairs = ranges
                .iter()
                .flat_map(|range| a[range.clone()].iter().zip(&b[range.clone()]));
            pairs.any(|(a, b)| holds(*a, *b))
        });
        parts.contains(&true)
    }

    /// Applies `rule` to every element.
    pub fn each(&self, y: &mut [f64], rule: impl Fn(&mut f64) + Sync) {
        self.on_each(y, |y, _| y.iter_mut().for_each(&rule));
    }

    /// `y ← y + α x`.
    pub fn add_scaled(&self, y: &mut [f64], alpha: f64, x: &[f64]) {
        self.update(y, x, |y, x| *y += alpha * x);
    }

    /// Applies `rule` to every pair of elements.
    pub fn update<T: Sync>(&self, y: &mut [f64], x: &[T], rule: impl Fn(&mut f64, &T) + Sync) {
        self.on_each(y, |y, range| {
            y.iter_mut().zip(&x[range]).for_each(|(y, x)| rule(y, x));
        });
    }

    /// Applies `rule` to every triple of elements.
    pub fn update_with<S: Sync, T: Sync>(
        &self,
        z: &mut [f64],
        x: &[S],
        y: &[T],
        rule: impl Fn(&mut f64, &S, &T) + Sync,
    ) {
        self.on_each(z, |z, range| {
            let others = x[range.clone()].iter().zip(&y[range]);
            (z.iter_mut().zip(others)).for_each(|(z, (x, y))| rule(z, x, y));
        });
    }

    /// The stretches of a field of rows of `size` elements, divided where a row ends: the row and column at which each
    /// begins, and its range.
    pub fn in_rows(&self, size: usize) -> impl Iterator<Item = ([usize; 2], Range<usize>)> {
        self.ranges.iter().flat_map(move |range| {
            let rows = range.start / size..range.end.div_ceil(size);
            rows.map(move |i| {
                let start = range.start.max(i * size);
                ([i, start - i * size], start..range.end.min((i + 1) * size))
            })
        })
    }

    /// Applies `rule` to each stretch of a field.
    fn on_each(&self, field: &mut [f64], rule: impl Fn(&mut [f64], Range<usize>) + Sync) {
        assert_eq!(field.len(), self.length, "the stretches of this field");
        on_parts(field, &|part, field| {
            for range in self.of_part(part) {
                let within = range.start - part * PART..range.end - part * PART;
                rule(&mut field[within], range.clone());
            }
        });
    }
}

/// A field that is zero outside some stretches.
pub struct SparseField {
    values: Vec<f64>,
    stretches: Arc<Stretches>,
}

impl SparseField {
    /// A field of zeros.
    pub fn new(length: usize) -> Self {
        Self {
            values: vec![0.0; length],
            stretches: Arc::new(Stretches::none(length)),
        }
    }

    /// Moves to other stretches, on which any values may then be written: zero outside them, and on them zero or what
    /// it was.
    pub fn on(&mut self, stretches: &Arc<Stretches>) -> &mut [f64] {
        if !Arc::ptr_eq(&self.stretches, stretches) {
            self.each(|value| *value = 0.0);
            self.stretches = stretches.clone();
        }
        &mut self.values
    }

    /// Applies `rule` to every element of the stretches.
    pub fn each(&mut self, rule: impl Fn(&mut f64) + Sync) {
        self.stretches.each(&mut self.values, rule);
    }

    /// Sets it to zero outside a mask.
    pub fn restrict(&mut self, mask: &[bool]) {
        (self.stretches).update(&mut self.values, mask, |value, member| {
            if !member {
                *value = 0.0;
            }
        });
    }

    /// `Σ aᵢ`.
    pub fn sum(&self) -> f64 {
        self.stretches.sum(&self.values)
    }

    /// `Σ aᵢ bᵢ`.
    pub fn dot(&self, other: &[f64]) -> f64 {
        self.stretches.dot(&self.values, other)
    }
}

impl Deref for SparseField {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{dot, sum, update_with};

    /// Fields of one part and of several, some not full.
    const LENGTHS: [usize; 5] = [0, 7, 8192, 32_769, 50_001];

    fn mask(length: usize) -> Vec<bool> {
        (0..length)
            .map(|i| i % 97 < 13 && i % 5000 > 700 || i + 1 == length)
            .collect()
    }

    fn field(length: usize, rate: f64) -> Vec<f64> {
        (0..length).map(|i| (rate * i as f64).sin()).collect()
    }

    fn within(mask: &[bool], field: Vec<f64>) -> Vec<f64> {
        let values = field.into_iter().zip(mask);
        values
            .map(|(value, member)| if *member { value } else { 0.0 })
            .collect()
    }

    #[test]
    fn a_sum_over_the_stretches_has_the_bits_of_the_sum_over_all_elements() {
        for length in LENGTHS {
            let mask = mask(length);
            let (a, b) = (within(&mask, field(length, 0.3)), field(length, 0.7));
            for stretches in [Stretches::around(&mask), Stretches::all(length)] {
                assert_eq!(stretches.sum(&a).to_bits() << 1, sum(&a).to_bits() << 1);
                assert_eq!(
                    stretches.dot(&a, &b).to_bits() << 1,
                    dot(&a, &b).to_bits() << 1
                );
            }
        }
    }

    #[test]
    fn every_element_of_a_mask_lies_on_a_stretch_and_few_others_do() {
        for length in LENGTHS {
            let mask = mask(length);
            let mut found = vec![0.0; length];
            Stretches::around(&mask).each(&mut found, |value| *value += 1.0);
            let near = |i: usize| mask[i / LANES * LANES..].iter().take(LANES).any(|m| *m);
            assert!((0..length).all(|i| found[i] == f64::from(u8::from(near(i)))));
            Stretches::none(length).each(&mut found, |_| unreachable!());
        }
    }

    #[test]
    fn stretches_are_divided_where_rows_end() {
        let mask = mask(9000);
        let stretches = Stretches::around(&mask);
        for size in [1, 7, 30, 1000] {
            let mut found = vec![0.0; mask.len()];
            for ([i, j], range) in stretches.in_rows(size) {
                assert!(range.start == i * size + j && j + range.len() <= size);
                found[range].iter_mut().for_each(|value| *value += 1.0);
            }
            let mut wanted = vec![0.0; mask.len()];
            stretches.each(&mut wanted, |value| *value += 1.0);
            assert_eq!(found, wanted, "{size}");
        }
    }

    #[test]
    fn updates_pair_elements_with_the_same_index() {
        let length = 32_769;
        let mask = mask(length);
        let stretches = Stretches::around(&mask);
        let (a, b) = (field(length, 0.3), within(&mask, field(length, 0.7)));
        let (mut found, mut wanted) = (vec![0.0; length], vec![0.0; length]);
        stretches.update_with(&mut found, &a, &b, |z, a, b| *z = a * b);
        update_with(&mut wanted, &a, &b, |z, a, b| *z = a * b);
        assert_eq!(found, wanted);
        stretches.add_scaled(&mut found, 2.0, &b);
        assert!((0..length).all(|i| found[i] == wanted[i] + 2.0 * b[i]));
        assert!(stretches.any(&b, &a, |b, a| b > a && b > 0.0));
        assert!(!stretches.any(&b, &a, |b, _| b > 1.0));
    }

    #[test]
    fn a_field_that_moves_is_zero_where_it_was() {
        let length = 9000;
        let masks = [3, 5].map(|n| (0..length).map(|i| i / 40 % n == 0).collect::<Vec<_>>());
        let [one, other] = masks.map(|mask| Arc::new(Stretches::around(&mask)));
        let mut field = SparseField::new(length);
        one.each(field.on(&one), |value| *value = 2.0);
        assert!(field[0] == 2.0 && field.sum() == field.iter().sum::<f64>());
        // On the same stretches it stays.
        assert!(field.on(&one)[0] == 2.0);
        field.on(&other);
        assert!(field.iter().all(|value| *value == 0.0));
        other.each(field.on(&other), |value| *value = 1.0);
        let even: Vec<bool> = (0..length).map(|i| i % 2 == 0).collect();
        field.restrict(&even);
        assert_eq!(field.dot(&field), field.iter().sum::<f64>());
        assert!(field[0] == 1.0 && field[1] == 0.0);
    }
}
