//! The certificate of `xtask/compare/certificate.py`: the same for every program.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::Problem;
use super::process::{Ending, run_within};
use crate::XtaskError;

/// How well a pressure solves the problem; lengths relative to the Hertzian approach `d_H`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// `Σ p |g| / (d_H Σ p)`.
    pub complementarity: f64,
    /// `max |g| / d_H` over the elements with `p > 0`.
    pub gap_in_contact: f64,
    /// `max(0, −min g) / d_H` over all elements.
    pub overlap: f64,
    /// `|h² Σ p − F| / F`.
    pub load: f64,
    /// Smallest pressure.
    pub min_pressure: f64,
    /// Penetration `Σ p v / Σ p`.
    pub penetration: f64,
    /// Elements with `p > 0`.
    pub contact_elements: usize,
}

/// The longest that one product may take.
const PATIENCE: Duration = Duration::from_mins(10);

impl Certificate {
    /// The largest of the four lines.
    #[must_use]
    pub fn worst(&self) -> f64 {
        let lines = [self.gap_in_contact, self.overlap, self.load];
        lines.into_iter().fold(self.complementarity, f64::max)
    }

    /// Judges the pressure in a `.npy` file by the script that `command` runs; the complaint if it cannot.
    ///
    /// # Errors
    /// A script that cannot be started; a log that cannot be written.
    pub fn judge(
        mut command: Command,
        problem: Problem,
        pressure: &Path,
    ) -> Result<Result<Self, String>, XtaskError> {
        command
            .arg(problem.case().to_string())
            .arg(problem.elements().to_string())
            .arg(pressure);
        let log = pressure.with_extension("log");
        Ok(match run_within(&mut command, PATIENCE, &log)? {
            Ending::Succeeded(printed) => {
                serde_json::from_str(&printed).map_err(|error| error.to_string())
            }
            Ending::Failed(complaint) => Err(complaint),
            Ending::Stopped => Err(format!("no certificate after {} s", PATIENCE.as_secs())),
        })
    }
}
