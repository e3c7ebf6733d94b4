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
    /// What is asked for, then the other numbers, each table as wide as a page.
    tables: Vec<NumberTable>,
    drawings: &'a [String],
}

/// Some of the numbers of every contact.
struct NumberTable {
    /// The symbol and the meaning of each number.
    heads: Vec<(&'static str, &'static str)>,
    /// Contacts, or what the numbers are means of, with the numbers in words.
    rows: Vec<(String, Vec<String>)>,
}

/// The numbers of the first table.
const FIRST: [IndentationNumber; 6] = [
    IndentationNumber::IndentationModulus,
    IndentationNumber::IndentationHardness,
    IndentationNumber::ContactDepth,
    IndentationNumber::MaxForce,
    IndentationNumber::ContactStiffness,
    IndentationNumber::Area,
];

/// Numbers of each further table: a narrow window shows them all.
const COLUMNS: usize = 4;

fn number_table(found: &EvaluationResult, of: &[IndentationNumber]) -> NumberTable {
    let cells = |numbers: &[Option<Uncertain>]| {
        let word = |of: &IndentationNumber| {
            let number = numbers[of.place()];
            number.map_or_else(String::new, |number| text::words(*of, number))
        };
        of.iter().map(word).collect()
    };
    let contacts = found.indentation.iter().map(|of| cells(&of.numbers));
    let contacts = text::names(&found.indentation).into_iter().zip(contacts);
    let repeats = found.repeats.iter().map(|of| {
        let name = format!("mean of {} curves, ± their scatter", of.curves.len());
        (name, cells(&of.numbers))
    });
    NumberTable {
        heads: of.iter().map(|of| (of.symbol(), of.meaning())).collect(),
        rows: contacts.chain(repeats).collect(),
    }
}

/// Renders the page as HTML.
#[must_use]
pub fn html(found: &EvaluationResult, drawings: &[String]) -> String {
    let heads = IndentationNumber::ALL.map(|of| (of.symbol(), of.meaning()));
    let others = IndentationNumber::ALL.into_iter();
    let others: Vec<_> = others.filter(|of| !FIRST.contains(of)).collect();
    let page = EvaluationPage {
        found,
        heads: heads.into(),
        tables: ([&FIRST[..]].into_iter().chain(others.chunks(COLUMNS)))
            .map(|of| number_table(found, of))
            .collect(),
        drawings,
    };
    page.to_string()
}
