//! The distribution of positive numbers.

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use crate::grid::region::Region;

/// Classes of a histogram: with this many, the tail of the pressures of some hundred islands is still smooth.
const CLASSES: usize = 64;

/// Numbers counted in equal classes from 0 to the largest.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    /// The largest number, where the last class ends; 0 if there are none.
    #[serde(deserialize_with = "nan_from_null")]
    pub largest: f64,
    /// Numbers in each class.
    pub counts: Vec<usize>,
}

impl Histogram {
    /// Counts the numbers that `of_line` gives for each row of the pressure on a region, and adds them; all must be
    /// finite and not negative.
    pub(super) fn of<'a, I: Iterator<Item = f64>>(
        region: &Region,
        pressure: &'a [f64],
        of_line: impl Fn(usize, &'a [f64]) -> I + Sync,
    ) -> (Self, f64) {
        let row = |line: usize| of_line(line, &pressure[line * region.size()..][..region.size()]);
        let ranges = region.by_lines(pressure, |line, _| {
            row(line).fold((0.0, 0.0, 0_usize), |(largest, sum, count), x| {
                (f64::max(largest, x), sum + x, count + 1)
            })
        });
        let (largest, sum, count) = ranges.into_iter().fold((0.0, 0.0, 0), |all, of| {
            (f64::max(all.0, of.0), all.1 + of.1, all.2 + of.2)
        });
        if count == 0 {
            return (Self::default(), 0.0);
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 0 to the number of classes"
        )]
        let class = |x: f64| (((x / largest) * CLASSES as f64) as usize).min(CLASSES - 1);
        let lines = region.by_lines(pressure, |line, _| {
            let mut counts = [0_usize; CLASSES];
            row(line).for_each(|x| counts[class(x)] += 1);
            counts
        });
        let mut counts = vec![0; CLASSES];
        for line in lines {
            counts.iter_mut().zip(line).for_each(|(all, of)| *all += of);
        }
        (Self { largest, counts }, sum)
    }

    /// Returns how many numbers were counted.
    #[must_use]
    pub fn total(&self) -> usize {
        self.counts.iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_counted_in_equal_classes_up_to_the_largest() {
        // The largest is 64, so each number lies in the class of its integer part, except for the largest itself.
        let field = [0.5, 64.0, 7.9, 8.0, 63.5, 32.0, 32.9, 0.0, 16.0];
        let region = Region::whole(3);
        let (found, sum) = Histogram::of(&region, &field, |_, row| {
            row.iter().copied().filter(|x| *x > 0.0)
        });
        let mut counts = vec![0; CLASSES];
        for class in [0, 63, 7, 8, 63, 32, 32, 16] {
            counts[class] += 1;
        }
        assert_eq!((found.largest, found.total()), (64.0, 8));
        assert!((sum - (0.5 + 64.0 + 7.9 + 8.0 + 63.5 + 32.0 + 32.9 + 16.0)).abs() < 1e-12);
        assert_eq!(found.counts, counts);
        let other = field.map(|x| x / 1e3);
        let (same, _) = Histogram::of(&region, &other, |_, row| {
            row.iter().copied().filter(|x| *x > 0.0)
        });
        assert_eq!(same.counts, counts);
        let (none, sum) = Histogram::of(&region, &field, |_, _| std::iter::empty());
        assert_eq!((none.total(), none.largest, sum), (0, 0.0, 0.0));
    }
}
