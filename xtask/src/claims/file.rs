//! `docs/claims.toml`: the sentences, what decides each of them, and the verdicts recorded.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::{Checker, ClaimsError, Verdict};

/// The file of claims.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimsFile {
    /// The sentences.
    #[serde(rename = "claim")]
    claims: Vec<Spanned<Claim>>,
    /// Where the paper says two things.
    #[serde(rename = "contradiction", default)]
    pub(super) contradictions: Vec<Contradiction>,
    /// What is followed over many grids.
    #[serde(rename = "refinement", default)]
    pub(super) refinements: Vec<Refinement>,
}

/// Whose sentence a claim is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// The paper's, in our words.
    #[default]
    Paper,
    /// Ours, about something the paper could not compute.
    Pellicle,
}

/// One checkable sentence.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Its name, for `--only`.
    pub id: String,
    /// Where the paper says it.
    pub place: String,
    /// Whose sentence it is.
    #[serde(default)]
    pub source: Source,
    /// What it says, in our words.
    pub sentence: String,
    /// The quantity that decides it.
    pub quantity: String,
    /// The check that computes the quantity.
    pub checker: Checker,
    /// The cases it looks at, `NAME` or `NAME:STEP`.
    pub cases: Vec<String>,
    /// Values of the cases that are replaced, as `--set` takes them.
    #[serde(default)]
    pub set: Vec<String>,
    /// Elements per side of the grids it is evaluated on.
    pub elements: Vec<usize>,
    /// The same for `--quick`; without them the claim needs the full grids and `--quick` leaves it out.
    #[serde(default)]
    pub quick: Vec<usize>,
    /// Where the quantity turns the verdict.
    pub threshold: f64,
    /// Why the threshold is what it is.
    pub because: String,
    /// The verdict recorded.
    pub verdict: Verdict,
    /// Why the verdict is what it is.
    pub reason: String,
}

/// Two statements of the paper that exclude each other.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contradiction {
    /// Where.
    pub place: String,
    /// What the paper says, in our words.
    pub paper: String,
    /// What we did.
    pub done: String,
}

/// A case whose peak and contact are followed over many grids.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refinement {
    /// The case.
    pub case: String,
    /// Values of the case that are replaced, as `--set` takes them.
    #[serde(default)]
    pub set: Vec<String>,
    /// What it is, for the heading of its table.
    pub title: String,
    /// Elements per side, each grid finer than the one before.
    pub elements: Vec<usize>,
}

impl ClaimsFile {
    /// Reads and checks the file of claims.
    ///
    /// # Errors
    /// [`ClaimsError::Read`] if it cannot be read, [`ClaimsError::Syntax`] with the place of what is not understood,
    /// [`ClaimsError::Claim`] with the line of a claim that is incomplete or contradicts itself.
    pub fn read(path: &Path) -> Result<Self, ClaimsError> {
        let text = std::fs::read_to_string(path).map_err(|source| ClaimsError::Read {
            path: path.into(),
            source,
        })?;
        Self::parse(&text)
    }

    /// The same for a text.
    ///
    /// # Errors
    /// As [`ClaimsFile::read`], but for reading.
    pub fn parse(text: &str) -> Result<Self, ClaimsError> {
        let file: Self = toml::from_str(text)?;
        let mut seen = BTreeSet::new();
        for spanned in &file.claims {
            let claim = spanned.get_ref();
            let problem = claim.problem().or_else(|| {
                let repeated = !seen.insert(claim.id.as_str());
                repeated.then(|| "its id stands twice, ids must differ".to_owned())
            });
            if let Some(problem) = problem {
                let line = 1 + text[..spanned.span().start].matches('\n').count();
                let id = claim.id.clone();
                return Err(ClaimsError::Claim { id, line, problem });
            }
        }
        Ok(file)
    }

    /// The claims, in the order of the file.
    pub fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.claims.iter().map(Spanned::get_ref)
    }

    /// The claims with one of these names, or all without any.
    ///
    /// # Errors
    /// [`ClaimsError::Unknown`] for a name that no claim has.
    pub(super) fn chosen(&self, names: &[String]) -> Result<Vec<&Claim>, ClaimsError> {
        let unknown = names
            .iter()
            .find(|name| !self.claims().any(|claim| claim.is_named(name)));
        if let Some(found) = unknown {
            let known: Vec<&str> = self.claims().map(|claim| claim.id.as_str()).collect();
            return Err(ClaimsError::Unknown {
                found: found.clone(),
                known: known.join(", "),
            });
        }
        let is_chosen =
            |claim: &&Claim| names.is_empty() || names.iter().any(|name| claim.is_named(name));
        Ok(self.claims().filter(is_chosen).collect())
    }
}

impl Claim {
    /// Whether `name` is the claim's id or the beginning of it, up to a hyphen.
    pub(super) fn is_named(&self, name: &str) -> bool {
        let rest = self.id.strip_prefix(name);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
    }

    /// What is wrong with it: found and wanted.
    fn problem(&self) -> Option<String> {
        let texts = [
            &self.id,
            &self.place,
            &self.sentence,
            &self.quantity,
            &self.because,
            &self.reason,
        ];
        if texts.iter().any(|text| text.trim().is_empty()) {
            return Some("one of its texts is empty".to_owned());
        }
        let [found, wanted] = [self.cases.len(), self.checker.check().cases()];
        if found != wanted {
            return Some(format!(
                "it names {found} cases, its checker looks at {wanted}"
            ));
        }
        if let Some(grids) = [&self.elements, &self.quick]
            .into_iter()
            .find(|grids| !is_refined(grids))
        {
            return Some(format!(
                "its grids are {grids:?}, at least two are wanted, each finer than the one before"
            ));
        }
        if self.elements.is_empty() {
            return Some("it has no grids, at least two are wanted".to_owned());
        }
        (!self.threshold.is_finite())
            .then(|| format!("its threshold is {}, a number is wanted", self.threshold))
    }
}

/// Whether a list of grids is empty, or of two or more that become finer.
fn is_refined(grids: &[usize]) -> bool {
    grids.len() != 1 && grids.windows(2).all(|pair| pair[0] < pair[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
[[claim]]
id = "2a-tops"
place = "Fig. 2(a)"
sentence = "contact is on the elements only"
quantity = "share between"
checker = "only-elements-touch"
cases = ["fig2a"]
elements = [512, 1024]
quick = [64, 128]
threshold = 1e-3
because = "a thousandth cannot be seen"
verdict = "borne out"
reason = "the share is nothing"
"#;

    fn complaint(text: &str) -> String {
        ClaimsFile::parse(text)
            .expect_err("the text is wrong")
            .to_string()
    }

    #[test]
    fn a_complete_claim_is_read() {
        let file = ClaimsFile::parse(GOOD).unwrap();
        let claim = file.claims().next().unwrap();
        assert_eq!(
            (claim.checker, claim.verdict),
            (Checker::OnlyElementsTouch, Verdict::BorneOut)
        );
        assert_eq!(claim.source, Source::Paper);
    }

    #[test]
    fn an_unknown_checker_verdict_or_key_is_named_with_its_line() {
        for (good, bad, line) in [
            ("only-elements-touch", "tops-touch", "line 7"),
            ("borne out", "true", "line 13"),
            ("threshold", "treshold", "line 11"),
        ] {
            let complaint = complaint(&GOOD.replacen(good, bad, 1));
            assert!(
                complaint.contains(line) && complaint.contains(bad),
                "{complaint}"
            );
        }
    }

    #[test]
    fn a_claim_on_one_grid_or_on_no_finer_one_is_refused() {
        for bad in ["[512]", "[1024, 512]", "[]"] {
            let complaint = complaint(&GOOD.replacen("[512, 1024]", bad, 1));
            assert!(
                complaint.contains("2a-tops") && complaint.contains("line 2"),
                "{complaint}"
            );
        }
    }

    #[test]
    fn a_claim_with_too_many_cases_or_an_empty_reason_is_refused() {
        let two = complaint(&GOOD.replacen(r#"["fig2a"]"#, r#"["fig2a", "fig2b"]"#, 1));
        assert!(
            two.contains("it names 2 cases, its checker looks at 1"),
            "{two}"
        );
        let empty = complaint(&GOOD.replacen("the share is nothing", " ", 1));
        assert!(empty.contains("one of its texts is empty"), "{empty}");
    }

    #[test]
    fn an_id_that_stands_twice_is_refused_at_its_second_place() {
        let complaint = complaint(&format!("{GOOD}{GOOD}"));
        assert!(
            complaint.contains("line 16") && complaint.contains("twice"),
            "{complaint}"
        );
    }

    #[test]
    fn a_name_is_an_id_or_the_beginning_of_one() {
        let file = ClaimsFile::parse(GOOD).unwrap();
        let claim = file.claims().next().unwrap();
        assert!(claim.is_named("2a") && claim.is_named("2a-tops"));
        assert!(!claim.is_named("2") && !claim.is_named("2a-top"));
    }
}
