//! `report.html` of a fit: the findings on one page that needs no network. The page is `cli/templates/fit_report.html`;
//! this module supplies its text.

use askama::Template;
use pellicle::display::significant;
use pellicle_identify::{Fit, FitVerdict, REFUSAL};

use super::findings::{CombinationResult, EstimateResult};
use super::pictures::{FitDrawings, FitPicture};
use super::result::{CurveResult, FitResult};
use super::taken_as_exact::ExactNumber;
use super::{Identification, names, units};

/// The contents of the page, with numbers in words.
#[derive(Template)]
#[template(path = "fit_report.html")]
struct FitPage<'a> {
    found: &'a FitResult,
    verdict: FitVerdict,
    misfit_p: String,
    /// The test that counts most against the model.
    worst: &'static str,
    refusal: String,
    level: String,
    tables: [(&'static str, Vec<EstimateRow>); 2],
    /// Names of the unknowns, and the parameters taken as exact.
    exact: (Vec<String>, Vec<ExactRow>),
    drawings: &'a FitDrawings,
    /// Names, values and meanings of the tests.
    tests: Vec<(&'static str, String, &'static str)>,
    /// Files, points, zeros of depth and force.
    curves: Vec<(String, usize, [String; 2])>,
    /// For each unknown that is not well determined, the measurement that would help.
    help: Vec<String>,
    seconds: String,
}

/// An estimate in words.
struct EstimateRow {
    name: String,
    key: String,
    value: String,
    interval: String,
    verdict: String,
    why: String,
    scatter: Option<String>,
    known: Option<String>,
}

/// A parameter taken as exact, in words.
struct ExactRow {
    name: String,
    key: String,
    value: String,
    /// The change of each unknown for an increase of the parameter by 1 %.
    changes: Vec<String>,
    /// The error that moves an unknown to the end of its interval.
    tolerance: String,
}

/// Renders the page as HTML.
#[must_use]
pub fn html(of: &Identification, fit: &Fit, found: &FitResult, drawings: &FitDrawings) -> String {
    let rows = |all: &[EstimateResult]| all.iter().map(row).collect();
    let page = FitPage {
        found,
        verdict: fit.verdict,
        misfit_p: significant(fit.goodness.misfit_p, 2),
        worst: worst(fit),
        refusal: REFUSAL.to_string(),
        level: percent(of.file.report.level),
        tables: [
            ("Unknowns", rows(&found.unknowns)),
            ("Nuisances", rows(&found.nuisances)),
        ],
        exact: exact(found),
        drawings,
        tests: noise(found).into_iter().chain(tests(fit)).collect(),
        curves: curves(found),
        help: match fit.verdict {
            FitVerdict::Fitted => found.unknowns.iter().filter_map(help).collect(),
            _ => vec![FIRST.into()],
        },
        seconds: significant(found.work.seconds, 3),
    };
    page.to_string()
}

/// The first step after a misfit, before any further measurement.
const FIRST: &str = "First find out why the model does not fit the measurements: until then the intervals and \
                     everything below are not valid.";

/// The measurement that would determine an unknown better; none if it is well determined.
fn help(of: &EstimateResult) -> Option<String> {
    let what = match of.verdict.as_str() {
        "weak" => "less noise, more loads, or an indenter of another radius",
        "one-sided" => {
            "loads that are sensitive to it: larger for what lies deep, smaller for what lies at the surface"
        }
        "not-identified" => "another measurement, or knowledge from elsewhere as a prior",
        "not-identifiable" => "no load or noise level helps: fix a parameter, or give one a prior",
        "prior-driven" => "another measurement: these data add almost nothing to the prior",
        _ => return None,
    };
    Some(format!("{}: {what}.", names::of_key(&of.key)))
}

/// A fraction as a percentage.
fn percent(part: f64) -> String {
    let percent = format!("{:.1}", 100.0 * part);
    format!("{} %", percent.trim_end_matches(".0"))
}

fn row(of: &EstimateResult) -> EstimateRow {
    let scale = units::scale(of.value, &of.unit);
    let number = |value: f64| significant(value / scale.divisor, 4);
    let with_unit = |text: String| format!("{text} {}", scale.label).trim_end().to_owned();
    EstimateRow {
        name: names::of_key(&of.key),
        key: of.key.clone(),
        value: with_unit(number(of.value)),
        interval: match of.interval {
            [None, None] => "open".into(),
            interval => with_unit(ends(interval, number)),
        },
        verdict: of.verdict.clone(),
        why: of.why.clone(),
        scatter: of.scatter.map(|scatter| with_unit(number(scatter))),
        known: of.known_combination.as_ref().map(known),
    }
}

/// Describes the parameters taken as exact.
fn exact(found: &FitResult) -> (Vec<String>, Vec<ExactRow>) {
    let row = |of: &ExactNumber| {
        let scale = units::scale(of.value, &of.unit);
        let value = significant(of.value / scale.divisor, 4);
        let change = |exponent: &Option<f64>| match exponent {
            Some(exponent) => format!("{exponent:+.2} %").replace('-', "−"),
            None => "open".into(),
        };
        let tolerance = of.tolerance(&found.unknowns);
        ExactRow {
            name: names::of_key(&of.key),
            key: of.key.clone(),
            value: format!("{value} {}", scale.label).trim_end().to_owned(),
            changes: of.exponents.iter().map(change).collect(),
            tolerance: match tolerance {
                Some((part, unknown)) if part < 1.0 => {
                    let percent = significant(100.0 * part, 2);
                    format!("{percent} %, for {}", names::symbol(unknown))
                }
                _ => "above 100 %".into(),
            },
        }
    };
    let unknowns = found.unknowns.iter().map(|of| names::symbol(&of.key));
    let rows = found.taken_as_exact.iter().map(row);
    (unknowns.collect(), rows.collect())
}

/// An interval in words; one or both ends may be open.
fn ends(interval: [Option<f64>; 2], number: impl Fn(f64) -> String) -> String {
    match interval {
        [Some(low), Some(high)] => format!("{} to {}", number(low), number(high)),
        [Some(low), None] => format!("above {}", number(low)),
        [None, Some(high)] => format!("below {}", number(high)),
        [None, None] => String::new(),
    }
}

fn known(of: &CombinationResult) -> String {
    let number = |value| significant(value, 4);
    let interval = ends(of.interval, number);
    format!(
        "{} = {}, {interval} in SI units",
        of.expression,
        number(of.value)
    )
}

/// The noise of each measured channel.
fn noise(found: &FitResult) -> Vec<(&'static str, String, &'static str)> {
    let noise = &found.fit.noise;
    let with_unit = |value: f64, unit| {
        let scale = units::scale(value, unit);
        format!("{} {}", significant(value / scale.divisor, 3), scale.label)
    };
    let depth = noise
        .depth
        .map(|sigma| ("noise of the depth", with_unit(sigma, "m")));
    let force = noise
        .force
        .map(|sigma| ("noise of the force", with_unit(sigma, "N")));
    let [relative, correlation] = [noise.relative, noise.correlation];
    let relative = (relative > 0.0).then(|| ("noise over the value", percent(relative)));
    let measured = depth.into_iter().chain(force).chain(relative);
    let lines =
        measured.map(|(name, value)| (name, value, "standard deviation, given or estimated"));
    let last = (
        "correlation of the noise",
        significant(correlation, 3),
        "from one point to the next",
    );
    lines.chain([last]).collect()
}

/// The test that counts most against the model.
fn worst(fit: &Fit) -> &'static str {
    let of = &fit.goodness;
    let tests = [
        ("χ²", of.chi_squared_p),
        ("the runs of residuals of one sign", Some(of.runs_p)),
        ("Durbin and Watson", Some(of.durbin_watson_p)),
        ("the lower half of the abscissae", of.lower_half_p),
        (
            "the persistence of the noise, which hides a misfit",
            of.persistence_p,
        ),
        ("the smooth part of the residuals", of.smooth_p),
        (
            "what the residuals of all repeats have in common",
            of.common_p,
        ),
    ];
    let known = tests.into_iter().filter_map(|(name, p)| Some((name, p?)));
    let worst = known.min_by(|(_, one), (_, other)| one.total_cmp(other));
    worst.map_or("", |(name, _)| name)
}

/// The tests of the residuals that are available for this fit.
fn tests(fit: &Fit) -> Vec<(&'static str, String, &'static str)> {
    let of = &fit.goodness;
    let always = |name, value, meaning| Some((name, significant(value, 3), meaning));
    let maybe = |name, value: Option<f64>, meaning| {
        value.map(|value| (name, significant(value, 3), meaning))
    };
    let rows = [
        always(
            "χ² per degree of freedom",
            of.chi_squared_per_degree,
            "near 1 where the noise is right; by construction where it is estimated",
        ),
        maybe("p of χ²", of.chi_squared_p, "of a larger χ² by chance"),
        always(
            "p of the runs",
            of.runs_p,
            "of residuals that keep their sign as long, by chance",
        ),
        always(
            "Durbin–Watson d",
            of.durbin_watson,
            "2 where neighbouring residuals are independent",
        ),
        always(
            "p of Durbin–Watson",
            of.durbin_watson_p,
            "of as small a d by chance",
        ),
        maybe(
            "p of the lower half",
            of.lower_half_p,
            "of as great a difference between the lower half of the abscissae and all, by chance",
        ),
        maybe(
            "p of the persistence",
            of.persistence_p,
            "that short-lived noise looks as persistent by chance",
        ),
        maybe(
            "p of the smooth part",
            of.smooth_p,
            "of as great a smooth part of the residuals by chance",
        ),
        maybe(
            "p of the common part",
            of.common_p,
            "that independent repeats have as much of their residuals in common by chance",
        ),
        always(
            "p of the misfit",
            of.misfit_p,
            "the least of these times their number, at most 1",
        ),
    ];
    rows.into_iter().flatten().collect()
}

fn curves(found: &FitResult) -> Vec<(String, usize, [String; 2])> {
    let column = |unit, of: fn(&CurveResult) -> Option<f64>| {
        let zeros = found.curves.iter().filter_map(of);
        let scale = units::scale(zeros.map(f64::abs).fold(0.0, f64::max), unit);
        move |curve: &CurveResult| {
            let words = |zero: f64| format!("{:.3} {}", zero / scale.divisor, scale.label);
            of(curve).map_or("taken as exact".into(), words)
        }
    };
    let depth = column("m", |curve| curve.depth_zero);
    let force = column("N", |curve| curve.force_zero);
    let rows = found.curves.iter().map(|curve| {
        let zeros = [depth(curve), force(curve)];
        (curve.file.clone(), curve.points, zeros)
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_show_units_and_open_ends() {
        let row = row(&EstimateResult {
            key: "indenter.radius".into(),
            unit: "m".into(),
            value: 1.642e-7,
            interval: [Some(1.6e-7), None],
            level: 0.95,
            wald: [None, None],
            verdict: "one-sided".into(),
            why: "Why.".into(),
            scatter: None,
            known_combination: None,
        });
        assert_eq!(row.value, "164.2 nm");
        assert_eq!(row.interval, "above 160.0 nm");
    }
}
