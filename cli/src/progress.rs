//! One line on the terminal while a case is being solved.

pub mod find;
pub mod study;

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use pellicle::{Event, Monitor};
use pellicle_contact::{Progress, Signal};

use crate::interrupt;

/// Shows the progress of a solution on standard error if it is a terminal, and passes Ctrl-C on.
#[derive(Debug)]
pub struct ProgressLine {
    /// None if nothing is shown.
    line: Option<ProgressBar>,
    /// Texts shown before and after the progress.
    around: [String; 2],
    clock: TimeLeft,
    keeps_steps: bool,
}

impl ProgressLine {
    /// Returns a line that is shown until dropped; it begins with the coefficients.
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Self::on(ProgressBar::new_spinner(), Default::default(), tolerance)
    }

    /// Returns a line that is never shown.
    #[must_use]
    pub fn hidden() -> Self {
        Self {
            line: None,
            around: Default::default(),
            clock: TimeLeft::start(1.0),
            keeps_steps: false,
        }
    }

    /// Returns the line for a path whose finished steps are written even if the user stops it.
    #[must_use]
    pub fn keeping_steps(mut self) -> Self {
        self.keeps_steps = true;
        self
    }

    /// Returns a function that shows how many files of the results are written.
    pub fn writing(&self) -> impl Fn(usize, usize) + Sync {
        let line = self.line.clone();
        move |done, total| {
            if let Some(line) = &line {
                line.set_message(writing(done, total));
            }
        }
    }

    /// Returns the line for the search for stresses.
    #[must_use]
    pub fn searching(&self) -> SearchLine {
        SearchLine(self.line.clone())
    }

    /// Returns a progress line drawn on `line`, with these texts before and after the progress.
    #[must_use]
    pub fn on(line: ProgressBar, around: [String; 2], tolerance: f64) -> Self {
        let [before, behind] = &around;
        line.set_message(format!("{before}influence coefficients{behind}"));
        // The template is a constant; if it were invalid, the default style would remain.
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
            line.set_style(style);
        }
        line.enable_steady_tick(Duration::from_millis(100));
        Self {
            line: Some(line),
            around,
            clock: TimeLeft::start(tolerance),
            keeps_steps: false,
        }
    }
}

/// A progress line for the search for stresses.
#[derive(Debug, Clone)]
pub struct SearchLine(Option<ProgressBar>);

impl Monitor for SearchLine {
    fn told(&mut self, event: Event<'_>) -> Signal {
        let message = match event {
            Event::StressesOf(step, steps) => format!("stresses of step {}/{steps}", step + 1),
            Event::CriticalLoads => "critical loads".into(),
            Event::Iteration(progress) if shown(self.0.as_ref()).is_some() => {
                format!("critical loads: {}", message(progress, None))
            }
            Event::Iteration(_) | Event::WaitsForMemory => return interrupt::signal(),
        };
        if let Some(line) = &self.0 {
            line.set_message(message);
        }
        interrupt::signal()
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if let Some(line) = &self.line {
            line.finish_and_clear();
        }
    }
}

impl Monitor for ProgressLine {
    fn told(&mut self, event: Event<'_>) -> Signal {
        let Event::Iteration(progress) = event else {
            return interrupt::signal();
        };
        if self.keeps_steps && progress.finished > 0 {
            interrupt::hold();
        }
        if let Some(line) = shown(self.line.as_ref()) {
            let left = self.clock.remaining(progress, Instant::now());
            let ([before, behind], message) = (&self.around, message(progress, left));
            line.set_message(format!("{before}{message}{behind}"));
        }
        interrupt::signal()
    }
}

/// The line, if it is visible.
fn shown(line: Option<&ProgressBar>) -> Option<&ProgressBar> {
    line.filter(|line| !line.is_hidden())
}

fn message(progress: &Progress, left: Option<Duration>) -> String {
    let Progress {
        finished,
        steps,
        elements,
        iteration,
        residual,
        ..
    } = progress;
    let step = finished + 1;
    let left = left.map_or_else(String::new, |left| format!(", {} left", in_words(left)));
    format!(
        "step {step}/{steps}, grid {elements} × {elements}, iteration {iteration}, \
         residual {residual:.1e}{left}"
    )
}

fn writing(done: usize, total: usize) -> String {
    format!("writing results, {done} of {total} fields and pictures")
}

/// A time in words: `40 s`, `3 min`, `2.5 h`.
#[must_use]
pub fn in_words(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 99.5 {
        format!("{} s", seconds.ceil().max(1.0))
    } else if seconds < 5970.0 {
        format!("{} min", (seconds / 60.0).round())
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

/// Estimates the time left from the work done so far.
///
/// Each remaining step is assumed to take as long as the finished ones on average. Within a step only the finest grid
/// counts, which takes nearly all the time; its residual is assumed to fall by the same factor in every iteration.
#[derive(Debug, Clone, Copy)]
struct TimeLeft {
    tolerance: f64,
    /// The start of the first step.
    start: Option<Instant>,
    /// Start of the present step, and the number of steps finished by then; steps solved together count as one.
    step: (Instant, usize),
    /// The first iteration on the present grid.
    level: Mark,
}

/// The first iteration on a grid.
#[derive(Debug, Clone, Copy)]
struct Mark {
    elements: usize,
    iteration: usize,
    residual: f64,
    time: Instant,
}

impl TimeLeft {
    fn start(tolerance: f64) -> Self {
        let now = Instant::now();
        Self {
            tolerance,
            start: None,
            step: (now, usize::MAX),
            level: Mark {
                elements: 0,
                iteration: 0,
                residual: 1.0,
                time: now,
            },
        }
    }

    /// Returns the time left at this progress; none while it cannot be estimated.
    fn remaining(&mut self, progress: &Progress, now: Instant) -> Option<Duration> {
        let start = *self.start.get_or_insert(now);
        let finished = progress.finished;
        let new_step = self.step.1 != finished;
        if new_step {
            self.step = (now, finished);
        }
        if new_step || self.level.elements != progress.elements {
            self.level = Mark {
                elements: progress.elements,
                iteration: progress.iteration,
                residual: progress.residual,
                time: now,
            };
        }
        let of_this = self.of_this_grid(progress, now);
        if finished == 0 {
            return if progress.steps == 1 { of_this } else { None };
        }
        let each = (self.step.0 - start).div_f64(finished as f64);
        let to_come = each.mul_f64((progress.steps - finished) as f64);
        Some(to_come.saturating_sub(now - self.step.0))
    }

    fn of_this_grid(&self, progress: &Progress, now: Instant) -> Option<Duration> {
        // ln r₀/r gained in the iterations so far, ln r/tolerance still to go
        let gained = (self.level.residual / progress.residual).ln();
        let to_gain = (progress.residual / self.tolerance).ln().max(0.0);
        let share = to_gain / gained;
        let done = progress.iteration.saturating_sub(self.level.iteration);
        let is_reliable = done >= 3 && gained > 0.0 && share.is_finite();
        is_reliable.then(|| (now - self.level.time).mul_f64(share.min(1e6)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn progress(step: usize, steps: usize, iteration: usize, residual: f64) -> Progress {
        Progress {
            step,
            finished: step,
            steps,
            elements: 64,
            iteration,
            residual,
            working_set: 120,
            working_set_change: 3,
        }
    }

    fn after(start: Instant, seconds: f64) -> Instant {
        start + Duration::from_secs_f64(seconds)
    }

    #[test]
    fn progress_numbers_steps_from_one() {
        let left = Some(Duration::from_secs(12));
        assert_eq!(
            message(&progress(0, 3, 5, 1.5e-4), left),
            "step 1/3, grid 64 × 64, iteration 5, residual 1.5e-4, 12 s left"
        );
    }

    #[test]
    fn files_are_counted_as_they_are_written() {
        assert_eq!(
            writing(3, 12),
            "writing results, 3 of 12 fields and pictures"
        );
    }

    #[test]
    fn a_residual_halfway_to_the_tolerance_takes_as_long_again() {
        let (mut clock, start) = (TimeLeft::start(1e-8), Instant::now());
        assert_eq!(clock.remaining(&progress(0, 1, 0, 1.0), start), None);
        let left = clock.remaining(&progress(0, 1, 10, 1e-4), after(start, 5.0));
        assert!((left.unwrap().as_secs_f64() - 5.0).abs() < 1e-6);
    }

    #[test]
    fn remaining_steps_are_estimated_from_finished_ones() {
        let (mut clock, start) = (TimeLeft::start(1e-8), Instant::now());
        assert_eq!(clock.remaining(&progress(0, 4, 0, 1.0), start), None);
        clock.remaining(&progress(1, 4, 0, 1.0), after(start, 10.0));
        let left = clock.remaining(&progress(1, 4, 3, 0.1), after(start, 14.0));
        assert!((left.unwrap().as_secs_f64() - 26.0).abs() < 1e-6);
    }

    #[test]
    fn times_are_printed_in_a_suitable_unit() {
        let words = |seconds| in_words(Duration::from_secs_f64(seconds));
        assert_eq!(
            [0.2, 59.2, 300.0, 9000.0].map(words),
            ["1 s", "60 s", "5 min", "2.5 h"]
        );
    }
}
