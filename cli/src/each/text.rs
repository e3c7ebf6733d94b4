//! What every curve gives alone, on the terminal.

use pellicle::display::{count, significant};

use super::{EachCurve, EachResult};
use crate::identification::findings::{EstimateResult, WarningResult};
use crate::identification::units;

/// So many curves are listed; more are in the table.
const MOST_LISTED: usize = 20;

/// A line for each of a few curves, and for each unknown the median and the quartiles of the fitted curves.
#[must_use]
pub fn text(result: &EachResult) -> String {
    let listed = result.curves.iter().take(MOST_LISTED).map(line);
    let more = match result.curves.len().saturating_sub(MOST_LISTED) {
        0 => String::new(),
        more => format!("  and {more} more, in each.csv\n"),
    };
    let fitted: Vec<&EachCurve> = (result.curves.iter())
        .filter(|curve| curve.verdict == "fitted")
        .collect();
    let unknowns = fitted.first().map(|curve| curve.unknowns.len());
    let medians = (0..unknowns.unwrap_or(0)).map(|index| median(&fitted, index));
    format!(
        "{}\n{}{more}{}\n{}",
        result.title,
        listed.collect::<String>(),
        counts(result),
        medians.collect::<String>()
    )
}

fn line(curve: &EachCurve) -> String {
    let unknowns = curve
        .unknowns
        .iter()
        .map(|of| format!("   {}", numbers(of)));
    let cause = curve.cause.iter().map(|cause| format!("\n      {cause}"));
    let rest: Vec<String> = unknowns.chain(cause).collect();
    format!("  {}: {}{}\n", curve.file, curve.verdict, rest.concat())
}

/// Median and quartiles of an unknown, over the curves whose interval closes.
fn median(fitted: &[&EachCurve], index: usize) -> String {
    let all = fitted.iter().filter_map(|curve| curve.unknowns.get(index));
    let open = all.clone().filter(|of| !of.is_closed()).count();
    let all = all.filter(|of| of.is_closed());
    let mut values: Vec<f64> = all.clone().map(|of| of.value).collect();
    values.sort_by(f64::total_cmp);
    let [first, median, third] = [0.25, 0.5, 0.75].map(|part| quantile(&values, part));
    let Some(of) = all.clone().next() else {
        return String::new();
    };
    let open = match open {
        0 => String::new(),
        open => format!(", without {}", count(open, "open interval")),
    };
    let scale = units::scale(median, &of.unit);
    let number = |value: f64| significant(value / scale.divisor, 4);
    format!(
        "  {}: median {} {}, half of them from {} to {}{open}\n",
        of.key,
        number(median),
        scale.label,
        number(first),
        number(third)
    )
}

/// The warnings of fitted curves, each kind once: in the words of the first curve that has it.
#[must_use]
pub fn warnings(result: &EachResult) -> Vec<String> {
    let fitted = (result.curves.iter()).filter(|curve| curve.verdict == "fitted");
    let mut kinds: Vec<(&WarningResult, &EachCurve, usize)> = Vec::new();
    for curve in fitted {
        for warning in &curve.warnings {
            match (kinds.iter_mut()).find(|(known, ..)| known.code == warning.code) {
                Some((.., curves)) => *curves += 1,
                None => kinds.push((warning, curve, 1)),
            }
        }
    }
    let all = result.count("fitted");
    let sentence = |(warning, curve, curves): (&WarningResult, &EachCurve, usize)| {
        if curves == all {
            warning.message.clone()
        } else {
            let curves = count(curves, "fitted curve");
            format!(
                "{curves} of {all}, {} first: {}",
                curve.file, warning.message
            )
        }
    };
    kinds.into_iter().map(sentence).collect()
}

/// How many curves have which verdict.
#[must_use]
pub fn counts(result: &EachResult) -> String {
    let verdicts = [
        "fitted",
        "misfit",
        "outside-model",
        "not-converged",
        super::FAILED,
    ];
    let counted = verdicts.map(|verdict| (result.count(verdict), verdict));
    let some: Vec<String> = (counted.iter().filter(|(number, _)| *number > 0))
        .map(|(number, verdict)| format!("{number} {verdict}"))
        .collect();
    let not_begun = match result.not_begun {
        0 => String::new(),
        number => format!(", {number} not begun"),
    };
    format!(
        "{}: {}{not_begun}",
        count(result.curves.len(), "curve"),
        some.join(", ")
    )
}

fn numbers(of: &EstimateResult) -> String {
    let scale = units::scale(of.value, &of.unit);
    let number = |value: f64| significant(value / scale.divisor, 4);
    let [low, high] = of.interval.map(|end| end.map_or("open".to_owned(), number));
    format!(
        "{} [{low}, {high}] {}, {}",
        number(of.value),
        scale.label,
        of.verdict
    )
}

/// The quantile of sorted values, by a line between the two nearest.
fn quantile(values: &[f64], part: f64) -> f64 {
    let place = part * (values.len().max(1) - 1) as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place in a list"
    )]
    let below = place.floor() as usize;
    let at = |index: usize| {
        values
            .get(index.min(values.len().max(1) - 1))
            .copied()
            .unwrap_or(f64::NAN)
    };
    at(below) + (place - below as f64) * (at(below + 1) - at(below))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_at_an_open_end_are_not_in_the_median() {
        let curve = |value: f64, interval: [Option<f64>; 2]| EachCurve {
            file: "a.txt".into(),
            position: None,
            verdict: "fitted".into(),
            unknowns: vec![EstimateResult {
                key: "E".into(),
                unit: "Pa".into(),
                value,
                interval,
                level: 0.95,
                wald: interval,
                verdict: "one-sided".into(),
                why: String::new(),
                scatter: None,
                known_combination: None,
            }],
            misfit_p: None,
            cause: None,
            warnings: Vec::new(),
        };
        let closed = curve(3.0, [Some(2.0), Some(4.0)]);
        let open = curve(1e-3, [None, Some(4.0)]);
        let line = median(&[&open, &closed], 0);
        let wanted =
            "  E: median 3.000 Pa, half of them from 3.000 to 3.000, without 1 open interval\n";
        assert_eq!(line, wanted);
        // None is left: no median.
        assert_eq!(median(&[&open], 0), "");
    }

    #[test]
    fn a_warning_of_some_curves_names_the_first_and_that_of_all_none() {
        let warning = |code: &str| WarningResult {
            code: code.into(),
            message: format!("{code} happened"),
        };
        let curve = |file: &str, codes: &[&str]| EachCurve {
            file: file.into(),
            position: None,
            verdict: "fitted".into(),
            unknowns: Vec::new(),
            misfit_p: None,
            cause: None,
            warnings: codes.iter().map(|code| warning(code)).collect(),
        };
        let result = EachResult {
            schema: crate::each::SCHEMA,
            program: "pellicle",
            version: "0",
            title: String::new(),
            curves: vec![curve("a.txt", &["this"]), curve("b.txt", &["this", "that"])],
            not_begun: 0,
        };
        let wanted = [
            "this happened",
            "1 fitted curve of 2, b.txt first: that happened",
        ];
        assert_eq!(warnings(&result), wanted);
    }

    #[test]
    fn quartiles_lie_between_the_nearest_values() {
        let values = [1.0, 2.0, 3.0, 5.0];
        assert_eq!(
            [0.0, 0.5, 0.75, 1.0].map(|part| quantile(&values, part)),
            [1.0, 2.5, 3.5, 5.0]
        );
        assert!(quantile(&[], 0.5).is_nan());
    }
}
