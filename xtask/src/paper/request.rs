//! What is asked of a case of the paper, and what tells one request from another.

use super::PaperCase;

/// What is kept of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// The summary.
    Numbers,
    /// The summary and the fields of every loading step.
    Fields,
}

/// A case at a number of elements.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// The case.
    pub case: PaperCase,
    /// Elements per side.
    pub elements: usize,
    /// Values of the case that are replaced, as `--set` takes them: `load.force=1e-5`.
    pub sets: Vec<String>,
    /// What is kept.
    pub keep: Keep,
}

impl Request {
    /// The numbers of a case as it stands, at this many elements per side.
    #[must_use]
    pub fn numbers(case: PaperCase, elements: usize) -> Self {
        Self {
            case,
            elements,
            sets: Vec::new(),
            keep: Keep::Numbers,
        }
    }

    /// The numbers and the fields of a case as it stands, at this many elements per side.
    #[must_use]
    pub fn fields(case: PaperCase, elements: usize) -> Self {
        Self {
            keep: Keep::Fields,
            ..Self::numbers(case, elements)
        }
    }

    /// The same with one more value replaced.
    #[must_use]
    pub fn with(mut self, set: impl Into<String>) -> Self {
        self.sets.push(set.into());
        self
    }

    /// Every value that is replaced, the number of elements the last.
    #[must_use]
    pub fn overrides(&self) -> Vec<String> {
        let elements = format!("grid.elements={}", self.elements);
        self.sets.iter().cloned().chain([elements]).collect()
    }

    /// The name of its folder: case, elements, a digest of what is replaced, and whether fields are kept.
    #[must_use]
    pub fn folder(&self) -> String {
        let replaced = if self.sets.is_empty() {
            String::new()
        } else {
            format!("-{}", &digest(&[&self.sets.join("\n")])[..8])
        };
        let fields = match self.keep {
            Keep::Numbers => "",
            Keep::Fields => "-fields",
        };
        format!("{}-{}{replaced}{fields}", self.case.name(), self.elements)
    }

    /// For people: `fig2c, 512 × 512 elements, load.force=1e-5`.
    #[must_use]
    pub fn describe(&self) -> String {
        let (name, n) = (self.case.name(), self.elements);
        let grid = [format!("{name}, {n} × {n} elements")];
        let parts: Vec<_> = grid.into_iter().chain(self.sets.iter().cloned()).collect();
        parts.join(", ")
    }
}

/// A digest of texts, as hexadecimal digits; no two lists of texts share one.
pub(super) fn digest(texts: &[&str]) -> String {
    let mut hasher = blake3::Hasher::new();
    for text in texts {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_that_differ_have_folders_that_differ() {
        let plain = Request::numbers(PaperCase::Fig2c, 64);
        let others = [
            Request::numbers(PaperCase::Fig2d, 64),
            Request::numbers(PaperCase::Fig2c, 128),
            Request::fields(PaperCase::Fig2c, 64),
            plain.clone().with("load.force=1e-5"),
            plain.clone().with("load.force=2e-5"),
        ];
        let mut folders: Vec<_> = others.iter().map(Request::folder).collect();
        folders.push(plain.folder());
        folders.sort();
        folders.dedup();
        assert_eq!(folders.len(), 6, "{folders:?}");
        assert_eq!(plain.folder(), "fig2c-64");
    }

    #[test]
    fn the_number_of_elements_overrules_what_is_replaced() {
        let request = Request::numbers(PaperCase::Fig2c, 64).with("grid.elements=8");
        assert_eq!(request.overrides(), ["grid.elements=8", "grid.elements=64"]);
    }

    #[test]
    fn a_digest_knows_where_a_text_ends() {
        assert_ne!(digest(&["ab", "c"]), digest(&["a", "bc"]));
    }
}
