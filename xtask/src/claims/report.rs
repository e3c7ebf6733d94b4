//! What the evidence says of all claims, beside what is recorded.

use std::fmt;
use std::process::ExitCode;

use super::Evaluation;
use super::refinement::Refined;

/// Every claim that was computed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ClaimsReport {
    /// The claims, in the order of the file.
    pub evaluations: Vec<Evaluation>,
    /// Ids of the claims that need finer grids than were asked for.
    pub left_out: Vec<String>,
    /// What was followed over many grids.
    pub(super) refined: Vec<Refined>,
}

impl ClaimsReport {
    /// The claims whose computed verdict is not the one recorded.
    pub fn changed(&self) -> impl Iterator<Item = &Evaluation> {
        self.evaluations
            .iter()
            .filter(|evaluation| !evaluation.is_as_recorded())
    }

    /// Success if every computed verdict is the one recorded, failure if one is not.
    #[must_use]
    pub fn exit_code(&self) -> ExitCode {
        match self.changed().next() {
            None => ExitCode::SUCCESS,
            Some(_) => ExitCode::FAILURE,
        }
    }

    /// A sentence for every verdict that changed: which claim, recorded, computed.
    #[must_use]
    pub fn complaints(&self) -> String {
        let lines = self.changed().map(|evaluation| {
            let (id, recorded) = (&evaluation.claim.id, evaluation.claim.verdict);
            let computed = evaluation.verdict;
            format!("claim `{id}`: recorded as {recorded}, computed as {computed}\n")
        });
        lines.collect()
    }
}

impl fmt::Display for ClaimsReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = |column: &dyn Fn(&Evaluation) -> usize| {
            self.evaluations.iter().map(column).max().unwrap_or(0)
        };
        let id_width = width(&|evaluation| evaluation.claim.id.chars().count());
        let verdict_width = width(&|evaluation| evaluation.verdict.to_string().chars().count());
        for evaluation in &self.evaluations {
            let mark = if evaluation.is_as_recorded() {
                " "
            } else {
                "!"
            };
            let verdict = evaluation.verdict.to_string();
            writeln!(
                f,
                "{mark} {:id_width$}  {verdict:verdict_width$}  {}",
                evaluation.claim.id, evaluation.claim.place
            )?;
            writeln!(f, "    {}", evaluation.claim.sentence)?;
            for (elements, finding) in &evaluation.findings {
                writeln!(f, "    N = {elements:4}: {}", finding.measured)?;
            }
        }
        self.closing(f)
    }
}

impl ClaimsReport {
    fn closing(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.left_out.is_empty() {
            writeln!(
                f,
                "left out, they need the full grids: {}",
                self.left_out.join(", ")
            )?;
        }
        let (all, changed) = (self.evaluations.len(), self.changed().count());
        writeln!(f, "{} of {all} verdicts as recorded", all - changed)
    }
}
