//! One line of the comparison.

use serde::Serialize;

use super::{Case, Certificate, Measurement};

/// One program on one problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Which problem.
    pub case: Case,
    /// Elements per side.
    pub elements: usize,
    /// Number of threads.
    pub threads: usize,
    /// Name of the program.
    pub program: String,
    /// The tolerance that it was asked for.
    pub tolerance: f64,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of a program on a problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It ended with a pressure.
    Solved(Box<Solved>),
    /// It was stopped after so many seconds.
    Stopped(u64),
    /// It is not installed, with the reason.
    Missing(String),
    /// It ended without a pressure, with its complaint.
    Failed(String),
    /// It cannot use several threads, so it was not run.
    Serial,
}

/// The runs of a program that ended with a pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Solved {
    /// The run of the median total time; of an even number, the slower of the two in the middle.
    pub median: Measurement,
    /// Total times of all runs, in s, in the order of the runs.
    pub seconds: Vec<f64>,
    /// Certificate of the last run; none if it could not be computed.
    pub certificate: Option<Certificate>,
    /// Why there is no certificate.
    pub uncertified: Option<String>,
    /// Its median total time over Pellicle's on the same problem with as many threads.
    pub times_pellicle: Option<f64>,
}

impl Solved {
    /// The summary of `runs`, whose last one got the certificate or the reason why it got none; none without a run.
    #[must_use]
    pub fn of(
        mut runs: Vec<Measurement>,
        certificate: Result<Certificate, String>,
    ) -> Option<Self> {
        let (certificate, uncertified) = match certificate {
            Ok(certificate) => (Some(certificate), None),
            Err(reason) => (None, Some(reason)),
        };
        let seconds = runs.iter().map(Measurement::total_seconds).collect();
        runs.sort_by(|a, b| a.total_seconds().total_cmp(&b.total_seconds()));
        let middle = runs.len() / 2;
        Some(Self {
            median: runs.into_iter().nth(middle)?,
            seconds,
            certificate,
            uncertified,
            times_pellicle: None,
        })
    }

    /// Median time of setup and solution, in s.
    #[must_use]
    pub fn total_seconds(&self) -> f64 {
        self.median.total_seconds()
    }

    /// Shortest time of setup and solution, in s: far below the median where the machine was busy.
    #[must_use]
    pub fn fastest_seconds(&self) -> f64 {
        self.seconds.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// Sets every row's time against that of the first, Pellicle's.
pub(super) fn relate(rows: &mut [Row]) {
    let time = |row: &Row| match &row.outcome {
        Outcome::Solved(solved) => Some(solved.total_seconds()),
        _ => None,
    };
    let Some(pellicle) = rows.first().and_then(time) else {
        return;
    };
    for row in rows {
        if let Outcome::Solved(solved) = &mut row.outcome {
            solved.times_pellicle = Some(solved.total_seconds() / pellicle);
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in super::super) fn measurement(seconds: f64) -> Measurement {
        Measurement {
            version: "1.0".to_owned(),
            setup_seconds: 0.0,
            solve_seconds: seconds,
            products: Some(7),
            peak_bytes: Some(1 << 20),
            converged: true,
            own_error: None,
        }
    }

    pub(in super::super) fn row(program: &str, outcome: Outcome) -> Row {
        Row {
            case: Case::Hertz,
            elements: 512,
            threads: 1,
            program: program.to_owned(),
            tolerance: 1e-8,
            outcome,
        }
    }

    fn solved(seconds: &[f64]) -> Solved {
        let runs = seconds.iter().copied().map(measurement).collect();
        Solved::of(runs, Err("no Python".into())).unwrap()
    }

    #[test]
    fn the_median_run_counts_and_all_times_are_kept_in_order() {
        let odd = solved(&[5.0, 1.0, 2.0]);
        assert_eq!(odd.median, measurement(2.0));
        assert_eq!(odd.seconds, [5.0, 1.0, 2.0]);
        assert_eq!(solved(&[1.0, 4.0]).median, measurement(4.0));
        assert_eq!(Solved::of(Vec::new(), Err(String::new())), None);
    }

    #[test]
    fn times_are_related_to_pellicles() {
        let outcome = |seconds| Outcome::Solved(Box::new(solved(&[seconds])));
        let mut rows = [
            row("Pellicle", outcome(2.0)),
            row("a", Outcome::Serial),
            row("b", outcome(8.0)),
        ];
        relate(&mut rows);
        let Outcome::Solved(slower) = &rows[2].outcome else {
            panic!("{:?}", rows[2]);
        };
        assert_eq!(slower.times_pellicle, Some(4.0));
    }
}
