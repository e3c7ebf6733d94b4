//! A part of a study: every n-th case.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Part `index` of `count` parts, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Number of the part, from 1.
    pub index: usize,
    /// Number of parts.
    pub count: usize,
}

impl Shard {
    /// The undivided study.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Whether a case, counted from 0, belongs to this part.
    ///
    /// Each of `count` successive cases goes to another part, so the parts are equally large. Their order is irregular,
    /// so that no part gets all cases of one value, such as the large grids.
    #[must_use]
    pub fn holds(self, case: usize) -> bool {
        Self::of(case, self.count) == self
    }

    /// Returns the part, of `count` parts, to which a case, counted from 0, belongs.
    #[must_use]
    pub fn of(case: usize, count: usize) -> Self {
        let (round, place) = (case / count, case % count);
        let index = (place + mixed(round) % count) % count + 1;
        Self { index, count }
    }

    /// Returns the number of cases of this part in a study of `len` cases.
    #[must_use]
    pub fn count_of(self, len: usize) -> usize {
        let whole_rounds = len / self.count;
        let rest = whole_rounds * self.count..len;
        whole_rounds + rest.filter(|case| self.holds(*case)).count()
    }

    /// Returns the name of a file of this part: `results.csv`, or `results-2-of-8.csv`.
    #[must_use]
    pub fn file(self, stem: &str, ending: &str) -> String {
        format!("{stem}{}.{ending}", self.suffix())
    }

    /// Returns the suffix of the names of its files, `-2-of-8`; empty for the whole study.
    #[must_use]
    pub fn suffix(self) -> String {
        match self {
            Self::WHOLE => String::new(),
            Self { index, count } => format!("-{index}-of-{count}"),
        }
    }
}

/// A pseudorandom number with 32 bits: the finalizer of `SplitMix64` (Steele, Lea, Flood 2014).
#[expect(clippy::cast_possible_truncation, reason = "any 32 bits will do")]
pub(crate) fn mixed(number: usize) -> usize {
    let mut z = (number as u64).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) as u32 as usize
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let both = text.split_once('/');
        let both = both.and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
        both.filter(|(index, count)| (1..=*count).contains(index))
            .map(|(index, count)| Self { index, count })
            .ok_or_else(|| "wanted part i of n parts, from 1, such as 2/8, or auto".into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_belongs_to_exactly_one_part() {
        for count in 1..9 {
            for case in 0..40 {
                let holds = |index: &usize| {
                    Shard {
                        index: *index,
                        count,
                    }
                    .holds(case)
                };
                assert_eq!((1..=count).filter(holds).count(), 1, "{case} of {count}");
            }
        }
    }

    #[test]
    fn parts_are_of_equal_size_and_none_holds_all_cases_of_one_value() {
        for index in 1..=4 {
            let shard = Shard { index, count: 4 };
            let held: Vec<_> = (0..400).filter(|case| shard.holds(*case)).collect();
            assert_eq!(held.len(), 100);
            for len in 0..20 {
                let held = (0..len).filter(|case| shard.holds(*case)).count();
                assert_eq!(shard.count_of(len), held, "{shard} of {len}");
            }
            for value in 0..4 {
                let count = held.iter().filter(|case| *case % 4 == value).count();
                // A quarter of 100, within three standard deviations.
                assert!((12..=38).contains(&count), "{count}");
            }
        }
    }

    #[test]
    fn parts_are_numbered_from_one() {
        assert_eq!("2/8".parse(), Ok(Shard { index: 2, count: 8 }));
        for text in ["0/8", "9/8", "2", "a/b", "", "1/0", "-1/2"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
        let file = |text: &str| text.parse::<Shard>().unwrap().file("results", "csv");
        assert_eq!(
            (file("1/1"), file("2/8")),
            ("results.csv".into(), "results-2-of-8.csv".into())
        );
    }
}
