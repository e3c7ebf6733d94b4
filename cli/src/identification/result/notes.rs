//! Notes on a fit for its reader: points left out, and warnings.

use pellicle_identify::{Fit, FitWarning, Stopped};

use crate::identification::Identification;
use crate::identification::findings::{ExcludedResult, WarningResult};

/// Rows that are left out because they are not in contact are told of if they are more than one in so many.
const MANY: usize = 10;

impl Identification {
    /// Counts the points left out before the fit, and the curves left out by it.
    pub(super) fn excluded(&self, fit: &Fit) -> Vec<ExcludedResult> {
        let mut found: Vec<ExcludedResult> = Vec::new();
        let mut add = |reason: String, count: usize| {
            if count == 0 {
                return;
            }
            match found.iter_mut().find(|known| known.reason == reason) {
                Some(known) => known.count += count,
                None => found.push(ExcludedResult { reason, count }),
            }
        };
        for source in &self.sources {
            for exclusion in &source.measured.excluded {
                add(exclusion.reason.to_string(), exclusion.count);
            }
            add(
                "no force or depth of contact".into(),
                source.without_contact,
            );
        }
        for ExcludedResult { reason, count } in self.outside.excluded() {
            add(reason, count);
        }
        for exclusion in &fit.excluded {
            let source = &self.sources[exclusion.curve];
            let file = source.measured.file.display();
            let factor = exclusion.roughness;
            add(
                format!("{file} is {factor:.1} times as rough as the other repeats"),
                source.abscissa.len(),
            );
        }
        found
    }

    /// Returns the warnings about the files and those of the fit.
    pub(super) fn warnings(&self, fit: &Fit) -> Vec<WarningResult> {
        let warning = |code: &str, message: String| WarningResult {
            code: code.into(),
            message,
        };
        let of_files = self.sources.iter().flat_map(|source| {
            let file = source.measured.file.display();
            let warnings = source.measured.warnings.iter();
            warnings.map(move |found| warning(found.code, format!("{file}: {}", found.message)))
        });
        let dropped = self.sources.iter().filter_map(|source| {
            let (count, rows) = (source.without_contact, source.measured.table_rows);
            let file = source.measured.file.display();
            (count * MANY > rows).then(|| {
                let message = format!(
                    "{file}: {count} of {rows} rows are not clearly in contact, and not among the points of the fit"
                );
                warning("before-contact", message)
            })
        });
        let name = |index: &usize| fit.estimates[*index].name.clone();
        let of_fit = fit.warnings.iter().map(|found| match found {
            FitWarning::SeveralMinima => warning(
                "several-minima",
                "another start led to another minimum, which is worse".into(),
            ),
            FitWarning::Jitter => warning(
                "jitter",
                "the predictions deviate from their derivatives: the best fit is known only to a fraction of a \
                 standard error"
                    .into(),
            ),
            FitWarning::AtBound(index) => warning(
                "at-bound",
                format!(
                    "the best fit lies at a bound of {}: the data may be in another unit, or the bound too narrow",
                    name(index)
                ),
            ),
            FitWarning::BetterFitFound(index) => warning(
                "better-fit",
                format!("the profile of {} found a better fit than the search", name(index)),
            ),
        });
        let stopped = fit.stopped.as_ref().map(|stopped| match stopped {
            Stopped::Search => warning(
                "stopped",
                "the fit was stopped before the best one was found: these are the best values so far".into(),
            ),
            Stopped::Profiles(missing) => {
                let missing: Vec<String> = missing.iter().map(name).collect();
                let missing = missing.join(", ");
                warning(
                    "stopped",
                    format!(
                        "the fit was stopped before the profiles of {missing}: their intervals are those of the covariance"
                    ),
                )
            }
        });
        let radius = self.file.stated_radius.as_ref().map(|stated| {
            let place = format!("line {}, \"{}\"", stated.line, stated.text);
            let message =
                format!("the radius of the indenter is that of {place} of the measurement");
            warning("stated-radius", message)
        });
        let of_files = of_files.chain(radius);
        of_files
            .chain(dropped)
            .chain(stopped)
            .chain(of_fit)
            .collect()
    }
}
