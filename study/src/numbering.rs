//! Numbering of a study's cases: the value of every axis in a case.

use serde::{Deserialize, Serialize};

/// The most cases of a study; more are a mistake.
pub(crate) const MAX_CASES: usize = 1_000_000;

/// How the values of several keys are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Combine {
    /// Every value of each key with every value of the others; the last key changes fastest.
    Product,
    /// The first values of all keys, then the second values of all, and so on.
    Zip,
}

impl Combine {
    /// The words of `study.combine`.
    pub const CHOICES: [(&'static str, Self); 2] = [("product", Self::Product), ("zip", Self::Zip)];
}

/// The axes of a study and the way they combine. An axis is a key with its values, or several keys that change
/// together.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CaseNumbering {
    /// The combination of the axes.
    pub combine: Combine,
    /// Number of values of every axis.
    pub lengths: Vec<usize>,
}

impl CaseNumbering {
    /// Number of cases.
    #[must_use]
    pub fn case_count(&self) -> usize {
        match self.combine {
            Combine::Product => self.lengths.iter().fold(1, |a, b| a.saturating_mul(*b)),
            Combine::Zip => self.lengths.first().copied().unwrap_or(0),
        }
    }

    /// Whether a study may have these axes; a damaged file may claim others.
    pub(crate) fn is_possible(&self) -> bool {
        let is_zipped = self.combine == Combine::Zip;
        (1..=MAX_CASES).contains(&self.case_count())
            && !self.lengths.contains(&0)
            && !(is_zipped && self.lengths.iter().any(|length| *length != self.lengths[0]))
    }

    /// Returns the index of each axis's value in a case; all indices count from 0.
    #[must_use]
    pub fn choice(&self, case: usize) -> Vec<usize> {
        let mut rest = case;
        let digit = |count: &usize| {
            let digit = rest % count;
            if self.combine == Combine::Product {
                rest /= count;
            }
            digit
        };
        // The last axis is the last digit of the case number.
        let mut choice: Vec<_> = self.lengths.iter().rev().map(digit).collect();
        choice.reverse();
        choice
    }

    /// Returns the cases with any values of these axes and, for the other axes, the values of the case `reference`. If
    /// the axes are zipped, these are all cases, since no axis changes alone.
    pub fn around(&self, reference: usize, axes: &[usize]) -> impl Iterator<Item = usize> + use<> {
        let (lengths, strides, base) = match self.combine {
            Combine::Zip if axes.is_empty() => (Vec::new(), Vec::new(), reference),
            Combine::Zip => (vec![self.case_count()], vec![1], 0),
            Combine::Product => {
                let strides: Vec<_> = axes.iter().map(|axis| self.stride(*axis)).collect();
                let choice = self.choice(reference);
                let own = axes.iter().zip(&strides);
                let own: usize = own.map(|(axis, stride)| choice[*axis] * stride).sum();
                let lengths = axes.iter().map(|axis| self.lengths[*axis]);
                (lengths.collect(), strides, reference - own)
            }
        };
        let inner = Self {
            combine: Combine::Product,
            lengths,
        };
        (0..inner.case_count()).map(move |i| {
            let choice = inner.choice(i);
            let offsets = choice
                .iter()
                .zip(&strides)
                .map(|(digit, stride)| digit * stride);
            base + offsets.sum::<usize>()
        })
    }

    /// Number of the cases that differ only in these axes.
    pub(crate) fn places(&self, axes: &[usize]) -> usize {
        match self.combine {
            Combine::Zip if !axes.is_empty() => self.case_count(),
            _ => axes
                .iter()
                .fold(1, |places, axis| places.saturating_mul(self.lengths[*axis])),
        }
    }

    /// Returns the index of a case among those that differ only in these axes, in the order of [`Self::around`].
    #[must_use]
    pub fn place(&self, case: usize, axes: &[usize]) -> usize {
        if self.combine == Combine::Zip && !axes.is_empty() {
            return case;
        }
        let choice = self.choice(case);
        let next = |place: usize, axis: &usize| place * self.lengths[*axis] + choice[*axis];
        axes.iter().fold(0, next)
    }

    /// Distance between the cases of two neighbouring values of an axis in a product.
    fn stride(&self, axis: usize) -> usize {
        self.lengths[axis + 1..].iter().product()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbering(combine: Combine, lengths: &[usize]) -> CaseNumbering {
        let lengths = lengths.to_vec();
        CaseNumbering { combine, lengths }
    }

    #[test]
    fn neighbouring_cases_differ_in_the_named_axes_and_come_in_order() {
        let product = numbering(Combine::Product, &[2, 3, 4]);
        for reference in 0..product.case_count() {
            for axes in [&[][..], &[0], &[1], &[2], &[0, 2], &[0, 1, 2]] {
                let around: Vec<_> = product.around(reference, axes).collect();
                let places = around.iter().map(|case| product.place(*case, axes));
                assert!(places.eq(0..around.len()), "{reference} {axes:?}");
                let differs = |case: &usize| {
                    let (a, b) = (product.choice(*case), product.choice(reference));
                    (0..3).all(|axis| axes.contains(&axis) || a[axis] == b[axis])
                };
                assert!(around.iter().all(differs), "{reference} {axes:?}");
            }
        }
    }

    #[test]
    fn zipped_axes_vary_together() {
        let zip = numbering(Combine::Zip, &[5, 5]);
        assert_eq!((zip.case_count(), zip.choice(3)), (5, vec![3, 3]));
        assert!(zip.around(2, &[1]).eq(0..5));
        assert!(zip.around(2, &[]).eq(2..3));
        assert_eq!((zip.place(4, &[0]), zip.place(4, &[])), (4, 0));
    }
}
