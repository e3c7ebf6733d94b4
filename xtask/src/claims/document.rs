//! `docs/claims.md`: the verdicts with their numbers, where we disagree, what the paper could not do.

use super::file::Source;
use super::refinement::Refined;
use super::{ClaimsFile, ClaimsReport, Contradiction, Evaluation, Verdict};

const OPENING: &str = "\
# The paper's claims

What becomes of each checkable sentence of F. I. Stepanov, E. V. Torskaya, Mech. Solids 57 (2022),
[doi:10.3103/S0025654422010034](https://doi.org/10.3103/S0025654422010034), when its cases are solved again. Written by
`cargo xtask claims`, which computes every verdict afresh from runs of the release binary; the sentences, what decides
each of them, the thresholds and the recorded verdicts are in [claims.toml](claims.toml).

The sentences are in our own words, from notes on the paper: nothing here is a quotation, and places are figures, since
our notes have no section numbers. A verdict is *borne out* if the sentence is true on every grid it was evaluated on,
*not borne out* if on none, *depends on the grid* if on some. Every number comes from a certified solution
(complementarity, gap and load to 1e-8). Lengths are in units of the indenter's radius R, pressures in units of the
coating's modulus E1, for Figs. 5 and 6 in SI units. N is the number of elements per side of the domain.
";

const REFINED: &str = "\
## What the paper could not do: finer grids

Under the edge of a rigid flat punch on an elastic half-space the pressure grows as `ρ^(−1/2)` towards the edge, so the
largest mean over an element of the grid grows as `N^(1/2)`, without end. A layer does not change that at distances
from the edge much shorter than its thickness H. Much farther away a stiff layer on a soft base is a plate, whose edge
carries a line load, and while the elements are that large the largest mean grows up to as fast as `N`; a soft layer on
a stiff base is a foundation of springs there, without any peak.

The cylinders are springs of compliance `η = h / E_a` between indenter and layer. They are as compliant as a half-space
of the layer's material at the wavenumber `1/ℓ`, `ℓ = η E1 / (2 (1 − ν1²))`; for shorter waves they are the more
compliant, and the pressure stays finite at the edge. So the peaks must grow while elements are larger than ℓ, and settle
once they are much smaller. Here h = H and the cylinders are of the layer's material, so ℓ is about half of H, and there is
hardly a range between the two where the exponent 1/2 could be seen.

`grows as` compares a line with the one above; `at r` is the distance of the largest pressure from the axis (the central
element's edge is at r = 0.005); `between` is the share of the contact area that lies between the elements.

";

/// The document over all claims.
pub(super) fn document(file: &ClaimsFile, report: &ClaimsReport) -> String {
    let of = |source| {
        report
            .evaluations
            .iter()
            .filter(move |one| one.claim.source == source)
    };
    [
        format!("{OPENING}\n{}", count(of(Source::Paper))),
        format!("## What the paper says\n\n{}", table(of(Source::Paper))),
        format!(
            "## Where we disagree\n\n{}",
            disagreements(of(Source::Paper))
        ),
        REFINED.to_owned()
            + &report
                .refined
                .iter()
                .map(Refined::markdown)
                .collect::<String>(),
        format!(
            "What follows from it, checked like the paper's sentences:\n\n{}",
            table(of(Source::Pellicle))
        ),
        format!(
            "## Where the paper contradicts itself\n\n{}",
            contradictions(&file.contradictions)
        ),
        format!(
            "## How each is decided\n\n{}",
            decisions(&report.evaluations)
        ),
    ]
    .join("\n")
}

fn count<'a>(evaluations: impl Iterator<Item = &'a Evaluation>) -> String {
    let verdicts: Vec<Verdict> = evaluations.map(|one| one.verdict).collect();
    let of = |wanted| {
        verdicts
            .iter()
            .filter(|&&verdict| verdict == wanted)
            .count()
    };
    format!(
        "Of {} sentences of the paper: borne out {}, not borne out {}, depends on the grid {}.\n",
        verdicts.len(),
        of(Verdict::BorneOut),
        of(Verdict::NotBorneOut),
        of(Verdict::DependsOnTheGrid)
    )
}

fn table<'a>(evaluations: impl Iterator<Item = &'a Evaluation>) -> String {
    let lines = evaluations.map(|one| {
        let claim = &one.claim;
        format!(
            "| `{}` | {} | {} | {} | **{}** |\n",
            claim.id,
            claim.place,
            claim.sentence,
            measured(one),
            one.verdict
        )
    });
    format!(
        "| claim | place | sentence | found | verdict |\n|---|---|---|---|---|\n{}",
        lines.collect::<String>()
    )
}

fn measured(evaluation: &Evaluation) -> String {
    let grids = evaluation
        .findings
        .iter()
        .map(|(n, finding)| format!("N = {n}: {}", finding.measured));
    grids.collect::<Vec<_>>().join("<br>")
}

/// An item for every reason, with all claims that share it.
fn disagreements<'a>(evaluations: impl Iterator<Item = &'a Evaluation>) -> String {
    let contested: Vec<&Evaluation> = evaluations
        .filter(|one| one.verdict != Verdict::BorneOut)
        .collect();
    let same = |one: &&Evaluation, next: &&Evaluation| one.claim.reason == next.claim.reason;
    let items = contested.chunk_by(same).map(|group| {
        let claim = &group[0].claim;
        let found = group.iter().map(|one| {
            let grids = one
                .findings
                .iter()
                .map(|(n, finding)| format!("N = {n}: {}", finding.measured));
            format!(
                "  - {}, `{}`: {}\n",
                one.claim.place,
                one.claim.id,
                grids.collect::<Vec<_>>().join("; ")
            )
        });
        format!(
            "- *{}*: **{}**. {}\n{}",
            claim.sentence,
            group[0].verdict,
            claim.reason,
            found.collect::<String>()
        )
    });
    items.collect()
}

fn contradictions(contradictions: &[Contradiction]) -> String {
    let lines = contradictions
        .iter()
        .map(|one| format!("| {} | {} | {} |\n", one.place, one.paper, one.done));
    format!(
        "| place | the paper | what we did |\n|---|---|---|\n{}",
        lines.collect::<String>()
    )
}

fn decisions(evaluations: &[Evaluation]) -> String {
    let lines = evaluations.iter().map(|one| {
        let claim = &one.claim;
        format!(
            "| `{}` | {} | {} | {} | {} |\n",
            claim.id, claim.quantity, claim.threshold, claim.because, claim.reason
        )
    });
    format!(
        "| claim | quantity | threshold | why that | why the verdict |\n|---|---|--:|---|---|\n{}",
        lines.collect::<String>()
    )
}
