//! What to measure, in a sentence or two.

use pellicle_identify::{IDENTIFIED_WITHIN, Verdict};

use super::comparison::better;
use super::result::{DesignResult, ExpectedResult};
use super::words::width;
use crate::identification::names;

/// A design of more curves is advised only if its worst standard error is below this part of that of fewer.
const WORTH: f64 = 0.67;

/// What the advice is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Advice {
    /// Nothing has been measured.
    ForAPlan,
    /// There are data, to which curves are added.
    AfterAFit,
}

/// The advice that follows from the designs, the best first.
#[must_use]
pub fn advice(designs: &[DesignResult], of: Advice) -> String {
    let Some(chosen) = chosen(designs) else {
        return String::new();
    };
    let mut sentences = Vec::new();
    let now = designs.iter().find(|design| design.curves.is_empty());
    if let Some(now) = now.filter(|now| now.is_told()) {
        sentences.push(format!("What was measured tells already {}.", told(now)));
    }
    let verb = match of {
        Advice::ForAPlan => "Measure",
        Advice::AfterAFit => "Add",
    };
    sentences.push(format!("{verb} {}: {}.", curves(chosen), told(chosen)));
    if !chosen.is_told() {
        let open = chosen.unknowns.iter().filter(|of| !is_told(of));
        let open: Vec<_> = open.map(|of| names::of_key(&of.key)).collect();
        sentences.push(format!(
            "Of these designs none tells {} within {:.0} %.",
            listed(&open, "or"),
            100.0 * (IDENTIFIED_WITHIN - 1.0)
        ));
    }
    let never = chosen.unknowns.iter().filter(|of| is_never(of));
    let never: Vec<_> = never.map(|of| names::of_key(&of.key)).collect();
    if !never.is_empty() {
        let rest = "no data of this kind can tell; hold a number fixed or give it a prior";
        sentences.push(format!("Of {} {rest}.", listed(&never, "and")));
    }
    sentences.join(" ")
}

/// The design with the fewest curves that tells every unknown; without one, the best, unless fewer curves do nearly as
/// well.
#[must_use]
pub fn chosen(designs: &[DesignResult]) -> Option<&DesignResult> {
    let best_of = |count: usize| {
        let of_count = designs.iter().filter(|design| design.curves.len() == count);
        of_count.min_by(|one, other| better(one, other))
    };
    let most = designs.iter().map(|design| design.curves.len()).max()?;
    let by_count: Vec<_> = (1..=most).filter_map(best_of).collect();
    if let Some(told) = by_count.iter().find(|design| design.is_told()) {
        return Some(told);
    }
    let better_by_far = |best: &DesignResult, more: &DesignResult| {
        more.lost() < best.lost() || more.worst() < WORTH * best.worst()
    };
    by_count.into_iter().reduce(|best, more| {
        if better_by_far(best, more) {
            more
        } else {
            best
        }
    })
}

impl DesignResult {
    /// Whether every unknown is told within a factor of 1.2.
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.unknowns.iter().all(is_told)
    }
}

fn is_told(of: &ExpectedResult) -> bool {
    !of.is_lost() && of.factor.is_some_and(|factor| factor <= IDENTIFIED_WITHIN)
}

fn is_never(of: &ExpectedResult) -> bool {
    of.verdict == Verdict::NotIdentifiable.to_string()
}

/// The curves of a design in words.
#[must_use]
pub fn curves(design: &DesignResult) -> String {
    let all: Vec<_> = design
        .curves
        .iter()
        .map(super::candidate::Candidate::words)
        .collect();
    match all.len() {
        0 => "nothing more".into(),
        1 | 2 => all.join(" and "),
        count => format!("all {count} curves"),
    }
}

/// Every unknown with its width: `E, layer 0, ± 3.4 %`.
fn told(design: &DesignResult) -> String {
    let one = |of: &ExpectedResult| format!("{} {}", names::of_key(&of.key), width(of));
    let all: Vec<_> = design.unknowns.iter().map(one).collect();
    all.join(", ")
}

fn listed(all: &[String], word: &str) -> String {
    match all {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} {word} {last}", first.join(", ")),
    }
}
