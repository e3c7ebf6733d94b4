//! `report.html` of an evaluation: the numbers and pictures on one page that needs no network. The page is
//! `cli/templates/evaluation_report.html`.

use askama::Template;
use pellicle_identify::indentation::{IndentationNumber, Uncertain};

use super::result::EvaluationResult;
use super::text;

#[derive(Template)]
#[template(path = "evaluation_report.html")]
struct EvaluationPage<'a> {
    found: &'a EvaluationResult,
    /// The symbol and the meaning of every number.
    heads: Vec<(&'static str, &'static str)>,
    /// Files, or what the numbers are means of, with the numbers in words.
    rows: Vec<(String, Vec<String>)>,
    drawings: &'a [String],
}

/// Renders the page as HTML.
#[must_use]
pub fn html(found: &EvaluationResult, drawings: &[String]) -> String {
    let heads = IndentationNumber::ALL.map(|of| (of.symbol(), of.meaning()));
    let cells = |numbers: &[Option<Uncertain>]| {
        let pairs = IndentationNumber::ALL.into_iter().zip(numbers);
        let words = pairs.map(|(of, number)| number.map(|number| text::words(of, number)));
        words.map(Option::unwrap_or_default).collect()
    };
    let curves = found.indentation.iter();
    let curves = curves.map(|of| (of.file.clone(), cells(&of.numbers)));
    let repeats = found.repeats.iter().map(|of| {
        let name = format!("mean of {} curves, ± their scatter", of.curves.len());
        (name, cells(&of.numbers))
    });
    let page = EvaluationPage {
        found,
        heads: heads.into(),
        rows: curves.chain(repeats).collect(),
        drawings,
    };
    page.to_string()
}
