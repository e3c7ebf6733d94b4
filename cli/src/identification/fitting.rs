//! Fits a fit file, and again without the points at which the model does not hold:
//!
//! ```text
//! best fit of all points
//! look where the model holds there                                  validity.rs
//! best fit of the points at which it does, until they stay the same
//! if too few are left: those are kept at which only the grid's error is too large
//! intervals, with that error if such points were kept                grid_error.rs
//! ```

use std::sync::atomic::{AtomicUsize, Ordering};

use pellicle_contact::ContactError;
use pellicle_identify::fit_file::report::OutsidePoints;
use pellicle_identify::{Fit, FitOptions, FitVerdict, IdentifyError, Intervals, identify};

use super::curve_source::FEWEST_POINTS;
use super::outside::{Handling, Outside};
use super::remembered::Remembered;
use super::{Identification, Spent, validity};
use crate::failure::Failure;

/// Number of fits after the first, each without the points at which the model does not hold according to the previous
/// one. As many more leave out those of all fits, for some points may be in and out by turns.
const MOST_REPETITIONS: usize = 3;

/// The tolerance of a search with a model that is exact to rounding, as that of unloadings.
const EXACT: f64 = 1e-16;

impl Identification {
    /// Runs the fit; `report` receives the number of predictions after each. The returned identification has the points
    /// of the fit: those of `self` unless some had to be left out.
    ///
    /// # Errors
    ///
    /// [`Failure`] if the model has no prediction at any start, or the user stops before the first.
    pub fn fitted(self, report: &(dyn Fn(usize) + Sync)) -> Result<(Self, Fit), Failure> {
        let predictions = AtomicUsize::new(0);
        let report = || report(1 + predictions.fetch_add(1, Ordering::Relaxed));
        let mut narrowed: Option<Self> = None;
        let mut repetitions = 0;
        let mut keeps_inaccurate = false;
        let mut abandoned = 0;
        let (outside, mut fit) = loop {
            let now = narrowed.as_ref().unwrap_or(&self);
            let model = Remembered::new(&now.model, &self.stop, &report);
            let search = now.fit(&model, Intervals::Wald)?;
            if search.stopped.is_some() {
                break (now.outside.clone(), search);
            }
            let Some(mut outside) = validity::outside(&self, &search, (now, &model)) else {
                break (now.outside.clone(), now.fit(&model, self.intervals())?);
            };
            if keeps_inaccurate {
                outside = outside.with_inaccurate();
            }
            if repetitions >= MOST_REPETITIONS {
                outside = outside.and(&now.outside, &self.sources);
            }
            let is_fit = search.verdict != FitVerdict::NotConverged;
            let handling = match self.file.report.outside {
                _ if outside.points == now.outside.points => Some(Handling::LeftOut),
                OutsidePoints::Keep => Some(Handling::Kept),
                // Values that are not a fit do not justify leaving out the points that lie outside the model there.
                OutsidePoints::LeaveOut if !is_fit && narrowed.is_none() => {
                    Some(Handling::NotConverged)
                }
                OutsidePoints::LeaveOut if !is_fit || repetitions == 2 * MOST_REPETITIONS => {
                    outside = now.outside.clone();
                    Some(Handling::Unsettled)
                }
                OutsidePoints::LeaveOut => None,
            };
            if let Some(handling) = handling {
                outside.handling = handling;
                break (outside, now.fit(&model, self.intervals())?);
            }
            let Some(next) = self.without(&outside, &search, now)? else {
                if outside.has_inaccurate() {
                    // Again from all points, with those that only the grid's error leaves out.
                    keeps_inaccurate = true;
                    abandoned += search.work.curves_solved;
                    narrowed = None;
                    continue;
                }
                if narrowed.is_some() {
                    outside = now.outside.clone();
                    outside.handling = Handling::Unsettled;
                } else {
                    outside.handling = Handling::TooFewLeft;
                }
                let verdict = FitVerdict::OutsideModel;
                break (outside, Fit { verdict, ..search });
            };
            narrowed = Some(next);
            repetitions += 1;
        };
        let mut found = narrowed.unwrap_or(self);
        found.outside = outside;
        found.spent.curves += abandoned;
        if found.outside.includes_inaccurate() && fit.stopped.is_none() {
            found.outside.failure = found.include_grid_error(&mut fit).err();
        }
        Ok((found, fit))
    }

    fn fit(&self, model: &Remembered<'_>, intervals: Intervals) -> Result<Fit, Failure> {
        let options = FitOptions {
            intervals,
            tolerance: if self.file.evaluation.is_some() {
                EXACT
            } else {
                FitOptions::default().tolerance
            },
            ..self.file.report.options()
        };
        Ok(identify(model, &self.problem, &options)?)
    }

    fn intervals(&self) -> Intervals {
        self.file.report.intervals
    }

    /// Poses the fit without these points, starting from the best values so far; none if too few points are left.
    fn without(
        &self,
        outside: &Outside,
        search: &Fit,
        before: &Self,
    ) -> Result<Option<Self>, Failure> {
        let mut first = 0;
        let sources = self
            .sources
            .iter()
            .zip(&self.tables)
            .map(|(source, table)| {
                let end = first + source.abscissa.len();
                // No list where every point is valid.
                let invalid = outside.invalid.get(first..end).unwrap_or_default();
                let kept = source.without(invalid);
                first = end;
                (*table, kept)
            });
        let sources: Vec<_> = sources.collect();
        let is_short =
            |(_, source): &(_, super::CurveSource)| source.abscissa.len() < FEWEST_POINTS;
        if sources.iter().any(is_short) {
            return Ok(None);
        }
        let starts: Vec<f64> = search.estimates.iter().map(|of| of.value).collect();
        let evaluated = self.evaluated.clone();
        let (file, stop) = (self.file.clone(), self.stop.clone());
        match Self::posed(file, sources, evaluated, Some(&starts), stop) {
            // Too few points, or none of them in contact.
            Err(
                Failure::Identify(IdentifyError::TooFewPoints { .. })
                | Failure::Case(pellicle::Error::Contact(ContactError::Force { .. })),
            ) => Ok(None),
            Err(failure) => Err(failure),
            Ok(next) => Ok(Some(Self {
                outside: outside.clone(),
                spent: Spent {
                    curves: before.spent.curves + search.work.curves_solved,
                    loads: before.spent.loads + before.model.loads_solved(),
                    products: before.spent.products + before.model.operator_applications(),
                },
                ..next
            })),
        }
    }
}
