//! The part of a study requested on the command line, by its number or as that of a task of a batch system.

use std::env;
use std::str::FromStr;

use pellicle_study::shard::Shard;

use crate::failure::Failure;

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

#[cfg(test)]
mod tests {
    use super::*;

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
}
