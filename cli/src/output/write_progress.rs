//! The writer of a results folder: writes files and pictures, counts them, stops when the user asks, and collects
//! warnings.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use pellicle::summary::WarningSummary;
use pellicle_files::whole::write_bytes;
use pellicle_plot::sheet::render;

use super::stoppable;
use crate::failure::Failure;
use crate::interrupt;

/// Called with the number of files written so far and in total.
pub type OnProgress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// The progress of a results folder, shared by all threads that write into it.
pub struct WriteProgress<'a> {
    on_progress: OnProgress<'a>,
    /// Total number of files.
    total: usize,
    written: AtomicUsize,
    left_out: AtomicUsize,
    failures: Mutex<Vec<WarningSummary>>,
}

impl<'a> WriteProgress<'a> {
    /// Creates the writer of this many files, fields and pictures together.
    #[must_use]
    pub fn new(total: usize, on_progress: OnProgress<'a>) -> Self {
        on_progress(0, total);
        Self {
            on_progress,
            total,
            written: AtomicUsize::new(0),
            left_out: AtomicUsize::new(0),
            failures: Mutex::default(),
        }
    }

    /// Writes a file; none if it was left out because the user asked to stop.
    ///
    /// # Errors
    ///
    /// The failure of `write`, unless it was stopped.
    pub fn file<T>(
        &self,
        write: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<Option<T>, Failure> {
        self.files(1, write)
    }

    /// Writes this many files at once; none if they were left out because the user asked to stop.
    ///
    /// # Errors
    ///
    /// The failure of `write`, unless it was stopped.
    pub fn files<T>(
        &self,
        count: usize,
        write: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<Option<T>, Failure> {
        if !interrupt::is_overdue() {
            match write() {
                Ok(written) => {
                    let before = self.written.fetch_add(count, Ordering::Relaxed);
                    (self.on_progress)(before + count, self.total);
                    return Ok(Some(written));
                }
                // A file stopped half-way is not a failure.
                Err(failure) if stoppable::was_stopped(&failure) => {}
                Err(failure) => return Err(failure),
            }
        }
        self.leave_out(count);
        Ok(None)
    }

    /// Draws, renders and writes a picture, and returns the drawing; none if it was left out, or cannot be drawn, which
    /// is a warning. Neither file is forced onto the disk: they can be drawn again.
    ///
    /// # Errors
    ///
    /// [`Failure::File`] if a file cannot be written.
    pub fn picture(
        &self,
        folder: &Path,
        name: &str,
        draw: impl FnOnce() -> String,
    ) -> Result<Option<String>, Failure> {
        let file = |ending| folder.join(format!("{name}.{ending}"));
        let written = self.file(|| {
            let render = |svg: String| {
                let png = render::png(&svg).map_err(|cause| cause.to_string())?;
                Ok((svg, png))
            };
            let Some(svg) = self.drawn(name, || Ok(draw())) else {
                return Ok(None);
            };
            stoppable::check(&file("png"))?;
            let Some((svg, png)) = self.drawn(name, || render(svg)) else {
                return Ok(None);
            };
            write_bytes(&file("svg"), svg.as_bytes())?;
            write_bytes(&file("png"), &png)?;
            Ok(Some(svg))
        })?;
        Ok(written.flatten())
    }

    /// Returns the drawing, or none with a warning: whatever happens while a picture is drawn, the numbers are kept.
    pub fn drawn<T>(&self, name: &str, draw: impl FnOnce() -> Result<T, String>) -> Option<T> {
        let drawn = catch_unwind(AssertUnwindSafe(draw));
        let reason = match drawn {
            Ok(Ok(drawn)) => return Some(drawn),
            Ok(Err(reason)) => reason,
            Err(_) => "an internal error of the program".to_owned(),
        };
        let message = format!("the picture {name} cannot be drawn: {reason}");
        let warning = WarningSummary {
            code: "picture-failed".into(),
            message,
        };
        self.failures().push(warning);
        None
    }

    fn failures(&self) -> std::sync::MutexGuard<'_, Vec<WarningSummary>> {
        self.failures.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The warnings about the writing, in an order that does not depend on threads.
    #[must_use]
    pub fn warnings(&self) -> Vec<WarningSummary> {
        let mut warnings = self.failures().clone();
        warnings.sort_by(|one, other| one.message.cmp(&other.message));
        let (left_out, total) = (self.left_out.load(Ordering::Relaxed), self.total);
        if left_out > 0 {
            warnings.push(WarningSummary {
                code: "stopped".into(),
                message: format!(
                    "stopped by the user while results were written: {left_out} of {total} fields and pictures are missing"
                ),
            });
        }
        warnings
    }

    /// Counts this many files as left out.
    pub fn leave_out(&self, files: usize) {
        self.left_out.fetch_add(files, Ordering::Relaxed);
    }

    /// Whether nothing was left out.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.left_out.load(Ordering::Relaxed) == 0
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_panic_in_one_picture_is_a_warning_and_the_others_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let writer = WriteProgress::new(3, &|_, _| ());
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2\" height=\"2\"/>";
        let draw = |name: &str, svg: &str| {
            let svg = svg.to_owned();
            writer.picture(folder.path(), name, || {
                assert!(!svg.is_empty(), "nothing to draw");
                svg
            })
        };
        assert_eq!(draw("panics", "").unwrap(), None);
        assert_eq!(draw("no-svg", "<svg").unwrap(), None);
        assert_eq!(draw("good", svg).unwrap().as_deref(), Some(svg));
        let warnings = writer.warnings();
        let codes: Vec<_> = warnings.iter().map(|warning| &warning.code[..]).collect();
        assert_eq!(codes, ["picture-failed"; 2]);
        assert!(warnings[1].message.contains("picture panics"));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn every_file_is_counted() {
        let reported = Mutex::new(Vec::new());
        let report = |done, total| reported.lock().unwrap().push((done, total));
        let writer = WriteProgress::new(2, &report);
        for _ in 0..2 {
            writer.file(|| Ok(())).unwrap();
        }
        assert_eq!(*reported.lock().unwrap(), [(0, 2), (1, 2), (2, 2)]);
        assert!(writer.is_whole() && writer.warnings().is_empty());
    }
}
