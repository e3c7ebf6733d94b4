//! Points and parts of the curves that deviate from a fit: outliers, and what residuals have in common.

use std::collections::BTreeMap;

use pellicle::display::significant;
use pellicle_identify::Fit;

use super::Identification;
use super::findings::{OutlierResult, WarningResult};
use super::units;

/// Outliers with a sentence of their own; all are in `fit.json`.
const MOST_NAMED: usize = 10;

impl Identification {
    /// The outliers of a fit, with their rows.
    pub(super) fn outliers(&self, fit: &Fit) -> Vec<OutlierResult> {
        let of_outlier = |outlier: &pellicle_identify::Outlier| {
            let (source, point) = self.source_of(outlier.point)?;
            let source = &self.sources[source];
            Some(OutlierResult {
                file: source.measured.file.display().to_string(),
                row: source.row(point),
                abscissa: source.abscissa[point],
                observed: outlier.observed,
                expected: outlier.expected,
                deviations: outlier.deviations,
            })
        };
        fit.outliers.iter().filter_map(of_outlier).collect()
    }

    /// A warning for each outlier, and the key that leaves them out.
    pub(super) fn outlier_warnings(&self, fit: &Fit) -> Vec<WarningResult> {
        let found = self.outliers(fit);
        let [x, y] = self.axis_units();
        let named = found.iter().take(MOST_NAMED).map(|of| {
            let observed = units::scale(of.observed, y);
            let expected = units::scale(of.expected, y);
            let abscissa = units::scale(of.abscissa, x);
            format!(
                "{}: row {} is an outlier: {} {} at {} {}, where its neighbours lead to expect {} {}, {} standard \
                 deviations away",
                of.file,
                of.row,
                significant(of.observed / observed.divisor, 4),
                observed.label,
                significant(of.abscissa / abscissa.divisor, 4),
                abscissa.label,
                significant(of.expected / expected.divisor, 4),
                expected.label,
                significant(of.deviations.abs(), 2),
            )
        });
        let more = found.len().saturating_sub(MOST_NAMED);
        let more = (more > 0).then(|| format!("{more} more outliers: fit.json lists them"));
        let advice = (!found.is_empty()).then(|| self.advice(fit));
        let messages: Vec<String> = named.chain(more).chain(advice).collect();
        let warning = |message| WarningResult {
            code: "outlier".into(),
            message,
        };
        messages.into_iter().map(warning).collect()
    }

    /// The key that leaves the outliers out.
    fn advice(&self, fit: &Fit) -> String {
        let mut tables: BTreeMap<usize, BTreeMap<usize, Vec<String>>> = BTreeMap::new();
        for outlier in &fit.outliers {
            if let Some((source, point)) = self.source_of(outlier.point) {
                let of_table = tables.entry(self.tables[source]).or_default();
                let rows = of_table.entry(source).or_default();
                rows.push(self.sources[source].row(point).to_string());
            }
        }
        let keys = tables.into_iter().map(|(table, of_table)| {
            let is_alone = self.file.data[table].files.len() == 1;
            let lists = of_table.into_iter().map(|(source, rows)| {
                let list = format!("[{}]", rows.join(", "));
                let file = &self.sources[source].measured.file;
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                if is_alone {
                    list
                } else {
                    format!("\"{name}\" = {list}")
                }
            });
            let lists: Vec<String> = lists.collect();
            let value = if is_alone {
                lists.join(", ")
            } else {
                format!("{{ {} }}", lists.join(", "))
            };
            format!("data[{table}].omit = {value}")
        });
        let keys: Vec<String> = keys.collect();
        format!(
            "the fit is drawn towards these points: correct them in the file, or leave them out with {}",
            keys.join(", ")
        )
    }

    /// What the residuals have in common, or what their noise has absorbed.
    pub(super) fn departure_warning(&self, fit: &Fit) -> Option<WarningResult> {
        let of = fit.departure?;
        let [x, y] = self.axis_units();
        let [range, size] = [units::scale(of.range[1], x), units::scale(of.largest, y)];
        let number = |value: f64| significant(value / range.divisor, 3);
        let side = if of.largest > 0.0 { "above" } else { "below" };
        let place = format!(
            "from {} to {} {}, by up to {} {}",
            number(of.range[0]),
            number(of.range[1]),
            range.label,
            significant(of.largest.abs() / size.divisor, 2),
            size.label,
        );
        let p = significant(of.probability, 2);
        let (code, message) = if self.problem.has_scatter() && of.curves > 1 {
            (
                "common-misfit",
                format!(
                    "all {} repeats lie {side} the model together {place}, which independent noise would do with a \
                     probability of {p}: the model or the instrument is wrong there, whatever the correlation of the \
                     noise",
                    of.curves
                ),
            )
        } else {
            (
                "systematic-residuals",
                format!(
                    "the measurements lie {side} the model {place}: the estimated correlation takes this for noise, \
                     and without it the probability is {p}. Repeats would show whether it is noise or a misfit"
                ),
            )
        };
        Some(WarningResult {
            code: code.into(),
            message,
        })
    }

    /// The curve of a point of the fit, and its index in it.
    fn source_of(&self, point: usize) -> Option<(usize, usize)> {
        let mut first = 0;
        self.sources.iter().enumerate().find_map(|(index, source)| {
            let own = point.checked_sub(first)?;
            first += source.abscissa.len();
            (own < source.abscissa.len()).then_some((index, own))
        })
    }

    /// The SI units of abscissa and observable.
    fn axis_units(&self) -> [&'static str; 2] {
        let observable = self.model.curves().first().map(|curve| curve.observable);
        let observable = observable.unwrap_or_default();
        [observable.abscissa().unit(), observable.observed().unit()]
    }
}
