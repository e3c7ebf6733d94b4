//! One line on the terminal while a case is being solved.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use pellicle_contact::{Observer, Progress, Signal};

/// Shows the progress of a solution on standard error, if that is a terminal.
#[derive(Debug)]
pub struct ProgressLine {
    line: ProgressBar,
}

impl ProgressLine {
    /// A line that is there until it is dropped; it says that the coefficients come first.
    #[must_use]
    pub fn new() -> Self {
        let line = ProgressBar::new_spinner().with_message("influence coefficients");
        // The template is a constant: were it faulty, the default style would stand.
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
            line.set_style(style);
        }
        line.enable_steady_tick(Duration::from_millis(100));
        Self { line }
    }

    /// No line at all.
    #[must_use]
    pub fn hidden() -> Self {
        let line = ProgressBar::hidden();
        Self { line }
    }
}

impl Default for ProgressLine {
    fn default() -> Self {
        Self::new()
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        self.line.finish_and_clear();
    }
}

impl Observer for ProgressLine {
    fn progress(&mut self, progress: &Progress) -> Signal {
        if !self.line.is_hidden() {
            self.line.set_message(message(progress));
        }
        Signal::Continue
    }
}

fn message(progress: &Progress) -> String {
    let Progress {
        step,
        steps,
        elements,
        iteration,
        residual,
        contact_elements,
    } = progress;
    let step = step + 1;
    format!(
        "step {step}/{steps}, grid {elements} × {elements}, iteration {iteration}, \
         residual {residual:.1e}, {contact_elements} elements in contact"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_counts_steps_from_one() {
        let progress = Progress {
            step: 0,
            steps: 3,
            elements: 64,
            iteration: 5,
            residual: 1.5e-4,
            contact_elements: 120,
        };
        assert_eq!(
            message(&progress),
            "step 1/3, grid 64 × 64, iteration 5, residual 1.5e-4, 120 elements in contact"
        );
    }
}
