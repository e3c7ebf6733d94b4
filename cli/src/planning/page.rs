//! `report.html` of a plan, a single page that needs no network. The page itself is `cli/templates/plan_report.html`.

use askama::Template;
use pellicle::display::{count, significant};

use super::design::{DesignResult, ExpectedResult};
use super::result::PlanResult;
use super::text::{self, percent};
use crate::identification::names;

/// The page, with its numbers as text.
#[derive(Template)]
#[template(path = "plan_report.html")]
struct PlanPage<'a> {
    plan: &'a PlanResult,
    level: String,
    conditions: String,
    designs: DesignTable,
    truth: Vec<(String, String, String)>,
    drawing: Option<&'a str>,
    work: String,
    seconds: String,
}

/// The designs in rows, for a page.
pub struct DesignTable {
    /// Names of the parameters.
    pub heads: Vec<String>,
    /// Names of the designs, each with a width for every parameter.
    pub rows: Vec<(String, Vec<String>)>,
    /// For each parameter that no data determine, the product of powers that the best design determines.
    pub instead: Vec<(String, String)>,
}

impl DesignTable {
    /// Builds the table of some designs.
    #[must_use]
    pub fn of(designs: &[DesignResult]) -> Self {
        let heads = designs.first().map(|first| {
            let all = text::numbers(first);
            all.map(|of| names::of_key(&of.key)).collect()
        });
        let row = |design: &DesignResult| {
            let widths = text::numbers(design).map(ExpectedResult::width);
            (text::name(design), widths.collect())
        };
        let instead = designs.first().map(|first| {
            let all = text::numbers(first);
            all.filter_map(|of| Some((names::of_key(&of.key), of.instead()?)))
                .collect()
        });
        Self {
            instead: instead.unwrap_or_default(),
            heads: heads.unwrap_or_default(),
            rows: designs.iter().map(row).collect(),
        }
    }
}

/// Returns the page as HTML.
#[must_use]
pub fn html(plan: &PlanResult, drawing: Option<&str>) -> String {
    let truth = plan.designs.first().map(|first| {
        let all = text::numbers(first);
        all.map(|of| {
            let scale = crate::identification::units::scale(of.value, &of.unit);
            let number = significant(of.value / scale.divisor, 4);
            let value = format!("{number} {}", scale.label).trim_end().to_owned();
            (names::of_key(&of.key), of.key.clone(), value)
        })
        .collect()
    });
    let page = PlanPage {
        plan,
        level: percent(plan.level),
        conditions: text::conditions(plan),
        designs: DesignTable::of(&plan.designs),
        truth: truth.unwrap_or_default(),
        drawing,
        work: count(plan.work.curves_solved, "curve"),
        seconds: significant(plan.work.seconds, 3),
    };
    page.to_string()
}
