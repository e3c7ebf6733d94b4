//! A part of a study: every n-th case.

use std::env;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::failure::Failure;

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
pub(super) fn mixed(number: usize) -> usize {
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

/// The part requested on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WantedShard {
    /// The given part.
    Given(Shard),
    /// The part of this task in a batch system.
    Auto,
}

impl WantedShard {
    /// Returns the part.
    ///
    /// # Errors
    ///
    /// [`Failure::NoTask`] if the part of a task is requested and the environment names none.
    pub fn resolve(self) -> Result<Shard, Failure> {
        match self {
            Self::Given(shard) => Ok(shard),
            Self::Auto => of_task(|name| env::var(name).ok()),
        }
    }
}

impl FromStr for WantedShard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text.trim() == "auto" {
            return Ok(Self::Auto);
        }
        text.parse().map(Self::Given)
    }
}

/// The part of a Slurm task, given the environment: a task of a job array, one of the tasks started by an `srun`, or
/// both, where every array task is divided among the tasks of its `srun`.
fn of_task(variable: impl Fn(&str) -> Option<String>) -> Result<Shard, Failure> {
    let number = |name: &'static str| {
        let Some(text) = variable(name) else {
            return Ok(None);
        };
        let number = text.trim().parse::<usize>();
        let found = Some(format!("{name}={text}"));
        number.map(Some).map_err(|_| Failure::NoTask { found })
    };
    let array = (
        number("SLURM_ARRAY_TASK_ID")?,
        number("SLURM_ARRAY_TASK_COUNT")?,
        number("SLURM_ARRAY_TASK_MIN")?,
        number("SLURM_ARRAY_TASK_STEP")?,
    );
    let array = match array {
        (Some(id), Some(count), Some(min), step) => {
            let step = step.unwrap_or(1).max(1);
            id.checked_sub(min).map(|place| (place / step, count))
        }
        _ => None,
    };
    let tasks = number("SLURM_PROCID")?.zip(number("SLURM_NTASKS")?);
    let none = Failure::NoTask { found: None };
    let (index, count) = match (array, tasks) {
        (Some((place, count)), Some((task, tasks))) => (place * tasks + task, count * tasks),
        (Some(one), None) | (None, Some(one)) => one,
        (None, None) => return Err(none),
    };
    if index >= count {
        let found = format!("task {} of {count}", index + 1);
        return Err(Failure::NoTask { found: Some(found) });
    }
    let index = index + 1;
    Ok(Shard { index, count })
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
    fn each_slurm_task_has_a_part_and_the_tasks_cover_all_parts() {
        let of = |variables: &[(&str, usize)]| {
            let variable = |name: &str| {
                let found = variables.iter().find(|(known, _)| *known == name);
                found.map(|(_, number)| number.to_string())
            };
            of_task(variable).map(|shard| shard.to_string())
        };
        let array = |id| {
            [
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_COUNT", 3),
                ("SLURM_ARRAY_TASK_MIN", 10),
                ("SLURM_ARRAY_TASK_STEP", 5),
            ]
        };
        let task = |id| [("SLURM_PROCID", id), ("SLURM_NTASKS", 2)];
        assert_eq!(
            [10, 15, 20].map(|id| of(&array(id)).unwrap()),
            ["1/3", "2/3", "3/3"]
        );
        assert_eq!([0, 1].map(|id| of(&task(id)).unwrap()), ["1/2", "2/2"]);
        let both = [10, 15, 20]
            .map(|id| [0, 1].map(|i| of(&[&array(id)[..], &task(i)].concat()).unwrap()));
        assert_eq!(both.concat(), ["1/6", "2/6", "3/6", "4/6", "5/6", "6/6"]);
        for wrong in [&[][..], &array(25)[..], &array(5)[..], &array(10)[..1]] {
            assert!(
                matches!(of(wrong), Err(Failure::NoTask { .. })),
                "{wrong:?}"
            );
        }
        let wrong = of_task(|_| Some("x".into())).unwrap_err().to_string();
        assert!(wrong.contains("SLURM_ARRAY_TASK_ID=x"), "{wrong}");
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
