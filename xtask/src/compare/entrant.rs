//! Who takes part: Pellicle, and every rival at each of its tolerances.

use std::path::Path;
use std::process::Command;

use super::rival::TOLERANCE;
use super::workshop::Workshop;
use super::{Problem, Rival};

/// A program at a tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Entrant {
    /// Pellicle as it comes: on a quadrant where the problem is its own mirror image.
    Pellicle,
    /// Pellicle on the whole grid, as it solves problems that are not.
    PellicleWhole,
    /// A rival at a nominal tolerance; what it bounds is the rival's own matter.
    Rival(Rival, f64),
}

/// The variables by which libraries below Python learn the number of threads.
const THREAD_VARIABLES: [&str; 4] = [
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMBA_NUM_THREADS",
];

impl Entrant {
    /// Pellicle first, in both ways, then the rivals in the order given.
    pub(super) fn all(rivals: &[Rival]) -> Vec<Self> {
        let at_tolerances = rivals.iter().flat_map(|&rival| {
            let tolerances = rival.tolerances().iter();
            tolerances.map(move |&tolerance| Self::Rival(rival, tolerance))
        });
        [Self::Pellicle, Self::PellicleWhole]
            .into_iter()
            .chain(at_tolerances)
            .collect()
    }

    /// Name of the program.
    pub(super) fn name(self) -> String {
        match self {
            Self::Pellicle => "Pellicle".to_owned(),
            Self::PellicleWhole => "Pellicle, whole grid".to_owned(),
            Self::Rival(rival, _) => rival.to_string(),
        }
    }

    /// The tolerance that it is asked for.
    pub(super) fn tolerance(self) -> f64 {
        match self {
            Self::Pellicle | Self::PellicleWhole => TOLERANCE,
            Self::Rival(_, tolerance) => tolerance,
        }
    }

    /// Whether it can use more than one thread.
    pub(super) fn is_threaded(self) -> bool {
        match self {
            Self::Pellicle | Self::PellicleWhole => true,
            Self::Rival(rival, _) => rival.is_threaded(),
        }
    }

    /// The process that solves `problem` once and writes its pressure; the reason if it is not installed.
    pub(super) fn command(
        self,
        workshop: &Workshop,
        problem: Problem,
        threads: usize,
        pressure: &Path,
    ) -> Result<Command, String> {
        let mut command = match self {
            Self::Pellicle | Self::PellicleWhole => workshop.pellicle(),
            Self::Rival(rival, _) => workshop.driver(rival)?,
        };
        command
            .arg(problem.case().to_string())
            .arg(problem.elements().to_string())
            .arg(threads.to_string())
            .arg(format!("{:e}", self.tolerance()))
            .arg(pressure)
            .args((self == Self::PellicleWhole).then_some("--whole-grid"))
            .envs(THREAD_VARIABLES.map(|variable| (variable, threads.to_string())));
        Ok(command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pellicle_is_first_and_aspher_runs_at_two_tolerances() {
        let entrants = Entrant::all(&[Rival::Tamaas, Rival::Aspher]);
        let listed: Vec<_> = entrants
            .iter()
            .map(|entrant| (entrant.name(), entrant.tolerance().to_string()))
            .collect();
        let expected = [
            ("Pellicle", 1e-8),
            ("Pellicle, whole grid", 1e-8),
            ("Tamaas", 1e-8),
            ("aspher", 1e-8),
            ("aspher", 1e-9),
        ];
        assert_eq!(
            listed,
            expected.map(|(name, tolerance)| (name.to_owned(), tolerance.to_string()))
        );
    }
}
