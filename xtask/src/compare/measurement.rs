//! What one run of one program says of itself.

use serde::{Deserialize, Serialize};

/// One run: the line of JSON that every driver prints, Pellicle's too.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// Version of the program.
    pub version: String,
    /// Time to build everything that the solution needs, in s.
    pub setup_seconds: f64,
    /// Time from a cold start to the solution, in s.
    pub solve_seconds: f64,
    /// Products with K on the finest grid, where the program tells.
    pub products: Option<usize>,
    /// Largest resident memory of the process until the solution was there, in bytes, where the system tells.
    pub peak_bytes: Option<u64>,
    /// Whether the program says that it met its own tolerance.
    pub converged: bool,
    /// The error that the program's own tolerance bounds, where it tells.
    pub own_error: Option<f64>,
}

impl Measurement {
    /// Setup and solution together, in s.
    #[must_use]
    pub fn total_seconds(&self) -> f64 {
        self.setup_seconds + self.solve_seconds
    }

    /// The measurement in the last line of what a driver printed, if it is one.
    #[must_use]
    pub fn parse(printed: &str) -> Option<Self> {
        serde_json::from_str(printed.trim_end().lines().next_back()?).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_line_counts_and_what_is_unknown_is_null() {
        let line =
            r#"{"version": "1.2", "setup_seconds": 1.0, "solve_seconds": 2.5, "products": null,
            "peak_bytes": 1024, "converged": true, "own_error": null}"#
                .replace('\n', " ");
        let measurement = Measurement::parse(&format!("a greeting\n{line}\n")).unwrap();
        assert_eq!(measurement.total_seconds().to_string(), "3.5");
        assert_eq!(
            (measurement.products, measurement.peak_bytes),
            (None, Some(1024))
        );
        assert_eq!(Measurement::parse("a greeting"), None);
        assert_eq!(Measurement::parse(""), None);
    }
}
