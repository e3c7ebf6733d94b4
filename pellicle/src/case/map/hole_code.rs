//! Heights that stand for missing ones: -9999, -32768, 1e30, or any one value far from all others.
//!
//! Programs write a hole as a number where their format has no other way. It is exactly the same number in each hole,
//! and far outside the range of the heights, so that none of them is taken for a hole.

use std::fmt;

use crate::display::significant;

/// Distance from the other heights over their range from which a value that repeats is a code.
const FAR: f64 = 100.0;

/// The same from which a usual code is one, since no height is exactly that by chance, and any other value may be one:
/// the ground between pillars is as far from their tops.
const APART: f64 = 1.0;

/// The same from which a usual code may be one; nearer, an end of an integer type is where an instrument saturates.
const BESIDE: f64 = 0.1;

/// The largest part of the heights that are holes; of a plateau there are more.
const MOST: f64 = 0.1;

/// From this size on a number is no height in any usual unit: 1e10 pm is a centimetre.
const HUGE: f64 = 1e10;

/// From this size on a number is no reading in any unit: 1e30 fN is the weight of a mountain.
const ABSURD: f64 = 1e30;

/// A value that stands for missing heights, in the unit of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HoleCode {
    value: f64,
    /// How many heights have it.
    count: usize,
    /// The lowest and the highest of the other heights.
    others: [f64; 2],
}

impl HoleCode {
    /// The codes among the heights: the usual ones, or a value far from the others.
    #[must_use]
    pub fn among(heights: &[f64]) -> Vec<Self> {
        let codes = usual(heights, APART);
        if codes.is_empty() {
            outlier(heights, FAR).into_iter().collect()
        } else {
            codes
        }
    }

    /// The usual codes among the readings of an instrument.
    #[must_use]
    pub fn usual_among(readings: &[f64]) -> Vec<Self> {
        let mut codes = usual(readings, APART);
        codes.retain(|code| code.value.abs() < HUGE || code.value.abs() >= ABSURD);
        codes
    }

    /// A value that may be a code, or else a plateau.
    #[must_use]
    pub fn perhaps_among(heights: &[f64]) -> Option<Self> {
        let usual = usual(heights, BESIDE).into_iter().next();
        usual.or_else(|| outlier(heights, APART))
    }

    /// Whether a height is a hole.
    #[must_use]
    pub fn is_at(self, height: f64) -> bool {
        is_same(self.value, height)
    }

    /// Whether it is more than so many ranges of the others, which differ, from these.
    fn is_far(self, times: f64) -> bool {
        let [lowest, highest] = self.others;
        let gap = (self.value - highest).max(lowest - self.value);
        highest > lowest && gap > times * (highest - lowest)
    }
}

impl fmt::Display for HoleCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { value, count, .. } = self;
        let [lowest, highest] = self.others.map(|height| significant(height, 4));
        let value = if value.abs() < HUGE {
            value.to_string()
        } else {
            format!("{value:e}")
        };
        write!(
            f,
            "{count} are {value}, far from the others ({lowest} .. {highest}), as holes are written"
        )
    }
}

/// Whether a number is one by which programs mark holes: at least three nines, an end of an integer type, or huge.
fn is_usual(height: f64) -> bool {
    let size = height.abs();
    let is_nines = (3..10).any(|digits| is_same(size + 1.0, 10_f64.powi(digits)));
    let ends = [15, 16, 31, 32].map(|bits| 2_f64.powi(bits));
    let is_end = |end: f64| is_same(height, -end) || is_same(height, end - 1.0);
    is_nines || size >= HUGE || ends.into_iter().any(is_end)
}

/// Whether two numbers are exactly the same.
fn is_same(one: f64, other: f64) -> bool {
    (one - other).abs() <= 0.0
}

/// The usual codes that are more than so many ranges of the other heights from these.
fn usual(heights: &[f64], times: f64) -> Vec<HoleCode> {
    let finite = heights.iter().copied().filter(|height| height.is_finite());
    let (mut suspects, others): (Vec<_>, Vec<_>) = finite.partition(|height| is_usual(*height));
    suspects.sort_by(f64::total_cmp);
    let others = range(&others);
    let codes = suspects.chunk_by(|one, next| is_same(*one, *next));
    let codes = codes.map(|same| HoleCode {
        value: same[0],
        count: same.len(),
        others,
    });
    codes.filter(|code| code.is_far(times)).collect()
}

/// The lowest or the highest value, if it repeats on a small part of the heights and is more than so many of their
/// ranges from the others.
fn outlier(heights: &[f64], times: f64) -> Option<HoleCode> {
    let finite: Vec<_> = heights
        .iter()
        .copied()
        .filter(|height| height.is_finite())
        .collect();
    let ends = range(&finite);
    ends.into_iter().find_map(|value| {
        let others = finite.iter().copied();
        let others: Vec<_> = others.filter(|height| !is_same(*height, value)).collect();
        let count = finite.len() - others.len();
        let code = HoleCode {
            value,
            count,
            others: range(&others),
        };
        let is_few = count > 1 && count as f64 <= MOST * finite.len() as f64;
        (is_few && code.is_far(times)).then_some(code)
    })
}

/// The lowest and the highest height.
fn range(heights: &[f64]) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    heights.iter().fold(ends, |[lowest, highest], height| {
        [lowest.min(*height), highest.max(*height)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 400 heights between 10 and 20, of which every so manieth is this value.
    fn heights(every: usize, value: f64) -> Vec<f64> {
        let height = |n: usize| match n % every {
            3 => value,
            _ => 15.0 + 5.0 * (n as f64).sin(),
        };
        (0..400).map(height).collect()
    }

    #[test]
    fn a_usual_code_and_a_far_value_that_repeats_are_holes() {
        for value in [
            -9999.0,
            999.0,
            -32768.0,
            65535.0,
            1e30,
            -f64::MAX,
            1.70141e38,
            -3456.7,
        ] {
            let found = HoleCode::among(&heights(20, value));
            assert_eq!(found.len(), 1, "{value}");
            assert_eq!((found[0].value, found[0].count), (value, 20));
        }
        // In another unit, and once.
        let small: Vec<_> = heights(20, -9999.0)
            .iter()
            .map(|height| height * 1e-9)
            .collect();
        assert_eq!(HoleCode::among(&small)[0].count, 20);
        assert_eq!(HoleCode::among(&heights(390, -9999.0))[0].count, 2);
        let both: Vec<_> = heights(20, 1e30).into_iter().chain([-9999.0]).collect();
        assert_eq!(HoleCode::among(&both).len(), 2);
    }

    #[test]
    fn plateaus_outliers_and_large_heights_are_none() {
        let mut spike = heights(400, 15.0);
        spike[7] = 1e5;
        let steps: Vec<_> = (0..400).map(|n| f64::from(n % 20 / 10)).collect();
        let large: Vec<_> = heights(20, 14.0)
            .iter()
            .map(|height| height * 1e10)
            .collect();
        let through: Vec<_> = (0..400).map(|n| f64::from(n) * 5.0 - 999.0).collect();
        for none in [
            spike,
            steps,
            large,
            through,
            heights(3, 900.0),
            heights(2, 0.0),
            vec![-9999.0; 9],
            vec![],
        ] {
            assert_eq!(
                HoleCode::among(&none),
                [],
                "{:?}",
                &none[..none.len().min(9)]
            );
        }
        let wide = heights(20, 99.0).into_iter();
        let saturated = wide.map(|height| ((height - 15.0) * 5e3).min(32767.0));
        let saturated: Vec<_> = saturated.collect();
        assert_eq!(HoleCode::among(&saturated), []);
        let zeros = heights(20, -40.0);
        assert_eq!(HoleCode::among(&zeros), []);
        assert_eq!(
            HoleCode::perhaps_among(&zeros).map(|code| code.count),
            Some(20)
        );
        assert_eq!(HoleCode::perhaps_among(&heights(20, 5.0)), None);
        // A code that is as near as the heights are far from each other.
        let high: Vec<_> = (0..400).map(|n| f64::from(n) * 40.0).collect();
        let holes = [&high[..], &[-9999.0; 3]].concat();
        assert_eq!(HoleCode::among(&holes), []);
        assert_eq!(
            HoleCode::perhaps_among(&holes).map(|code| code.count),
            Some(3)
        );
    }
}
