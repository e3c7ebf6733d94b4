//! The advice on the next measurement, in one or two sentences.

use pellicle_identify::IDENTIFIED_WITHIN;

use super::candidate::CandidateCurve;
use super::design::{DesignResult, ExpectedResult, better};
use crate::identification::names;

/// A design with more curves is advised only if its worst standard error is below this fraction of that with fewer.
const WORTH: f64 = 0.67;

/// The occasion of the advice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Advice {
    /// Nothing has been measured.
    ForAPlan,
    /// There are data, and curves are added to them.
    AfterAFit,
}

/// Derives the advice from the designs, which are sorted best first.
#[must_use]
pub fn advice(designs: &[DesignResult], of: Advice) -> String {
    let Some(chosen) = chosen(designs) else {
        return String::new();
    };
    let (never, rest): (Vec<_>, Vec<_>) = chosen.unknowns.iter().partition(|of| of.is_never());
    let mut sentences = Vec::new();
    let now = designs.iter().find(|design| design.curves.is_empty());
    if let Some(now) = now.filter(|now| now.is_determined()) {
        let now: Vec<_> = now.unknowns.iter().collect();
        sentences.push(format!(
            "What was measured determines all: {}.",
            widths(&now)
        ));
    }
    let verb = match of {
        Advice::ForAPlan => "Measure",
        Advice::AfterAFit => "Add",
    };
    if !rest.is_empty() {
        sentences.push(format!("{verb} {}: {}.", curves(chosen), widths(&rest)));
    }
    let open: Vec<_> = rest.into_iter().filter(|of| !of.is_determined()).collect();
    if !open.is_empty() {
        let within = 100.0 * (IDENTIFIED_WITHIN - 1.0);
        sentences.push(format!(
            "None of these designs determines {} within {within:.0} %.",
            listed(&open, "or")
        ));
    }
    if !never.is_empty() {
        sentences.push(format!(
            "Data of this kind cannot determine {}: fix a parameter, or give one a prior.",
            listed(&never, "or")
        ));
    }
    sentences.join(" ")
}

/// Returns the design with the fewest curves that determines every unknown that any design determines. If there is
/// none, it returns the best design, unless one with fewer curves is nearly as good.
#[must_use]
pub fn chosen(designs: &[DesignResult]) -> Option<&DesignResult> {
    let best_of = |count: usize| {
        let of_count = designs.iter().filter(|design| design.curves.len() == count);
        of_count.min_by(|one, other| better(one, other))
    };
    let most = designs.iter().map(|design| design.curves.len()).max()?;
    let by_count: Vec<_> = (1..=most).filter_map(best_of).collect();
    let fewest_lost = designs.iter().map(DesignResult::lost).min()?;
    let is_determined = |design: &&&DesignResult| {
        let mut unknowns = design.unknowns.iter();
        design.lost() == fewest_lost && unknowns.all(|of| of.is_lost() || of.is_determined())
    };
    if let Some(design) = by_count.iter().find(is_determined) {
        return Some(design);
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

/// Describes the curves of a design.
#[must_use]
pub fn curves(design: &DesignResult) -> String {
    let all: Vec<_> = design.curves.iter().map(CandidateCurve::words).collect();
    match all.len() {
        0 => "nothing more".into(),
        1 | 2 => all.join(" and "),
        count => format!("all {count} curves"),
    }
}

/// Lists parameters with their widths: `thickness of layer 0 ± 3.4 %, Young's modulus of layer 0 lost`.
fn widths(all: &[&ExpectedResult]) -> String {
    let one = |of: &&ExpectedResult| format!("{} {}", names::of_key(&of.key), of.width());
    let all: Vec<_> = all.iter().map(one).collect();
    all.join(", ")
}

fn listed(all: &[&ExpectedResult], word: &str) -> String {
    let all: Vec<_> = all.iter().map(|of| names::of_key(&of.key)).collect();
    match &all[..] {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} {word} {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use pellicle_identify::Verdict;

    use super::*;

    /// Returns a design with this many curves and one unknown with this standard error.
    fn design(curves: usize, error: Option<f64>, verdict: Verdict) -> DesignResult {
        let curve = CandidateCurve {
            radius: None,
            forces: [1e-5, 1e-3],
            points: 24,
        };
        DesignResult {
            curves: vec![curve; curves],
            unknowns: vec![ExpectedResult {
                key: "foundation.substrate.young_modulus".into(),
                unit: "Pa".into(),
                value: 1e9,
                standard_error: error,
                factor: error.map(|error| (2.0 * error).exp()),
                interval: [None, None],
                verdict: verdict.to_string(),
                known_combination: None,
            }],
            nuisances: Vec::new(),
        }
    }

    #[test]
    fn the_fewest_curves_that_determine_the_unknowns_are_advised() {
        let designs = [
            design(3, Some(0.01), Verdict::Identified),
            design(2, Some(0.05), Verdict::Identified),
            design(1, Some(0.2), Verdict::Weak),
        ];
        assert_eq!(chosen(&designs).unwrap().curves.len(), 2);
        let advice = advice(&designs, Advice::ForAPlan);
        assert!(advice.contains("0.01 to 1 mN"), "{advice}");
        assert!(advice.ends_with("± 11 %."), "{advice}");
    }

    #[test]
    fn if_no_design_determines_the_unknowns_more_curves_are_advised_only_if_they_help() {
        let single = design(1, Some(0.2), Verdict::Weak);
        let little = [design(2, Some(0.18), Verdict::Weak), single.clone()];
        assert_eq!(chosen(&little).unwrap().curves.len(), 1);
        let much = [design(2, Some(0.12), Verdict::Weak), single];
        assert_eq!(chosen(&much).unwrap().curves.len(), 2);
        assert!(
            advice(&much, Advice::ForAPlan)
                .contains("None of these designs determines Young's modulus")
        );
    }

    #[test]
    fn no_measurement_is_advised_for_an_unidentifiable_unknown() {
        let never = [design(1, None, Verdict::NotIdentifiable)];
        let advice = advice(&never, Advice::ForAPlan);
        assert!(
            advice.starts_with("Data of this kind cannot determine Young's modulus"),
            "{advice}"
        );
        assert!(!advice.contains("Measure"), "{advice}");
    }
}
